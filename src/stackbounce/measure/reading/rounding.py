"""To what steps times were rounded, by their digits; whether they are even, and what they were."""

from dataclasses import dataclass
from decimal import Decimal

import numpy as np

from stackbounce.measure.quantities import Array

_COUNTED = 2000  # numbers whose digits are counted: nearly none of them may end in zeros
_SINGLE_DIGITS = 8  # that a float of 32 bits does not have, but that programs write of it
_NINTH_DIGIT = 5.1e-9  # relative: how far nine digits may be off the float they were written of
_UNSEEN = 1e-3  # of a step: times that are that even are left as they are
_ODD = 0.3  # of a step, by which odd steps differ from it
_FEW_ODD = 3  # odd steps: fewer are gaps or repeats, not the pattern that rounding makes
_SLACK = 0.1  # of what rounding moves times, by which the fitted even ones may be off more than it


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
    >>> even_times(np.round(np.arange(100) / 30.0, 2), Rounding(2, 3, False))[1:5].round(3)
    array([0.033, 0.067, 0.1  , 0.133])
    """
    count = len(times)
    step = (times[-1] - times[0]) / (count - 1) if count > 2 else 0.0
    if not step > 0.0:
        return None
    places = np.arange(count, dtype=np.float64)
    off = times[0] + step * places
    np.abs(np.subtract(times, off, out=off), out=off)
    half = np.maximum(0.5 * rounded.steps(times), _UNSEEN * step)
    if off.max() <= _UNSEEN * step or (off > 2.0 * half + half[-1] + half[0]).any():
        return None
    odd = np.abs(np.diff(times) - step) > _ODD * step
    if 0 < np.count_nonzero(odd) < _FEW_ODD:
        return None
    even = np.asarray(np.polyval(np.polyfit(places, times, 1, w=1.0 / half), places), np.float64)
    return even if (np.abs(times - even) <= (1.0 + _SLACK) * half).all() else None


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
