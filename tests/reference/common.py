"""What the reference solvers share: their digits and their answer."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from typing import Any

from mpmath import mpf

Number = mpf
Row = Sequence[Any]  # numbers of the balls, contacts or gaps, bottom first
DIGITS = 50  # digits carried; thirty of them are wanted
TINY = mpf(10) ** -40  # what counts as zero, in units of the problem's own length or speed


@dataclass
class Interval:
    """One contact interval: from touching to separation."""

    contact: int
    start: Number
    end: Number | None = None
    peak_force: Number = field(default_factory=mpf)
    peak_compression: Number = field(default_factory=mpf)
    impulse: Number = field(default_factory=mpf)


@dataclass
class Outcome:
    """The end of a run: velocities (up-positive), the intervals in order of start, the end time."""

    velocities: list[Number]
    intervals: list[Interval]
    end_time: Number
    energy_retained: Number

    def counts(self, contacts: int) -> list[int]:
        """Return how many intervals each of the contacts had."""
        return [sum(i.contact == k for i in self.intervals) for k in range(contacts)]


def kinetic(masses: Iterable[Number], velocities: Iterable[Number]) -> Number:
    """Return the kinetic energy."""
    return sum((m * v * v / 2 for m, v in zip(masses, velocities, strict=True)), mpf(0))
