"""Sound of a bouncing ball: the times of its knocks."""

from stackbounce.measure.kind import IN_AIR, Kind

SOUND = Kind(
    "sound",
    "restitution of each bounce, its fall with speed",
    f"{__name__}.kind",
    options=("height", "measured_to", "gravity", *IN_AIR),
    columns=(("time",), ("sound",)),
    longest_step=2.5e-3,  # 400 samples per second: slower ones are no sound
)
