"""Contacts whose loading curve has several pieces, each a polynomial of the compression.

A piece has four numbers: the compression x at which it begins, and the coefficients of

    F = k (a + b (c - x) + s (c - x)^2).

The last piece has no end. In the first one F(0) = 0. All pieces are continued by the next, so that
the force is continuous. Unloading from the peak C follows the loading curve times a share r(c/C)
that rises to 1 at the peak, see `cycles`. This share is

- 1 if all energy is returned;
- 1 - g + g (c/C)^M, where g is such that a given share e^2 of the work is returned. The exponent M
  is (P + 1) (1/e^2 - 1), where no loading curve is steeper than c^P seen from 0: the work W up to
  c is at least c F/(P + 1), so that g is at most 1;
- straight pieces of its own, over c/C, each of which has four numbers as well.

Where a compression passes from one piece into the next is an event (CROSSED): inside a piece the
motion is analytic.
"""

import math

from stackbounce.engine.codes import EPSILON, PIECEWISE
from stackbounce.engine.elementary import power
from stackbounce.engine.kernels import kernel
from stackbounce.engine.stack import MOST_PIECES, PIECE_NUMBERS, Stack

_HALVINGS = 60  # of a range of compressions whose ends are a factor of 2 apart
_ROUND_OFF = 4.0 * EPSILON  # of a share


@kernel
def take_two_stages(stack: Stack, i: int, knee: float, softening: float, returned: float) -> None:
    """Give contact i a loading curve of two straight pieces: c up to ``knee``, then softer."""
    _put_straight(stack, i, 0, 0.0, 1.0)
    _put_straight(stack, i, 1, knee, softening)
    take_table(stack, i, 2, 2.0 * (1.0 / returned - 1.0), returned)


@kernel
def take_table(stack: Stack, i: int, loading: int, loss: float, returned: float) -> None:
    """Give contact i the loading pieces that ``stack.pieces`` holds already.

    If ``returned`` is 0, ``loss`` is the number of pieces of the share, which follow them; else it
    is the exponent M.
    """
    stack.law[i] = PIECEWISE
    stack.loading_pieces[i] = loading
    stack.unloading_pieces[i] = int(loss) if returned == 0.0 else 0
    stack.loss_exponent[i] = 1.0 if returned == 0.0 else loss
    stack.returned[i] = returned
    stack.exponent[i] = 1.0
    stack.unloading[i] = 1.0
    stack.factor_exponent[i] = 0.0
    stack.curve_force[i] = stack.stiffness[i]
    stack.curve_unit[i] = 1.0
    stack.curve_exponent[i] = 0.0
    stack.top[i] = math.inf
    find_piece(stack, i, 0.0, True)


@kernel
def _put_straight(stack: Stack, i: int, j: int, begin: float, slope: float) -> None:
    """Give contact i a straight piece that begins where the first one, c, is."""
    at = (i * MOST_PIECES + j) * PIECE_NUMBERS
    stack.pieces[at] = stack.pieces[at + 1] = begin
    stack.pieces[at + 2] = slope
    stack.pieces[at + 3] = 0.0


@kernel
def _piece(stack: Stack, i: int, j: int) -> tuple[float, float, float, float]:
    """Return the four numbers of a piece of contact i: x, a, b and s."""
    at = (i * MOST_PIECES + j) * PIECE_NUMBERS
    return stack.pieces[at], stack.pieces[at + 1], stack.pieces[at + 2], stack.pieces[at + 3]


@kernel
def _end(stack: Stack, i: int, j: int, last: int) -> float:
    """Return the compression at which a piece of contact i ends; the last of its curve has none."""
    return stack.pieces[(i * MOST_PIECES + j + 1) * PIECE_NUMBERS] if j < last else math.inf


@kernel
def has_one_curve(stack: Stack, i: int) -> bool:
    """Return whether piecewise contact i unloads along its loading curve."""
    return stack.returned[i] >= 1.0


@kernel
def _piece_at(stack: Stack, i: int, first: int, count: int, unit: float, c: float, up: bool) -> int:
    """Return the index of the piece, of ``count`` from ``first`` on, that holds c.

    The pieces begin at compressions in a unit. Where one piece ends and the next begins, that is
    the next one if the compression goes up.
    """
    j, last = first, first + count - 1
    while j < last:
        end = _end(stack, i, j, last) * unit
        if end > c or (end == c and not up):
            break
        j += 1
    return j


