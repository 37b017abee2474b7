"""The knocks of one ball's bounces: a sound gives them, and restitutions follow from them."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from stackbounce.measure.finding import Finding
from stackbounce.measure.quantities import Array, Number, Row

SHRINKS = (0.15, 1.03)
"""The range of the ratio of neighbouring flights."""


@dataclass(frozen=True)
class Dropped:
    """A sound outside the series of bounces: its time in s, and why it was left out."""

    time: float
    why: str


@dataclass(frozen=True, repr=False)
class Knocks(Finding):
    """The knocks of one ball's bounces, or other sounds.

    Attributes
    ----------
    times : tuple of ufloat
        Onset of each, in s.
    loudness : ndarray
        (N,) amplitude over 10 ms without hum, relative to the loudest.
    missed : tuple of int
        How many bounces are missing after each but the last.
    dropped : tuple of Dropped
        Sounds that were left out: echoes, second sounds of one impact, tails, and no bounces.
    rate : float
        Samples per second.
    notes : tuple of str
        What a reader of the numbers should know, a sentence each.
    against : str
        Why these sounds are no bouncing ball; empty if they may be one.
    """

    picture: ClassVar[str] = "sound"

    times: tuple[Number, ...]
    loudness: Array
    missed: tuple[int, ...]
    dropped: tuple[Dropped, ...]
    rate: float
    notes: tuple[str, ...]
    against: str = ""

    def rows(self) -> list[Row]:
        """Return the table, the most important first."""
        rows = [Row("knocks", len(self.times)), Row("sounds left out", len(self.dropped))]
        for k, (time, loudness) in enumerate(zip(self.times, self.loudness, strict=True)):
            rows.append(Row(f"time of knock {k}", time, "s"))
            rows.append(Row(f"loudness of knock {k}", float(loudness)))
        return rows


def missed_between(steps: Sequence[float] | NDArray[Any]) -> list[int]:
    """Return how many bounces seem to be missing in each interval: 0 or 1.

    An interval that holds two flights is longer than the one before it by ``r (1 + r)``, where r is
    what the others shrink by.

    Parameters
    ----------
    steps : sequence of float
        Intervals between successive bounces in s, above 0.

    Returns
    -------
    list of int

    Examples
    --------
    >>> missed_between([1.0, 0.8, 0.64 + 0.512, 0.4096, 0.32768])
    [0, 0, 1, 0, 0]
    """
    lengths = [float(step) for step in steps]
    ratios = np.array(lengths[1:]) / np.array(lengths[:-1])
    usual = ratios[(ratios < SHRINKS[1]) & (ratios > SHRINKS[0])]
    missed = [0] * len(lengths)
    if len(usual) < 3:
        return missed
    r = float(np.median(usual))
    flight = lengths[0]
    for k in range(1, len(lengths)):
        ratio = lengths[k] / flight
        two = r * (1.0 + r)
        flight = lengths[k]
        if ratio > 1.1 * r and abs(math.log(ratio / two)) < min(0.12, abs(math.log(ratio / r))):
            missed[k] = 1
            flight = lengths[k] * r / (1.0 + r)
    return missed
