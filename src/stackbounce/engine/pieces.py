"""Contacts whose loading curve has several pieces, each a polynomial of the compression.

A piece is told by four numbers: the compression x at which it begins, and the coefficients of

    F = k (a + b (c - x) + s (c - x)^2).

The last piece has no end. Unloading, which begins at the peak C with the force F, follows one of

- the loading curve itself, if all energy is returned;
- the loading curve times (c/C)^m, where m is such that a given share of the work is returned;
- pieces of its own, F (a + b (y - x) + s (y - x)^2) with y = c/C, from y = 0 to F at y = 1. Where
  they would lie above the loading curve, from another peak than that at which they were measured,
  it is the loading curve times (c/C)^m again, with the share of work that they return from theirs.

In the first piece F(0) = 0. All pieces are continued by the next, so that the force is continuous.
Where a compression passes from one piece into the next is an event (CROSSED): inside a piece the
motion is analytic.
"""

import math

from stackbounce.engine.codes import PIECEWISE
from stackbounce.engine.elementary import power
from stackbounce.engine.kernels import kernel
from stackbounce.engine.stack import MOST_PIECES, PIECE_NUMBERS, Stack

_BEGIN, _CONSTANT, _SLOPE, _SQUARE = 0, 1, 2, 3  # numbers of a piece
_HALVINGS = 60
_STEPS = 50  # of the search for an exponent, which takes about six
_CLOSE = 1e-15  # of an exponent
_TOUCHES = 1e-9  # of the peak force: curves that are the same but for round-off


@kernel
def take_two_stages(stack: Stack, i: int, knee: float, softening: float, returned: float) -> None:
    """Give contact i a loading curve of two straight pieces: c up to ``knee``, then softer."""
    _put_piece(stack, i, 0, 0.0, 0.0, 1.0, 0.0)
    _put_piece(stack, i, 1, knee, knee, softening, 0.0)
    take_table(stack, i, 2, 0, returned)


@kernel
def take_table(stack: Stack, i: int, loading: int, unloading: int, returned: float) -> None:
    """Give contact i the loading and unloading pieces that ``stack.pieces`` holds already."""
    stack.law[i] = PIECEWISE
    stack.loading_pieces[i] = loading
    stack.unloading_pieces[i] = unloading
    stack.returned[i] = returned
    stack.exponent[i] = 1.0
    stack.unloading[i] = 1.0
    stack.factor_exponent[i] = 0.0
    stack.curve_force[i] = stack.stiffness[i]
    stack.curve_unit[i] = 1.0
    stack.curve_exponent[i] = 0.0
    stack.top[i] = math.inf
    stack.rescaled[i] = 0
    take_piece(stack, i, 0)


@kernel
def _put_piece(
    stack: Stack, i: int, j: int, begin: float, constant: float, slope: float, square: float
) -> None:
    at = (i * MOST_PIECES + j) * PIECE_NUMBERS
    stack.pieces[at + _BEGIN] = begin
    stack.pieces[at + _CONSTANT] = constant
    stack.pieces[at + _SLOPE] = slope
    stack.pieces[at + _SQUARE] = square


@kernel
def has_one_curve(stack: Stack, i: int) -> bool:
    """Tell whether piecewise contact i unloads along its loading curve."""
    return stack.unloading_pieces[i] == 0 and stack.returned[i] >= 1.0


@kernel
def _range(stack: Stack, i: int) -> tuple[int, int, float]:
    """Return the first piece of the present curve, their number, and the unit of their knots."""
    if stack.rescaled[i] == 1:
        return stack.loading_pieces[i], stack.unloading_pieces[i], stack.curve_unit[i]
    return 0, stack.loading_pieces[i], 1.0


