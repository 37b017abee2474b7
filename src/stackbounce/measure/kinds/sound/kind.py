"""Sound as a kind of measurement."""

from itertools import pairwise
from typing import Any

from stackbounce.measure.kind import Kind
from stackbounce.model.drop import STANDARD_GRAVITY

__all__ = ["SOUND"]


def _analyse(
    data: Any,
    *,
    height: Any = None,
    measured_to: Any = "bottom",
    mass: Any = None,
    diameter: Any = None,
    drag_coefficient: Any = None,
    air_density: Any = None,
    gravity: float = STANDARD_GRAVITY,
) -> Any:
    from stackbounce.measure.drag import drag_of
    from stackbounce.measure.kinds.bounces.analysis import bounces
    from stackbounce.measure.kinds.heights.analysis import fallen
    from stackbounce.measure.kinds.sound.analysis import knocks
    from stackbounce.measure.kinds.sound.few_bounces import few_bounces

    drag = drag_of(mass, diameter, drag_coefficient, air_density)
    height = fallen(height, measured_to, diameter)
    heard = knocks(data)
    # A restitution needs two known flights in a row; the drop is one if its height is known.
    whole = [height is not None, *(not lost for lost in heard.missed)]
    if any(one and other for one, other in pairwise(whole)):
        return bounces(heard, drop_height=height, gravity=gravity, drag=drag), heard
    return few_bounces(heard, gravity=gravity, drag=drag), heard


SOUND = Kind(
    "sound",
    "restitution of each bounce, its fall with speed",
    _analyse,
    columns=(("time",), ("sound",)),
    longest_step=2.5e-3,  # 400 samples per second: slower ones are no sound
)
