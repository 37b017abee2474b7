"""A video's track as a kind of measurement."""

from typing import Any

from stackbounce.errors import InvalidValue
from stackbounce.measure.kinds.track.analysis import track
from stackbounce.measure.kinds.track.result import Tracks
from stackbounce.measure.quantities import nominal
from stackbounce.measure.setup import Setup, above_bottom, places


def analyse(data: Any, setup: Setup) -> Tracks:
    """Analyse a track; the floor's level becomes that of the point that was followed."""
    _, point = places(setup.measured_to)
    floor = setup.floor
    if floor is not None:
        floor += nominal(above_bottom(point, setup.diameter))
    found = track(data, gravity=setup.gravity, floor=floor, drag=setup.drag)
    if floor is not None and len(found.balls) > 1:
        raise InvalidValue(
            f"floor is for the track of one ball, as the others bounce on balls, got "
            f"{len(found.balls)}"
        )
    return found
