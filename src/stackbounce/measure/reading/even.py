"""Times that were rounded: whether they are even, and what they were then."""

import numpy as np
from numpy.typing import NDArray

from stackbounce.measure.quantities import Array
from stackbounce.measure.reading.rounding import Rounding

__all__ = ["even_times", "spread"]

_UNSEEN = 1e-3  # of a step: times that are that even are left as they are
_ODD = 0.3  # of a step by which odd steps differ from it
_FEW = 3  # odd steps: fewer are gaps or repeats, not the pattern that rounding makes
_SLACK = 1e-3  # of the rounding's step, for numbers that lie between two
_ROUNDS = 40
_STARTS = 64
_GOLDEN = 0.5 * (5.0**0.5 - 1.0)


def even_times(times: Array, rounded: Rounding) -> Array | None:
    """Return even times that agree with all given ones within their rounding.

    Parameters
    ----------
    times : ndarray
        (n,) as they are written, never decreasing.
    rounded : Rounding
        To what.

    Returns
    -------
    ndarray or None
        (n,); None where times are even as they are, or were not even before they were rounded.

    Examples
    --------
    >>> even_times(np.array([0, 0.03, 0.07, 0.1, 0.13, 0.17]), Rounding(2, 2, False)).round(3)
    array([0.   , 0.033, 0.067, 0.1  , 0.133, 0.167])
    """
    count = len(times)
    step = (times[-1] - times[0]) / (count - 1) if count > 2 else 0.0
    if not step > 0.0:
        return None
    places = np.arange(count, dtype=np.float64)
    off = times[0] + step * places
    np.abs(np.subtract(times, off, out=off), out=off)
    half = 0.5 * rounded.steps(times)
    if off.max() <= _UNSEEN * step or (off > 2.0 * half + half[-1] + half[0]).any():
        return None
    odd = np.abs(np.diff(times) - step) > _ODD * step
    if 0 < np.count_nonzero(odd) < _FEW:
        return None
    line = _line(times - half, times + half, step, float(half.max()))
    return None if line is None else line[0] + line[1] * places


def _line(low: Array, high: Array, slope: float, most: float) -> tuple[float, float] | None:
    """Return start and slope of a line between bounds, as far from all of them as can be.

    Only few of the bounds matter; those that a line violates most are added until none is left.
    """
    count = len(low)
    places = np.arange(count, dtype=np.float64)
    used = np.unique(np.linspace(0, count - 1, min(count, _STARTS)).astype(np.intp))
    slack = _SLACK * most
    reach = 6.0 * most / (count - 1)
    for _ in range(_ROUNDS):
        slope, excess = _steepness(used, low[used], high[used], slope, reach)
        if excess > slack:
            return None
        below, above = low - slope * places, high - slope * places
        tight = np.array([np.argmax(below), np.argmin(above)])
        highest, lowest = below[tight[0]], above[tight[1]]
        if highest - lowest <= max(excess, -slack) + 1e-3 * slack:
            return 0.5 * float(highest + lowest), slope
        more = np.union1d(used, tight)
        if len(more) == len(used):
            return (0.5 * float(highest + lowest), slope) if highest - lowest <= slack else None
        used = more
    return None


def _steepness(
    places: NDArray[np.intp], low: Array, high: Array, slope: float, reach: float
) -> tuple[float, float]:
    """Return the slope at which a line fits best between bounds, and by how much it does not fit.

    How much is a convex function of the slope: its least value is found by golden section.
    """

    def excess(at: float) -> float:
        return float(np.max(low - at * places) - np.min(high - at * places))

    first, last = slope - reach, slope + reach
    left, right = last - _GOLDEN * (last - first), first + _GOLDEN * (last - first)
    of_left, of_right = excess(left), excess(right)
    for _ in range(60):
        if of_left < of_right:
            last, right, of_right = right, left, of_left
            left = last - _GOLDEN * (last - first)
            of_left = excess(left)
        else:
            first, left, of_left = left, right, of_right
            right = first + _GOLDEN * (last - first)
            of_right = excess(right)
    middle = 0.5 * (first + last)
    return middle, excess(middle)


def spread(times: Array, rounded: Rounding) -> Array:
    """Return times in which those that repeat are spread over what they were rounded to.

    Parameters
    ----------
    times : ndarray
        (n,) as they are written, never decreasing.
    rounded : Rounding
        To what.

    Examples
    --------
    >>> spread(np.array([0.0, 0.1, 0.1, 0.2]), Rounding(1, 1, False)).round(3)
    array([0.   , 0.075, 0.125, 0.2  ])
    """
    different, first, counts = np.unique(times, return_index=True, return_counts=True)
    half = 0.5 * rounded.steps(different)
    between = 0.5 * np.diff(different)
    low = -np.minimum(half, np.concatenate([half[:1], between]))
    high = np.minimum(half, np.concatenate([between, half[-1:]]))
    of = np.repeat(np.arange(len(different)), counts)
    place = (np.arange(len(times)) - first[of] + 0.5) / counts[of]
    moved = times + low[of] + (high - low)[of] * place
    return np.where(counts[of] > 1, moved, times)
