"""A video's track as a kind of measurement."""

from typing import Any

from stackbounce.errors import InvalidValue
from stackbounce.measure.kind import Kind
from stackbounce.model.drop import STANDARD_GRAVITY

__all__ = ["TRACK"]


def _analyse(
    data: Any,
    *,
    floor: float | None = None,
    measured_to: Any = "bottom",
    mass: Any = None,
    diameter: Any = None,
    drag_coefficient: Any = None,
    air_density: Any = None,
    gravity: float = STANDARD_GRAVITY,
) -> Any:
    """Analyse a track; the floor's level becomes that of the point that was followed."""
    from stackbounce.measure.drag import drag_of
    from stackbounce.measure.kinds.heights.analysis import above_bottom, places
    from stackbounce.measure.kinds.track.analysis import track
    from stackbounce.measure.quantities import nominal

    point = places(measured_to)[1]
    if floor is not None:
        floor += nominal(above_bottom(point, diameter))
    drag = drag_of(mass, diameter, drag_coefficient, air_density)
    found = track(data, gravity=gravity, floor=floor, drag=drag)
    if floor is not None and len(found.balls) > 1:
        raise InvalidValue(
            f"floor is for the track of one ball, as the others bounce on balls, got "
            f"{len(found.balls)}"
        )
    return found


TRACK = Kind(
    "track",
    "drop height, speeds, restitution, rebound ratios, a check of clock and ruler",
    _analyse,
    columns=(("time",), ("y", "x")),
    dimension="track",
    longest_step=2.0,  # a step of 1 may be a frame: gravity tells
)
