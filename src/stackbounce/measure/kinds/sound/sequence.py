"""Selects the bounces of one ball among many sounds: their intervals shrink steadily."""

import math
from typing import NamedTuple

import numpy as np

from stackbounce.measure.kinds.bounces.knocks import SHRINKS
from stackbounce.measure.kinds.sound.loudness import Rises

# Weights of a series' score, in which a clear knock counts 1 to 3: set by hand on the synthetic
# recordings of `benchmarks/coverage/sound.py` and those in `docs/lab`.
_LONGEST_FLIGHT = 3.0  # s: a bounce of 11 m
_RATIO_SPREAD = 0.06  # by which the logarithm of the ratio of flights changes from bounce to bounce
_RATIO_LIMIT = 3.0  # times that: no series changes more
_LOUDNESS_SPREAD = 1.0  # by which ln(loudness) scatters about that of the speed
_MISSED_PENALTY = 2.5  # of a missing bounce
_START_PENALTY = 1.0  # of a series
_RANGES = 8  # of the ratio, for each of which the best series is kept
_RANGE = math.log(SHRINKS[1] / SHRINKS[0]) / _RANGES  # width of one in the logarithm


class Chain(NamedTuple):
    """Indices of a series' knocks, and how many bounces are missing after each but the last."""

    indices: tuple[int, ...]
    missed: tuple[int, ...]


def find_chain(rises: Rises, dead_time: float) -> Chain:
    """Return the series of bounces that explains most of the knocks.

    Each flight is shorter than the one before by a factor that changes slowly, and loudness falls
    with speed. Single bounces may be missing. The series is found by dynamic programming over pairs
    of neighbouring bounces, each with the best series that ends in it.

    Parameters
    ----------
    rises : Rises
        All knocks, ascending in time; their amplitudes are above 0.
    dead_time : float
        The shortest flight in s.

    Returns
    -------
    Chain
        Empty if there is no knock.

    Examples
    --------
    >>> times = np.array([0.0, 0.3, 1.0, 1.3, 1.8, 2.44])  # two are echoes
    >>> amplitudes = np.array([5, 1, 4, 1, 3.2, 2.6])
    >>> find_chain(Rises(times, np.full(6, 1e-4), amplitudes, np.full(6, 1.6)), 0.01)
    Chain(indices=(0, 2, 4, 5), missed=(0, 0, 0))
    """
    times, errors, amplitudes, ratios = rises
    count = len(times)
    if count < 3:
        return Chain(tuple(range(count)), (0,) * max(count - 1, 0))
    pairs = _Pairs(count)
    first = np.searchsorted(times, times - _LONGEST_FLIGHT)
    last = np.searchsorted(times, times - dead_time, side="right")
    logs = np.log(amplitudes)
    worth = 0.5 + np.clip(np.log(ratios), 0.0, 3.0)
    for k in range(count):
        for j in range(first[k], min(last[k], k)):
            flight = times[k] - times[j]
            pairs.score[j, k, 0] = worth[j] + worth[k] - _START_PENALTY
            pairs.flight[j, k, 0] = flight
            step = _Step(flight, 2.0 * max(errors[j], errors[k]) / flight, logs[k] - logs[j])
            _go_on(pairs, j, k, step, worth[k])
    return pairs.best()


class _Step(NamedTuple):
    flight: float
    error: float  # relative
    louder: float  # logarithm


class _Pairs:
    """The best series that end in each pair of neighbouring bounces.

    One that begins with the pair (slot 0), and one for each range of the ratio of its last two
    flights, so that a wrong beginning does not hide a right one.
    """

    def __init__(self, count: int) -> None:
        shape = (count, count, 1 + _RANGES)
        self.score = np.full(shape, -np.inf)
        self.flight = np.full(shape, np.nan)
        self.ratio = np.full(shape, np.nan)
        self.before = np.full((*shape, 2), -1)
        self.missed = np.zeros(shape, dtype=np.int64)

    def best(self) -> Chain:
        j, k, slot = (int(i) for i in np.unravel_index(np.argmax(self.score), self.score.shape))
        if not np.isfinite(self.score[j, k, slot]):
            return Chain((0,), ())
        indices, missed = [k], []
        while j >= 0:
            indices.append(j)
            missed.append(int(self.missed[j, k, slot]))
            before, new = (int(i) for i in self.before[j, k, slot])
            j, k, slot = before, j, new
        return Chain(tuple(indices[::-1]), tuple(missed[::-1]))


def _go_on(pairs: _Pairs, j: int, k: int, step: _Step, worth: float) -> None:
    """Extend the best series that end in j by the flight from j to k."""
    scores = pairs.score[:j, j]
    known = np.argwhere(np.isfinite(scores))
    if not len(known):
        return
    at = tuple(known.T)
    whole = step.flight / pairs.flight[:j, j][at]
    previous = pairs.ratio[:j, j][at]
    for missed in (0, 1):
        # One bounce is missing: the interval holds two flights, r and r**2 times the last one.
        ratio = 0.5 * (np.sqrt(1.0 + 4.0 * whole) - 1.0) if missed else whole
        fresh = np.isnan(previous)
        change = np.log(ratio / np.where(fresh, ratio, previous)) / math.hypot(
            _RATIO_SPREAD, step.error
        )
        quieter = np.clip(
            (step.louder - (1 + missed) * np.log(ratio)) / _LOUDNESS_SPREAD, -2.0, 2.0
        )
        total = scores[at] + worth - 0.5 * change**2 - 0.5 * quieter**2 - missed * _MISSED_PENALTY
        allowed = (ratio > SHRINKS[0]) & (ratio < SHRINKS[1] + step.error)
        allowed &= np.abs(change) < _RATIO_LIMIT
        if missed:  # only a steady series tells that one is missing
            allowed &= ~fresh
        slots = 1 + np.clip((np.log(ratio / SHRINKS[0]) / _RANGE).astype(int), 0, _RANGES - 1)
        flights = step.flight * (ratio / (1.0 + ratio) if missed else np.ones_like(ratio))
        for i in np.flatnonzero(allowed):
            slot = slots[i]
            if total[i] > pairs.score[j, k, slot]:
                pairs.score[j, k, slot] = total[i]
                pairs.flight[j, k, slot] = flights[i]
                pairs.ratio[j, k, slot] = ratio[i]
                pairs.before[j, k, slot] = known[i]
                pairs.missed[j, k, slot] = missed
