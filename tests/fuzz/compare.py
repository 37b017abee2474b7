"""Random drops once more: as plain Python, and by another method altogether."""

from collections.abc import Mapping
from typing import Any

import numpy as np

import stackbounce as sb
from fuzz import drive
from fuzz.batch import Batch
from fuzz.draw import EVENTS
from fuzz.replay import drop_of, options_of
from reference.integrate import integrate
from stackbounce.engine import codes

SAME, DIFFERENT, DOUBTFUL, UNFINISHED = "same", "different", "doubtful", "not finished"
_EVENTS = 100  # with plain Python
_STEPS = 20_000  # of the reference
_EQUAL = 1e-9  # velocities, in units of the largest
_SHIFT = 1e-12  # of a velocity, in that unit, to see what an error of a step can become
_LARGER = 30.0  # than what that shift makes of it
_BEGUN = 1e-14  # of the momentum: what an interval under way has exerted if it counts


def plainly(batch: Batch, row: int) -> str:
    """Return whether a drop has the same status, velocities and counts as plain Python."""
    size = batch.drops.mass.shape[1]
    found = batch.found[row]
    plain = sb.simulate(drop_of(batch.drops, row), **options_of(batch.drops, row), compiled=False)
    counts = np.where(plain.collisions < 0, -1, found[drive.COLUMNS + size :])
    same = (
        plain.status == found[drive.STATUS]
        and plain.end_time == found[drive.END]
        and np.array_equal(plain.rebound_speeds, found[drive.COLUMNS : drive.COLUMNS + size])
        and np.array_equal(plain.collisions, counts)
    )
    return SAME if same else DIFFERENT


def can_be_compared_plainly(batch: Batch, row: int) -> bool:
    """Return whether a drop is not too long a story for plain Python."""
    found = batch.found[row]
    return bool(found[drive.STATUS] != codes.EVENT_LIMIT and found[drive.EVENT_COUNT] < _EVENTS)


def can_be_integrated(batch: Batch, row: int) -> bool:
    """Return whether the reference knows a drop's laws, and its end."""
    other = np.any(batch.drops.law[row] == drive.RELAXING)
    ended = batch.found[row, drive.STATUS] in (sb.Status.FINISHED, sb.Status.TIME_REACHED)
    return bool(ended and not other)


def otherwise(batch: Batch, row: int) -> str:
    """Return whether a drop has the velocities and counts of collocation in short steps.

    Where they differ, the reference begins again, each time with the velocity of one ball slightly
    changed: counts that change with it, or that it doubts itself, are doubtful, and velocities may
    differ as much. An interval that has only just begun at the end is not counted.
    """
    drop = drop_of(batch.drops, row)
    options = options_of(batch.drops, row) | {"rtol": 1e-12, "event_limit": EVENTS[1]}
    ours = sb.simulate(drop, **options, compiled=True)
    if ours.status not in (sb.Status.FINISHED, sb.Status.TIME_REACHED):
        return UNFINISHED
    if drop.gravity > 0.0:
        options |= {"until": ours.end_time}  # velocities are to be those of one time
    theirs = _integrated(drop, options)
    if theirs.status not in ("finished", "time reached"):
        return UNFINISHED
    speed = drop.reference_speed
    error = np.max(np.abs(theirs.velocities - ours.rebound_speeds)) / speed
    rows = ours.intervals
    counts = _counts(rows["contact"], rows["end"], rows["impulse"], drop)
    columns = theirs.intervals.T
    alike = counts == _counts(columns[0], columns[2], columns[5], drop)
    if alike and error < _EQUAL:
        return SAME
    shift, doubtful = 0.0, theirs.doubtful
    for ball in range(len(drop.balls)):
        shifted = _integrated(drop, options, ball)
        doubtful = doubtful or shifted.counts != theirs.counts
        shift = max(shift, np.max(np.abs(theirs.velocities - shifted.velocities)) / speed)
    if doubtful:
        return DOUBTFUL
    return SAME if alike and error < _LARGER * shift else DIFFERENT


def _counts(contact: np.ndarray, end: np.ndarray, impulse: np.ndarray, drop: sb.Drop) -> list[int]:
    """Return how often each contact closed, without what is only just closed at the end."""
    momentum = sum(ball.mass for ball in drop.balls) * drop.reference_speed
    counted = np.isfinite(end) | (impulse > _BEGUN * momentum)
    return np.bincount(contact[counted].astype(int), minlength=len(drop.balls)).tolist()


def _integrated(drop: sb.Drop, options: Mapping[str, float], ball: int = -1) -> Any:
    """Return what the reference finds, with another velocity of one ball if any."""
    velocities = list(drop.velocities)
    if ball >= 0:
        velocities[ball] += _SHIFT * drop.reference_speed
    return integrate(
        [ball.mass for ball in drop.balls],
        [law and law.to_mapping() for law in drop.contacts],
        drop.gaps,
        velocities,
        drop.gravity,
        options.get("until", np.inf),
        _STEPS,
    )