@kernel
def take_piece(stack: Stack, i: int, j: int) -> None:
    """Set the gain of contact i to piece j of its present curve."""
    first, count, unit = _range(stack, i)
    at = (i * MOST_PIECES + first + j) * PIECE_NUMBERS
    stack.piece[i] = j
    stack.gain_origin[i] = stack.pieces[at + _BEGIN] * unit
    stack.gain_constant[i] = stack.pieces[at + _CONSTANT]
    stack.gain_slope[i] = stack.pieces[at + _SLOPE] / unit
    stack.gain_square[i] = stack.pieces[at + _SQUARE] / unit / unit
    stack.piece_low[i] = stack.gain_origin[i]
    stack.piece_high[i] = math.inf
    if j + 1 < count:
        stack.piece_high[i] = stack.pieces[at + PIECE_NUMBERS + _BEGIN] * unit


@kernel
def find_piece(stack: Stack, i: int, compression: float) -> None:
    """Set the gain of contact i to the piece of its present curve at a compression."""
    j = 0
    take_piece(stack, i, 0)
    while compression >= stack.piece_high[i]:
        j += 1
        take_piece(stack, i, j)


@kernel
def cross_knot(stack: Stack, i: int) -> None:
    """Pass from the present piece of contact i, anchored now, into that beyond the nearer knot."""
    c = stack.compression[i]
    up = abs(stack.piece_high[i] - c) < abs(c - stack.piece_low[i])
    take_piece(stack, i, stack.piece[i] + 1 if up else max(0, stack.piece[i] - 1))


@kernel
def _sum_of_pieces(
    stack: Stack, i: int, first: int, count: int, unit: float, m: float, c: float
) -> float:
    """Return the integral from 0 to c of (y/c)^m times the pieces, whose knots have a unit."""
    total = 0.0
    for j in range(count):
        at = (i * MOST_PIECES + first + j) * PIECE_NUMBERS
        low, high = stack.pieces[at + _BEGIN] * unit, c
        if low >= c:
            break
        if j + 1 < count:
            high = min(c, stack.pieces[at + PIECE_NUMBERS + _BEGIN] * unit)
        constant = stack.pieces[at + _CONSTANT]
        slope = stack.pieces[at + _SLOPE] / unit
        square = stack.pieces[at + _SQUARE] / unit / unit
        if m == 0.0:
            width = high - low
            total += width * (constant + width * (0.5 * slope + width * square / 3.0))
            continue
        constant -= low * (slope - low * square)  # about 0
        slope -= 2.0 * low * square
        constant, slope, square = constant / (m + 1.0), slope / (m + 2.0), square / (m + 3.0)
        total += high * (constant + high * (slope + high * square)) * power(high / c, m)
        if low > 0.0:
            total -= low * (constant + low * (slope + low * square)) * power(low / c, m)
    return total


@kernel
def curve_work(stack: Stack, i: int, c: float) -> float:
    """Return the integral from 0 to c of the force of contact i on its present curve."""
    if c <= 0.0:
        return 0.0
    first, count, unit = _range(stack, i)
    m = stack.curve_exponent[i]
    work = stack.curve_force[i] * _sum_of_pieces(stack, i, first, count, unit, m, c)
    return work if m == 0.0 else work * power(c / stack.curve_unit[i], m)


@kernel
def energy_given_back(stack: Stack, i: int, c: float, pressing: float) -> float:
    """Return the energy that contact i, with the force ``pressing``, would now give back."""
    if stack.top[i] < math.inf or has_one_curve(stack, i):
        return curve_work(stack, i, c)
    if may_rescale(stack, i, c, pressing):
        return pressing * _rescaled_work(stack, i, c)
    return stack.returned[i] * curve_work(stack, i, c)


@kernel
def _rescaled_work(stack: Stack, i: int, c: float) -> float:
    """Return the work of the unloading pieces of contact i from a peak c, over its force."""
    first, count = stack.loading_pieces[i], stack.unloading_pieces[i]
    return _sum_of_pieces(stack, i, first, count, c, 0.0, c)


@kernel
def may_rescale(stack: Stack, i: int, c: float, pressing: float) -> bool:
    """Tell whether contact i, on its loading curve, may unload from a peak on its own pieces.

    That is so if they return no more than the work done, and lie below the loading curve where a
    piece of either begins.
    """
    first, count = stack.loading_pieces[i], stack.unloading_pieces[i]
    if count == 0 or c <= 0.0:
        return False
    if pressing * _rescaled_work(stack, i, c) > curve_work(stack, i, c):
        return False
    for j in range(first + count):
        knot = stack.pieces[(i * MOST_PIECES + j) * PIECE_NUMBERS + _BEGIN]
        if j >= first:
            knot *= c
        if knot >= c:
            continue
        below = pressing * _value(stack, i, first, count, c, knot)
        above = stack.stiffness[i] * _value(stack, i, 0, first, 1.0, knot)
        if below > above + _TOUCHES * pressing:
            return False
    return True


