"""Acceleration as a kind of measurement."""

from typing import Any

from stackbounce.measure.kind import Kind
from stackbounce.model.drop import STANDARD_GRAVITY

__all__ = ["ACCELERATION"]


def _analyse(data: Any, *, gravity: float = STANDARD_GRAVITY) -> Any:
    from stackbounce.measure.kinds.acceleration.analysis import accelerometer

    return accelerometer(data, gravity=gravity)


_AXES = ("acceleration", "acceleration_absolute", "acceleration_z", "acceleration_y")
ACCELERATION = Kind(
    "acceleration",
    "drop height, restitution, contact times of fast sensors",
    _analyse,
    columns=(("time",), (*_AXES, "acceleration_x")),
)
