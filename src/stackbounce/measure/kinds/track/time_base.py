"""The frame rate and the scale of a track, checked against gravity."""

import math
from typing import NamedTuple

from stackbounce.measure.quantities import Number

__all__ = ["TimeBase", "check_time_base", "is_usual"]

_AGREES = 0.03  # a difference smaller than that is the calibration's
_NEAR = 0.06  # by how much a factor may miss a sensible one
_FACTORS = (
    *(2, 4, 8, 16, 20, 40, 1 / 2, 1 / 4, 1 / 8, 1 / 16, 5 / 4, 4 / 5, 6 / 5, 5 / 6, 10 / 3),
    *(5 / 3, 3 / 5, 3 / 2, 2 / 3, 3, 1 / 3, 10, 1 / 10, 5, 1 / 5),
)
_USUAL = (24, 25, 30, 50, 60, 100, 120, 125, 240, 250, 300, 480, 500, 600, 960, 1000, 1200)


class TimeBase(NamedTuple):
    """What gravity says about a track's frame rate and scale.

    Attributes
    ----------
    gravity : ufloat
        Of the flights as tracked, in m/s².
    ratio : ufloat
        Ratio of `gravity` to the true gravity.
    frame_rate : float
        As the times of the track have it, in 1/s.
    frame_rate_factor : float or None
        By which the true frame rate is higher: a usual factor near the one that gravity requires.
        None where frame rate and scale agree with gravity, or no usual factor is near.
    agrees : bool
        Whether frame rate and scale agree with gravity.
    note : str
        A sentence or two for people; empty where they agree.
    """

    gravity: Number
    ratio: Number
    frame_rate: float
    frame_rate_factor: float | None
    agrees: bool
    note: str


def check_time_base(gravity: Number, true: float, frame_rate: float) -> TimeBase:
    """Return what the gravity of the flights says about a track's frame rate and scale.

    Gravity as tracked is proportional to the scale and to the square of the frame rate, so that it
    cannot tell which of the two is wrong.

    Parameters
    ----------
    gravity : ufloat
        Of the flights, in m/s².
    true : float
        In m/s².
    frame_rate : float
        As the times of the track have it, in 1/s.

    Returns
    -------
    TimeBase

    Examples
    --------
    >>> from uncertainties import ufloat
    >>> check_time_base(ufloat(0.613, 0.004), 9.80665, 60.0).frame_rate_factor
    4
    """
    ratio = gravity / true
    value = float(ratio.nominal_value)
    agrees = abs(value - 1.0) < max(_AGREES, 3.0 * float(ratio.std_dev))
    if agrees:
        return TimeBase(gravity, ratio, frame_rate, None, True, "")
    factor = math.sqrt(1.0 / value)
    sensible = min(_FACTORS, key=lambda one: abs(math.log(one / factor)))
    slack = max(_NEAR, 1.5 * float(ratio.std_dev) / value)
    near = abs(math.log(sensible / factor)) < slack and abs(factor - 1.0) > 0.1
    beginning = f"Gravity comes out as {gravity:.2uS} m/s^2 instead of {true:g}: "
    clock = f"the frame rate is wrong by a factor of {factor:.3g}"
    if near:
        rates = _rates(frame_rate, sensible)
        clock = f"the video's frame rate is wrong by a factor of {sensible:.3g}{rates}"
    note = (
        f"{beginning}either {clock}, or all lengths must be "
        f"multiplied by {1.0 / value:.3g}. Nothing has been corrected."
    )
    return TimeBase(gravity, ratio, frame_rate, sensible if near else None, False, note)


def is_usual(ratio: float, frame_rate: float) -> bool:
    """Return whether two usual frame rates, one read for the other, make a ratio of gravity.

    Examples
    --------
    >>> is_usual(1 / 16, 60.0), is_usual(1 / 20, 60.0), is_usual(1 / 16, 110.0)
    (True, False, False)
    """
    factor = math.sqrt(1.0 / ratio)
    nearest = min(_FACTORS, key=lambda one: abs(math.log(one / factor)))
    return abs(math.log(nearest / factor)) < _NEAR and bool(_rates(frame_rate, nearest))


def _rates(frame_rate: float, factor: float) -> str:
    """Return words for the two frame rates, where both are usual ones."""

    def usual(rate: float) -> int | None:
        nearest = min(_USUAL, key=lambda one: abs(math.log(one / rate)))
        return nearest if abs(nearest / rate - 1.0) < 0.02 else None

    read, true = usual(frame_rate), usual(frame_rate * factor)
    return f": {true} frames per second read as {read}" if read and true else ""
