"""Rigid contacts: instantaneous collisions; restitutions may depend on the speed, and scatter."""

from collections.abc import Mapping
from dataclasses import replace
from typing import Annotated, Any, ClassVar, Self

from stackbounce.engine import codes
from stackbounce.engine.elementary import power
from stackbounce.errors import between, fraction
from stackbounce.model.laws.law import ContactLaw, EngineNumbers, Given, Quantity
from stackbounce.model.laws.registry import register

_RESTITUTION = Quantity("", lambda n, v: fraction(n, v, zero=False), (0.8, 0.05, 1.0))
_SPEED = Quantity("m/s", lambda n, v: between(n, v, 1e-9, 1e9, "m/s"), (1.0, 0.01, 10.0))
_EXPONENT = Quantity("", lambda n, v: between(n, v, 0.0, 4.0), (0.25, 0.0, 1.0))
_SCATTER = Quantity("", lambda n, v: between(n, v, 0.0, 1.0), (0.0, 0.0, 0.2))
_SEEDS = 4294967295.0
_SEED = Quantity("", lambda n, v: between(n, v, 0.0, _SEEDS), (0.0, 0.0, 100.0))


@register
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
    form = codes.RIGID
    third_number = "restitution"
    rigid = True
    exact = True
    loss = "restitution"
    needs: ClassVar[tuple[str, ...] | None] = ("restitution",)

    restitution: Annotated[float, Quantity("", fraction, (0.8, 0.05, 1.0))]

    @property
    def contact_time_depends_on(self) -> tuple[str, ...]:
        """Nothing: the contact time is always 0."""
        return ()

    def contact_time_at(self, mass: float, speed: float) -> float:
        """Return 0."""
        return 0.0

    @classmethod
    def calibrated(cls, given: Given) -> Self:
        """Return the law with the measured restitution."""
        return cls(given["restitution"])


@register
class RigidBySpeed(Rigid):
    """An instantaneous collision whose restitution falls with a power of the speed.

    ``e = restitution (v/speed)**-speed_exponent``, at most 1, where v is the speed at which the two
    meet. All else is as of `Rigid`.

    Parameters
    ----------
    restitution : float
        The restitution at `speed`, above 0 and at most 1.
    speed : float
        In m/s, from 1e-9 to 1e9.
    speed_exponent : float, optional
        From 0 to 4; by default 1/4, that of spheres that yield. 0: e is the same at all speeds.
    scatter : float, optional
        The standard deviation of e from collision to collision, from 0 to 1, at a given speed.
        Draws are normal, and e is kept from 0 to 1.
    seed : float, optional
        From 0 to 4294967295: another number gives other draws. A draw follows from the seed, the
        contact's place in the stack, and how often the contact has collided.

    Raises
    ------
    InvalidValue
        If a number lies outside its range.
    InvalidType
        If one is no number.

    Notes
    -----
    Source: A. P. Hatzes, F. G. Bridges and D. N. C. Lin, Mon. Not. R. Astron. Soc. 231 (1988),
    whose abstract, all that was read, has a power law for ice with frost. As others quote them, e
    of spheres that yield is proportional to v**(-1/4) (K. L. Johnson, Contact Mechanics, Cambridge,
    1985, section 11.5), and e of ice is 0.32 (v/(1 cm/s))**-0.234 (F. G. Bridges, A. Hatzes and
    D. N. C. Lin, Nature 309, 333, 1984).

    Examples
    --------
    >>> from stackbounce.run.collision import restitution
    >>> ice = RigidBySpeed(0.32, speed=0.01, speed_exponent=0.234)
    >>> [round(restitution(ice, impact_speed=v), 3) for v in (0.00001, 0.001, 0.01, 0.05)]
    [1.0, 0.548, 0.32, 0.22]
    """

    formula = "v' = -e v, e = min(1, restitution (v/speed)**-speed_exponent)"
    source = "A. P. Hatzes, F. G. Bridges and D. N. C. Lin, Mon. Not. R. Astron. Soc. 231 (1988)"
    form = codes.RIGID_POWER
    third_number = "scatter"
    fourth_number = "seed"
    page_code: ClassVar = {
        "numbers": """({ restitution, speed, speed_exponent, scatter, seed }) =>
          [restitution * speed ** speed_exponent, speed_exponent, scatter, seed]"""
    }
    loss_depends_on = ("impact_speed",)
    needs = ("restitution", "impact_speed")

    restitution: Annotated[float, _RESTITUTION]
    speed: Annotated[float, _SPEED]
    speed_exponent: Annotated[float, _EXPONENT] = 0.25
    scatter: Annotated[float, _SCATTER] = 0.0
    seed: Annotated[float, _SEED] = 0.0

    def engine_numbers(self, varied: Mapping[str, Any] = {}) -> EngineNumbers:
        """Return the law's numbers, with k of ``e = k v**-p`` in place of a stiffness."""
        e, v, p, scatter, seed = self.values(varied)
        return self.form, e * powers(v, p), p, scatter, seed

    def _described_fields(self) -> list[str]:
        """Return the fields to describe: scatter and seed only where it scatters."""
        names = super()._described_fields()
        return names if self.scatter else names[:-2]

    def of_collision(self, number: int) -> Self:
        """Return the law with another seed for each number."""
        return replace(self, seed=(self.seed + number) % _SEEDS) if self.scatter else self

    def restitution_at(self, mass: float, speed: float) -> float:
        """Return the restitution at a speed in m/s, without scatter."""
        return min(1.0, self.restitution * power(self.speed / speed, self.speed_exponent))

    @classmethod
    def calibrated(cls, given: Given) -> Self:
        """Return the law with a restitution measured at a speed, and the usual exponent."""
        return cls(given["restitution"], given["impact_speed"])


