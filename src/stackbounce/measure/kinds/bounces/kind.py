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
    diameter: Any = None,
    gravity: float = STANDARD_GRAVITY,
) -> Any:
    from stackbounce.measure.kinds.bounces.analysis import bounces
    from stackbounce.measure.kinds.heights.analysis import fallen

    return bounces(data, drop_height=fallen(height, measured_to, diameter), gravity=gravity)


KNOCKS = Kind(
    "knocks",
    _SAYS,
    _analyse,
    columns=(("knock_time",),),
    dimension="knock",
    longest_step=20.0,  # flights: 20 s are from a height of 500 m
)
BOUNCES = Kind("bounces", _SAYS, _analyse)  # recognised by phyphox's layout
