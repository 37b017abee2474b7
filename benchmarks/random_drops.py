"""Random drops of two balls on springs, and hard ones, next to where a number of contacts changes.

Everything is in units of the lower ball's mass, its spring's stiffness and the impact speed, so
that ω = 1 and lengths are in v0/ω.
"""

from collections.abc import Callable
from dataclasses import dataclass
from itertools import product
from typing import NamedTuple

import numpy as np

import stackbounce as sb

MASS_RATIOS = (0.05, 50.0)  # lower to upper ball
STIFFNESS_RATIOS = (0.02, 50.0)  # floor to ball-ball
LARGEST_GAP = 2.0  # v0/ω
OFFSETS = (1e-4, 1e-7, 1e-10)  # of a hard drop from the change, relative
WIDTH = 1e-14  # relative, to which a change is bracketed
VARIED = ("gap", "mass ratio", "stiffness ratio")
FEW = 12  # contacts; beyond, changes crowd


class PairDrops(NamedTuple):
    """Drops of two balls under any law, in units of v0 and of the lower ball's contact."""

    masses: np.ndarray  # (n, 2)
    stiffnesses: np.ndarray  # (n, 2)
    losses: np.ndarray  # (n, 2)
    gaps: np.ndarray  # (n,)


@dataclass(frozen=True)
class Drops:
    """Drops of two balls on springs; `ratios`, shape (n, 3), has the columns m0/m1, k0/k1, gap."""

    ratios: np.ndarray

    def __len__(self) -> int:
        """Return the number of drops."""
        return len(self.ratios)

    def first(self, n: int) -> "Drops":
        """Return the first n drops."""
        return Drops(self.ratios[:n])

    @property
    def masses(self) -> np.ndarray:
        """The masses, shape (n, 2), lower ball first."""
        return np.stack([np.ones(len(self)), 1.0 / self.ratios[:, 0]], axis=-1)

    @property
    def stiffnesses(self) -> np.ndarray:
        """The stiffnesses, shape (n, 2), the floor's contact first."""
        return np.stack([np.ones(len(self)), 1.0 / self.ratios[:, 1]], axis=-1)

    @property
    def losses(self) -> np.ndarray:
        """No losses, shape (n, 2)."""
        return np.zeros((len(self), 2))

    @property
    def gaps(self) -> np.ndarray:
        """The gaps, shape (n,)."""
        return self.ratios[:, 2]


@dataclass(frozen=True)
class Change:
    """Where, along one of `VARIED`, a number of contacts changes: ratios there, and the column."""

    at: tuple[float, float, float]
    column: int

    def beside(self, offset: float) -> tuple[float, float, float]:
        """Return the ratios that far, relative, from the change."""
        ratios = list(self.at)
        ratios[self.column] *= 1.0 + offset
        return tuple(ratios)


def simulated(ratios: tuple[float, float, float]) -> sb.Result:
    """Return what this package finds for one drop; compiled, which gives the same bits."""
    mass, stiffness, gap = map(float, ratios)
    balls = [sb.Ball(1.0), sb.Ball(1.0 / mass)]
    contacts = [sb.Spring(1.0), sb.Spring(1.0 / stiffness)]
    return sb.simulate(sb.Drop(balls, contacts, [gap], impact_speed=1.0), compiled=True)


def counts(ratios: tuple[float, float, float]) -> tuple[int, ...]:
    """Return how many contact intervals each contact has; none if the run did not finish."""
    result = simulated(ratios)
    finished = result.status is sb.Status.FINISHED
    return tuple(int(n) for n in result.collisions) if finished else ()


def random(n: int, seed: int) -> Drops:
    """Return n random drops: ratios log-uniform, half of the gaps zero, the others uniform."""
    rng = np.random.default_rng(seed)
    mass = np.exp(rng.uniform(*np.log(MASS_RATIOS), n))
    stiffness = np.exp(rng.uniform(*np.log(STIFFNESS_RATIOS), n))
    gap = rng.uniform(0.0, LARGEST_GAP, n)
    gap[::2] = 0.0
    return Drops(np.stack([mass, stiffness, gap], axis=-1))


def changes(n: int, seed: int, progress: Callable[[str], None] = lambda _: None) -> list[Change]:
    """Return n changes of a number of contacts, as many along the gap as along either ratio.

    Two random drops that differ in one of these numbers and in a count are the ends of a bisection.
    """
    rng = np.random.default_rng(seed)
    found: list[Change] = []
    while len(found) < n:
        progress(f"hard drops: change {len(found) + 1} of {n}")
        column = (2, 0, 1)[len(found) % 3]
        begin, end = random(4, int(rng.integers(2**32))).ratios[[1, 3]]
        if column != 2 and rng.random() < 0.5:
            begin[2] = 0.0
        change = _bisected(tuple(begin), column, end[column])
        if change is not None and _clear(change):
            found.append(change)
    return found


def hard(n: int, seed: int, progress: Callable[[str], None] = lambda _: None) -> dict[float, Drops]:
    """Return, for each of `OFFSETS`, 2 n drops that far below and above n changes, in turn."""
    beside = changes(n, seed, progress)
    return {
        offset: Drops(np.array([c.beside(s * offset) for c, s in product(beside, (-1, 1))]))
        for offset in OFFSETS
    }


def _bisected(begin: tuple[float, ...], column: int, end: float) -> Change | None:
    """Return a change between two values of a column; None if there is none, or too many."""
    low, high = sorted((begin[column], end))

    def at(value: float) -> tuple[float, ...]:
        return (*begin[:column], value, *begin[column + 1 :])

    below, above = counts(at(low)), counts(at(high))
    if not below or not above or below == above or max(below + above) > FEW:
        return None
    while high - low > WIDTH * high:
        middle = 0.5 * (low + high)
        if not low < middle < high:
            break
        here = counts(at(middle))
        low, high = (middle, high) if here == below else (low, middle)
    return Change(at(0.5 * (low + high)), column)


def _clear(change: Change) -> bool:
    """Return whether all drops beside a change finish, with other counts below than above."""
    pairs = [[counts(change.beside(s * offset)) for s in (-1, 1)] for offset in OFFSETS]
    return all(below and above and below != above for below, above in pairs)
