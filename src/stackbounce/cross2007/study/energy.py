"""What energy alone says, whatever happens between the balls.

A floor contact that loses the share 1 - e**2 of what it stores loses at least that of the lower
ball's own energy: on the way down the upper ball can only push the lower one further. At most
``(m1 e**2 + m2)/(m1 + m2)`` of the energy is then left, however the balls meet.
"""

import math
from typing import NamedTuple

from stackbounce.cross2007.study import inputs
from stackbounce.cross2007.study.catalogue import AS_HEIGHTS, AS_PRINTED

__all__ = ["EnergyBound", "bound_energy", "kept"]


class EnergyBound(NamedTuple):
    """Shares of the energy that a pair brings: what is left, and what can be left.

    `printed` and `heights` are the most that Table I allows with its COR taken as restitution and
    as ratio of heights; `needed` is the least restitution of the lower ball that what is left asks
    for, with its error (nan where any will do).
    """

    pair: str
    measured: float
    error: float
    printed: float
    heights: float
    needed: float
    needed_error: float

    @property
    def excess(self) -> float:
        """By how many errors more is left than Table I as printed allows."""
        return (self.measured - self.printed) / self.error


def bound_energy(pair: str) -> EnergyBound:
    """Return what energy says of a pair.

    Examples
    --------
    >>> [round(number, 3) for number in bound_energy("B2_on_B1")[1:5]]
    [0.76, 0.017, 0.683, 0.822]
    """
    lower, upper = (ball.mass for ball in inputs.make_balls(pair))
    whole = lower + upper
    (first, error), (second, other) = inputs.MEASURED[pair]["rebound_ratios"]
    measured = (lower * first**2 + upper * second**2) / whole
    spread = 2.0 * math.hypot(lower * first * error, upper * second * other) / whole
    name = f"e_{inputs.PAIRS[pair][0]}"
    printed, heights = (
        (lower * one[name] ** 2 + upper) / whole for one in (AS_PRINTED, AS_HEIGHTS)
    )
    squared = (measured * whole - upper) / lower
    needed = math.sqrt(squared) if squared > 0.0 else math.nan
    off = 0.5 * spread * whole / lower / needed
    return EnergyBound(pair, measured, spread, printed, heights, needed, off)


kept = bound_energy  # the name in earlier releases
