"""What happens when a stack of balls hits the floor: predicted, measured, fitted, explained."""

from stackbounce.calibrate import calibrate, contact_time, restitution, separate
from stackbounce.errors import StackbounceError
from stackbounce.model import (
    Ball,
    Dashpot,
    Drop,
    Hertz,
    HuntCrossley,
    Hysteretic,
    PowerLaw,
    Rigid,
    Spring,
    Viscoelastic,
    series,
)
from stackbounce.result import Result, Status
from stackbounce.simulate import simulate
from stackbounce.sweep import sweep
from stackbounce.version import __version__

__all__ = [
    "Ball",
    "Dashpot",
    "Drop",
    "Hertz",
    "HuntCrossley",
    "Hysteretic",
    "PowerLaw",
    "Result",
    "Rigid",
    "Spring",
    "StackbounceError",
    "Status",
    "Viscoelastic",
    "__version__",
    "calibrate",
    "contact_time",
    "restitution",
    "separate",
    "series",
    "simulate",
    "sweep",
]
