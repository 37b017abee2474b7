"""A solid whose force relaxes, and one ball on it in closed form.

In units of τ for times, with ``a = τ**2 k/m``, the motion of one ball has the exponents ``-y`` and
``-σ ± i ν``, the roots of ``x**3 + x**2 + (1 + Δ) a x + a``. With ``w = 1 - y``, the first one is

``w (1 - w)**2 = a (Δ - (1 + Δ) w)``,  and then ``σ = w/2``, ``ν**2 = a/y - σ**2``.

With ``z = 1/(1 + Δ)``, ``g = y - σ`` and ``N = g**2 + ν**2`` the force is proportional to

``f = A (cos(ν t) - exp(-g t)) + B sin(ν t)/ν``,  ``A = y - z``, ``B = ν**2 + g (z - σ)``,

times ``exp(-σ t)``. It begins at 0, rises, and is back at 0 before ``A cos(ν t) + B sin(ν t)/ν``
is. Three real exponents, ``ν**2 < 0``, are possible for ``Δ > 8`` only; the force is back at zero
once as well, so that every ball leaves. Nothing here depends on the speed.

Source: C. Zener, Elasticity and Anelasticity of Metals (1948), for the solid; the collision is this
package's own.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Annotated, ClassVar, Self

from stackbounce.engine import codes
from stackbounce.errors import InvalidValue, non_negative, positive
from stackbounce.model.collision import elastic
from stackbounce.model.collision.roots import root
from stackbounce.model.laws.law import ContactLaw, Flank, Flanks, Given, Quantity, stiffness_in
from stackbounce.model.laws.registry import register

_CLOSE = 1e-3
"""N over y**2 below which the three exponents are so close that the closed form loses digits."""

_STRONGEST = 1e6
"""The largest relaxation strength that `calibrate` tries."""


@register
@dataclass(frozen=True)
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
    least_restitution = 2.7e-4  # nearly at the largest relaxation strength that is tried

    exponent: ClassVar[float] = 1.0
    stiffness: Annotated[float, stiffness_in("N/m")]
    relaxation_strength: Annotated[float, Quantity("", non_negative, (0.5, 1e-3, 10.0))]
    relaxation_time: Annotated[
        float, Quantity("s", lambda n, v: positive(n, v, "seconds"), (1e-3, 1e-6, 1.0))
    ]

    def restitution_at(self, mass: float, speed: float) -> float:
        """Return e, which follows from Δ and ``τ sqrt(k/m)``."""
        return self._collision(mass)[0]

    def duration_at(self, mass: float, speed: float) -> float:
        """Return the contact time in units of C/v."""
        return self._collision(mass)[1]

    def _collision(self, mass: float) -> tuple[float, float]:
        time = self.relaxation_time * math.sqrt(self.stiffness) / math.sqrt(mass)
        return collision(self.relaxation_strength, time)

    @classmethod
    def calibrated(cls, given: Given) -> Self:
        """Return the law that has a measured restitution and contact time.

        Without a ``relaxation_time`` it is the one at which a vibration with the half period of the
        contact time T would lose most, ``T/π/sqrt(1 + Δ)``.
        """
        kept, lasts = given["restitution"], given["contact_time"]
        known = given.get("relaxation_time")

        def share(strength: float) -> float:
            """Return τ/T."""
            own = 1.0 / math.pi / math.sqrt(1.0 + strength)
            return own if known is None else known / lasts

        strength = _strength(kept, share) if kept < 1.0 else 0.0
        time = _time(strength, share(strength))
        k = elastic.measured_stiffness(given, collision(strength, time)[1])
        return cls(k, strength, lasts * share(strength))

    @classmethod
    def flanks(cls, exponent: float | None, law: ContactLaw | None = None) -> Flanks:
        """Return the flanks: the force rises and falls linearly."""
        return Flank(1.0, 1.0), Flank(1.0, 1.0)


def collision(strength: float, time: float) -> tuple[float, float]:
    """Return the restitution e, and the contact time in units of ``C/v = sqrt(m/k)``.

    Parameters
    ----------
    strength : float
        Δ, 0 or above.
    time : float
        τ in the same units, above 0.

    Returns
    -------
    tuple of float

    Raises
    ------
    ArithmeticError
        If a number is out of range.

    Examples
    --------
    >>> [tuple(round(x, 6) for x in collision(1.0, t)) for t in (1e-9, 0.5, 1e9)]
    [(1.0, 3.141593), (0.67795, 2.574206), (1.0, 2.221441)]
    """
    if strength == 0.0:
        return 1.0, math.pi
    a, b = time * time, 1.0 + strength
    if not 0.0 < a < math.inf:
        raise OverflowError
    w = root(
        lambda w: w * (1.0 - w) ** 2 - a * (strength - b * w),
        a * strength / (1.0 + a * b),
        strength / b,
    )
    y, sigma = 1.0 - w, 0.5 * w
    g, square = y - sigma, a / y - sigma * sigma
    norm = g * g + square
    if norm < _CLOSE * y * y:
        return StandardLinearSolid(1.0, strength, time)._bounce(1.0, 1.0)
    start = y * y * w / (a * b)  # A, without cancellation
    slope = square + g * (1.0 / b - sigma)  # B

    def force(t: float) -> float:
        cos, sin, decay = _turn(square, t)
        return start * (cos - decay * math.exp(-g * t)) + slope * sin

    late = _after_release(square, start, slope, force)
    early = 0.5 * late
    while force(early) <= 0.0:
        early *= 0.5
    t = root(force, early, late)
    cos, sin, decay = _turn(square, t)
    rest = square - sigma * g
    leaving = (y - sigma * y + rest) * cos + (rest * (1.0 - sigma) - y * square) * sin
    speed = decay * y * w * math.exp(-g * t) - leaving
    return speed * math.exp(-sigma * t) / decay / norm, time * t


def _turn(square: float, t: float) -> tuple[float, float, float]:
    """Return cos(ν t), sin(ν t)/ν and 1, or for ``ν**2 < 0`` all of them times exp(-|ν| t)."""
    nu = math.sqrt(abs(square))
    if square > 0.0:
        return math.cos(nu * t), math.sin(nu * t) / nu, 1.0
    decay = math.exp(-nu * t)
    if nu == 0.0:
        return 1.0, t, decay
    return 0.5 * (1.0 + decay * decay), 0.5 * (1.0 - decay * decay) / nu, decay


def _after_release(
    square: float, start: float, slope: float, force: Callable[[float], float]
) -> float:
    """Return a time after the release, and before the formula of the force rises again."""
    if square > 0.0:
        nu = math.sqrt(square)
        return math.atan2(start * nu, -slope) / nu
    t = 1.0
    while force(t) > 0.0:
        t *= 2.0
        if t == math.inf:
            raise ArithmeticError
    return t


def _time(strength: float, share: float) -> float:
    """Return τ in units of sqrt(m/k) for which it is a share of the contact time."""
    low, high = 0.5 * share, 2.0 * share

    def excess(time: float) -> float:
        return time - share * collision(strength, time)[1]

    while excess(low) > 0.0:
        low *= 0.5
    while excess(high) < 0.0:
        high *= 2.0
    return root(excess, low, high)


def _strength(restitution: float, share: Callable[[float], float]) -> float:
    """Return Δ of a restitution below 1, τ being a share of the contact time that depends on Δ."""

    def excess(strength: float) -> float:
        return collision(strength, _time(strength, share(strength)))[0] - restitution

    low = 1.0 - restitution
    while excess(low) < 0.0:
        low *= 0.5
    high = 2.0 * low
    while excess(high) > 0.0:
        high *= 2.0
        if high > _STRONGEST:
            raise InvalidValue(
                f"restitution must be one that a relaxation_time of {share(high):.2g} contact "
                f"times allows, got {restitution:g}: no relaxation strength up to "
                f"{_STRONGEST:g} loses so much"
            )
    return root(excess, low, high)
