"""Root finding for functions of one number."""

import math
import sys
from collections.abc import Callable

_MARGIN = 1e-3  # round-off at an end of a bracket must not hide the change of sign
_CLOSEST = 1e-15  # relative
_LEAST = 5e-324
_WIDEST = 10.0  # times, from one end of a bracket to the next
_ROUNDS = 2000  # a bracket of numbers above 0 can span 600 decades


def root(function: Callable[[float], float], low: float, high: float) -> float:
    """Return the zero of a monotonic function to machine precision.

    Parameters
    ----------
    function : callable
        From a float to a float.
    low, high : float
        An interval above 0 that contains the zero; an end may equal it within round-off.

    Returns
    -------
    float

    Raises
    ------
    ArithmeticError
        If the function has the same sign at both ends.

    Notes
    -----
    Source: R. P. Brent, Algorithms for Minimization Without Derivatives (1973); the same steps, to
    the last bit, as ``scipy.optimize.brentq``.

    Examples
    --------
    >>> round(root(lambda x: x * x - 2.0, 1.0, 2.0), 15)
    1.414213562373095
    """
    before, x = low * (1.0 - _MARGIN), high * (1.0 + _MARGIN)
    f_before, f = function(before), function(x)
    if f_before == 0.0:
        return before
    if (f < 0.0) == (f_before < 0.0) and f != 0.0:
        raise ArithmeticError
    other, f_other, last, step = before, f_before, 0.0, 0.0  # the root lies between x and other
    for _ in range(_ROUNDS):
        if f_before != 0.0 and f != 0.0 and (f_before < 0.0) != (f < 0.0):
            other, f_other = before, f_before
            last = step = x - before
        if abs(f_other) < abs(f):
            before, x, other = x, other, x
            f_before, f, f_other = f, f_other, f
        closest = (_LEAST + _CLOSEST * abs(x)) / 2.0
        half = (other - x) / 2.0
        if f == 0.0 or abs(half) < closest:
            return x
        shift = math.nan
        if abs(last) > closest and abs(f) < abs(f_before):
            shift = _interpolated(before, f_before, x, f, other, f_other)
        if 2.0 * abs(shift) < min(abs(last), 3.0 * abs(half) - closest):
            last, step = step, shift
        else:
            last = step = half
        before, f_before = x, f
        x += step if abs(step) > closest else math.copysign(closest, half)
        f = function(x)
    raise ArithmeticError


def rising_root(function: Callable[[float], float], start: float) -> float:
    """Return the zero of a function that rises with a number above 0, near a start or far from it.

    Raises
    ------
    ArithmeticError
        If it has no zero among the numbers above 0.

    Examples
    --------
    >>> round(rising_root(lambda x: x * x - 2.0, 1e9), 15)
    1.414213562373095
    """
    low = high = start
    factor = 1.1

    def value(x: float) -> float:
        if not sys.float_info.min < x < math.inf:
            raise ArithmeticError
        return function(x)

    while value(low) > 0.0:
        high, low = low, low / factor
        factor = min(factor * factor, _WIDEST)
    while value(high) < 0.0:
        low, high = high, high * factor
        factor = min(factor * factor, _WIDEST)
    return root(function, low, high)


def _interpolated(
    before: float, f_before: float, x: float, f: float, other: float, f_other: float
) -> float:
    """Return the step by the secant rule, or by inverse quadratic interpolation of three points."""
    if before == other:
        above, below = -f * (x - before), f - f_before
    else:
        slope, chord = (f_before - f) / (before - x), (f_other - f) / (other - x)
        above = -f * (f_other * chord - f_before * slope)
        below = chord * slope * (f_other - f_before)
    return above / below if below != 0.0 else math.nan
