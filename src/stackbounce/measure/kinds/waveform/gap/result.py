"""The results of the analyses of the gap between two balls."""

import math
from dataclasses import dataclass, field
from typing import Any, ClassVar

from stackbounce.measure.finding import Finding
from stackbounce.measure.kinds.waveform.result import Waveform
from stackbounce.measure.quantities import Number, Row, known_rows
from stackbounce.measure.statistics.change_point import Kink


@dataclass(frozen=True, eq=False)
class FloorGap(Finding):
    """The delay and the gap of two balls from the floor's force; made by `floor_gap`.

    Parameters
    ----------
    delay : UFloat or None
        From the floor's first touch to that of the balls, in s; None where only limits are known.
    gap : UFloat or None
        Between the balls as they fell, in m; None where only limits are known.
    delay_limits, gap_limits : (float, float)
        Limits in s and m: two standard errors each way, or those without a change point.
    gain : float
        Ratio of the stack's force to the lower ball's alone, before the balls touch.
    notes : tuple of str
        What should be known about it, a sentence each.
    stack, alone : Waveform
        The two records.
    kink : Kink
        The change point at which the two forces part.
    """

    picture: ClassVar[str] = "gap"

    delay: Number | None
    gap: Number | None
    delay_limits: tuple[float, float]
    gap_limits: tuple[float, float]
    gain: float
    notes: tuple[str, ...]
    stack: Waveform = field(repr=False)
    alone: Waveform = field(repr=False)
    kink: Kink = field(repr=False)

    def rows(self) -> list[Row]:
        """Return the table, the most important first."""
        return [
            Row("gap between the balls", _limited(self.gap, self.gap_limits), "m"),
            Row("delay of their touch", _limited(self.delay, self.delay_limits), "s"),
            Row("force over that of the ball alone", self.gain),
        ]


@dataclass(frozen=True)
class SensorGap(Finding):
    """The delay and the gap of two balls from two sensors; made by `sensor_gap`.

    Attributes
    ----------
    delay : UFloat
        From the floor's first touch to that of the balls, in s.
    gap : UFloat or None
        Between the balls as they fell, in m; None where speed or contact time are not known.
    notes : tuple of str
        What should be known about it, a sentence each.
    """

    delay: Number
    gap: Number | None
    notes: tuple[str, ...]

    def rows(self) -> list[Row]:
        """Return the table, the most important first."""
        gap = ("gap between the balls", self.gap, "m")
        return known_rows([gap, ("delay of their touch", self.delay, "s")])


def _limited(value: Any, limits: tuple[float, float]) -> Any:
    """Return a value or, where there is none, its limits as words."""
    low, high = limits
    if value is not None:
        return value
    if math.isinf(high):
        return "unknown"
    if low <= 0.0:
        return f"below {high:.2g}"
    return f"{low:.2g} to {high:.2g}"
