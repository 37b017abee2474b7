"""What a contact interval costs, from two balls to two thousand.

Two kinds of stack, each rigid, on springs and on Hertz's contacts:

- a **chain**: equal balls that touch, at rest, without a floor; the first one strikes the others;
- a **gapped** stack: random masses and gaps, dropped on a floor.

A run that is stopped before anything has happened gives the time that Python needs to set up
the numbers. What is left after that, by the number of contact intervals, is the cost of one.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from itertools import product

import numpy as np

import stackbounce as sb
from benchmarks.timing import best

LAWS: dict[str, sb.Rigid | sb.Spring | sb.Hertz] = {
    "rigid": sb.Rigid(1.0),
    "springs": sb.Spring(1e3),
    "Hertz": sb.Hertz(1e5),
}
SHAPES = ("chain", "gapped")
SIZES = (2, 4, 8, 16, 32, 64, 128, 256, 512, 1000, 2000)
EVENTS = 10_000  # a gapped stack has O(N²) collisions: of a tall one the first ones will do
AT_ONCE = 1e-200  # s, when a run is stopped to time what it needs to begin
LOOKS = 100
FAINT = 1e-6
VISIBLE = 0.3  # of the time to set up: a run that takes less on top of it tells nothing


@dataclass(frozen=True)
class Cost:
    """What one run took.

    ``seconds`` and ``setup`` are the times of the run and of its beginning in s, ``cluster`` is
    the mean number of contacts in a row that press on each other.
    """

    shape: str
    law: str
    balls: int
    seconds: float
    setup: float
    intervals: int
    cluster: float
    finished: bool

    @property
    def per_interval(self) -> float:
        """Time per contact interval in s; nan where the run hardly took longer than to set up."""
        spent = self.seconds - self.setup
        return spent / self.intervals if spent > VISIBLE * self.setup else math.nan


def stack(shape: str, law: str, balls: int) -> sb.Drop:
    """Return a chain or a gapped stack of that many balls; speeds are 1 m/s."""
    contact = LAWS[law]
    if shape == "chain":
        return sb.Drop(
            [sb.Ball(1.0)] * balls,
            [None, *[contact] * (balls - 1)],
            velocities=[1.0, *[0.0] * (balls - 1)],
        )
    random = np.random.default_rng(balls)
    masses = np.exp(random.uniform(-1.0, 1.0, balls))
    gaps = random.uniform(
        0.05, 1.0, balls - 1
    ).tolist()  # m; contacts give way by about 0.03 m or less
    return sb.Drop([sb.Ball(m) for m in masses], [contact] * balls, gaps, impact_speed=1.0)


def cluster(result: sb.Result) -> float:
    """Return how many contacts in a row press on each other, on average.

    Counted in the middle of `LOOKS` contact intervals, around the contact with the largest force:
    all that have more than `FAINT` of it. Rigid contacts never press on each other: 1.
    """
    if isinstance(result.drop.contacts[-1], sb.Rigid):
        return 1.0
    rows = result.intervals[np.isfinite(result.intervals["end"])]
    rows = rows[np.linspace(0, len(rows) - 1, min(LOOKS, len(rows))).astype(int)]
    forces = result.sample(np.sort(0.5 * (rows["start"] + rows["end"]))).force.values
    pressed = np.pad(forces > FAINT * forces.max(axis=0), ((1, 1), (0, 0)))  # open at the ends
    sizes = [
        int(np.argmin(column[place:]) + np.argmin(column[place::-1])) - 1
        for place, column in zip(1 + forces.argmax(axis=0), pressed.T, strict=True)
    ]
    return float(np.mean(sizes))


def measure(progress: Callable[[str], None]) -> list[Cost]:
    """Return the costs of compiled runs of all shapes, laws and sizes."""
    kinds, results, calls = [], [], []
    for shape, law, balls in product(SHAPES, LAWS, SIZES):
        progress(f"growth: {shape}, {law}, {balls} balls")
        run = partial(sb.simulate, stack(shape, law, balls), event_limit=EVENTS, compiled=True)
        kinds.append((shape, law, balls))
        results.append(run())
        calls += [run, partial(run, until=AT_ONCE)]
    times = best(calls, lambda text: progress(f"growth: {text}"))
    return [
        Cost(
            *kind,
            seconds=seconds,
            setup=setup,
            intervals=len(result.intervals),
            cluster=cluster(result),
            finished=result.status == sb.Status.FINISHED,
        )
        for kind, result, seconds, setup in zip(
            kinds, results, times[::2], times[1::2], strict=True
        )
    ]
