"""Contacts with hysteresis: what they remember when they are compressed again before they open.

Such a contact is a bundle of elements. The element l touches when the compression rises through l,
carries the part dL(l) of the loading curve L, and parts when the compression falls through l. Below
the highest compression H since it touched it carries its part times the share r(c/H), on the way
out and in again. Once it has parted it has forgotten H, so that

    F(c) = integral over l from 0 to c of r(c/H(l)) dL(l).

At the first loading H = c and F = L. From the peak C all elements unload together: F = L r(c/C).
Turning points in between form cycles inside one another, C > h1 > h2 ... and l1 < l2 < ...: the
elements from l(j) to l(j+1) remember h(j), and those above the last one are on the loading curve,
or on the way out from the last peak:

    F = sum over j of (L(l(j+1)) - L(l(j))) r(c/h(j)) + (L(c) - L(l)) (1 or r(c/h)).

A cycle is closed, and forgotten, when the compression comes back to the turning point before last
(RETURNED). Each element loses energy in every cycle, and gains none, where r rises. A contact that
just opens and one that just does not are the same: of this, the force is a continuous function of
the whole path of the compression. It is the Preisach model for this share of elements.

The share is r = f + g (c/H)^M: f = 0, g = 1, and M = n - p for k c^p in and k C^p (c/C)^n out
(HYSTERETIC); see `pieces` for the others (PIECEWISE). The elements that remember a peak therefore
add ``offset + held_force (c/held_unit)^M`` to the force.

Of cycles inside one another `TURNS` are remembered. From the next one on, the elements that touched
in between remember the innermost of these peaks, which is above their own: they carry less.
"""

import math

from stackbounce.engine.codes import COMPRESSING, HYSTERETIC, PIECEWISE, RELEASING
from stackbounce.engine.elementary import power
from stackbounce.engine.kernels import kernel
from stackbounce.engine.pieces import (
    find_piece,
    has_one_curve,
    lost_share,
    piece_share,
    pieces_moment,
    pieces_value,
)
from stackbounce.engine.slots import WORK
from stackbounce.engine.stack import TURNS, Stack
from stackbounce.engine.work import CYCLE

_HALVINGS = 120  # of a range of compressions: they reach the last bit from far away, too


@kernel
def has_hysteresis(stack: Stack, i: int) -> bool:
    """Return whether contact i unloads along another curve than it loads."""
    if stack.law[i] == PIECEWISE:
        return not has_one_curve(stack, i)
    return stack.law[i] == HYSTERETIC


@kernel
def lowest_compression(stack: Stack, i: int) -> float:
    """Return the compression at which the present curve of contact i ends downwards."""
    depth = stack.depth[i]
    return stack.lows[i * TURNS + depth - 1] if depth > 0 else 0.0


@kernel
def begin_loading(stack: Stack, i: int) -> None:
    """Let contact i forget all its peaks."""
    stack.depth[i] = 0
    _go_on_loading(stack, i)


@kernel
def turn_out(stack: Stack, i: int, c: float) -> None:
    """Let contact i, which stops loading, begin to unload from the peak c."""
    while stack.depth[i] > 0 and c >= stack.highs[i * TURNS + stack.depth[i] - 1]:
        stack.depth[i] -= 1
    stack.phase[i] = RELEASING
    stack.top[i] = c


@kernel
def turn_in(stack: Stack, i: int, c: float) -> None:
    """Let contact i, which stops unloading, begin to load from c."""
    if c > lowest_compression(stack, i):
        if stack.depth[i] < TURNS:
            stack.highs[i * TURNS + stack.depth[i]] = stack.top[i]
            stack.depth[i] += 1
        stack.lows[i * TURNS + stack.depth[i] - 1] = c
    _go_on_loading(stack, i)


@kernel
def return_to_turn(stack: Stack, i: int) -> None:
    """Let contact i forget the cycle that is closed now, and go on as before it."""
    depth = max(0, stack.depth[i] - 1)
    stack.depth[i] = depth
    if stack.phase[i] == RELEASING:
        stack.top[i] = stack.highs[i * TURNS + depth]
    else:
        _go_on_loading(stack, i)


@kernel
def _go_on_loading(stack: Stack, i: int) -> None:
    depth = stack.depth[i]
    stack.phase[i] = COMPRESSING
    stack.top[i] = stack.highs[i * TURNS + depth - 1] if depth > 0 else math.inf


@kernel
def count_cycles(stack: Stack, i: int) -> None:
    """Add to the work of a run what it costs to go through the cycles of contact i."""
    stack.counter[WORK] += CYCLE * (stack.depth[i] + 1) * (stack.loading_pieces[i] + 1)


