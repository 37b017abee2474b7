"""Times of successive bounces: restitutions, and how they fall with speed."""

from stackbounce.measure.kind import IN_AIR, Kind

__all__ = ["BOUNCES", "KNOCKS"]

_SAYS = "restitution of each bounce, its fall with speed"
_OPTIONS = ("height", "measured_to", "gravity", *IN_AIR)
KNOCKS = Kind(
    "knocks",
    _SAYS,
    f"{__name__}.kind",
    options=_OPTIONS,
    columns=(("knock_time",),),
    dimension="knock",
    longest_step=20.0,  # flights: 20 s are from a height of 500 m
)
BOUNCES = Kind("bounces", _SAYS, f"{__name__}.kind", options=_OPTIONS)  # phyphox's layout tells it
