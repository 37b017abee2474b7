"""Times of successive bounces: restitutions, and how they fall with speed."""

from stackbounce.measure.kind import Kind

__all__ = ["BOUNCES", "KNOCKS"]

_SAYS = "restitution of each bounce, its fall with speed"
_BALL = ("height", "measured_to", "mass", "diameter", "drag_coefficient", "air_density", "gravity")
KNOCKS = Kind(
    "knocks",
    _SAYS,
    f"{__name__}.kind",
    options=_BALL,
    columns=(("knock_time",),),
    dimension="knock",
    longest_step=20.0,  # flights: 20 s are from a height of 500 m
)
BOUNCES = Kind("bounces", _SAYS, f"{__name__}.kind", options=_BALL)  # phyphox's layout tells it
