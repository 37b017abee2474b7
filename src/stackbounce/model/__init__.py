"""What is dropped: balls, contact laws, drops, and the catalogue of the paper's balls.

Frozen values, validated once, without numerics.
"""

from stackbounce.model.ball import Ball
from stackbounce.model.drop import STANDARD_GRAVITY, Drop
from stackbounce.model.laws import (
    LAWS,
    ContactLaw,
    Dashpot,
    Hertz,
    HuntCrossley,
    Hysteretic,
    PowerLaw,
    Rigid,
    Spring,
    Viscoelastic,
    law_named,
    series,
)

__all__ = [
    "LAWS",
    "STANDARD_GRAVITY",
    "Ball",
    "ContactLaw",
    "Dashpot",
    "Drop",
    "Hertz",
    "HuntCrossley",
    "Hysteretic",
    "PowerLaw",
    "Rigid",
    "Spring",
    "Viscoelastic",
    "law_named",
    "series",
]
