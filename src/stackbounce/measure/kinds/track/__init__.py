"""Tracks of falling and bouncing balls, from video: flights, speeds, heights."""

from stackbounce.measure.kind import IN_AIR, Kind

TRACK = Kind(
    "track",
    "drop height, speeds, restitution, rebound ratios, a check of clock and ruler",
    f"{__name__}.analysis",
    options=("floor", "measured_to", "gravity", *IN_AIR),
    columns=(("time",), ("y", "x")),
    dimension="track",
    longest_step=2.0,  # a step of 1 may be a frame: gravity tells
)
