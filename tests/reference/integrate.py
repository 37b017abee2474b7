"""Any stack of finite contacts by Gauss collocation in double precision, compiled: a quick check.

`integrate` takes the steps of `gauss`, each so short that its last Legendre terms are below
`TOLERANCE`. After each it looks for a change of sign, in sample points and at peaks between them,
of every compression, of every force that may be clipped, and of the rate of a hysteretic contact;
the step is repeated up to the first change. All of this is independent of `precise`.
"""

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from numba import njit

from reference.forces import (
    CLIPPED,
    DASHPOT,
    HUNT_CROSSLEY,
    HYSTERETIC,
    LOADING,
    MOST_PAIRS,
    NONE,
    OPEN,
    POWER,
    UNLOADING,
    VISCOELASTIC,
    accelerate,
    force_of,
    numbers_of,
    power,
    turning_lengths,
)
from reference.gauss import (
    DEGREE,
    LAST,
    NODES,
    PLACES,
    SWEEPS,
    TO_LENGTH,
    TO_RATE,
    WEIGHTS,
    crossing,
    dense,
    evaluate,
    highest,
)

TOLERANCE = 1e-13  # of a step's last term, in units of the problem's speed and length
SAMPLES = 12  # places in a step where events are looked for
NEAR = 1e-9  # how close to zero, in the contact's own scale, makes a count doubtful
NOISE = 1e-12  # round-off of a compression that has only begun to rise from rest, in that scale
PULL = 1e-13  # how far a force must be below zero, in its scale, to be clipped: it may creep to 0
EQUAL = 1e-12  # rates of approach that are smaller, in units of the largest speed, are none

STATUS = ("finished", "time reached", "too long", "no convergence")
FINISHED, TIME_REACHED, TOO_LONG, NO_CONVERGENCE = range(4)
COLUMNS = 6  # of an interval: contact, start, end, peak force, peak compression, impulse


class Solution(NamedTuple):
    """What came out; `intervals` has rows as in the data files, an open end is nan.

    `doubtful` tells that a compression had an extreme, or a parting a speed, so close to zero that
    round-off may have decided a count.
    """

    status: str
    velocities: np.ndarray
    counts: list[int]
    intervals: np.ndarray
    doubtful: bool
    steps: int


def integrate(
    masses: Sequence[float],
    contacts: Sequence[Mapping[str, Any] | None],
    gaps: Sequence[float],
    velocities: Sequence[float],
    gravity: float = 0.0,
    until: float = np.inf,
    limit: int = 1_000_000,
) -> Solution:
    """Solve a drop, bottom first, in at most `limit` steps; contacts as in `laws.read`."""
    laws = np.array([numbers_of(**law) if law else (NONE, 0.0, 1.0, 1.0, 0.0) for law in contacts])
    v = np.array(velocities, dtype=float)
    c = -np.array([0.0, *gaps])
    rates = np.array([0.0, *v[:-1]]) - v
    log = np.full((4096, COLUMNS), np.nan)
    while True:
        status, rows, doubtful, steps, end = _run(
            np.array(masses, dtype=float), laws, c, rates, gravity, until, limit, log
        )
        if rows <= len(log):
            break
        log = np.full((rows + 1, COLUMNS), np.nan)
    rows = log[:rows]
    counts = [int(np.sum(rows[:, 0] == i)) for i in range(len(v))]
    return Solution(STATUS[status], -np.cumsum(end), counts, rows, bool(doubtful), steps)


@njit
def _step(mass, laws, phase, pairs, depth, gravity, c, rates, h, acc, forces, scale, speed):
    """Solve the collocation by sweeps; return its error over the tolerance, inf if none is met."""
    size = len(mass)
    x, y, force, a = np.empty(size), np.empty(size), np.empty(size), np.empty(size)
    change = np.inf
    for _ in range(SWEEPS):
        before, change = change, 0.0
        for j in range(NODES):
            for i in range(size):
                x[i] = c[i] + h * PLACES[j] * rates[i]
                y[i] = rates[i]
                for k in range(NODES):
                    x[i] += h * h * TO_LENGTH[j, k] * acc[i, k]
                    y[i] += h * TO_RATE[j, k] * acc[i, k]
            accelerate(mass, laws, phase, pairs, depth, gravity, x, y, force, a)
            for i in range(size):
                change = max(change, h * abs(a[i] - acc[i, j]))
                acc[i, j] = a[i]
                forces[i, j] = force[i]
        if change <= 1e-15 * speed or (change <= 1e-14 * speed and change >= before):
            break
        if not change < 1e6 * speed:
            return np.inf
    if not change <= 1e-14 * speed:
        return np.inf
    error = 0.0
    for i in range(size):
        for row in range(LAST.shape[0]):
            term = 0.0
            for j in range(NODES):
                term += LAST[row, j] * acc[i, j]
            error = max(error, h * abs(term) / speed, 0.1 * h * h * abs(term) / scale)
    return error / TOLERANCE


