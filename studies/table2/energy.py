"""A bound on the energy after the impact, from the floor contact alone.

A floor contact that loses the share 1 - e**2 of its stored energy loses at least this share of the
lower ball's kinetic energy, because during the compression the upper ball can only add energy to
it. The energy retained is therefore at most ``(m1 e**2 + m2)/(m1 + m2)`` of the initial energy.

Two assumptions are needed. No energy of a ball's inner vibration comes back to its motion. And a
contact that takes longer than that of the ball alone loses no smaller share.
"""

import math
from typing import NamedTuple

from stackbounce.cross2007 import PAPER
from studies.table2 import inputs
from studies.table2.catalogue import AS_HEIGHTS, AS_PRINTED

_HEIGHT_ERROR = 1e-2  # m: "about 20 cm" (Sec. IV)


class EnergyBound(NamedTuple):
    """The energy that a pair retains and its upper bounds, over the initial energy.

    `error` is that of the ratios; `height_error` is what 1 cm of the drop height adds to the
    measured energy. `printed` and `heights` are the bounds with Table I's COR taken as restitution
    and as ratio of heights; `printed_error` is what Table I's ± 0.02 makes of the former. `needed`
    is the smallest restitution of the lower ball that is compatible with the measured energy, with
    its error (nan if any restitution is).
    """

    pair: str
    measured: float
    error: float
    height_error: float
    printed: float
    printed_error: float
    heights: float
    needed: float
    needed_error: float

    @property
    def excesses(self) -> dict[str, float]:
        """By how many errors the energy exceeds the bound from Table I as printed.

        The errors of the ratios; with Table I's; with that of the drop height, too.
        """
        errors = (self.error, self.printed_error, self.height_error)
        names = ("ratios", "Table I", "drop height")
        return {
            name: (self.measured - self.printed) / math.hypot(*errors[: k + 1])
            for k, name in enumerate(names)
        }


def bound_energy(pair: str) -> EnergyBound:
    """Return the measured energy of a pair and its bounds.

    Examples
    --------
    >>> bound = bound_energy("B2_on_B1")
    >>> round(bound.measured, 3), round(bound.printed, 3), round(bound.heights, 3)
    (0.76, 0.683, 0.822)
    >>> [round(excess, 1) for excess in bound.excesses.values()]
    [4.5, 2.5, 1.6]
    """
    lower, upper = (ball.mass for ball in inputs.make_balls(pair))
    whole = lower + upper
    (first, error), (second, other) = inputs.MEASURED[pair]["rebound_ratios"]
    measured = (lower * first**2 + upper * second**2) / whole
    spread = 2.0 * math.hypot(lower * first * error, upper * second * other) / whole
    name = inputs.PAIRS[pair][0]
    printed, heights = (
        (lower * read[f"e_{name}"] ** 2 + upper) / whole for read in (AS_PRINTED, AS_HEIGHTS)
    )
    off = 2.0 * lower * inputs.PRINTED[name] * PAPER["B1.restitution"].spread / whole
    squared = (measured * whole - upper) / lower
    needed = math.sqrt(squared) if squared > 0.0 else math.nan
    needed_error = 0.5 * spread * whole / lower / needed
    tall = measured * _HEIGHT_ERROR / inputs.HEIGHT
    return EnergyBound(pair, measured, spread, tall, printed, off, heights, needed, needed_error)
