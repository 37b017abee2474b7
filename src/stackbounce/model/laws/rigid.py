"""The rigid contact: instantaneous collisions."""

from dataclasses import dataclass
from typing import Annotated, Self

from stackbounce.errors import fraction
from stackbounce.model.laws.law import ContactLaw, Given, Quantity
from stackbounce.model.laws.registry import register


@register
@dataclass(frozen=True)
class Rigid(ContactLaw):
    """An instantaneous collision with Newton's restitution.

    The relative speed after the collision is e times that before it,
    ``v_upper' - v_lower' = -e (v_upper - v_lower)``, and momentum is conserved; at the floor
    ``v' = -e v``.

    Parameters
    ----------
    restitution : float
        The ratio e of the relative speeds after and before, from 0 to 1.

    Raises
    ------
    InvalidValue
        If `restitution` lies outside 0 to 1.
    InvalidType
        If it is no number.

    Notes
    -----
    Source: R. Cross, Am. J. Phys. 75, 1009 (2007), eqs 1 to 4.

    Examples
    --------
    >>> Rigid(0.9)
    Rigid(restitution=0.9)
    """

    formula = "v' = -restitution v"
    source = "R. Cross, Am. J. Phys. 75, 1009 (2007), eqs 1 to 4"
    form = "RIGID"
    third_number = "restitution"
    rigid = True
    exact = True
    loss = "restitution"

    restitution: Annotated[float, Quantity("", fraction, (0.8, 0.05, 1.0))]

    @property
    def contact_time_depends_on(self) -> tuple[str, ...]:
        """Nothing: the contact time is always 0."""
        return ()

    def contact_time_at(self, mass: float, speed: float) -> float:
        """Return 0."""
        return 0.0

    @classmethod
    def calibration_needs(cls, exponent: float | None = None) -> list[str]:
        """Return the name of the only argument that `calibrate` needs."""
        return ["restitution"]

    @classmethod
    def calibrated(cls, given: Given) -> Self:
        """Return the law with the measured restitution."""
        return cls(given["restitution"])
