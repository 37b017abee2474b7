"""A solid whose force relaxes; runs of one ball give its restitution and its contact time."""

import math
from collections.abc import Mapping
from typing import Annotated, ClassVar, Self

from stackbounce.engine import codes
from stackbounce.errors import InvalidValue, non_negative, positive
from stackbounce.model.laws.law import ContactLaw, Flank, Given, Quantity, number_in, stiffness_in
from stackbounce.model.laws.registry import register


@register
class StandardLinearSolid(ContactLaw):
    """A spring in parallel with a spring and a dashpot in series (Zener): its force relaxes.

    ``F = k (c + Δ (c - u))``, where u, the compression of the dashpot, follows the compression c of
    the contact: ``u̇ = (c - u)/τ``. A slow contact has the stiffness k, a sudden one ``(1 + Δ) k``,
    and the loss is largest between. A contact at rest begins with u = 0 and a force that rises from
    0. It ends when the force is back at zero: the ball leaves while the contact is still
    compressed. The surface then recovers without a force, in the time ``(1 + Δ) τ``; a ball that
    comes back before meets it where it is. Both springs store energy, ``k c**2/2`` and
    ``Δ k (c - u)**2/2``, also those of a surface that has not yet recovered.

    Parameters
    ----------
    stiffness : float
        k, in N/m, above 0: that of a slow compression, when all relaxation is over.
    relaxation_strength : float
        Δ, 0 or above: the share of the force that relaxes, over the share that stays.
    relaxation_time : float
        τ, in s, above 0: of the force at a constant compression.

    Raises
    ------
    InvalidValue
        If `stiffness` or `relaxation_time` is not positive and finite, or `relaxation_strength` is
        negative or not finite.
    InvalidType
        If one of them is no number.

    Notes
    -----
    Source: C. Zener, Elasticity and Anelasticity of Metals (1948), whose relaxation strength is Δ.
    The law is linear: neither restitution nor contact time depend on the speed.

    Examples
    --------
    >>> law = StandardLinearSolid(22500, relaxation_strength=0.5, relaxation_time=1e-3)
    >>> law
    StandardLinearSolid(stiffness=22500.0, relaxation_strength=0.5, relaxation_time=0.001)
    >>> round(law.restitution_at(mass=0.057, speed=3.0), 4)
    0.801
    """

    formula = (
        "F = max(0, stiffness (c + relaxation_strength (c - u))), u' = (c - u)/relaxation_time"
    )
    source = "C. Zener, Elasticity and Anelasticity of Metals (1948)"
    form = codes.RELAXING
    page_code: ClassVar = {
        "others": """({ contact_time }, { relaxation_strength }) =>
          ({ relaxation_time: contact_time / Math.PI / Math.sqrt(1 + relaxation_strength) })"""
    }
    third_number = "relaxation_strength"
    fourth_number = "relaxation_time"
    loss = "relaxation_strength"
    loss_depends_on = ("mass",)
    least_restitution = 2.7e-4  # at a relaxation strength of half a million
    usual_flanks = Flank(1.0, 1.0), Flank(1.0, 1.0)  # linear

    exponent: ClassVar[float] = 1.0
    stiffness: Annotated[float, stiffness_in("N/m")]
    relaxation_strength: Annotated[float, Quantity("", non_negative, (0.5, 1e-3, 10.0))]
    relaxation_time: Annotated[float, number_in("s", positive, (1e-3, 1e-6, 1.0))]

    @classmethod
    def assumed(cls, given: Given, numbers: Mapping[str, float]) -> dict[str, float]:
        """Return the relaxation time, unless it is given: ``T/π/sqrt(1 + Δ)``.

        With it a vibration with the half period of the contact time T loses most.
        """
        if "relaxation_time" in given:
            return {}
        rate = math.pi * math.sqrt(1.0 + numbers["relaxation_strength"])
        return {"relaxation_time": given["contact_time"] / rate}

    @classmethod
    def calibrated(cls, given: Given) -> Self:
        """Return the law that has a measured restitution and contact time."""
        try:
            return super().calibrated(given)
        except ArithmeticError:
            if "relaxation_time" not in given:
                raise
            share = given["relaxation_time"] / given["contact_time"]
            raise InvalidValue(
                f"restitution must be one that a relaxation_time of {share:.2g} contact "
                f"times allows, got {given['restitution']:g}: no relaxation strength loses so much"
            ) from None
