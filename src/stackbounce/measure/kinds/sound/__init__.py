"""Sound of a bouncing ball: the times of its knocks."""

from stackbounce.measure.kind import Kind

__all__ = ["SOUND"]

SOUND = Kind(
    "sound",
    "restitution of each bounce, its fall with speed",
    f"{__name__}.kind",
    options=(
        *("height", "measured_to", "mass", "diameter"),
        *("drag_coefficient", "air_density", "gravity"),
    ),
    columns=(("time",), ("sound",)),
    longest_step=2.5e-3,  # 400 samples per second: slower ones are no sound
)
