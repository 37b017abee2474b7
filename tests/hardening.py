"""A law whose form of force no law of the package has: all that is known of it is in this file."""

from dataclasses import dataclass
from typing import Annotated, ClassVar

from stackbounce.model.laws.law import ContactLaw, Flank, Flanks, Quantity, stiffness_in


@dataclass(frozen=True)
class Hardening(ContactLaw):
    """A spring that hardens when it is compressed: ``F = k c (1 + (c/length)**2)``."""

    formula = "F = stiffness c (1 + (c/length)**2)"
    source = "I. Kovacic and M. J. Brennan, The Duffing Equation (Wiley, 2011)"
    form = "HARDENING"
    law_parameter = "length"
    rate_free = True
    usual_models: ClassVar = {"Hardening": {}}

    exponent: ClassVar[float] = 1.0
    stiffness: Annotated[float, stiffness_in("N/m")]
    length: Annotated[float, Quantity("m", slider=(2e-3, 1e-4, 1e-1))] = 2e-3

    @classmethod
    def _needs_speed(cls, exponent: float) -> bool:  # noqa: ARG003
        return True

    @classmethod
    def flanks(cls, *_: object) -> Flanks:
        """Return a force that rises and falls in proportion to time."""
        return Flank(1.0, 1.0, exact=True), Flank(1.0, 1.0, exact=True)
