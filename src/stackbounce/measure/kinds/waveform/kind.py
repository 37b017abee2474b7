"""Force against time as a kind of measurement."""

from contextlib import suppress
from typing import TYPE_CHECKING, Any

from stackbounce.errors import InvalidValue
from stackbounce.measure.kind import Kind
from stackbounce.model.drop import STANDARD_GRAVITY

if TYPE_CHECKING:
    import xarray as xr

    from stackbounce.measure.finding import Finding

__all__ = ["WAVEFORM"]


def _analyse(
    data: "xr.Dataset",
    *,
    mass: Any = None,
    contact_time: Any = None,
    restitution: Any = None,
    law: Any = None,
    exponent: float | None = None,
    height: Any = None,
    measured_to: Any = "bottom",
    diameter: Any = None,
    speed: Any = None,
    alone: "xr.Dataset | None" = None,
    time_constant: float | None = None,
    gravity: float = STANDARD_GRAVITY,
) -> "tuple[Finding, ...]":
    """Analyse a force, and the gap between two balls where there is a second channel or record."""
    from stackbounce.measure.kinds.heights.analysis import fallen
    from stackbounce.measure.kinds.waveform.analysis import waveform
    from stackbounce.measure.kinds.waveform.gap.delay import sensor_gap
    from stackbounce.measure.kinds.waveform.gap.floor_gap import floor_gap

    height = fallen(height, measured_to, diameter)
    known: Any = {"time_constant": time_constant, "law": law, "exponent": exponent}
    one = waveform(data, mass=mass, impact_speed=speed, **known)
    if speed is None and height is not None:
        speed = (2.0 * gravity * height) ** 0.5
    found: tuple[Finding, ...] = (one,)
    with suppress(InvalidValue):  # there is one channel, or the second is no sensor of balls
        found = (sensor_gap(data, impact_speed=speed, contact_time=contact_time), one)
    if alone is None:
        return found
    told = {"impact_speed": speed, "restitution": restitution, "time_constant": time_constant}
    return (*found, floor_gap(one, waveform(alone, **known), mass=mass, **told))


WAVEFORM = Kind(
    "waveform",
    "contacts, contact times, peaks, impulse, stiffness, gaps",
    _analyse,
    columns=(("time",), ("force", "voltage")),
)
