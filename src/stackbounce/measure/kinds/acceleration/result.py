"""The result of the analysis of an acceleration."""

from dataclasses import dataclass, field
from typing import Any, ClassVar

from stackbounce.measure.finding import Finding, rigid_contact
from stackbounce.measure.quantities import Array, Number, Row, known_rows, nominal


@dataclass(frozen=True, eq=False)
class Accelerometer(Finding):
    """The fall and the bounces of an accelerometer; made by `accelerometer`.

    Attributes
    ----------
    fall : ufloat or None
        From the release to the first touch, in s; None where the record does not hold it.
    flights : tuple of ufloat
        Between neighbouring bounces, in s.
    drop_height : ufloat or None
        Of a fall from rest, in m.
    apex_heights : tuple of ufloat
        Of the flights, in m.
    impact_speeds : tuple of ufloat
        Of the bounces that have a restitution, in m/s.
    restitutions : tuple of ufloat
        Of each bounce between two flights, or between the fall and a flight. Neighbours share a
        flight, so their errors are correlated.
    mean : ufloat or None
        The one restitution that leads from the first impact speed to the last rebound speed.
    contact_times : tuple of (ufloat or None)
        Of the bounces, in s; None where the sampling is too coarse.
    peaks : tuple of float
        The largest acceleration in each bounce, in m/s².
    notes : tuple of str
        What a reader of the numbers should know, a sentence each.
    times, values : ndarray
        (n,) the record's times in s, and the magnitude of the acceleration in m/s², about 0 in
        flight.
    spans : tuple of (float, float)
        Of the fall and the flights, in s.
    """

    picture: ClassVar[str] = "acceleration"

    fall: Number | None
    flights: tuple[Number, ...]
    drop_height: Number | None
    apex_heights: tuple[Number, ...]
    impact_speeds: tuple[Number, ...]
    restitutions: tuple[Number, ...]
    mean: Number | None
    contact_times: tuple[Number | None, ...]
    peaks: tuple[float, ...]
    notes: tuple[str, ...]
    times: Array = field(repr=False)
    values: Array = field(repr=False)
    spans: tuple[tuple[float, float], ...] = field(repr=False)

    def rows(self) -> list[Row]:
        """Return the table, the most important first."""
        listed = (  # values side by side, with the names and units of each
            ((self.impact_speeds, "impact speed of bounce", "m/s"),
             (self.restitutions, "restitution of bounce", "")),
            ((self.flights, "time of flight", "s"), (self.apex_heights, "height of flight", "m")),
            ((self.contact_times, "contact time of bounce", "s"),),
            ((self.peaks, "largest acceleration in bounce", "m/s^2"),),
        )  # fmt: skip
        rows: list[tuple[str, Any, str]] = [
            ("restitution, mean", self.mean, ""),
            ("drop height", self.drop_height, "m"),
            ("time of fall", self.fall, "s"),
        ]
        for columns in listed:
            for k in range(len(columns[0][0])):
                rows += [(f"{name} {k}", values[k], unit) for values, name, unit in columns]
        return known_rows(rows)

    def parts(self) -> dict[str, Any]:
        """Return the floor's contact and the drop height, as in a drop's TOML."""
        parts = {} if self.mean is None else rigid_contact(self.mean)
        if self.drop_height is not None:
            parts["height"] = nominal(self.drop_height)
        return parts

    def law_arguments(self) -> dict[str, Any]:
        """Return the mean restitution and, after a fall, impact speed and contact time."""
        found: dict[str, Any] = {"restitution": self.mean}
        if self.fall is not None:
            found |= {"impact_speed": self.impact_speeds[0], "contact_time": self.contact_times[0]}
        return found
