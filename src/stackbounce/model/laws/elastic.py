"""The lossless laws: the force is a power of the compression, loading and unloading."""

from typing import Annotated, ClassVar

from stackbounce.engine import codes
from stackbounce.errors import InvalidValue, instance
from stackbounce.model.ball import Ball
from stackbounce.model.laws.law import EXPONENT, ContactLaw, Flank, stiffness_in
from stackbounce.model.laws.registry import register

_ELASTIC = ("diameter", "young_modulus", "poisson_ratio")  # what Hertz's law needs of a ball
_STEEPEST_FLANK = 2.5  # the largest exponent that a force record of an unknown power law may have


class ElasticLaw(ContactLaw):
    """A law ``F = k c**p`` without loss; a class sets `exponent` or has it as a field."""

    form = codes.POWER
    rate_free = True

    @classmethod
    def flanks(cls, exponent: float | None, law: ContactLaw | None = None) -> tuple[Flank, Flank]:
        """Return the flanks: the same power of the time at touch and release."""
        either = Flank(exponent or 1.0, exponent or _STEEPEST_FLANK, exact=True)
        return either, either

    def as_hysteretic(self) -> ContactLaw:
        """Return the law as a `Hysteretic` one that loses nothing."""
        from stackbounce.model.laws.hysteretic import Hysteretic

        return Hysteretic(self.stiffness, exponent=self.exponent, restitution=1.0)


@register
class Spring(ElasticLaw):
    """A linear spring without loss that can be compressed and cannot pull.

    ``F = k c`` while the compression c is above 0, else 0. The contact ends when force and
    compression are back at zero.

    Parameters
    ----------
    stiffness : float
        k, in N/m, above 0.

    Raises
    ------
    InvalidValue
        If `stiffness` is not positive and finite.
    InvalidType
        If it is no number.

    Notes
    -----
    Source: R. Cross, Am. J. Phys. 75, 1009 (2007), eqs 5 and 6.

    Examples
    --------
    >>> Spring(2500)
    Spring(stiffness=2500.0)
    """

    formula = "F = stiffness c"
    source = "R. Cross, Am. J. Phys. 75, 1009 (2007), eqs 5 and 6"
    exact = True
    usual_models: ClassVar = {"Spring": {}}

    exponent: ClassVar[float] = 1.0
    stiffness: Annotated[float, stiffness_in("N/m")]


@register
class Hertz(ElasticLaw):
    """The contact of two elastic spheres, or of one and a flat floor, without loss.

    ``F = k c**1.5`` while the compression c is above 0, else 0. The contact ends when force and
    compression are back at zero; it stores ``k c**2.5/2.5``.

    Parameters
    ----------
    stiffness : float
        k, in N/m**1.5, above 0; `between` computes it from the balls' materials.

    Raises
    ------
    InvalidValue
        If `stiffness` is not positive and finite.
    InvalidType
        If it is no number.

    Notes
    -----
    Source: H. Hertz, J. Reine Angew. Math. 92, 156 (1881); K. L. Johnson, Contact Mechanics
    (Cambridge, 1985), section 4.2. The `exponent`, 1.5, can be read.

    Examples
    --------
    >>> Hertz(2e9), Hertz(2e9).exponent
    (Hertz(stiffness=2000000000.0), 1.5)
    """

    formula = "F = stiffness c**1.5"
    source = (
        "H. Hertz, J. Reine Angew. Math. 92, 156 (1881); "
        "K. L. Johnson, Contact Mechanics (Cambridge, 1985), section 4.2"
    )
    usual_models: ClassVar = {"Hertz": {}}

    exponent: ClassVar[float] = 1.5
    stiffness: Annotated[float, stiffness_in("N/m**1.5")]

    @classmethod
    def between(cls, ball_a: Ball, ball_b: Ball | None = None) -> "Hertz":
        """Return the contact of two balls, or of one and a flat rigid floor.

        ``k = (4/3) E* sqrt(R*)`` with ``1/E* = (1 - ν1**2)/E1 + (1 - ν2**2)/E2`` and
        ``1/R* = 1/R1 + 1/R2``; a flat rigid floor has no share in either sum.

        Parameters
        ----------
        ball_a : Ball
            One ball, with its `diameter`, `young_modulus` and `poisson_ratio`.
        ball_b : Ball, optional
            The other one; by default a flat rigid floor.

        Returns
        -------
        Hertz

        Raises
        ------
        InvalidValue
            If a ball lacks one of these three, or they give no finite stiffness.
        InvalidType
            If one of them is no Ball.

        Notes
        -----
        Source: K. L. Johnson, Contact Mechanics (Cambridge, 1985), eqs 4.17, 4.18 and 4.23.

        Examples
        --------
        >>> steel = {"young_modulus": 206e9, "poisson_ratio": 0.3}
        >>> lower, upper = Ball(0.228, 0.0381, **steel), Ball(0.081, 0.0270, **steel)
        >>> print(f"{Hertz.between(lower).stiffness:.3e}")
        4.166e+10
        >>> print(f"{Hertz.between(lower, upper).stiffness:.3e}")
        1.341e+10
        """
        shares = [_shares("ball_a", ball_a)]
        if ball_b is not None:
            shares.append(_shares("ball_b", ball_b))
        compliance, curvature = map(sum, zip(*shares, strict=True))  # 1/E* in 1/Pa, 1/R* in 1/m
        return cls(4.0 / 3.0 / compliance / curvature**0.5)


def _shares(name: str, ball: object) -> tuple[float, float]:
    """Return a ball's shares in 1/E* and 1/R*."""
    ball = instance(name, ball, Ball)
    numbers = [getattr(ball, field) for field in _ELASTIC]
    if None in numbers:
        missing = (f for f, number in zip(_ELASTIC, numbers, strict=True) if number is None)
        listed = ", ".join(f"{name}.{field}" for field in missing)
        raise InvalidValue(f"{listed} must be given for a Hertz contact, got None")
    diameter, modulus, ratio = numbers
    return (1.0 - ratio) * (1.0 + ratio) / modulus, 2.0 / diameter


@register
class PowerLaw(ElasticLaw):
    """A spring without loss whose force grows as a power of the compression.

    ``F = k c**p`` while the compression c is above 0, else 0. The contact ends when force and
    compression are back at zero; it stores ``k c**(p + 1)/(p + 1)``.

    Parameters
    ----------
    stiffness : float
        k, in N/m**exponent, above 0.
    exponent : float
        p, from 1, a linear spring, to 1e6.

    Raises
    ------
    InvalidValue
        If `stiffness` is not positive and finite, or `exponent` is out of its range.
    InvalidType
        If one of them is no number.

    Notes
    -----
    Source: P. Patricio, "The Hertz contact in chain elastic collisions", Am. J. Phys. 72, 1488
    (2004).

    Examples
    --------
    >>> PowerLaw(1e7, exponent=1.3)
    PowerLaw(stiffness=10000000.0, exponent=1.3)
    """

    formula = "F = stiffness c**exponent"
    source = (
        'P. Patricio, "The Hertz contact in chain elastic collisions", Am. J. Phys. 72, 1488 (2004)'
    )

    stiffness: Annotated[float, stiffness_in("N/m**exponent")]
    exponent: Annotated[float, EXPONENT]
