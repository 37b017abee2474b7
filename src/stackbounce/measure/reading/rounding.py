"""To what steps times were rounded, by their digits; whether they are even, and what they were."""

from dataclasses import dataclass
from decimal import Decimal

import numpy as np
from numpy.typing import NDArray

from stackbounce.measure.quantities import Array

_COUNTED = 2000  # numbers whose digits are counted: nearly none of them may end in zeros
_SINGLE_DIGITS = 8  # that a float of 32 bits does not have, but that programs write of it
_NINTH_DIGIT = 5.1e-9  # relative: how far nine digits may be off the float they were written of
_UNSEEN = 1e-3  # of a step: times that are that even are left as they are
_ODD = 0.3  # of a step, by which odd steps differ from it
_FEW_ODD = 3  # odd steps: fewer are gaps or repeats, not the pattern that rounding makes
_SLACK = 1e-3  # of the rounding's step, for numbers that lie between two
_ROUNDS = 40  # of adding the bounds that a line violates most
_FIRST_BOUNDS = 64  # that a line is put between at first
_SEARCH_ROUNDS = 60  # of golden section, to the last digit of a slope
_GOLDEN = 0.5 * (5.0**0.5 - 1.0)


@dataclass(frozen=True)
class Rounding:
    """How numbers were rounded: to decimals, to digits, or to a float of 32 bits.

    Parameters
    ----------
    decimals : int
        The most that a number has behind the decimal point; negative where all are whole tens.
    digits : int
        The most that a number has.
    single : bool
        Whether all are floats of 32 bits.
    """

    decimals: int
    digits: int
    single: bool

    def steps(self, values: Array) -> Array:
        """Return the distance of neighbouring numbers that could be written, at each value.

        Examples
        --------
        >>> Rounding(4, 6, False).steps(np.array([0.5, 12.5, 123.5])).tolist()
        [0.0001, 0.0001, 0.001]
        """
        size = np.maximum(np.abs(values), 1e-300)
        written = 10.0 ** (np.floor(np.log10(size) * (1.0 + 1e-15)) + 1 - self.digits)
        written = np.maximum(written, 10.0 ** float(-self.decimals))
        if self.single:
            binary = np.spacing(np.abs(values).astype(np.float32)).astype(np.float64)
            written += binary
        return np.asarray(written)


def rounding_of(values: Array) -> Rounding:
    """Return how finite numbers were rounded.

    Examples
    --------
    >>> rounding_of(np.array([0.0, 0.0226757, 453.492]))
    Rounding(decimals=7, digits=6, single=False)
    >>> rounding_of(np.array([0.1, 0.7], dtype=np.float32).astype(float)).single
    True
    """
    some = values[:: max(1, len(values) // _COUNTED)]
    decimals, digits = -300, 1
    for value in some.tolist():
        if value:
            _, figures, exponent = Decimal(repr(value)).normalize().as_tuple()
            decimals = max(decimals, -int(exponent))
            digits = max(digits, len(figures))
    near = some.astype(np.float32).astype(np.float64)
    single = bool(np.all(np.abs(some - near) <= _NINTH_DIGIT * np.abs(some)))
    return Rounding(decimals, digits, single and digits > _SINGLE_DIGITS)


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
    if 0 < np.count_nonzero(odd) < _FEW_ODD:
        return None
    line = _line(times - half, times + half, step, float(half.max()))
    return None if line is None else line[0] + line[1] * places


def _line(low: Array, high: Array, slope: float, most: float) -> tuple[float, float] | None:
    """Return start and slope of a line between bounds, as far from all of them as can be.

    Only few of the bounds matter; those that a line violates most are added until none is left.
    """
    count = len(low)
    places = np.arange(count, dtype=np.float64)
    used = np.unique(np.linspace(0, count - 1, min(count, _FIRST_BOUNDS)).astype(np.intp))
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
    for _ in range(_SEARCH_ROUNDS):
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
