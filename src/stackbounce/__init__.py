"""What happens when a stack of balls hits the floor: predicted, measured, fitted, explained."""

from stackbounce.calibrate import separate
from stackbounce.errors import StackbounceError
from stackbounce.model import Ball, Drop, Hysteretic, Rigid, Spring
from stackbounce.result import Result, Status
from stackbounce.simulate import simulate
from stackbounce.version import __version__

__all__ = [
    "Ball",
    "Drop",
    "Hysteretic",
    "Result",
    "Rigid",
    "Spring",
    "StackbounceError",
    "Status",
    "__version__",
    "separate",
    "simulate",
]
