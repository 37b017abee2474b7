"""The contact laws: what the force between two balls, or ball and floor, is while compressed.

Each is a small frozen value with its formula, its source and the end of its contact. Forces never
pull. A force that a formula would make negative is 0, which leaves no trace: the compression goes
on, and so does the formula. A contact ends when its force is back at zero for good, and
``k c**(p + 1)/(p + 1)`` counts as stored energy while the compression c is above 0.
"""

from stackbounce.model.laws.elastic import STEEPEST, Hertz, PowerLaw, Spring
from stackbounce.model.laws.hysteretic import Hysteretic
from stackbounce.model.laws.lossy import Dashpot, HuntCrossley, Viscoelastic
from stackbounce.model.laws.rigid import Rigid
from stackbounce.model.laws.stacked import series
from stackbounce.model.laws.table import LAWS, ContactLaw, law_named

__all__ = [
    "LAWS",
    "STEEPEST",
    "ContactLaw",
    "Dashpot",
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
