"""The units of a track, its frame rate and its scale, checked against gravity."""

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

from stackbounce.measure.quantities import Number

_CALIBRATION = 0.03  # relative error of gravity that a calibration of the scale may make
_NEAR = 0.06  # relative difference of a factor to the nearest one of those below
_FACTORS = (  # of two frame rates
    *(2, 4, 8, 16, 20, 40, 1 / 2, 1 / 4, 1 / 8, 1 / 16, 5 / 4, 4 / 5, 6 / 5, 5 / 6, 10 / 3),
    *(5 / 3, 3 / 5, 3 / 2, 2 / 3, 3, 1 / 3, 10, 1 / 10, 5, 1 / 5),
)
_FRAME_RATES = (24, 25, 30, 50, 60, 100, 120, 125, 240, 250, 300, 480, 500, 600, 960, 1000, 1200)


class TrackUnits(NamedTuple):
    """The units of a track: those of SI, or pixels and frames where scale or clock are not known.

    Attributes
    ----------
    length : str
        ``"m"`` or ``"px"``.
    time : str
        ``"s"`` or ``"frame"``.

    Examples
    --------
    >>> TrackUnits("px").speed, TrackUnits("px").known
    ('px/s', False)
    """

    length: str = "m"
    time: str = "s"

    @property
    def known(self) -> bool:
        """Return whether they are those of SI, so that gravity can check them."""
        return self == SI

    @property
    def speed(self) -> str:
        """The unit of speeds."""
        return f"{self.length}/{self.time}"


SI = TrackUnits()


def units_of(data: Any) -> TrackUnits:
    """Return the units of a Dataset, those of SI where it tells none."""
    axis = next((name for name in ("y", "x") if name in getattr(data, "data_vars", ())), None)
    if axis is None:
        return SI
    pixels = data[axis].attrs.get("units") == "px"
    frames = "time" in data.variables and data["time"].attrs.get("units") == "frame"
    return TrackUnits("px" if pixels else "m", "frame" if frames else "s")


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


def check_time_base(
    gravity: Number, true: float, frame_rate: float, units: TrackUnits = SI
) -> TimeBase:
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
    units : TrackUnits, optional
        Of the track; where they are not those of SI, there is nothing to agree with.

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
    if not units.known:
        seen = f"The flights fall with {gravity:.2uS} {units.speed}^2: "
        note = "restitutions do not depend on frame rate and scale, heights and speeds do."
        if units.time == "s":
            note = f"if that is free fall, the scale is {1.0 / value:.3g} m for a pixel."
        return TimeBase(gravity, ratio, frame_rate, None, False, seen + note)
    if abs(value - 1.0) < max(_CALIBRATION, 3.0 * float(ratio.std_dev)):
        return TimeBase(gravity, ratio, frame_rate, None, True, "")
    factor = math.sqrt(1.0 / value)
    sensible = _nearest(_FACTORS, factor)
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
    nearest = _nearest(_FACTORS, factor)
    return abs(math.log(nearest / factor)) < _NEAR and bool(_rates(frame_rate, nearest))


def _rates(frame_rate: float, factor: float) -> str:
    """Return words for the two frame rates, where both are usual ones."""
    rates = frame_rate, frame_rate * factor
    read, true = (_nearest(_FRAME_RATES, rate) for rate in rates)
    usual = abs(read / rates[0] - 1.0) < 0.02 and abs(true / rates[1] - 1.0) < 0.02
    return f": {true} frames per second read as {read}" if usual else ""


def _nearest(numbers: Sequence[float], wanted: float) -> float:
    """Return the number whose ratio to the wanted one is nearest to 1."""
    return min(numbers, key=lambda number: abs(math.log(number / wanted)))