@kernel
def find_piece(stack: Stack, i: int, c: float, up: bool) -> None:
    """Set the gain of contact i to the piece of its loading curve at a compression."""
    count = stack.loading_pieces[i]
    j = _piece_at(stack, i, 0, count, 1.0, c, up)
    begin, constant, slope, square = _piece(stack, i, j)
    stack.gain_origin[i], stack.gain_constant[i] = begin, constant
    stack.gain_slope[i], stack.gain_square[i] = slope, square
    stack.piece_low[i], stack.piece_high[i] = begin, _end(stack, i, j, count - 1)


@kernel
def crossed_knot(stack: Stack, i: int) -> tuple[float, bool]:
    """Return the knot that contact i, anchored now, has come to, and whether from below."""
    c = stack.compression[i]
    up = abs(stack.piece_high[i] - c) < abs(c - stack.piece_low[i])
    return (stack.piece_high[i] if up else stack.piece_low[i]), up


@kernel
def piece_share(
    stack: Stack, i: int, peak: float, c: float, up: bool
) -> tuple[float, float, float, float]:
    """Return f and g of the share f + g c/C of a measured contact, and the ends of their piece."""
    first, count = stack.loading_pieces[i], stack.unloading_pieces[i]
    j = _piece_at(stack, i, first, count, peak, c, up)
    begin, constant, slope, _ = _piece(stack, i, j)
    end = _end(stack, i, j, first + count - 1)
    return constant - slope * begin, slope, begin * peak, end * peak


@kernel
def lost_share(stack: Stack, i: int, peak: float) -> float:
    """Return g of the share 1 - g + g (c/C)^M with which contact i returns e^2 of its work."""
    left = pieces_moment(stack, i, stack.loss_exponent[i], peak, 0.0, peak)
    whole = pieces_work(stack, i, peak)
    lost = (1.0 - stack.returned[i]) / (1.0 - left / whole)
    return lost if lost < 1.0 - _ROUND_OFF else 1.0


@kernel
def pieces_work(stack: Stack, i: int, c: float) -> float:
    """Return the work of the first loading up to c, over the stiffness."""
    return pieces_moment(stack, i, 0.0, 1.0, 0.0, c)


@kernel
def pieces_moment(stack: Stack, i: int, m: float, unit: float, low: float, high: float) -> float:
    """Return the integral of (c/unit)^m times the loading curve over c, over the stiffness."""
    total, count = 0.0, stack.loading_pieces[i]
    for j in range(count):
        begin, constant, slope, square = _piece(stack, i, j)
        a, b = max(low, begin), min(high, _end(stack, i, j, count - 1))
        if a >= b:
            continue
        if m == 0.0:
            far, near = b - begin, a - begin
            total += far * (constant + far * (0.5 * slope + far * square / 3.0))
            total -= near * (constant + near * (0.5 * slope + near * square / 3.0))
            continue
        constant -= begin * (slope - begin * square)  # about 0
        slope -= 2.0 * begin * square
        constant, slope, square = constant / (m + 1.0), slope / (m + 2.0), square / (m + 3.0)
        total += b * (constant + b * (slope + b * square)) * power(b / unit, m)
        if a > 0.0:
            total -= a * (constant + a * (slope + a * square)) * power(a / unit, m)
    return total


@kernel
def pieces_value(stack: Stack, i: int, c: float) -> float:
    """Return the loading curve at a compression, over the stiffness."""
    j = _piece_at(stack, i, 0, stack.loading_pieces[i], 1.0, c, True)
    begin, constant, slope, square = _piece(stack, i, j)
    y = c - begin
    return constant + y * (slope + y * square)


@kernel
def compression_of_work(stack: Stack, i: int, work: float) -> float:
    """Return about the compression at which contact i has taken up ``work`` in loading."""
    k = stack.stiffness[i]
    low, high = 0.0, 1.0
    while k * pieces_work(stack, i, high) > work and high > 0.0:
        high *= 0.5
    while k * pieces_work(stack, i, high) < work and high < math.inf:
        low, high = high, 2.0 * high
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        if k * pieces_work(stack, i, middle) < work:
            low = middle
        else:
            high = middle
    return high
