"""A linear spring and a dashpot, and one ball on them in closed form.

With ``ω0**2 = k/m`` and the damping ratio ``ζ = b/(2 m ω0)`` the compression is
``c = (v/ω) exp(-ζ ω0 t) sin(ω t)``, ``ω = ω0 sqrt(1 - ζ**2)``. The force is back at zero at T,
where ``tan(ω T) = -2 ζ ω0 ω/(ω**2 - ζ**2 ω0**2)``, that is ``ω T = 2 acos(ζ)``, and there ``ċ`` is
``-v exp(-ζ ω0 T)``. So

``ω0 T = 2 acos(ζ)/sqrt(1 - ζ**2)``,  ``e = exp(-2 ζ acos(ζ)/sqrt(1 - ζ**2))``,

which are analytic in ζ. At the critical damping ζ = 1 they are 2 and exp(-2). For ζ above 1,
``acosh(ζ)/sqrt(ζ**2 - 1)`` replaces ``acos(ζ)/sqrt(1 - ζ**2)``: an overdamped ball rebounds as
well, and e approaches ``(2 ζ)**-2`` for large ζ.

Source: T. Schwager and T. Pöschel, Granular Matter 9, 465 (2007), who write arctangents in place of
``acos(ζ)``.
"""

import math
from typing import Annotated, ClassVar, Self

from stackbounce.engine import codes
from stackbounce.errors import non_negative
from stackbounce.model.collision import elastic
from stackbounce.model.collision.roots import root
from stackbounce.model.laws.law import ContactLaw, Flank, Given, number_in, stiffness_in
from stackbounce.model.laws.registry import register


class DampedSpring(ContactLaw):
    """A linear spring and a dashpot in parallel, with fields `stiffness` and `damping`."""

    third_number = "damping"
    loss = "damping"
    exponent: ClassVar[float] = 1.0

    def series_constants(self) -> dict[str, float]:
        """Return what two such contacts in series must have in common: b/k."""
        return {"damping/stiffness": self.damping / self.stiffness}

    def series_changes(self, stiffness: float, share: float) -> dict[str, float]:
        """Return stiffness and damping of two contacts in series; b/k is that of each."""
        return {"stiffness": stiffness, "damping": stiffness * (self.damping / self.stiffness)}


@register
class Dashpot(DampedSpring):
    """A linear spring and a dashpot in parallel (Kelvin-Voigt), which cannot pull.

    This is the Kelvin-Voigt model, spring and dashpot in parallel, without tension:
    ``F = max(0, k c + b ċ)`` while the compression c is above 0, else 0. The contact begins with
    the force b times the closing speed. It ends when the force returns to zero, which is before the
    compression does. Until then ``k c**2/2`` counts as stored energy.

    Parameters
    ----------
    stiffness : float
        k, in N/m, above 0.
    damping : float
        b, in N s/m, 0 or above.

    Raises
    ------
    InvalidValue
        If `stiffness` is not positive and finite, or `damping` is negative or not finite.
    InvalidType
        If one of them is no number.

    Notes
    -----
    Source: Bartz, arXiv 2007.15005. If the contact ended at c = 0 instead, the force would pull
    before the end, and the restitution would be another one.

    Examples
    --------
    >>> Dashpot(22500, damping=7.2)
    Dashpot(stiffness=22500.0, damping=7.2)
    """

    formula = "F = max(0, stiffness c + damping c')"
    source = "Bartz, arXiv 2007.15005"
    form = codes.DASHPOT
    loss_depends_on = ("mass",)
    usual_flanks = Flank(0.01, 0.3, "jump"), Flank(1.0, 1.0)  # a jump, and a linear release

    stiffness: Annotated[float, stiffness_in("N/m")]
    damping: Annotated[float, number_in("N s/m", non_negative, (2.0, 1e-2, 1e3))]

    def restitution_at(self, mass: float, speed: float) -> float:
        """Return e, which follows from the damping ratio ``ζ = b/(2 sqrt(k m))``."""
        return restitution(self._damping_ratio(mass))

    def duration_at(self, mass: float, speed: float) -> float:
        """Return the contact time in units of C/v."""
        return duration(self._damping_ratio(mass))

    def _damping_ratio(self, mass: float) -> float:
        return 0.5 * self.damping / math.sqrt(self.stiffness) / math.sqrt(mass)

    @classmethod
    def calibrated(cls, given: Given) -> Self:
        """Return the law that has a measured restitution and contact time."""
        zeta = damping_ratio(given["restitution"])
        lasts = duration(zeta)
        damping = 2.0 * zeta * given["mass"] * lasts / given["contact_time"]  # b = 2 ζ m ω0
        return cls(elastic.measured_stiffness(given, lasts), damping)

    @property
    def linger(self) -> float:
        """The time in s for which c stays above 0 after the force ends at ``c = -b ċ/k``."""
        return self.damping / self.stiffness


_FAR = 2.0  # from here on 1 - x would lose digits


def duration(zeta: float) -> float:
    """Return ``ω0 T``: the contact time T in units of ``1/ω0 = C/v``, see `elastic`.

    Parameters
    ----------
    zeta : float
        The damping ratio ζ, 0 or above.

    Returns
    -------
    float
        From π down to 0.

    Examples
    --------
    >>> [round(duration(zeta), 6) for zeta in (0.0, 0.1, 1.0)]
    [3.141593, 2.956075, 2.0]
    """
    if zeta > _FAR:
        return 2.0 * math.acosh(zeta) / (math.sqrt(zeta - 1.0) * math.sqrt(zeta + 1.0))
    # acos(ζ) = 2 atan(x) and sqrt(1 - ζ**2) = (1 + ζ) x, without loss where x is small
    x = math.sqrt(abs(1.0 - zeta) / (1.0 + zeta))
    arc = math.atan(x) if zeta < 1.0 else math.atanh(x)
    return 4.0 / (1.0 + zeta) * (arc / x if x > 0.0 else 1.0)


def restitution(zeta: float) -> float:
    """Return e at a damping ratio ζ of 0 or above.

    Examples
    --------
    >>> [round(restitution(zeta), 6) for zeta in (0.0, 0.1, 0.3)]
    [1.0, 0.744079, 0.450975]
    """
    return math.exp(-zeta * duration(zeta))


def damping_ratio(restitution: float) -> float:
    """Return the damping ratio ζ, 0 or above, of a restitution e above 0 and up to 1.

    Examples
    --------
    >>> round(damping_ratio(0.744079), 6)
    0.1
    """
    loss = -math.log(restitution)
    if loss == 0.0:
        return 0.0
    # ζ acos(ζ)/sqrt(1 - ζ**2) is at most ζ π/2, and from ζ = 1 on at least acosh(ζ)
    low, high = loss / math.pi, math.cosh(0.5 * loss)
    return root(lambda zeta: zeta * duration(zeta) - loss, low, high)
