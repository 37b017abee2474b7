"""The right analysis for what a file holds."""

from itertools import pairwise
from typing import TYPE_CHECKING, Any

from stackbounce.errors import InvalidType, InvalidValue, shown
from stackbounce.measure.kinds.acceleration.analysis import accelerometer
from stackbounce.measure.kinds.bounces.analysis import bounces
from stackbounce.measure.kinds.gap.floor_gap import floor_gap
from stackbounce.measure.kinds.gap.sensor_gap import SensorGap, sensor_gap
from stackbounce.measure.kinds.heights.analysis import (
    Place,
    above_bottom,
    heights,
    lowest_point,
    places,
)
from stackbounce.measure.kinds.press import press
from stackbounce.measure.kinds.sound.analysis import Knocks, knocks
from stackbounce.measure.kinds.sound.few_bounces import few_bounces
from stackbounce.measure.kinds.track.analysis import Tracks, track
from stackbounce.measure.kinds.waveform import waveform
from stackbounce.model.drop import STANDARD_GRAVITY
from stackbounce.model.laws import ContactLaw

if TYPE_CHECKING:
    import xarray as xr
    from uncertainties import UFloat

__all__ = ["analyse"]


def analyse(
    data: "xr.Dataset",
    *,
    mass: "float | UFloat | None" = None,
    diameter: "float | UFloat | None" = None,
    height: "float | UFloat | None" = None,
    speed: "float | UFloat | None" = None,
    measured_to: Place | tuple[Place, Place] = "bottom",
    height_error: float | None = None,
    repeated: bool = False,
    floor: float | None = None,
    alone: "xr.Dataset | None" = None,
    contact_time: "float | UFloat | None" = None,
    restitution: "float | UFloat | None" = None,
    time_constant: float | None = None,
    gravity: float = STANDARD_GRAVITY,
    law: "ContactLaw | type[ContactLaw] | str | None" = None,
    exponent: float | None = None,
) -> tuple[Any, ...]:
    r"""Return what is found in a measurement by the analysis, or analyses, that fit its kind.

    Parameters
    ----------
    data : xarray.Dataset
        As `read` gives it.
    mass : float or ufloat, optional
        The ball's, in kg: makes a stiffness of a contact time.
    diameter : float or ufloat, optional
        The ball's, in m; needed where `measured_to` is not its bottom.
    height : float or ufloat, optional
        From where the ball fell, in m: gives the restitution of the first bounce.
    speed : float or ufloat, optional
        Impact speed in m/s: calibrates the impulse of a force waveform.
    measured_to : {"bottom", "centre", "top"} or a pair of them, optional
        The point of the ball that `height` and a table's heights are those of, and that a track
        follows; a pair has the drop height's first and then the bounces'.
    height_error : float, optional
        Of each height in a table, in m.
    repeated : bool, optional
        Whether a table's heights after the first are one bounce's, from drop after drop.
    floor : float, optional
        Of a track of one ball: how high the floor is, in m as tracked.
    alone : xarray.Dataset, optional
        The floor's force under the lower ball alone, for that under a stack: tells the gap.
    contact_time, restitution : float or ufloat, optional
        Of the lower ball alone, in s and as a number, for the gap of a stack.
    time_constant : float, optional
        Of a piezo sensor's droop, in s, which is then undone.
    gravity : float, optional
        In m/s**2.
    law : ContactLaw, its class or its name, optional
        Of the contact that a force waveform shows: its touch and release are the surer.
    exponent : float, optional
        Of the loading curve of a law that has one to choose.

    Returns
    -------
    tuple
        Of a sound `Bounces` (`FewBounces` where they are too few for a restitution) and `Knocks`;
        of knock times and of phyphox's bounces `Bounces`; of a track `Tracks`; of an acceleration
        `Accelerometer`; of a force waveform `Waveform`, with a second sensor between two balls
        `SensorGap` before it, and with `alone` `FloorGap` after it; of a press curve `Press`; of a
        table with one column of heights, the drop's above the bounces', `Heights`.

    Raises
    ------
    InvalidType
        If `data` is none of `read`.
    InvalidValue
        If there is no analysis for what it holds, or nothing that it looks for is there.

    Examples
    --------
    >>> import stackbounce as sb
    >>> path = getfixture("tmp_path") / "knocks.csv"
    >>> text = '"Event time (s)","Interval (s)"\n0,0\n0.8,0.8\n1.44,0.64\n1.952,0.512\n'
    >>> _ = path.write_text(text)
    >>> (found,) = analyse(sb.read(path))
    >>> f"{found.mean.nominal_value:.3f}"
    '0.800'
    """
    holds = getattr(data, "attrs", {}).get("holds")
    if holds is None:
        raise InvalidType(f"data must be a Dataset from read, got {shown(data)}")
    if height is not None:
        height = lowest_point("height", height, places(measured_to)[0], diameter)
    if holds == "sound":
        heard = knocks(data)
        if _enough(heard, height):
            return bounces(heard, drop_height=height, gravity=gravity), heard
        return few_bounces(heard, gravity=gravity), heard
    if holds in ("knocks", "bounces"):
        return (bounces(data, drop_height=height, gravity=gravity),)
    if holds == "track":
        return (_tracked(data, floor, places(measured_to)[1], diameter, gravity),)
    if holds == "waveform":
        of_it: Any = {"time_constant": time_constant, "law": law, "exponent": exponent}
        one = waveform(data, mass=mass, impact_speed=speed, **of_it)
        if speed is None and height is not None:
            speed = (2.0 * gravity * height) ** 0.5
        told = {"impact_speed": speed, "restitution": restitution, "time_constant": time_constant}
        gap = (
            () if alone is None else (floor_gap(one, waveform(alone, **of_it), mass=mass, **told),)
        )
        return (*_by_two_sensors(data, speed, contact_time), one, *gap)
    if holds == "acceleration":
        return (accelerometer(data, gravity=gravity),)
    if holds == "press curve":
        return (press(data),)
    if holds == "table" and "y" in data:
        dropped, *risen = data["y"].values.tolist()
        found = heights(
            dropped,
            risen,
            diameter=diameter,
            measured_to=measured_to,
            height_error=height_error,
            repeated=repeated,
        )
        return (found,)
    kinds = "sound, knocks, bounces, track, waveform, acceleration, press curve, table of heights"
    raise InvalidValue(f"there is no analysis of {holds}: tell what it holds, one of {kinds}")


def _enough(heard: Knocks, height: float | None) -> bool:
    """Tell whether there are two flights in a row, of which the first may be the drop."""
    whole = [height is not None, *(not lost for lost in heard.missed)]
    return any(one and other for one, other in pairwise(whole))


def _by_two_sensors(data: "xr.Dataset", speed: Any, contact_time: Any) -> tuple[SensorGap, ...]:
    """Return the gap of two balls if the record's second channel feels them touch."""
    try:
        return (sensor_gap(data, impact_speed=speed, contact_time=contact_time),)
    except InvalidValue:  # one channel, or one that is of something else
        return ()


def _tracked(
    data: "xr.Dataset", floor: float | None, point: str, diameter: Any, gravity: float
) -> Tracks:
    """Return what a track tells; the floor's level becomes that of the point that was followed."""
    if floor is None:
        return track(data, gravity=gravity)
    up = above_bottom(point, diameter)
    found = track(data, gravity=gravity, floor=floor + getattr(up, "nominal_value", up))
    if len(found.balls) > 1:
        raise InvalidValue(
            f"floor is for the track of one ball, as the others bounce on balls, got "
            f"{len(found.balls)}"
        )
    return found
