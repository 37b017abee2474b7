"""The result of the analysis of a press curve."""

from dataclasses import dataclass
from typing import Any, ClassVar

from stackbounce.errors import InvalidValue
from stackbounce.measure.finding import Branch, Finding
from stackbounce.measure.kinds.press.table import fitted_table
from stackbounce.measure.quantities import Array, Number, Row, known_rows, measured
from stackbounce.model import Tabulated
from stackbounce.model.laws.tabulated import MOST_POINTS

_AGREES = 2.0  # standard errors


@dataclass(frozen=True)
class Curve:
    """The points of one branch and the curve through them.

    Parameters
    ----------
    compression : ndarray
        (N,) from the contact on, in m; negative in the slack.
    force : ndarray
        (N,) in N, less its zero.
    fit : ndarray
        (N,) in N, the power law.
    misfit : float
        Root mean square of the part of the residuals that is smooth along the curve, over the peak
        force.
    noise : float
        Root mean square of the other part, in N.
    fits : bool
        Whether the smooth part is below 1 % of the peak force, or not significant in the noise.
    """

    compression: Array
    force: Array
    fit: Array
    misfit: float
    noise: float
    fits: bool


@dataclass(frozen=True, kw_only=True)
class Press(Finding):
    """The result of the analysis of a press curve; see `press`. None stands for unknown numbers.

    Parameters
    ----------
    stiffness : UFloat or None
        k of ``F = k c**p``, in N/m**p.
    exponent : UFloat or None
        p of the loading.
    linear_stiffness : UFloat or None
        Of the straight line through the contact that fits the loading best, in N/m.
    tangent_stiffness : UFloat or None
        p F/c at the peak, in N/m.
    secant_stiffness : UFloat or None
        Force over compression at the peak, in N/m.
    peak_compression : UFloat
        From contact to peak, in m.
    peak_force : UFloat
        In N.
    work_in, work_out : UFloat or None
        In J, from contact to peak and back.
    loss : UFloat or None
        ``1 - work_out/work_in``.
    restitution : UFloat or None
        ``sqrt(work_out/work_in)``.
    unloading_exponent : UFloat or None
        n of the unloading ``F ∝ c**n``, by the fit.
    energy_exponent : UFloat or None
        n by the works, ``(p + 1) work_in/work_out - 1``.
    contact : UFloat
        Compression at which the contact begins, on the record's scale, in m.
    zero : UFloat
        Zero of the force: its value in the slack, in N; exactly 0 without slack, as the force is
        then taken as recorded.
    relaxed : UFloat or None
        By how much the force dropped at the turn, in N.
    loading, unloading : Curve or None
        Points and fits.
    record : tuple of ndarray
        (compression, force) of all points, on the scales of the curves.
    cycle, cycles : int
        Which cycle this is, from 0, and how many the record has.
    tabulated : bool
        Whether the contact is the table of the curve, see `parts`.
    others : tuple of Press
        The other cycles that have a loading.
    notes : tuple of str
        What a reader of the numbers should know, a sentence each.
    """

    picture: ClassVar[str] = "press"

    peak_compression: Number
    peak_force: Number
    contact: Number
    zero: Number
    record: tuple[Array, Array]
    stiffness: Number | None = None
    exponent: Number | None = None
    linear_stiffness: Number | None = None
    tangent_stiffness: Number | None = None
    secant_stiffness: Number | None = None
    work_in: Number | None = None
    work_out: Number | None = None
    loss: Number | None = None
    restitution: Number | None = None
    unloading_exponent: Number | None = None
    energy_exponent: Number | None = None
    relaxed: Number | None = None
    loading: Curve | None = None
    unloading: Curve | None = None
    cycle: int = 0
    cycles: int = 1
    tabulated: bool = False
    others: "tuple[Press, ...]" = ()
    notes: tuple[str, ...] = ()

    @property
    def linear(self) -> bool:
        """Whether the exponent is 1 within two standard errors."""
        p: Any = self.exponent
        return p is not None and abs(p.nominal_value - 1.0) <= _AGREES * p.std_dev

    @property
    def lossless(self) -> bool | None:
        """Whether the loss is not significant (two standard errors). None without unloading."""
        loss: Any = self.loss
        return None if loss is None else bool(loss.nominal_value <= _AGREES * loss.std_dev)

    def compression_at(self, force: Number | float) -> Number:
        """Return the compression in m at which the loading has a force in N.

        Raises
        ------
        InvalidValue
            If there is no loading, or `force` is not positive.
        """
        at = measured("force", force, "newtons")
        if self.stiffness is None or self.exponent is None:
            raise InvalidValue("compression_at must have a loading to read it from, got none")
        return (at / self.stiffness) ** (1.0 / self.exponent)

    def rows(self) -> list[Row]:
        """Return what was found as rows of a table, the most important first."""
        p = f"N/m^{self.exponent.nominal_value:.3g}" if self.exponent is not None else "N/m^p"
        found = [
            ("static stiffness, straight line", self.linear_stiffness, "N/m"),
            ("exponent", self.exponent, ""),
            ("stiffness of the power law", self.stiffness, p),
            ("restitution", self.restitution, ""),
            ("energy lost", self.loss, ""),
            ("unloading exponent, from the energy", self.energy_exponent, ""),
            ("unloading exponent, from the curve", self.unloading_exponent, ""),
            ("peak compression", self.peak_compression, "m"),
            ("peak force", self.peak_force, "N"),
            ("stiffness at the peak, tangent", self.tangent_stiffness, "N/m"),
            ("stiffness at the peak, secant", self.secant_stiffness, "N/m"),
            ("work in loading", self.work_in, "J"),
            ("work in unloading", self.work_out, "J"),
            ("compression at contact, as recorded", self.contact, "m"),
            ("force with nothing pressed, as recorded", self.zero, "N"),
            ("drop of the force at the turn", self.relaxed, "N"),
        ]
        rows = known_rows(found)
        if self.cycles > 1:
            rows.append(Row("cycle", f"{self.cycle + 1} of {self.cycles}"))
        return rows

    def branches(self) -> list[Branch]:
        """Return loading and unloading, as far as they were recorded."""
        ways = (("pressed in", self.loading), ("let go", self.unloading))
        return [Branch(label, way.compression, way.force, way.fit) for label, way in ways if way]

    def table(self, points: int = MOST_POINTS) -> Tabulated:
        """Return the curve itself as a law: a `Tabulated` one, with as many points.

        Parameters
        ----------
        points : int, optional
            3 to 16, at equal distances from the contact to the peak.

        Raises
        ------
        InvalidValue
            If there is no loading, or it has too few points.
        """
        if self.loading is None:
            raise InvalidValue("table must have a loading to read it from, got none")
        back = self.unloading
        return fitted_table(
            (self.loading.compression, self.loading.force),
            None if back is None else (back.compression, back.force),
            points,
        )

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
            ``{"contact": {"law": …}}``, or nothing if there is no loading.
        """
        k, p, line, e = self.stiffness, self.exponent, self.linear_stiffness, self.restitution
        if k is None or p is None or line is None:
            return {}
        if self.tabulated:
            return {"contact": self.table().to_mapping()}
        as_spring = self.linear or p.nominal_value < 1.0
        contact: dict[str, object] = {"stiffness": float((line if as_spring else k).nominal_value)}
        if not as_spring:
            contact["exponent"] = float(p.nominal_value)
        if e is None or self.lossless:
            return {"contact": {"law": "Spring" if as_spring else "PowerLaw", **contact}}
        return {"contact": {"law": "Hysteretic", **contact, "restitution": float(e.nominal_value)}}
