"""The result of the analysis of bounce times."""

from dataclasses import dataclass
from typing import Any, ClassVar

from stackbounce.measure.drag import Drag, speed_after_fall
from stackbounce.measure.finding import Finding, rigid_contact
from stackbounce.measure.kinds.bounces.restitution_law import RestitutionLaw
from stackbounce.measure.quantities import Number, Row, nominal


@dataclass(frozen=True, repr=False)
class Bounces(Finding):
    """Restitutions from the times of bounces; made by `bounces`.

    Attributes
    ----------
    times : tuple of ufloat
        Of the bounces, in s.
    flights : tuple of (ufloat or None)
        Time in the air between neighbouring bounces, in s; None where a bounce is missing.
    numbers : tuple of int
        Which bounces have a restitution; the first one is 0.
    impact_speeds : tuple of ufloat
        Of these bounces, in m/s.
    restitutions : tuple of ufloat
        Of these bounces. Neighbours share a flight, so their errors are correlated.
    mean : ufloat
        Their weighted mean, which supposes that restitution does not depend on speed.
    laws : tuple of RestitutionLaw
        The fits of its fall with speed, a line and a power law, the latter only where the speeds
        are not far from 1 m/s; empty for fewer than three restitutions.
    drop_height : ufloat or float or None
        In m, as given or inferred.
    inferred : bool
        Whether the drop height is inferred from the mean energy retained, as phyphox does.
    scatter : float
        Excess scatter of the restitutions: standard deviation from bounce to bounce beyond the
        errors of the times.
    gravity : float
        In m/s**2.
    notes : tuple of str
        What a reader of the numbers should know, a sentence each.
    drag : Drag or None
        Of the air, where it was taken into account.
    """

    picture: ClassVar[str] = "bounces"

    times: tuple[Number, ...]
    flights: tuple[Number | None, ...]
    numbers: tuple[int, ...]
    impact_speeds: tuple[Number, ...]
    restitutions: tuple[Number, ...]
    mean: Number
    laws: tuple[RestitutionLaw, ...]
    drop_height: Number | float | None
    inferred: bool
    scatter: float
    gravity: float
    notes: tuple[str, ...]
    drag: Drag | None = None

    def rows(self) -> list[Row]:
        """Return the table, the most important first."""
        rows = [Row("restitution, mean", self.mean)]
        for law in self.laws:
            at, unit = ("0", "s/m") if law.form == "linear" else ("1 m/s", "")
            name = "its fall per m/s" if law.form == "linear" else "exponent of its fall"
            rows.append(Row(f"restitution at {at} ({law.form})", law.coefficient))
            rows.append(Row(f"{name} ({law.form})", law.slope, unit))
        if self.drop_height is not None:
            how = "inferred from the mean energy retained" if self.inferred else "given"
            rows.append(Row(f"drop height, {how}", self.drop_height, "m"))
        for k, speed, kept in zip(self.numbers, self.impact_speeds, self.restitutions, strict=True):
            rows.append(Row(f"impact speed of bounce {k}", speed, "m/s"))
            rows.append(Row(f"restitution of bounce {k}", kept))
        if self.scatter:
            rows.append(Row("scatter of restitution from bounce to bounce", self.scatter))
        return [*rows, *(self.drag.rows() if self.drag else ())]

    def parts(self) -> dict[str, Any]:
        """Return the floor's contact and, if it is known, the drop height, as in a drop's TOML.

        In air it is the impact speed: a simulated drop falls without.
        """
        parts = rigid_contact(min(nominal(self.mean), 1.0))
        if self.drop_height is not None:
            start = "height" if self.drag is None else "impact_speed"
            parts[start] = nominal(self.drop_height if self.drag is None else self._speed)
        return parts

    def law_arguments(self) -> dict[str, Any]:
        """Return the mean restitution and, if a drop height was given, the impact speed."""
        found: dict[str, Any] = {"restitution": self.mean}
        if self.drop_height is not None and not self.inferred:
            found["impact_speed"] = self._speed
        return found

    @property
    def _speed(self) -> Any:
        return speed_after_fall(self.drop_height, self.gravity, self.drag)
