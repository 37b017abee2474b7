"""The result of the analysis of bounce heights."""

from dataclasses import dataclass
from typing import Any, ClassVar

from stackbounce.measure.finding import Finding, rigid_contact
from stackbounce.measure.quantities import Number, Row, nominal
from stackbounce.model.drop import STANDARD_GRAVITY

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

    drop_height: Number
    bounce_heights: tuple[Number, ...]
    restitutions: tuple[Number, ...]
    mean: Number
    repeated: bool
    notes: tuple[str, ...]

    def rows(self) -> list[Row]:
        """Return the table, the most important first."""
        rows = [Row("restitution", self.mean), Row("drop height", self.drop_height, "m")]
        after, of = ("", "") if self.repeated else ("after bounce ", "of bounce ")
        for k, height in enumerate(self.bounce_heights):
            rows.append(Row(f"height {after}{k}", height, "m"))
            rows.append(Row(f"restitution {of}{k}", self.restitutions[k]))
        return rows

    def parts(self) -> dict[str, Any]:
        """Return the floor's contact and the drop height, as in a drop's TOML."""
        return {"height": nominal(self.drop_height), **rigid_contact(self.mean)}

    def told(self) -> dict[str, Any]:
        """Return the restitution and the impact speed, at standard gravity."""
        speed = (2.0 * STANDARD_GRAVITY * self.drop_height) ** 0.5
        return {"restitution": self.mean, "impact_speed": speed}
