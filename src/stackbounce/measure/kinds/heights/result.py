"""The result of the analysis of bounce heights."""

from dataclasses import dataclass
from typing import Any, ClassVar

from stackbounce.measure.drag import Drag, speed_after_fall
from stackbounce.measure.finding import Finding, rigid_contact
from stackbounce.measure.quantities import Number, Row, nominal
from stackbounce.model.drop import STANDARD_GRAVITY


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
    drag : Drag or None
        Of the air, where it was taken into account.
    """

    picture: ClassVar[str] = "heights"

    drop_height: Number
    bounce_heights: tuple[Number, ...]
    restitutions: tuple[Number, ...]
    mean: Number
    repeated: bool
    notes: tuple[str, ...]
    drag: Drag | None = None

    def rows(self) -> list[Row]:
        """Return the table, the most important first."""
        rows = [Row("restitution", self.mean), Row("drop height", self.drop_height, "m")]
        after, of = ("", "") if self.repeated else ("after bounce ", "of bounce ")
        for k, height in enumerate(self.bounce_heights):
            rows.append(Row(f"height {after}{k}", height, "m"))
            rows.append(Row(f"restitution {of}{k}", self.restitutions[k]))
        return [*rows, *(self.drag.rows() if self.drag else ())]

    def parts(self) -> dict[str, Any]:
        """Return the floor's contact and the drop height, as in a drop's TOML.

        In air it is the impact speed: a simulated drop falls without.
        """
        contact = rigid_contact(self.mean)
        if self.drag is not None:
            return {"impact_speed": nominal(self._speed), **contact}
        return {"height": nominal(self.drop_height), **contact}

    def law_arguments(self) -> dict[str, Any]:
        """Return the restitution and the impact speed, at standard gravity."""
        return {"restitution": self.mean, "impact_speed": self._speed}

    @property
    def _speed(self) -> Any:
        return speed_after_fall(self.drop_height, STANDARD_GRAVITY, self.drag)
