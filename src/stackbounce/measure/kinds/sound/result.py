"""What a recording with too few bounces tells."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

from stackbounce.measure.finding import Finding
from stackbounce.measure.quantities import Row

if TYPE_CHECKING:
    from uncertainties import UFloat


__all__ = ["FewBounces"]


@dataclass(frozen=True)
class FewBounces(Finding):
    """Flights without a neighbouring flight, which give no restitution.

    Attributes
    ----------
    flights : tuple of (ufloat or None)
        Time in the air after each bounce but the last, in s; None where a bounce is missing.
    apex_heights : tuple of (ufloat or None)
        How high the ball rose in them, in m.
    notes : tuple of str
        What was not found, and what is needed to find it.
    """

    flights: "tuple[UFloat | None, ...]"
    apex_heights: "tuple[UFloat | None, ...]"
    notes: tuple[str, ...]

    def rows(self) -> list[Row]:
        """Return the table, the most important first."""
        rows = []
        for k, (flight, height) in enumerate(zip(self.flights, self.apex_heights, strict=True)):
            if flight is not None and height is not None:
                rows.append(Row(f"flight after bounce {k}", flight, "s"))
                rows.append(Row(f"apex height after bounce {k}", height, "m"))
        return rows
