"""Times of bounces as kinds of measurement: of knocks, and as phyphox derives them."""

from typing import Any

from stackbounce.measure.kind import Kind
from stackbounce.model.drop import STANDARD_GRAVITY

__all__ = ["BOUNCES", "KNOCKS"]

_SAYS = "restitution of each bounce, its fall with speed"


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

    drag = drag_of(mass, diameter, drag_coefficient, air_density)
    height = fallen(height, measured_to, diameter)
    return bounces(data, drop_height=height, gravity=gravity, drag=drag)


KNOCKS = Kind(
    "knocks",
    _SAYS,
    _analyse,
    columns=(("knock_time",),),
    dimension="knock",
    longest_step=20.0,  # flights: 20 s are from a height of 500 m
)
BOUNCES = Kind("bounces", _SAYS, _analyse)  # recognised by phyphox's layout
