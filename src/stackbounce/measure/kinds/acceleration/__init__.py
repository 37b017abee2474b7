"""Accelerations of what falls and bounces: flights, restitutions, drop height."""

from stackbounce.measure.kind import Kind

_AXES = ("acceleration", "acceleration_absolute", "acceleration_z", "acceleration_y")
ACCELERATION = Kind(
    "acceleration",
    "drop height, restitution, contact times of fast sensors",
    f"{__name__}.analysis",
    options=("gravity",),
    columns=(("time",), (*_AXES, "acceleration_x")),
)
