"""The contact laws: the force between two balls, or ball and floor, while they are compressed.

Each law is a frozen dataclass in a file of its own or of its family, with all its formulas. A
force never pulls, but for that of a `Bond`: where the formula is negative, the force is 0. The
formula is evaluated further, so that the force may become positive again. A contact ends when its
force is zero for good. Under `Dashpot`, `Viscoelastic` and `HuntCrossley`, as without loss,
``k c**(p + 1)/(p + 1)`` counts as stored energy while the compression c is above 0. The surface of
a `StandardLinearSolid` recovers after the end of a contact; no other law has a memory of earlier
contacts.
"""

# The laws are imported in the order in which people are shown them: each registers itself.
# isort: off
from stackbounce.model.laws.rigid import Rigid, RigidBySpeed, RigidLossBySpeed
from stackbounce.model.laws.elastic import Spring, Hertz, PowerLaw
from stackbounce.model.laws.dashpot import Dashpot
from stackbounce.model.laws.standard_linear_solid import StandardLinearSolid
from stackbounce.model.laws.viscoelastic import Viscoelastic
from stackbounce.model.laws.hunt_crossley import HuntCrossley
from stackbounce.model.laws.hysteretic import Hysteretic
from stackbounce.model.laws.hollow_ball import HollowBall
from stackbounce.model.laws.tabulated import Tabulated
from stackbounce.model.laws.bond import Bond

# isort: on
from stackbounce.engine import codes
from stackbounce.model.laws.law import STEEPEST, ContactLaw, Quantity, contact_numbers, stiffness_in
from stackbounce.model.laws.registry import LAWS, law_named, register, usual_laws
from stackbounce.model.laws.series import series

__all__ = [
    "LAWS", "STEEPEST", "Bond", "ContactLaw", "Dashpot", "Hertz", "HollowBall", "HuntCrossley",
    "Hysteretic", "PowerLaw", "Quantity", "Rigid", "RigidBySpeed", "RigidLossBySpeed", "Spring",
    "StandardLinearSolid", "Tabulated", "Viscoelastic", "codes", "contact_numbers", "law_named",
    "register", "series", "stiffness_in", "usual_laws",
]  # fmt: skip
