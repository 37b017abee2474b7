"""The model: balls, contact laws, drops, air, and the catalogue of balls.

All are frozen dataclasses that are validated when they are made. All names of
`stackbounce.model.laws` are here too.
"""

from stackbounce.model import laws
from stackbounce.model.air import Air, Flight
from stackbounce.model.ball import Ball
from stackbounce.model.drop import STANDARD_GRAVITY, Drop
from stackbounce.model.laws import *  # noqa: F403

__all__ = ["STANDARD_GRAVITY", "Air", "Ball", "Drop", "Flight"]
__all__ += laws.__all__