@kernel
def _value(stack: Stack, i: int, first: int, count: int, unit: float, c: float) -> float:
    """Return the value of pieces at a compression, their knots having a unit."""
    j = 0
    at = (i * MOST_PIECES + first) * PIECE_NUMBERS
    while j + 1 < count and stack.pieces[at + PIECE_NUMBERS + _BEGIN] * unit <= c:
        j += 1
        at += PIECE_NUMBERS
    y = c / unit - stack.pieces[at + _BEGIN]
    slope = stack.pieces[at + _SLOPE] + y * stack.pieces[at + _SQUARE]
    return stack.pieces[at + _CONSTANT] + y * slope


@kernel
def unloading_factor(stack: Stack, i: int, c: float) -> float:
    """Return the exponent m of the factor (x/c)^m with which contact i unloads from its peak c.

    The inverse of the share of the work that is returned grows almost linearly with m; for one
    straight piece it is (m + 2)/2. The search is a secant method in this variable.
    """
    count = stack.loading_pieces[i]
    work = _sum_of_pieces(stack, i, 0, count, 1.0, 0.0, c)
    asked = 1.0 / stack.returned[i]
    before, excess = 0.0, 1.0 - asked
    m = 2.0 * asked - 2.0
    for _ in range(_STEPS):
        now = work / _sum_of_pieces(stack, i, 0, count, 1.0, m, c) - asked
        if now == excess:
            break
        following = max(0.0, m - now * (m - before) / (now - excess))
        before, excess = m, now
        change = abs(following - m)
        m = following
        if change <= _CLOSE * m:
            break
    return m


@kernel
def compression_of_work(stack: Stack, i: int, work: float) -> float:
    """Return about the compression at which contact i has taken up ``work`` along its curve."""
    low, high = 0.0, 1.0
    while curve_work(stack, i, high) > work and high > 0.0:
        high *= 0.5
    while curve_work(stack, i, high) < work and high < math.inf:
        low, high = high, 2.0 * high
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        if curve_work(stack, i, middle) < work:
            low = middle
        else:
            high = middle
    return high


@kernel
def compression_of_force(stack: Stack, i: int, pressing: float) -> float:
    """Return the compression at which contact i, on its present curve, has a force."""
    first, count, unit = _range(stack, i)
    low, high, j = 0.0, math.inf, 0
    while high == math.inf and j + 1 < count:
        knot = stack.pieces[(i * MOST_PIECES + first + j + 1) * PIECE_NUMBERS] * unit
        if _force_at(stack, i, knot, j) >= pressing:
            high = knot
        else:
            low = knot
            j += 1
    if high == math.inf:
        high = max(2.0 * low, stack.scale[i])
        while _force_at(stack, i, high, j) < pressing and high < math.inf:
            high *= 2.0
    for _ in range(2 * _HALVINGS):
        middle = 0.5 * (low + high)
        if _force_at(stack, i, middle, j) < pressing:
            low = middle
        else:
            high = middle
    return 0.5 * (low + high)


@kernel
def _force_at(stack: Stack, i: int, c: float, j: int) -> float:
    """Return the force of contact i at a compression on piece j of its present curve."""
    first, _, unit = _range(stack, i)
    at = (i * MOST_PIECES + first + j) * PIECE_NUMBERS
    y = c / unit - stack.pieces[at + _BEGIN]
    gain = stack.pieces[at + _CONSTANT]
    gain += y * (stack.pieces[at + _SLOPE] + y * stack.pieces[at + _SQUARE])
    m = stack.curve_exponent[i]
    factor = 1.0 if m == 0.0 else power(c / stack.curve_unit[i], m)
    return stack.curve_force[i] * factor * gain
