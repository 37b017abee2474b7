"""Heights of successive bounces: restitutions."""

from stackbounce.measure.kind import IN_AIR, Kind

TABLE = Kind(
    "table",
    "restitution of each bounce, where its one column is heights",
    f"{__name__}.kind",
    options=("heights", "height_error", "repeated", "measured_to", *IN_AIR),
    dimension="row",
    starts_with=("heights",),
    typed="heights of bounces",
)
