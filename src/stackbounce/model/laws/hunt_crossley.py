"""Hunt and Crossley's law: the restitution in closed form, the contact time by a run of one ball.

With ``d = χ v`` and ``u = ċ/v``, ``m v**2 u du = -k c**p (1 + d u) dc`` gives

``k c**(p+1)/(p+1) = m v**2 M/d**2``,  ``M = d - d u - ln((1 + d)/(1 + d u))``,

which returns to 0 at ``u = -e``, so that ``d (1 + e) = ln((1 + d)/(1 - d e))``. Both sides are
called q here: χ times the change of velocity in the collision. Then

``d = (q - 1 + exp(-q))/(1 - exp(-q))``,  ``e = (1 - (1 + q) exp(-q))/(q - 1 + exp(-q))``.

These formulas keep full precision for tiny and for huge d, if ``E(x) = (exp(x) - 1 - x)/x**2`` is
computed without cancellation.

Source: K. H. Hunt and F. R. E. Crossley, J. Appl. Mech. 42, 440 (1975); D. W. Marhefka and
D. E. Orin, IEEE Trans. Syst. Man Cybern. A 29, 566 (1999).
"""

import math
from typing import Annotated, ClassVar, Self

from stackbounce.engine import codes
from stackbounce.errors import non_negative
from stackbounce.model.collision import elastic
from stackbounce.model.collision.roots import root
from stackbounce.model.laws.law import EXPONENT, ContactLaw, Flank, Given, number_in, stiffness_in
from stackbounce.model.laws.registry import register

LARGEST = 1e300
"""The largest d that the functions of this module accept."""
_SMALL = 1.0  # the size up to which E(x) is summed
_FACTORS = tuple(1.0 / math.factorial(n) for n in range(2, 22))


@register
class HuntCrossley(ContactLaw):
    """A power law with a damping force in proportion to the elastic force.

    The damping force is proportional to the elastic force:
    ``F = max(0, k c**p (1 + χ ċ))`` while the compression c is above 0, else 0. A contact of two
    bodies ends when force and compression are both back at zero, because they separate more slowly
    than 1/χ. ``k c**(p + 1)/(p + 1)`` counts as stored energy.

    Parameters
    ----------
    stiffness : float
        k, in N/m**exponent, above 0.
    exponent : float
        p, from 1 to 1e6; 1.5 for spheres.
    dissipation : float
        χ, in s/m, 0 or above.

    Raises
    ------
    InvalidValue
        If `stiffness` is not positive and finite, `exponent` is out of its range, or `dissipation`
        is negative or not finite.
    InvalidType
        If one of them is no number.

    Notes
    -----
    Source: K. H. Hunt and F. R. E. Crossley, J. Appl. Mech. 42, 440 (1975). They write λ = k χ.

    Examples
    --------
    >>> HuntCrossley(3e6, 1.5, dissipation=0.15)
    HuntCrossley(stiffness=3000000.0, exponent=1.5, dissipation=0.15)
    """

    formula = "F = max(0, stiffness c**exponent (1 + dissipation c'))"
    source = "K. H. Hunt and F. R. E. Crossley, J. Appl. Mech. 42, 440 (1975)"
    form = codes.HUNT_CROSSLEY
    third_number = "dissipation"
    loss = "dissipation"
    loss_depends_on = ("impact_speed",)
    usual_exponent = 1.5
    usual_models: ClassVar = {"HuntCrossley": {}}

    stiffness: Annotated[float, stiffness_in("N/m**exponent")]
    exponent: Annotated[float, EXPONENT]
    dissipation: Annotated[float, number_in("s/m", non_negative, (0.2, 1e-3, 10.0))]

    def restitution_at(self, mass: float, speed: float) -> float:
        """Return e, which follows from ``d = χ v``."""
        d = self.dissipation * speed
        if d > LARGEST:
            raise OverflowError
        return restitution(d)

    @classmethod
    def calibrated(cls, given: Given) -> Self:
        """Return the law that has a measured restitution and contact time."""
        p, d = given["exponent"], dissipation(given["restitution"])
        k = elastic.measured_stiffness(given, cls(1.0, p, d).duration_at(1.0, 1.0))
        return cls(k, p, d / given["impact_speed"])

    @classmethod
    def flanks(cls, exponent: float | None, law: ContactLaw | None = None) -> tuple[Flank, Flank]:
        """Return the flanks: a power at the touch, and roughly a power at the release."""
        return Flank(exponent or 1.0, exponent or 1.5, exact=True), Flank(1.0, 2.5)

    def series_constants(self) -> dict[str, float]:
        """Return the quantities that two laws in series must have in common: also χ/k**(1/p)."""
        rate = self.dissipation / self.stiffness ** (1.0 / self.exponent)
        return {"exponent": self.exponent, "dissipation/stiffness**(1/exponent)": rate}

    def series_changes(self, stiffness: float, share: float) -> dict[str, float]:
        """Return stiffness and dissipation of two laws in series; the latter is χ times `share`."""
        return {"stiffness": stiffness, "dissipation": self.dissipation * share}


def restitution(d: float) -> float:
    """Return e at ``d = χ v``, 0 or above; it does not depend on the exponent.

    Examples
    --------
    >>> [round(restitution(d), 5) for d in (0.0, 0.1, 0.3, 1.0)]
    [1.0, 0.93748, 0.83287, 0.59362]
    """
    return _restitution(_change(d)) if d > 0.0 else 1.0


def dissipation(restitution: float) -> float:
    """Return ``d = χ v`` of a restitution e above 0 and up to 1.

    Raises
    ------
    ArithmeticError
        If d is too large.

    Examples
    --------
    >>> round(dissipation(0.593624), 5)
    1.0
    """
    if restitution == 1.0:
        return 0.0
    # 1 - e is at most q/3, and q - 1 at most 1/e
    low, high = 1.0 - restitution, 1.0 + 1.0 / restitution
    if high > LARGEST:
        raise OverflowError
    return _dissipation(root(lambda q: _restitution(q) - restitution, low, high))


def _excess(x: float) -> float:
    """Return ``E(x) = (exp(x) - 1 - x)/x**2``."""
    if abs(x) < _SMALL:
        return sum(factor * x**n for n, factor in enumerate(_FACTORS))
    return (math.expm1(x) - x) / x / x


def _dissipation(q: float) -> float:
    """Return d at a ``q = d (1 + e)`` above 0."""
    if q < _SMALL:
        return q * _excess(-q) * (q / -math.expm1(-q))
    return (q + math.expm1(-q)) / -math.expm1(-q)


def _restitution(q: float) -> float:
    """Return e at a ``q = d (1 + e)`` above 0."""
    if q < _SMALL:
        return math.exp(-q) * _excess(q) / _excess(-q)
    return (1.0 - (1.0 + q) * math.exp(-q)) / (q + math.expm1(-q))


def _change(d: float) -> float:
    """Return q at a d above 0; it is at most 2 d and 1 + d, because e is at most 1 and 1/d."""
    return root(lambda q: _dissipation(q) - d, d, min(2.0 * d, 1.0 + d))
