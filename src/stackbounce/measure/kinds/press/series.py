"""Two balls pressed in series: the compression of each."""

from dataclasses import dataclass
from typing import Annotated, Any

from stackbounce.errors import InvalidValue, shown
from stackbounce.measure.finding import Finding, Listed
from stackbounce.measure.quantities import Number, measured


@dataclass(frozen=True, repr=False)
class Split(Finding):
    """The parts of a compression in series at one force; see `split_series`. Lengths in m.

    Parameters
    ----------
    ratio : UFloat
        Of both stiffnesses, k1/k2.
    floor_stiffness, ball_stiffness : UFloat
        Force over `bottom` and over `between`, in N/m.
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
    force : UFloat
        In N.
    notes : tuple of str
        What a reader of the numbers should know, a sentence each.
    """

    ratio: Annotated[Number, Listed("stiffness ratio, floor over balls")]
    floor_stiffness: Annotated[Number, Listed("stiffness at the floor", "N/m")]
    ball_stiffness: Annotated[Number, Listed("stiffness between the balls", "N/m")]
    bottom: Annotated[Number, Listed("compression of the lower ball's bottom", "m")]
    top: Annotated[Number, Listed("compression of the lower ball's top", "m")]
    upper: Annotated[Number, Listed("compression of the upper ball", "m")]
    between: Annotated[Number, Listed("compression between the centres", "m")]
    excess: Annotated[Number, Listed("compression beyond the sum of each alone", "m")]
    force: Annotated[Number, Listed("force", "N")]
    notes: tuple[str, ...]

    def parts(self) -> dict[str, object]:
        """Return the contact between the two balls as a linear spring, as a drop's TOML has it."""
        k = self.ball_stiffness.nominal_value
        return {"contact": {"law": "Spring", "stiffness": float(k)}} if k > 0.0 else {}


def split_series(lower: Any, upper: Any, both: Any, *, force: Any) -> Split:
    """Return the parts of the compression of two balls pressed in series, as in Figure 7.

    Parameters
    ----------
    lower, upper : float or UFloat
        Compression in m of each ball pressed alone between two plates; `Press.compression_at` reads
        it off a press curve.
    both : float or UFloat
        That of the upper ball on the lower one, pressed between the same plates.
    force : float or UFloat
        In N, the same in all three.

    Returns
    -------
    Split

    Raises
    ------
    InvalidType
        If one of them is no number.
    InvalidValue
        If one is not positive, or both are compressed too little.

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
    at = measured("force", force, "newtons")
    given = {"lower": lower, "upper": upper, "both": both}
    below, above, pair = (measured(name, value, "metres") for name, value in given.items())
    bottom = below / 2.0
    top = pair - bottom - above
    closer = top + above / 2.0
    excess = pair - below - above
    if closer.nominal_value <= 0.0:
        raise InvalidValue(
            "both must be compressed by more than the lower ball's bottom and the upper ball's "
            f"upper half, got {shown(float(pair.nominal_value))} m"
        )
    note = "The upper ball indents the lower one locally: it is softer there."
    if abs(excess.nominal_value) <= 2.0 * excess.std_dev:
        note = "Within the errors the two are springs in series: no extra indentation."
    elif excess.nominal_value < 0.0:
        note = "Both give way by less than the two alone, which springs in series never do."
    floor, ball = at / bottom, at / closer
    return Split(closer / bottom, floor, ball, bottom, top, above, closer, excess, at, (note,))