@njit
def _watch(law, phase, pairs, depth, lengths, rates, scale, f):
    """Write the polynomials whose rise above 0 ends the phase; return how many there are."""
    f[:] = 0.0
    code = law[0]
    damped = code in (DASHPOT, VISCOELASTIC, HUNT_CROSSLEY)
    f[0] = -lengths
    if phase == OPEN:
        f[0] = lengths
        return 1
    if phase == CLIPPED or (damped and phase == LOADING):
        sign = 1.0 if phase == CLIPPED else -1.0
        if code == DASHPOT:
            f[1] = sign * law[1] * lengths
            f[1, :DEGREE] += sign * law[4] * rates
        elif code == VISCOELASTIC:
            f[1] = sign * lengths
            f[1, :DEGREE] += sign * 1.5 * law[4] * rates
        else:
            f[1, :DEGREE] = sign * law[4] * rates
            f[1, 0] += sign
        if phase == LOADING:
            unit = 1.0 if code == HUNT_CROSSLEY else scale * (law[1] if code == DASHPOT else 1.0)
            f[1, 0] -= PULL * unit
        return 2
    if code != HYSTERETIC:
        return 1
    sign = 1.0 if phase == UNLOADING else -1.0
    f[1, :DEGREE] = sign * rates
    if depth == 1:
        return 2
    f[2] = -sign * lengths
    f[2, 0] += pairs[depth - 1, 0] if phase == UNLOADING else -pairs[depth - 2, 1]
    return 3


@njit
def _next_phase(phase, which, code):
    """Return the phase after the event of that number in `_watch`."""
    if phase == OPEN:
        return LOADING
    if which == 0:
        return OPEN
    if which == 2:
        return phase
    if phase == LOADING:
        return UNLOADING if code == HYSTERETIC else CLIPPED
    return LOADING


@njit
def _remember(pairs, depth, before, phase, c):
    """Update what the elements of a hysteretic contact remember; return how many pairs it is."""
    if phase == OPEN:
        return 0
    if before == OPEN:
        pairs[0, 0], pairs[0, 1] = 0.0, np.inf
        return 1
    if phase == before:  # at the last but one turning point again
        if phase == LOADING:
            pairs[depth - 2, 1] = np.inf
        return depth - 1
    if phase == UNLOADING:
        pairs[depth - 1, 1] = c
        return depth
    pairs[depth, 0], pairs[depth, 1] = c, np.inf
    return depth + 1


@njit
def _event(laws, phase, pairs, depth, fresh, c, rates, acc, h, scales):
    """Return the first event of a step: place, contact, number; and whether it is doubtful."""
    lengths, speeds, f = np.empty(DEGREE + 1), np.empty(DEGREE), np.empty((3, DEGREE + 1))
    best, contact, which, doubtful = 2.0, -1, -1, False
    for i in range(len(c)):
        if laws[i, 0] == NONE:
            continue
        dense(c[i], rates[i], acc[i], h, lengths, speeds)
        events = _watch(laws[i], phase[i], pairs[i], depth[i], lengths, speeds, scales[i], f)
        if fresh[i]:
            f[0, 0] -= NOISE * scales[i]
        resting = phase[i] == OPEN and c[i] == 0.0 and rates[i] == 0.0
        for number in range(events):
            place, top = crossing(f[number], SAMPLES)
            if number == 1 and place < best and evaluate(lengths, place) <= 0.0:
                continue  # round-off where it has just begun
            if place < best:
                best, contact, which = place, i, number
            if number == 0 and top > -NEAR * scales[i] and not (resting or fresh[i]):
                doubtful = True
    return best, contact, which, doubtful


@njit
def _record(laws, phase, c, rates, acc, forces, h, row, log):
    """Add a step to the peaks and the impulses of the contacts that are not open."""
    lengths, speeds = np.empty(DEGREE + 1), np.empty(DEGREE)
    for i in range(len(c)):
        if phase[i] == OPEN or row[i] >= len(log):
            continue
        entry = log[row[i]]
        dense(c[i], rates[i], acc[i], h, lengths, speeds)
        entry[4] = highest(lengths, SAMPLES, entry[4])
        if phase[i] == CLIPPED:
            continue
        for j in range(NODES):
            entry[5] += h * WEIGHTS[j] * forces[i, j]
        if laws[i, 0] in (POWER, HYSTERETIC):
            entry[3] = laws[i, 1] * power(entry[4], laws[i, 2])
        else:
            _peak_force(laws[i], lengths, speeds, entry)


@njit
def _force_at(law, lengths, speeds, x):
    c, rate = 0.0, 0.0
    for k in range(DEGREE, -1, -1):
        c = c * x + lengths[k]
    for k in range(DEGREE - 1, -1, -1):
        rate = rate * x + speeds[k]
    return force_of(law, c, rate)


@njit
def _peak_force(law, lengths, speeds, entry):
    """Put the largest force of the step into the entry (golden section about the best sample)."""
    top, place = -np.inf, -1.0
    for j in range(SAMPLES + 1):
        x = -1.0 + 2.0 * j / SAMPLES
        force = _force_at(law, lengths, speeds, x)
        if force > top:
            top, place = force, x
    if top + 1e-3 * abs(top) > entry[3]:
        low, high = max(place - 2.0 / SAMPLES, -1.0), min(place + 2.0 / SAMPLES, 1.0)
        for _ in range(45):
            left, right = low + 0.382 * (high - low), low + 0.618 * (high - low)
            a, b = _force_at(law, lengths, speeds, left), _force_at(law, lengths, speeds, right)
            top = max(top, a, b)
            if a < b:
                low = left
            else:
                high = right
    entry[3] = max(entry[3], top)


