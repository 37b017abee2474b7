"""Two balls pressed in series: the compression of each."""

import math
from dataclasses import dataclass
from typing import Any

from stackbounce.errors import InvalidType, InvalidValue, between, positive, shown
from stackbounce.measure.kinds.press.result import Press
from stackbounce.measure.quantities import Number, Row, measured
from stackbounce.model.laws import STEEPEST, PowerLaw, series


@dataclass(frozen=True)
class Split:
    """The parts of a compression in series at one force; see `split_series`. Lengths in m.

    Parameters
    ----------
    force : UFloat
        In N.
    bottom : UFloat
        Compression of the lower ball at the plate (or floor) below it.
    top : UFloat
        Of the lower ball at the upper one.
    upper : UFloat
        Of the upper ball.
    between : UFloat
        Of the centres' distance: `top` and half of `upper`.
    excess : UFloat
        Of both together, less the sum of each alone: 0 for springs in series.
    floor_stiffness, ball_stiffness : UFloat
        Force over `bottom` and over `between`, in N/m.
    ratio : UFloat
        Their ratio, k1/k2.
    notes : tuple of str
        What a reader of the numbers should know, a sentence each.
    """

    force: Number
    bottom: Number
    top: Number
    upper: Number
    between: Number
    excess: Number
    floor_stiffness: Number
    ball_stiffness: Number
    ratio: Number
    notes: tuple[str, ...]

    def rows(self) -> list[Row]:
        """Return the parts as rows of a table."""
        return [
            Row("stiffness ratio, floor over balls", self.ratio),
            Row("stiffness at the floor", self.floor_stiffness, "N/m"),
            Row("stiffness between the balls", self.ball_stiffness, "N/m"),
            Row("compression of the lower ball's bottom", self.bottom, "m"),
            Row("compression of the lower ball's top", self.top, "m"),
            Row("compression of the upper ball", self.upper, "m"),
            Row("compression between the centres", self.between, "m"),
            Row("compression beyond the sum of each alone", self.excess, "m"),
            Row("force", self.force, "N"),
        ]

    def parts(self) -> dict[str, object]:
        """Return the contact between the two balls as a linear spring, as a drop's TOML has it."""
        k = self.ball_stiffness.nominal_value
        return {"contact": {"law": "Spring", "stiffness": float(k)}} if k > 0.0 else {}


def split_series(lower: Any, upper: Any, both: Any, *, force: Any = None) -> Split:
    """Return the parts of the compression of two balls pressed in series, as in Figure 7.

    Parameters
    ----------
    lower, upper : Press, float or UFloat
        Each ball pressed alone between two plates: what `press` found, or its compression in m at
        `force`.
    both : Press, float or UFloat
        The upper ball on the lower one, pressed between the same plates.
    force : float or UFloat, optional
        In N; needed with compressions. By default the lowest of the peak forces.

    Returns
    -------
    Split

    Raises
    ------
    InvalidType
        If one of them is neither.
    InvalidValue
        If a number is not positive, or `force` is needed and missing.

    Notes
    -----
    A ball alone between two plates is compressed equally at both, so that half of its compression
    is at the bottom; this half is the same with the other ball on top. The compression of both,
    less this half and the upper ball's own compression, is that of the lower ball's top: R. Cross,
    Am. J. Phys. 75, 1009 (2007), section III. The stiffness between the balls is defined by the
    distance of their centres, so that half of the upper ball's compression counts; the other half
    is at the plate above it. This reading gives the paper's ratio of 1.8.

    Examples
    --------
    >>> from uncertainties import ufloat
    >>> mm = [ufloat(c, 0.05e-3) for c in (18.6e-3, 2.9e-3, 27.7e-3)]
    >>> split = split_series(*mm, force=ufloat(30.0, 0.5))
    >>> print(f"{1e3 * split.top:.1f} mm, {1e3 * split.excess:.1f} mm, {split.ratio:.2f}")
    15.5+/-0.1 mm, 6.2+/-0.1 mm, 1.82+/-0.01
    """
    given = {"lower": lower, "upper": upper, "both": both}
    curves = [curve for curve in given.values() if isinstance(curve, Press)]
    if force is None:
        if len(curves) < 3:
            raise InvalidValue("force must be given with compressions, got None")
        force = min((curve.peak_force for curve in curves), key=lambda peak: peak.nominal_value)
    at = measured("force", force, "newtons")
    below, above, pair = (_compression(name, value, at) for name, value in given.items())
    bottom, half = below / 2.0, above / 2.0
    top = pair - bottom - above
    closer = top + half
    excess = pair - below - above
    notes = []
    lowest = min((float(curve.peak_force.nominal_value) for curve in curves), default=math.inf)
    if at.nominal_value > 1.001 * lowest:
        notes.append("The force is beyond the peak of a curve, whose power law was continued.")
    if closer.nominal_value <= 0.0:
        raise InvalidValue(
            "both must be compressed by more than the lower ball's bottom and the upper ball's "
            f"upper half, got {shown(float(pair.nominal_value))} m"
        )
    if abs(excess.nominal_value) <= 2.0 * excess.std_dev:
        notes.append("Within the errors the two are springs in series: no extra indentation.")
    elif excess.nominal_value > 0.0:
        notes.append("The upper ball indents the lower one locally: it is softer there.")
    else:
        notes.append("Both give way by less than the two alone, which springs in series never do.")
    floor, ball = at / bottom, at / closer
    return Split(at, bottom, top, above, closer, excess, floor, ball, closer / bottom, tuple(notes))


def _compression(name: str, one: Any, force: Number) -> Number:
    """Return a compression at a force, as given or read off a curve."""
    if isinstance(one, Press):
        if one.loading is None:
            raise InvalidValue(f"{name} must be a press curve with a loading, got none")
        return one.compression_at(force)
    try:
        return measured(name, one, "metres")
    except InvalidType:
        raise InvalidType(
            f"{name} must be what press found, or a compression in m, got {shown(one)}"
        ) from None


def series_stiffness(stiffness_a: Any, stiffness_b: Any, *, exponent: float = 1.0) -> Number:
    """Return the stiffness of two contacts in series, ``k**(-1/p) = k1**(-1/p) + k2**(-1/p)``.

    Parameters
    ----------
    stiffness_a, stiffness_b : float or UFloat
        In N/m**exponent.
    exponent : float, optional
        p of both; 1 by default, and then ``1/k = 1/k1 + 1/k2``.

    Returns
    -------
    UFloat
        In N/m**exponent; the law is `stackbounce.series`.

    Raises
    ------
    InvalidValue
        If a number is out of its range.
    InvalidType
        If it is none.

    Examples
    --------
    >>> from uncertainties import ufloat
    >>> print(series_stiffness(ufloat(5.4e4, 0.25e4), ufloat(3.6e4, 0.28e4)))
    (2.16+/-0.11)e+04
    """
    a = measured("stiffness_a", stiffness_a, "N/m**exponent")
    b = measured("stiffness_b", stiffness_b, "N/m**exponent")
    p = between("exponent", exponent, 1.0, STEEPEST)
    k1, k2 = float(a.nominal_value), float(b.nominal_value)
    both = positive("series", series(PowerLaw(k1, p), PowerLaw(k2, p)).stiffness)
    # dk/k1 = (k/k1)**(1 + 1/p)
    slopes = [(both / k) ** (1.0 + 1.0 / p) for k in (k1, k2)]
    return both + slopes[0] * (a - k1) + slopes[1] * (b - k2)
