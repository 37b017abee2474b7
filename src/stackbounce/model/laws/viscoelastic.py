"""The contact of viscoelastic spheres, and one ball on it, which has one dimensionless parameter.

In units of ``L = (m v**2/k)**(2/5)`` and L/v the motion is ``x'' = -(x**1.5 + v*² sqrt(x) x')``
with ``v*² = 1.5 A (k/m)**(2/5) v**(1/5)``.

The restitution is a function of v*² alone, computed by a simulation.

Source: P. Müller and T. Pöschel, Phys. Rev. E 84, 021302 (2011). As here, their contact ends when
the force is back at zero.
"""

import functools
import math
from dataclasses import dataclass
from typing import Annotated, ClassVar, Self

from stackbounce.engine import codes
from stackbounce.errors import non_negative
from stackbounce.model.collision import elastic
from stackbounce.model.collision.roots import root
from stackbounce.model.laws.law import ContactLaw, Flank, Flanks, Given, Quantity, stiffness_in
from stackbounce.model.laws.registry import register

_WEAK = 1e-5
"""Up to this v*² the loss is computed by its power series: a simulation has too much round-off."""

_LOSS = 0.8 * 1.25**0.6 * math.gamma(0.6) * math.gamma(1.5) / math.gamma(2.1)
"""What the motion without loss, x'² = 1 - 0.8 x**2.5, dissipates per v*²: the integral of
sqrt(x) x' over x, in and out; 1 - e = u - 0.6 u² + ..., u being this times v*²."""


@register
@dataclass(frozen=True)
class Viscoelastic(ContactLaw):
    """The contact of two viscoelastic spheres, or of one and a flat floor.

    ``F = max(0, k (c**1.5 + 1.5 A sqrt(c) ċ))`` while the compression c is above 0, else 0. The
    contact ends when the force is back at zero, which is before the compression is. Until then,
    ``k c**2.5/2.5`` counts as stored energy.

    Parameters
    ----------
    stiffness : float
        k, in N/m**1.5, above 0, as of `Hertz`.
    dissipative_time : float
        A, in s, 0 or above: a constant of the material.

    Raises
    ------
    InvalidValue
        If `stiffness` is not positive and finite, or `dissipative_time` is negative or not finite.
    InvalidType
        If one of them is no number.

    Notes
    -----
    Source: G. Kuwabara and K. Kono, Jpn. J. Appl. Phys. 26, 1230 (1987); N. V. Brilliantov,
    F. Spahn, J.-M. Hertzsch and T. Pöschel, Phys. Rev. E 53, 5382 (1996). Valid where the speed is
    well below that of sound.

    Examples
    --------
    >>> Viscoelastic(3e6, dissipative_time=1e-4)
    Viscoelastic(stiffness=3000000.0, dissipative_time=0.0001)
    """

    formula = "F = max(0, stiffness (c**1.5 + 1.5 dissipative_time c**0.5 c'))"
    source = (
        "G. Kuwabara and K. Kono, Jpn. J. Appl. Phys. 26, 1230 (1987); N. V. Brilliantov, "
        "F. Spahn, J.-M. Hertzsch and T. Pöschel, Phys. Rev. E 53, 5382 (1996)"
    )
    form = codes.VISCOELASTIC
    third_number = "dissipative_time"
    loss = "dissipative_time"
    loss_depends_on = ("mass", "impact_speed")
    usual_models: ClassVar = {"Viscoelastic": {}}

    exponent: ClassVar[float] = 1.5
    stiffness: Annotated[float, stiffness_in("N/m**1.5")]
    dissipative_time: Annotated[
        float, Quantity("s", lambda n, v: non_negative(n, v, "seconds"), (3e-4, 1e-6, 1e-2))
    ]

    def restitution_at(self, mass: float, speed: float) -> float:
        """Return e, which follows from v*²."""
        return restitution(self._squared_speed(mass, speed))

    def duration_at(self, mass: float, speed: float) -> float:
        """Return the contact time in units of C/v."""
        return duration(self._squared_speed(mass, speed))

    def _squared_speed(self, mass: float, speed: float) -> float:
        rate: float = self.stiffness**0.4 / mass**0.4 * speed**0.2
        return 1.5 * self.dissipative_time * rate

    @classmethod
    def calibrated(cls, given: Given) -> Self:
        """Return the law that has a measured restitution and contact time."""
        squared = squared_speed(given["restitution"])
        k = elastic.measured_stiffness(given, duration(squared))
        # v*² = 1.5 A (k/m)**0.4 v**0.2
        rate = (k / given["mass"]) ** 0.4 * given["impact_speed"] ** 0.2
        return cls(k, squared / 1.5 / rate)

    @property
    def linger(self) -> float:
        """The time in s for which c stays above 0 after the force ends at ``c = -1.5 A ċ``."""
        return 1.5 * self.dissipative_time

    @classmethod
    def flanks(cls, exponent: float | None, law: ContactLaw | None = None) -> Flanks:
        """Return the flanks: ``root`` at the touch and ``fade`` at the release; see `Flank`."""
        return Flank(0.01, 0.3, "root"), Flank(0.01, 0.3, "fade")


@functools.lru_cache(maxsize=256)
def _collision(squared: float) -> tuple[float, float]:
    """Return e, and the contact time in units of L/v, at v*²."""
    return Viscoelastic(1.0, squared / 1.5)._bounce(1.0, 1.0)


def restitution(squared: float) -> float:
    """Return e at v*², 0 or above.

    Examples
    --------
    >>> [round(restitution(v * v), 6) for v in (0.0, 0.3, 0.5)]
    [1.0, 0.902852, 0.760037]
    """
    if squared <= _WEAK:
        loss = _LOSS * squared
        return float(1.0 - loss * (1.0 - 0.6 * loss))
    return _collision(squared)[0]


def duration(squared: float) -> float:
    """Return the contact time in units of C/v, see `elastic`, at v*², 0 or above.

    Examples
    --------
    >>> round(duration(0.0), 6)
    2.943275
    """
    if squared == 0.0:
        return elastic.duration(1.5)
    return _collision(squared)[1] / elastic.peak_compression(1.0, 1.5, 1.0, 1.0)


def squared_speed(restitution: float) -> float:
    """Return v*² at which e is `restitution`, from above 0 to 1.

    Examples
    --------
    >>> round(squared_speed(0.760037), 5)
    0.25
    """
    loss = 1.0 - restitution
    if loss <= _WEAK:
        return float(2.0 * loss / (1.0 + math.sqrt(1.0 - 2.4 * loss)) / _LOSS)
    # 1 - e is below 1.154 v*², its limit for small v*, and e below 1.311 v***(-10/3), for large
    low, high = (1.0 - restitution) / 1.154, (1.311 / restitution) ** 0.6
    return root(lambda squared: _collision(squared)[0] - restitution, low, high)
