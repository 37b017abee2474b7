"""What was found in a recording."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

import numpy as np
from numpy.typing import NDArray

from stackbounce.measure.finding import Finding
from stackbounce.measure.quantities import Row

if TYPE_CHECKING:
    from uncertainties import UFloat


__all__ = ["Dropped", "FewBounces", "Knocks"]


@dataclass(frozen=True)
class Dropped:
    """A sound outside the series of bounces: its time in s, and why it was left out."""

    time: float
    why: str


@dataclass(frozen=True)
class Knocks(Finding):
    """The knocks of one ball's bounces.

    Attributes
    ----------
    times : tuple of ufloat
        Onset of each, in s.
    loudness : ndarray
        (N,) amplitude over 10 ms without hum, relative to the loudest.
    missed : tuple of int
        How many bounces are missing after each but the last.
    dropped : tuple of Dropped
        Sounds that were left out: echoes, second sounds of one impact, others.
    rate : float
        Samples per second.
    notes : tuple of str
        What a reader of the numbers should know, a sentence each.
    """

    picture: ClassVar[str] = "sound"

    times: "tuple[UFloat, ...]"
    loudness: NDArray[np.float64]
    missed: tuple[int, ...]
    dropped: tuple[Dropped, ...]
    rate: float
    notes: tuple[str, ...]

    def rows(self) -> list[Row]:
        """Return the table, the most important first."""
        rows = [Row("knocks", len(self.times)), Row("sounds left out", len(self.dropped))]
        for k, (time, loudness) in enumerate(zip(self.times, self.loudness, strict=True)):
            rows.append(Row(f"time of knock {k}", time, "s"))
            rows.append(Row(f"loudness of knock {k}", float(loudness)))
        return rows


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
