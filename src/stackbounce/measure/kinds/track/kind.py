"""A video's track as a kind of measurement."""

from typing import TYPE_CHECKING, Any

from stackbounce.errors import InvalidValue
from stackbounce.measure.kind import Kind
from stackbounce.model.drop import STANDARD_GRAVITY

if TYPE_CHECKING:
    import xarray as xr

    from stackbounce.measure.kinds.track.result import Tracks

__all__ = ["TRACK"]


def _analyse(
    data: "xr.Dataset",
    *,
    floor: float | None = None,
    measured_to: Any = "bottom",
    diameter: Any = None,
    gravity: float = STANDARD_GRAVITY,
) -> "tuple[Tracks, ...]":
    """Analyse a track; the floor's level becomes that of the point that was followed."""
    from stackbounce.measure.kinds.heights.analysis import above_bottom, places
    from stackbounce.measure.kinds.track.analysis import track

    point = places(measured_to)[1]
    if floor is None:
        return (track(data, gravity=gravity),)
    up = above_bottom(point, diameter)
    found = track(data, gravity=gravity, floor=floor + getattr(up, "nominal_value", up))
    if len(found.balls) > 1:
        raise InvalidValue(
            f"floor is for the track of one ball, as the others bounce on balls, got "
            f"{len(found.balls)}"
        )
    return (found,)


TRACK = Kind(
    "track",
    "drop height, speeds, restitution, rebound ratios, a check of clock and ruler",
    _analyse,
    columns=(("time",), ("y", "x")),
    dimension="track",
)
