"""A law whose form of force no law of the package has: all that is known of it is in this file."""

import math
from dataclasses import dataclass
from typing import Annotated, ClassVar, Self

from scipy.optimize import brentq

from stackbounce.model.laws.law import ContactLaw, Flank, Flanks, Given, Quantity, stiffness_in


@dataclass(frozen=True)
class Hardening(ContactLaw):
    """A spring that hardens when it is compressed: ``F = k c (1 + (c/length)**2)``."""

    says = "A spring that hardens when it is compressed"
    formula = "F = stiffness c (1 + (c/length)**2)"
    source = "I. Kovacic and M. J. Brennan, The Duffing Equation (Wiley, 2011)"
    form = "HARDENING"
    third_number = "length"
    rate_free = True
    usual_models: ClassVar = {"Hardening": {}}

    exponent: ClassVar[float] = 1.0
    stiffness: Annotated[float, stiffness_in("N/m")]
    length: Annotated[float, Quantity("m", slider=(2e-3, 1e-4, 1e-1))] = 2e-3

    def restitution_at(self, mass: float, speed: float) -> float:  # noqa: ARG002
        """Return 1."""
        return 1.0

    @classmethod
    def _needs_speed(cls, exponent: float) -> bool:  # noqa: ARG003
        return True

    @classmethod
    def calibrated(cls, given: Given) -> Self:
        """Return the law of the default length that has a measured contact time."""
        mass, speed, lasts = given["mass"], given["impact_speed"], given["contact_time"]
        stiffest = mass * (math.pi / lasts) ** 2  # of a spring that does not harden

        def late(stiffness: float) -> float:
            return cls(stiffness).contact_time_at(mass, speed) - lasts

        return cls(brentq(late, 1e-6 * stiffest, stiffest, rtol=1e-14))

    @classmethod
    def flanks(cls, *_: object) -> Flanks:
        """Return a force that rises and falls in proportion to time."""
        return Flank(1.0, 1.0, exact=True), Flank(1.0, 1.0, exact=True)