@register
class RigidLossBySpeed(RigidBySpeed):
    """An instantaneous collision whose loss grows with a power of the speed.

    ``1 - e = (1 - restitution) (v/speed)**speed_exponent``, at most 1, where v is the speed at
    which the two meet. All else is as of `Rigid`.

    Parameters
    ----------
    restitution : float
        The restitution at `speed`, above 0 and at most 1.
    speed : float
        In m/s, from 1e-9 to 1e9.
    speed_exponent : float, optional
        From 0 to 4; by default 1/5, that of viscoelastic spheres whose loss is small. 0: e is the
        same at all speeds.
    scatter : float, optional
        As of `RigidBySpeed`.
    seed : float, optional
        As of `RigidBySpeed`.

    Raises
    ------
    InvalidValue
        If a number lies outside its range.
    InvalidType
        If one is no number.

    Notes
    -----
    Source: R. Ramírez, T. Pöschel, N. V. Brilliantov and T. Schwager, Phys. Rev. E 60, 4465 (1999),
    whose abstract, all that was read, gives 1 - e = C v**(1/5) to leading order.

    Examples
    --------
    >>> from stackbounce.run.collision import restitution
    >>> basketball = RigidLossBySpeed(0.8, speed=3.0, speed_exponent=0.43)
    >>> [round(restitution(basketball, impact_speed=v), 3) for v in (0.5, 3.0, 6.0)]
    [0.907, 0.8, 0.731]
    """

    formula = "v' = -e v, e = max(0, 1 - (1 - restitution) (v/speed)**speed_exponent)"
    source = (
        "R. Ramírez, T. Pöschel, N. V. Brilliantov and T. Schwager, Phys. Rev. E 60, 4465 (1999)"
    )
    form = codes.RIGID_LOSS
    page_code: ClassVar = {
        "numbers": """({ restitution, speed, speed_exponent, scatter, seed }) =>
          [(1 - restitution) * speed ** -speed_exponent, speed_exponent, scatter, seed]"""
    }

    speed_exponent: Annotated[float, _EXPONENT] = 0.2

    def engine_numbers(self, varied: Mapping[str, Any] = {}) -> EngineNumbers:
        """Return the law's numbers, with k of ``1 - e = k v**p`` in place of a stiffness."""
        e, v, p, scatter, seed = self.values(varied)
        return self.form, (1.0 - e) * powers(v, -p), p, scatter, seed

    def restitution_at(self, mass: float, speed: float) -> float:
        """Return the restitution at a speed in m/s, without scatter."""
        faster = power(speed / self.speed, self.speed_exponent)
        return max(0.0, 1.0 - (1.0 - self.restitution) * faster)


def powers(base: Any, exponent: Any) -> Any:
    """Return the power of two numbers, or of each two of arrays, with the engine's own bits.

    Examples
    --------
    >>> powers(4.0, 0.5)
    2.0
    """
    if isinstance(base, float) and isinstance(exponent, float):
        return power(base, exponent)
    import numpy as np

    return np.frompyfunc(power, 2, 1)(base, exponent).astype(float)
