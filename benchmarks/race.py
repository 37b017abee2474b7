"""Our package and its peers on the same drops: time, error of the velocities, wrong counts.

Times are processor times of one thread, medians of rounds over all solvers, so that a busy second
does not fall on all tries of one of them. Compilation is left out.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from statistics import median
from time import process_time

import numpy as np

from benchmarks import random_drops
from benchmarks.impacts import normal_modes
from benchmarks.peers import by_cvode, by_cyrk, by_heyoka, by_scipy, by_steps, ours
from benchmarks.peers.common import Answer, Peer
from benchmarks.random_drops import Drops

OURS = ours.PEER
PEERS = (
    OURS,
    by_heyoka.BATCH,
    by_heyoka.SCALAR,
    by_cyrk.PEER,
    by_cvode.PEER,
    by_scipy.PEER,
    by_steps.PEER,
)
MOST = 10_000  # random drops
CHANGES = 90  # with two hard drops each at every offset
SEED = 2007
SECONDS = 10.0  # for all rounds of one peer; what it manages is its share of the random drops
ROUNDS = 3
PILOT = 20  # drops, of which a peer's number follows
SAMPLE, HARD_SAMPLE = 100, 20  # drops that are solved to fifty digits: random, and of each offset


@dataclass(frozen=True)
class Sets:
    """The random drops, the hard ones by offset, and the truth about each, by key; 0: random."""

    drops: dict[float, Drops]
    truth: dict[float, Answer]


@dataclass(frozen=True)
class Entry:
    """What one solver did; errors in units of v0, times in s per drop. No times: it was skipped.

    `wrong` is the share of drops with a wrong count in either contact, by key of the set.
    """

    peer: Peer
    drops: int = 0
    rounds: list[float] = field(default_factory=list)
    median_error: float = 0.0
    worst_error: float = 0.0
    wrong: dict[float, float] = field(default_factory=dict)

    @property
    def seconds(self) -> float:
        """The median of the rounds."""
        return median(self.rounds)


@dataclass(frozen=True)
class Check:
    """The truth against fifty digits: drops, the errors of the velocities, wrong counts."""

    drops: int
    errors: np.ndarray
    wrong: int


def sets(progress: Callable[[str], None], most: int = MOST, changes: int = CHANGES) -> Sets:
    """Return the drops, and what `simulate` says about them."""
    drops = {0.0: random_drops.random(most, SEED)}
    drops |= random_drops.hard(changes, SEED, progress)
    progress("the truth about all drops")
    return Sets(drops, {key: truth(some) for key, some in drops.items()})


def truth(drops: Drops) -> Answer:
    """Return the answer of `simulate`, which is exact for springs; `check` checks it."""
    results = [random_drops.simulated(row) for row in drops.ratios]
    return (
        np.array([result.rebound_speeds for result in results]),
        np.array([result.collisions for result in results]),
    )


def check(
    given: Sets, progress: Callable[[str], None], sample: int = SAMPLE, hard: int = HARD_SAMPLE
) -> Check:
    """Return how the truth compares with fifty digits on the first drops of each set."""
    off, wrong = [], 0
    for key, drops in given.drops.items():
        few = drops.first(hard if key else sample)
        rows = zip(few.masses, few.stiffnesses, few.gaps, *given.truth[key], strict=False)
        for number, (m, k, gap, velocities, counts) in enumerate(rows):
            progress(f"fifty digits: offset {key:g}, drop {number + 1} of {len(few)}")
            found = normal_modes.run(m.tolist(), k.tolist(), [float(gap)], [-1.0, -1.0])
            off.append(np.abs(velocities - np.array(found.velocities, dtype=float)).max())
            wrong += found.counts(2) != counts.tolist()
    return Check(len(off), np.array(off), wrong)


def race(
    given: Sets,
    progress: Callable[[str], None],
    peers: Sequence[Peer] = PEERS,
    seconds: float = SECONDS,
) -> list[Entry]:
    """Return what each solver did; one that is not installed has no times."""
    shares = {}
    for peer in (peer for peer in peers if peer.available()):
        progress(f"{peer.name}: compiling")
        pilot = given.drops[0.0].first(PILOT)
        peer.solve(pilot)
        each = _timed(peer, pilot)[0] / len(pilot)
        most = max(PILOT, int(seconds / ROUNDS / each))
        shares[peer.name] = given.drops[0.0].first(len(given.drops[0.0]) if peer is OURS else most)
    times: dict[str, list[float]] = {name: [] for name in shares}
    answers = {}
    for number in range(1, ROUNDS + 1):
        for peer in (peer for peer in peers if peer.name in shares):
            progress(f"{peer.name}: round {number} of {ROUNDS}, {len(shares[peer.name])} drops")
            spent, answers[peer.name] = _timed(peer, shares[peer.name])
            times[peer.name].append(spent / len(shares[peer.name]))
    return [
        _entry(peer, given, times[peer.name], answers[peer.name], progress)
        if peer.name in shares
        else Entry(peer)
        for peer in peers
    ]


def _timed(peer: Peer, drops: Drops) -> tuple[float, Answer]:
    """Return the processor time in s, of all threads, and the answer."""
    start = process_time()
    answer = peer.solve(drops)
    return process_time() - start, answer


def _entry(
    peer: Peer,
    given: Sets,
    times: list[float],
    answer: Answer,
    progress: Callable[[str], None],
) -> Entry:
    """Return a peer's errors on its random drops, and its wrong counts on the hard ones too."""
    velocities, counts = answer
    n = len(velocities)
    off = np.abs(velocities - given.truth[0.0][0][:n]).max(axis=1)
    wrong = {0.0: _share(counts, given.truth[0.0][1][:n])}
    for key in (key for key in given.drops if key):
        progress(f"{peer.name}: hard drops, offset {key:g}")
        wrong[key] = _share(peer.solve(given.drops[key])[1], given.truth[key][1])
    return Entry(peer, n, times, float(np.median(off)), float(off.max()), wrong)


def _share(counts: np.ndarray, expected: np.ndarray) -> float:
    """Return the share of drops with a wrong count."""
    return float((counts != expected).any(axis=1).mean())