@njit
def _parting(laws, phase, rates, speed):
    """Return whether no force acts and no contact approaches, and whether that is doubtful."""
    doubtful = False
    for i in range(len(rates)):
        if laws[i, 0] != NONE:
            if phase[i] in (LOADING, UNLOADING) or rates[i] > EQUAL * speed:
                return False, False
            doubtful = doubtful or 0.0 < abs(rates[i]) < NEAR * speed
    return True, doubtful


@njit
def _run(mass, laws, start, start_rates, gravity, until, limit, log):
    """Step from event to event; return status, rows, doubtful, steps and the last rates."""
    size = len(mass)
    c, rates = start.copy(), start_rates.copy()
    v = -np.cumsum(rates)
    speed = max(np.max(np.abs(v)), 0.0) or gravity * until
    scales = turning_lengths(mass, laws, speed)
    scale = np.min(scales)
    phase, row = np.zeros(size, np.int64), np.zeros(size, np.int64)
    clipped, pressed = np.zeros(size), np.zeros(size)
    pairs, depth = np.zeros((size, MOST_PAIRS, 2)), np.zeros(size, np.int64)
    touching, fresh = np.zeros(size, np.bool_), np.zeros(size, np.bool_)
    acc, forces = np.zeros((size, NODES)), np.zeros((size, NODES))
    now, h, rows, doubtful, steps = 0.0, 1e-3 * scale / speed, 0, False, 0
    while now < until:
        finished, unsure = _parting(laws, phase, rates, speed)
        if finished and until == np.inf:
            for i in range(size):
                if phase[i] == CLIPPED and row[i] < len(log):
                    log[row[i], 2] = clipped[i]
            return FINISHED, rows, doubtful or unsure, steps, rates
        if steps >= limit or np.max(depth) == MOST_PAIRS:
            return TOO_LONG, rows, doubtful, steps, rates
        for i in range(size):
            still = phase[i] == OPEN and c[i] == 0.0 and rates[i] == 0.0
            if still and not touching[i]:
                pressed[i] = now
            touching[i] = still
            fresh[i] = fresh[i] and phase[i] != OPEN and c[i] < NOISE * scales[i]
        h = min(h, until - now)
        steps += 1
        error = _step(
            mass, laws, phase, pairs, depth, gravity, c, rates, h, acc, forces, scale, speed
        )
        if error > 1.0:
            acc[:] = 0.0
            h *= 0.25 if error == np.inf else max(0.1, 0.8 * error ** (-1.0 / NODES))
            if h < 1e-30 * scale / speed:
                return NO_CONVERGENCE, rows, doubtful, steps, rates
            continue
        longer = h * min(3.0, 0.8 * max(error, 1e-9) ** (-1.0 / NODES))
        place, i, which, near = _event(laws, phase, pairs, depth, fresh, c, rates, acc, h, scales)
        if i >= 0:
            h *= 0.5 * (1.0 + place)
            _step(mass, laws, phase, pairs, depth, gravity, c, rates, h, acc, forces, scale, speed)
        else:
            doubtful = doubtful or near
        _record(laws, phase, c, rates, acc, forces, h, row, log)
        for j in range(size):
            c[j] += h * rates[j]
            for k in range(NODES):
                c[j] += h * h * WEIGHTS[k] * (1.0 - PLACES[k]) * acc[j, k]
                rates[j] += h * WEIGHTS[k] * acc[j, k]
        now = until if i < 0 and h == until - now else now + h
        h = longer
        if i < 0:
            continue
        before, phase[i] = phase[i], _next_phase(phase[i], which, laws[i, 0])
        if laws[i, 0] == HYSTERETIC:
            depth[i] = _remember(pairs[i], depth[i], before, phase[i], c[i])
        if before == OPEN:
            c[i] = 0.0
            row[i], rows = rows, rows + 1
            begun = pressed[i] if touching[i] else now
            fresh[i] = touching[i]
            if row[i] < len(log):
                log[row[i]] = 0.0
                log[row[i], :3] = np.array([float(i), begun, np.nan])
            h = min(h, 1e-2 * scales[i] / speed)
        elif phase[i] == OPEN:
            c[i] = 0.0
            if row[i] < len(log):
                log[row[i], 2] = clipped[i] if before == CLIPPED else now
                doubtful = doubtful or log[row[i], 4] < NEAR * scales[i]
        elif laws[i, 0] == HYSTERETIC and which == 1:
            rates[i] = 0.0
        elif phase[i] == CLIPPED:
            clipped[i] = now
        if before in (OPEN, CLIPPED):
            for j in range(size):
                if touching[j] and j != i:
                    pressed[j] = begun if before == OPEN else now
    return TIME_REACHED, rows, doubtful, steps, rates
