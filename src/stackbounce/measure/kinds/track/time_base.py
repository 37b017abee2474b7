"""The units of a track, its frame rate and its scale, checked against gravity."""

import math
from typing import Any, NamedTuple

from stackbounce.measure.quantities import Number

_CALIBRATION = 0.03  # relative error of gravity that a calibration of the scale may make
_NEAR = 0.06  # relative difference of a factor to that of two usual frame rates
_LEAST_FACTOR = 0.1  # relative difference to 1 of a factor that two frame rates make
_KNOWN_WITHIN = 0.02  # relative difference of a track's frame rate to a usual one
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
    frame_rate_factor : float or None
        By which the true frame rate is higher: that of two usual frame rates, near the one that
        gravity requires. None where gravity agrees, or no usual frame rates make such a factor.
    agrees : bool
        Whether frame rate and scale agree with gravity.
    note : str
        A sentence or two for people; empty where they agree.
    """

    gravity: Number
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
    4.0
    """
    ratio = gravity / true
    value = float(ratio.nominal_value)
    if not units.known:
        seen = f"The flights fall with {gravity:.2uS} {units.speed}^2: "
        note = "restitutions do not depend on frame rate and scale, heights and speeds do."
        if units.time == "s":
            note = f"if that is free fall, the scale is {1.0 / value:.3g} m for a pixel."
        return TimeBase(gravity, None, False, seen + note)
    if abs(value - 1.0) < max(_CALIBRATION, 3.0 * float(ratio.std_dev)):
        return TimeBase(gravity, None, True, "")
    factor = math.sqrt(1.0 / value)
    clock = f"the frame rate is wrong by a factor of {factor:.3g}"
    rates = _misread(frame_rate, factor, max(_NEAR, 1.5 * float(ratio.std_dev) / value))
    usual = rates[1] / rates[0] if rates else None
    if rates:
        clock = (
            f"the video's frame rate is wrong by a factor of {usual:.3g}: {rates[1]} frames per "
            f"second read as {rates[0]}"
        )
    note = (
        f"Gravity comes out as {gravity:.2uS} m/s^2 instead of {true:g}: either {clock}, or all "
        f"lengths must be multiplied by {1.0 / value:.3g}. Nothing has been corrected."
    )
    return TimeBase(gravity, usual, False, note)


def is_usual(ratio: float, frame_rate: float) -> bool:
    """Return whether two usual frame rates, one read for the other, make a ratio of gravity.

    Examples
    --------
    >>> is_usual(1 / 16, 60.0), is_usual(1 / 20, 60.0), is_usual(1 / 16, 110.0)
    (True, False, False)
    """
    return _misread(frame_rate, math.sqrt(1.0 / ratio), _NEAR) is not None


def _misread(frame_rate: float, factor: float, slack: float) -> tuple[int, int] | None:
    """Return the usual frame rate that was read, and the true one, that make about a factor."""
    read = _nearest(frame_rate)
    true = _nearest(factor * read)
    near = abs(math.log(true / read / factor)) < slack and abs(factor - 1.0) > _LEAST_FACTOR
    return (read, true) if near and abs(read / frame_rate - 1.0) < _KNOWN_WITHIN else None


def _nearest(frame_rate: float) -> int:
    """Return the usual frame rate whose ratio to another is nearest to 1."""
    return min(_FRAME_RATES, key=lambda usual: abs(math.log(usual / frame_rate)))