@kernel
def take_shares(stack: Stack, i: int, c: float, up: bool) -> None:
    """Set what the elements of contact i that remember a peak add to its force at c.

    A piecewise contact takes the pieces at c, too, above it if the compression goes up.
    """
    depth, out = stack.depth[i], stack.phase[i] == RELEASING
    count_cycles(stack, i)
    pieces = stack.law[i] == PIECEWISE
    if pieces:
        find_piece(stack, i, c, up)
    stack.flat[i] = 0.0
    unit = stack.top[i] if stack.top[i] < math.inf else 1.0
    offset, held, before = 0.0, 0.0, 0.0
    for j in range(depth + 1 if out else depth):
        peak, upto = unit, 0.0
        if j < depth:
            peak, upto = stack.highs[i * TURNS + j], stack.lows[i * TURNS + j]
            upto = loading_force(stack, i, upto)
        f, g, low, high = _share(stack, i, peak, c, up)
        stack.piece_low[i] = max(stack.piece_low[i], low)
        stack.piece_high[i] = min(stack.piece_high[i], high)
        if j == depth and pieces:
            stack.flat[i] = stack.stiffness[i] * f
            stack.curve_force[i] = stack.stiffness[i] * g
        offset += (upto - before) * f
        held += (upto - before) * g * power(unit / peak, stack.loss_exponent[i])
        before = upto
    offset -= before
    stack.offset[i] = offset
    stack.held_force[i] = held
    stack.held_unit[i] = unit


@kernel
def _share(
    stack: Stack, i: int, peak: float, c: float, up: bool
) -> tuple[float, float, float, float]:
    """Return f and g of the share of elements that remember a peak, and the ends of its piece."""
    if stack.law[i] == HYSTERETIC:
        return 0.0, 1.0, 0.0, math.inf
    if stack.returned[i] > 0.0:
        g = lost_share(stack, i, peak)
        return 1.0 - g, g, 0.0, math.inf
    return piece_share(stack, i, peak, c, up)


@kernel
def loading_force(stack: Stack, i: int, c: float) -> float:
    """Return the force of contact i at its first loading."""
    if stack.law[i] == PIECEWISE:
        return stack.stiffness[i] * pieces_value(stack, i, c)
    return stack.stiffness[i] * power(c, stack.exponent[i])


@kernel
def _moment(stack: Stack, i: int, m: float, unit: float, low: float, high: float) -> float:
    """Return the integral of (c/unit)^m times the loading curve of contact i over c."""
    if stack.law[i] == PIECEWISE:
        return stack.stiffness[i] * pieces_moment(stack, i, m, unit, low, high)
    total = high * loading_force(stack, i, high) * power(high / unit, m)
    if low > 0.0:
        total -= low * loading_force(stack, i, low) * power(low / unit, m)
    return total / (stack.exponent[i] + m + 1.0)


@kernel
def _shared_work(stack: Stack, i: int, peak: float, low: float, high: float) -> tuple[float, float]:
    """Return the integrals of r(c/peak) L(c) and of r(c/peak) from ``low`` to ``high``."""
    work, length, m = 0.0, 0.0, stack.loss_exponent[i]
    a = low
    while a < high:
        f, g, _, end = _share(stack, i, peak, a, True)
        b = min(high, end) if end > a else high
        ahead, behind = power(b / peak, m), power(a / peak, m)
        length += f * (b - a) + g * (ahead * b - behind * a) / (m + 1.0)
        work += g * _moment(stack, i, m, peak, a, b)
        if f != 0.0:
            work += f * _moment(stack, i, 0.0, 1.0, a, b)
        a = b
    return work, length


@kernel
def returned_work(stack: Stack, i: int, c: float) -> float:
    """Return the work that contact i, with hysteresis, would do from c until it opens."""
    total, low, before, depth = 0.0, 0.0, 0.0, stack.depth[i]
    for j in range(depth + 1):
        high, peak = c, stack.top[i] if stack.phase[i] == RELEASING else c
        if j < depth:
            high, peak = stack.lows[i * TURNS + j], stack.highs[i * TURNS + j]
        work, length = _shared_work(stack, i, peak, low, high)
        total += work - before * length
        if j < depth:
            upto = loading_force(stack, i, high)
            _, length = _shared_work(stack, i, peak, high, c)
            total += (upto - before) * length
            low, before = high, upto
    return total


@kernel
def loading_compression(stack: Stack, i: int, pressing: float) -> float:
    """Return the compression at which the loading curve of contact i has a force."""
    if stack.law[i] == HYSTERETIC:
        return power(pressing / stack.stiffness[i], 1.0 / stack.exponent[i])
    low, high = 0.0, stack.scale[i]
    while loading_force(stack, i, high) < pressing and high < math.inf:
        low, high = high, 2.0 * high
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        if loading_force(stack, i, middle) < pressing:
            low = middle
        else:
            high = middle
    return 0.5 * (low + high)
