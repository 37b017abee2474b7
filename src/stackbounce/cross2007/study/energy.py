"""A bound on the energy after the impact that holds for any contact between the balls.

A floor contact that loses the share 1 - e**2 of its stored energy loses at least this share of the
lower ball's kinetic energy, because during the compression the upper ball can only add energy to
it. The energy retained is therefore at most ``(m1 e**2 + m2)/(m1 + m2)`` of the initial energy.
"""

import math
from typing import NamedTuple

from stackbounce.cross2007.study import inputs
from stackbounce.cross2007.study.catalogue import AS_HEIGHTS, AS_PRINTED

__all__ = ["EnergyBound", "bound_energy", "kept"]


class EnergyBound(NamedTuple):
    """The energy that a pair retains and its upper bounds, over the initial energy.

    `printed` and `heights` are the bounds with Table I's COR taken as restitution and as ratio of
    heights. `needed` is the smallest restitution of the lower ball that is compatible with the
    measured energy, with its error (nan if any restitution is).
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
        """By how many errors the measured energy exceeds the bound from Table I as printed."""
        return (self.measured - self.printed) / self.error


def bound_energy(pair: str) -> EnergyBound:
    """Return the measured energy of a pair and its bounds.

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
