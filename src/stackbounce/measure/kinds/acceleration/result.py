"""What was found in an acceleration."""

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from stackbounce.measure.finding import Finding, as_ratios
from stackbounce.measure.quantities import Row

if TYPE_CHECKING:
    import xarray as xr
    from uncertainties import UFloat


__all__ = ["Accelerometer"]


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

    fall: "UFloat | None"
    flights: "tuple[UFloat, ...]"
    drop_height: "UFloat | None"
    apex_heights: "tuple[UFloat, ...]"
    impact_speeds: "tuple[UFloat, ...]"
    restitutions: "tuple[UFloat, ...]"
    mean: "UFloat | None"
    contact_times: "tuple[UFloat | None, ...]"
    peaks: tuple[float, ...]
    notes: tuple[str, ...]
    times: NDArray[np.float64] = field(repr=False)
    values: NDArray[np.float64] = field(repr=False)
    spans: tuple[tuple[float, float], ...] = field(repr=False)

    def rows(self) -> list[Row]:
        """Return the table, the most important first."""
        rows = [] if self.mean is None else [Row("restitution, mean", self.mean)]
        if self.drop_height is not None and self.fall is not None:
            rows.append(Row("drop height", self.drop_height, "m"))
            rows.append(Row("time of fall", self.fall, "s"))
        for k, (speed, kept) in enumerate(zip(self.impact_speeds, self.restitutions, strict=True)):
            rows.append(Row(f"impact speed of bounce {k}", speed, "m/s"))
            rows.append(Row(f"restitution of bounce {k}", kept))
        for k, (time, height) in enumerate(zip(self.flights, self.apex_heights, strict=True)):
            rows.append(Row(f"time of flight {k}", time, "s"))
            rows.append(Row(f"height of flight {k}", height, "m"))
        for k, lasting in enumerate(self.contact_times):
            if lasting is not None:
                rows.append(Row(f"contact time of bounce {k}", lasting, "s"))
        rows += [
            Row(f"largest acceleration in bounce {k}", a, "m/s^2") for k, a in enumerate(self.peaks)
        ]
        return rows

    def parts(self) -> dict[str, Any]:
        """Return the floor's contact and the drop height, as in a drop's TOML."""
        parts: dict[str, Any] = {}
        if self.mean is not None and self.mean.nominal_value <= 1.0:
            parts["contact"] = {"law": "Rigid", "restitution": float(self.mean.nominal_value)}
        if self.drop_height is not None:
            parts["height"] = float(self.drop_height.nominal_value)
        return parts

    def told(self) -> dict[str, Any]:
        """Return the mean restitution and, after a fall, impact speed and contact time."""
        told: dict[str, Any] = {"restitution": self.mean}
        if self.fall is not None:
            told["impact_speed"] = self.impact_speeds[0]
            told["contact_time"] = self.contact_times[0]
        return told

    def measured(self, data: "xr.Dataset") -> dict[str, str]:  # noqa: ARG002
        """Return the first bounce's restitution, which is the ball's rebound ratio."""
        return as_ratios(self.restitutions[:1])
