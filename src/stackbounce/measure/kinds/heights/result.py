"""What heights of bounces tell."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar

from stackbounce.measure.finding import Finding, as_ratios
from stackbounce.measure.quantities import Row
from stackbounce.model.drop import STANDARD_GRAVITY

if TYPE_CHECKING:
    import xarray as xr
    from uncertainties import UFloat


__all__ = ["Heights"]


@dataclass(frozen=True)
class Heights(Finding):
    """Restitutions from the heights of bounces; made by `heights`.

    Attributes
    ----------
    drop_height : ufloat
        Of the ball's lowest point above the floor, in m.
    bounce_heights : tuple of ufloat
        Of its lowest point, in m.
    restitutions : tuple of ufloat
        Of each bounce. Neighbours share a height, so their errors are correlated.
    mean : ufloat
        The one restitution that leads from the drop height to the last height.
    repeated : bool
        Whether the heights are those of the first bounce in repeated drops.
    notes : tuple of str
        What a reader of the numbers should know, a sentence each.
    """

    picture: ClassVar[str] = "heights"

    drop_height: "UFloat"
    bounce_heights: "tuple[UFloat, ...]"
    restitutions: "tuple[UFloat, ...]"
    mean: "UFloat"
    repeated: bool
    notes: tuple[str, ...]

    def rows(self) -> list[Row]:
        """Return the table, the most important first."""
        rows = [Row("restitution", self.mean), Row("drop height", self.drop_height, "m")]
        numbered = enumerate(zip(self.bounce_heights, self.restitutions, strict=True))
        for k, (height, kept) in numbered:
            rows.append(Row(f"height {'' if self.repeated else 'after bounce '}{k}", height, "m"))
            rows.append(Row(f"restitution {'' if self.repeated else 'of bounce '}{k}", kept))
        return rows

    def parts(self) -> dict[str, Any]:
        """Return the floor's contact and the drop height, as in a drop's TOML."""
        parts: dict[str, Any] = {"height": float(self.drop_height.nominal_value)}
        if self.mean.nominal_value <= 1.0:
            kept = float(self.mean.nominal_value)
            parts["contact"] = {"law": "Rigid", "restitution": kept}
        return parts

    def told(self) -> dict[str, Any]:
        """Return the restitution and the impact speed, at standard gravity."""
        speed = (2.0 * STANDARD_GRAVITY * self.drop_height) ** 0.5
        return {"restitution": self.mean, "impact_speed": speed}

    def measured(self, data: "xr.Dataset") -> dict[str, str]:  # noqa: ARG002
        """Return the first bounce's restitution, which is the ball's rebound ratio."""
        return as_ratios(self.restitutions[:1])
