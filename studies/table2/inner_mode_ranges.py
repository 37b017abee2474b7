"""What an inner vibration of any frequency makes of the bound on the energy.

Balls that lose nothing, each with an inner vibration as in `inner_mode`, are compared with
`energy.bound_energy`: over ranges of the frequency, and with those frequencies for which the
vibration alone takes from B1 what Table I says it loses.
"""

from typing import Any, NamedTuple

import numpy as np

from studies.table2 import inputs
from studies.table2.energy import bound_energy
from studies.table2.inner_mode import InnerMode, bounce_alone, compare_inner_modes

__all__ = ["RANGES", "InnerModes", "ModeRange", "find_modes", "study_inner_modes"]

RANGES = ((1.0, 2.0), (2.0, 3.0), (3.0, 5.0), (5.0, 10.0))
"""The ranges of the frequency of a free ball's vibration over that of the ball on its contact."""

_STEPS = 9  # of the ratio in each range
_SHARES = (0.3, 0.5, 0.7)  # of a ball's mass that is in its lower part
_TRIED_RATIOS = np.linspace(0.3, 3.0, 28)
_TRIED_SHARES = (0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8)
_ON_B1 = ("B2_on_B1", "B3_on_B1")


class ModeRange(NamedTuple):
    """A pair of elastic balls, over a range of the frequency ratio and three shares of mass.

    `least_excess` and `most_excess` are those of the energy retained over the bound,
    `most_left` is the largest share of the energy that stays in the vibrations.
    """

    pair: str
    low: float
    high: float
    least_excess: float
    most_excess: float
    most_left: float


class InnerModes(NamedTuple):
    """What inner vibrations can do: over ranges, and where one explains B1's restitution.

    `alone` has the pairs on B1, with vibrations for which B1 alone has Table I's restitution, and
    `measured` by how much these pairs exceed the bound in Table II.
    """

    ranges: list[ModeRange]
    alone: list[InnerMode]
    measured: dict[str, float]

    def of_range(self, low: float) -> list[ModeRange]:
        """Return the rows of the range that begins at a ratio."""
        return [one for one in self.ranges if one.low == low]

    @property
    def slow(self) -> float:
        """The largest excess over the bound with a ratio below 5."""
        return max(one.most_excess for one in self.ranges if one.low < RANGES[-1][0])

    @property
    def fast(self) -> float:
        """The largest excess over the bound with a ratio of at least 5."""
        return max(one.most_excess for one in self.of_range(RANGES[-1][0]))

    @property
    def beyond(self) -> int:
        """How many rows of `alone` exceed the bound by more than was measured."""
        return sum(one.excess > self.measured[one.pair] for one in self.alone)

    def as_dict(self) -> dict[str, Any]:
        """Return all numbers as plain values, for JSON."""
        return {
            "ranges": [one._asdict() for one in self.ranges],
            "alone": [{**one._asdict(), "excess": one.excess} for one in self.alone],
            "measured": self.measured,
        }


def study_inner_modes() -> InnerModes:
    """Return what inner vibrations can do in the pairs of Table II."""
    alone = [
        one
        for ratio, share in find_modes(inputs.PRINTED["B1"])
        for one in compare_inner_modes(_ON_B1, [ratio], [share])
    ]
    bounds = {pair: bound_energy(pair) for pair in _ON_B1}
    return InnerModes(
        [_over(pair, low, high) for pair in inputs.PAIRS for low, high in RANGES],
        alone,
        {pair: one.measured - one.printed for pair, one in bounds.items()},
    )


def _over(pair: str, low: float, high: float) -> ModeRange:
    found = compare_inner_modes([pair], np.linspace(low, high, _STEPS).tolist(), _SHARES)
    excesses = [one.excess for one in found]
    left = max(one.left for one in found)
    return ModeRange(pair, low, high, min(excesses), max(excesses), left)


def find_modes(restitution: float) -> list[tuple[float, float]]:
    """Return frequency ratio and share of the modes that give a ball alone a restitution.

    Ratios are looked for from 0.3 to 3, shares are 0.2 to 0.8 in steps of 0.1.

    Examples
    --------
    >>> [(round(ratio, 2), share) for ratio, share in find_modes(0.78)][:2]
    [(0.79, 0.3), (0.98, 0.3)]
    """
    from scipy.optimize import brentq

    found = []
    for share in _TRIED_SHARES:

        def excess(ratio: float, share: float = share) -> float:
            return bounce_alone(ratio, share) - restitution

        values = [excess(ratio) for ratio in _TRIED_RATIOS.tolist()]
        for k in np.flatnonzero(np.diff(np.sign(values))).tolist():
            ends = _TRIED_RATIOS[k : k + 2].tolist()
            found.append((float(brentq(excess, *ends, xtol=1e-9)), share))
    return found
