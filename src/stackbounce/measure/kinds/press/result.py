"""The result of the analysis of a press curve."""

from dataclasses import dataclass
from typing import Annotated, Any, ClassVar

import numpy as np

from stackbounce.errors import InvalidValue
from stackbounce.measure.finding import Branch, Finding, Listed
from stackbounce.measure.quantities import Array, Number, Row, measured, nominal
from stackbounce.model import Tabulated
from stackbounce.model.laws.tabulated import MOST_POINTS

_AGREES = 2.0  # standard errors
_FEWEST = 6  # points of a branch that is a table
_STEEP = 1e-6  # of the mean rise: the smallest rise of the loading from point to point
_FIRM = 1e3  # weight of the condition that unloading begins where loading ends, over all points


@dataclass(frozen=True, kw_only=True, repr=False)
class Press(Finding):
    """The result of the analysis of a press curve; see `press`. None stands for unknown numbers.

    Parameters
    ----------
    linear_stiffness : UFloat
        Of the straight line through the contact that fits the loading best, in N/m.
    exponent : UFloat
        p of the loading.
    stiffness : UFloat
        k of ``F = k c**p``, in N/m**p.
    restitution : UFloat or None
        ``sqrt(work_out/work_in)``.
    loss : UFloat or None
        ``1 - work_out/work_in``.
    energy_exponent : UFloat or None
        n by the works, ``(p + 1) work_in/work_out - 1``.
    unloading_exponent : UFloat or None
        n of the unloading ``F ∝ c**n``, by the fit.
    peak_compression : UFloat
        From contact to peak, in m.
    peak_force : UFloat
        In N.
    tangent_stiffness : UFloat
        p F/c at the peak, in N/m.
    secant_stiffness : UFloat
        Force over compression at the peak, in N/m.
    work_in, work_out : UFloat, and UFloat or None
        In J, from contact to peak and back.
    contact : UFloat
        Compression at which the contact begins, on the record's scale, in m.
    zero : UFloat
        Zero of the force: its value in the slack, in N; exactly 0 without slack, as the force is
        then taken as recorded.
    relaxed : UFloat or None
        By how much the force dropped at the turn, in N.
    cycle : str or None
        Which cycle of how many this is, counted from 1; None where the record has one.
    loading, unloading : Branch, and Branch or None
        Points and fits.
    tabulated : bool
        Whether the contact is the table of the curve, see `parts`.
    notes : tuple of str
        What a reader of the numbers should know, a sentence each.
    """

    picture: ClassVar[str] = "press"

    linear_stiffness: Annotated[Number, Listed("static stiffness, straight line", "N/m")]
    exponent: Annotated[Number, Listed("exponent")]
    stiffness: Annotated[Number, Listed("stiffness of the power law", "N/m^p")]
    restitution: Annotated[Number | None, Listed("restitution")] = None
    loss: Annotated[Number | None, Listed("energy lost")] = None
    energy_exponent: Annotated[Number | None, Listed("unloading exponent, from the energy")] = None
    unloading_exponent: Annotated[Number | None, Listed("unloading exponent, from the curve")] = (
        None
    )
    peak_compression: Annotated[Number, Listed("peak compression", "m")]
    peak_force: Annotated[Number, Listed("peak force", "N")]
    tangent_stiffness: Annotated[Number, Listed("stiffness at the peak, tangent", "N/m")]
    secant_stiffness: Annotated[Number, Listed("stiffness at the peak, secant", "N/m")]
    work_in: Annotated[Number, Listed("work in loading", "J")]
    work_out: Annotated[Number | None, Listed("work in unloading", "J")] = None
    contact: Annotated[Number, Listed("compression at contact, as recorded", "m")]
    zero: Annotated[Number, Listed("force with nothing pressed, as recorded", "N")]
    relaxed: Annotated[Number | None, Listed("drop of the force at the turn", "N")] = None
    cycle: Annotated[str | None, Listed("cycle")] = None
    loading: Branch
    unloading: Branch | None = None
    tabulated: bool = False
    notes: tuple[str, ...] = ()

    def compression_at(self, force: Number | float) -> Number:
        """Return the compression in m at which the loading has a force in N.

        Raises
        ------
        InvalidValue
            If `force` is not positive.
        """
        return (measured("force", force, "newtons") / self.stiffness) ** (1.0 / self.exponent)

    def rows(self) -> list[Row]:
        """Return the table, the most important first; p in a unit is the exponent."""
        power = f"^{self.exponent.nominal_value:.3g}"
        return [row._replace(unit=row.unit.replace("^p", power)) for row in super().rows()]

    def branches(self) -> list[Branch]:
        """Return loading and unloading, as far as they were recorded."""
        return [way for way in (self.loading, self.unloading) if way is not None]

    def as_law(self) -> Tabulated:
        """Return the curve itself as a law: a `Tabulated` one.

        Its points are at equal distances from the contact to the peak, by monotone least squares
        through the many points of a branch; those with a compression below 0 are left out.

        Raises
        ------
        InvalidValue
            If it has too few points.
        """
        from scipy.interpolate import PchipInterpolator

        c, f = _pressed("loading", self.loading)
        knots = np.linspace(0.0, float(c.max()), MOST_POINTS)
        force, bulge = np.zeros(MOST_POINTS), np.zeros(len(c))
        for _ in range(2):  # the second time by how much the law's spline is off straight lines
            force = np.append(0.0, np.cumsum(_rises(_ramps(knots, c), f - bulge)))
            bulge = PchipInterpolator(knots, force)(c) - np.interp(c, knots, force)
        force[1:] += _STEEP * force[-1] * np.arange(1, MOST_POINTS) / MOST_POINTS
        if self.unloading is None:
            return Tabulated(knots.tolist(), force.tolist())
        c, f = _pressed("unloading", self.unloading)
        # The share of the loading rises to 1: all rises together are 1, by a firm condition.
        ramps = np.insert(_ramps(knots, c)[:, 1:], 0, 1.0, axis=1)
        ramps *= np.interp(c, knots, force)[:, None]
        firm = _FIRM * len(c) ** 0.5 * force[-1]
        firmly = np.vstack([ramps, np.full_like(ramps[:1], firm)])
        shares = np.cumsum(_rises(firmly, np.append(f, firm)))
        shares[-1] = 1.0
        back = np.append(0.0, force[1:] * np.minimum(shares, 1.0))
        return Tabulated(knots.tolist(), force.tolist(), back.tolist())

    def parts(self) -> dict[str, Any]:
        """Return the contact, as a drop's TOML has it.

        The exponent is 1 where it is 1 within two standard errors or below 1, which no law has; the
        stiffness then is that of the straight line. Without a significant loss (two standard
        errors), or without unloading, the law is `Spring`, or `PowerLaw` for another exponent.
        Otherwise it is `Hysteretic`, with the restitution that the works give. If `tabulated` is
        true, the law is `Tabulated`.

        Returns
        -------
        dict
            ``{"contact": {"law": …}}``.
        """
        if self.tabulated:
            return {"contact": self.as_law().to_mapping()}
        p, e = self.exponent, self.restitution
        loss: Any = self.loss
        contact: dict[str, Any] = {"law": "Spring", "stiffness": nominal(self.linear_stiffness)}
        if p.nominal_value - 1.0 > _AGREES * p.std_dev:
            contact = {"law": "PowerLaw", "stiffness": nominal(self.stiffness)}
            contact["exponent"] = nominal(p)
        if e is not None and loss.nominal_value > _AGREES * loss.std_dev:
            contact |= {"law": "Hysteretic", "restitution": nominal(e)}
        return {"contact": contact}


def _pressed(name: str, curve: Branch) -> tuple[Array, Array]:
    """Return the points of a branch at which the ball is pressed."""
    keep = curve.compression >= 0.0
    if keep.sum() < _FEWEST or not np.any(curve.compression > 0.0):
        raise InvalidValue(
            f"{name} must have at least {_FEWEST} points with a compression of 0 or above, "
            f"got {keep.sum()}"
        )
    return curve.compression[keep], curve.force[keep]


def _ramps(knots: Array, c: Array) -> Array:
    """Return how far each point is within each interval of the knots, from 0 to 1, (N, K - 1)."""
    return np.asarray(np.clip((c[:, None] - knots[None, :-1]) / np.diff(knots), 0.0, 1.0))


def _rises(ramps: Array, wanted: Array) -> Array:
    """Return the rises, none below 0, whose sum along the ramps fits points best."""
    from scipy.optimize import nnls

    return np.asarray(nnls(ramps, wanted)[0])
