"""Times of successive bounces: restitutions, and how they fall with speed."""

from stackbounce.measure.kind import IN_AIR, Kind

KNOCKS = Kind(
    "knocks",
    "restitution of each bounce, its fall with speed",
    f"{__name__}.analysis",
    options=("height", "measured_to", "gravity", *IN_AIR),
    columns=(("knock_time",),),
    dimension="knock",
    longest_step=20.0,  # flights: 20 s are from a height of 500 m
)
