"""Selects the bounces of one ball among many sounds: their intervals shrink steadily."""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from stackbounce.measure.kinds.bounces.knocks import SHRINKS
from stackbounce.measure.kinds.sound.loudness import Rises
from stackbounce.measure.quantities import Array

# Weights of a series' score, in which a clear knock counts 1 to 3: set by hand on the synthetic
# recordings of `benchmarks/coverage/sound.py` and those in `docs/lab`.
_LONGEST_FLIGHT = 3.0  # s: a bounce of 11 m
_RATIO_SPREAD = 0.06  # by which the logarithm of the ratio of flights changes from bounce to bounce
_RATIO_LIMIT = 3.0  # times that: no series changes more
_LOUDNESS_SPREAD = 1.0  # by which ln(loudness) scatters about that of the speed
_MISSED_PENALTY = 2.5  # of a missing bounce
_LOUDER_PENALTY = 2.0  # of a sound that is left out, although louder than the next bounce
_START_PENALTY = 1.0  # of a series
_RANGES = 8  # of the ratio, for each of which the best series is kept
_RANGE = math.log(SHRINKS[1] / SHRINKS[0]) / _RANGES  # width of one in the logarithm


class Chain(NamedTuple):
    """Indices of a series' knocks, bounces missing after each but the last, and the score."""

    indices: tuple[int, ...]
    missed: tuple[int, ...]
    score: float = 0.0


def find_chain(rises: Rises) -> Chain:
    """Return the series of bounces that explains most of the knocks.

    Each flight is shorter than the one before by a factor that changes slowly, and loudness falls
    with speed. Single bounces may be missing. The series is found by dynamic programming over pairs
    of neighbouring bounces, each with the best series that ends in it.

    Parameters
    ----------
    rises : Rises
        All knocks, ascending in time; their amplitudes are above 0.

    Returns
    -------
    Chain
        Empty if there is no knock.

    Examples
    --------
    >>> times = np.array([0.0, 0.3, 1.0, 1.3, 1.8, 2.44])  # two are echoes
    >>> amplitudes = np.array([5, 1, 4, 1, 3.2, 2.6])
    >>> chain = find_chain(Rises(times, np.full(6, 1e-4), amplitudes, np.full(6, 1.6)))
    >>> chain.indices, chain.missed
    ((0, 2, 4, 5), (0, 0, 0))
    """
    count = len(rises.times)
    if count < 3:
        return Chain(tuple(range(count)), (0,) * max(count - 1, 0))
    pairs = _Pairs(count)
    logs = np.log(rises.amplitudes)
    worth = 0.5 + np.clip(np.log(rises.ratios), 0.0, 3.0)
    for j in range(count - 1):
        flights = rises.times[j + 1 :] - rises.times[j]
        later = np.flatnonzero(flights <= _LONGEST_FLIGHT)
        if not len(later):
            continue
        between = np.maximum.accumulate(np.append(-np.inf, logs[j + 1 : -1]))[later]
        k, flights = later + j + 1, flights[later]
        louder = logs[k] - logs[j]
        errors = 2.0 * np.maximum(rises.errors[j], rises.errors[k]) / flights
        gain = worth[k] - _LOUDER_PENALTY * (between > logs[k])
        pairs.score[j, k, 0] = worth[j] + gain - _START_PENALTY
        pairs.flight[j, k, 0] = flights
        _go_on(pairs, j, k, _Steps(flights, errors, louder, gain))
    return pairs.best()


class _Steps(NamedTuple):
    """Flights from one knock to later ones: of each its time, and what it is worth."""

    flights: Array
    errors: Array  # relative
    louder: Array  # logarithm
    gain: Array


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
        score = float(self.score[j, k, slot])
        if not np.isfinite(score):
            return Chain((0,), ())
        indices, missed = [k], []
        while j >= 0:
            indices.append(j)
            missed.append(int(self.missed[j, k, slot]))
            before, new = (int(i) for i in self.before[j, k, slot])
            j, k, slot = before, j, new
        return Chain(tuple(indices[::-1]), tuple(missed[::-1]), score)


def _go_on(pairs: _Pairs, j: int, later: NDArray[np.int64], steps: _Steps) -> None:
    """Extend the best series that end in j by the flights from j to later knocks."""
    scores = pairs.score[:j, j]
    known = np.argwhere(np.isfinite(scores))
    if not len(known):
        return
    at = tuple(known.T)
    whole = steps.flights / pairs.flight[:j, j][at][:, None]  # (series, later knocks)
    previous = pairs.ratio[:j, j][at][:, None]
    fresh = np.isnan(previous)
    for missed in (0, 1):
        # One bounce is missing: the interval holds two flights, r and r**2 times the last one.
        ratio = 0.5 * (np.sqrt(1.0 + 4.0 * whole) - 1.0) if missed else whole
        log = np.log(ratio)
        before = np.where(fresh, log, np.log(previous))
        change = (log - before) / np.hypot(_RATIO_SPREAD, steps.errors)
        quieter = np.clip((steps.louder - (1 + missed) * log) / _LOUDNESS_SPREAD, -2.0, 2.0)
        total = scores[at][:, None] + steps.gain - 0.5 * (change**2 + quieter**2)
        allowed = (ratio > SHRINKS[0]) & (ratio < SHRINKS[1] + steps.errors)
        allowed &= np.abs(change) < _RATIO_LIMIT
        if missed:  # only a steady series tells that one is missing
            allowed &= ~fresh
            total -= _MISSED_PENALTY
        places = np.clip(((log - math.log(SHRINKS[0])) / _RANGE).astype(int), 0, _RANGES - 1)
        for slot in range(_RANGES):
            held = np.where(allowed & (places == slot), total, -np.inf)
            best = np.argmax(held, axis=0)
            columns = np.arange(len(later))
            columns = columns[held[best, columns] > pairs.score[j, later, 1 + slot]]
            best, end = best[columns], (j, later[columns], 1 + slot)
            pairs.score[end] = held[best, columns]
            pairs.flight[end] = steps.flights[columns]
            if missed:
                part = ratio[best, columns]
                pairs.flight[end] *= part / (1.0 + part)
            pairs.ratio[end] = ratio[best, columns]
            pairs.before[end] = known[best]
            pairs.missed[end] = missed
