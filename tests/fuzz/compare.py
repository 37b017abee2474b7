"""Random drops once more: as plain Python, and by another method altogether."""

from collections.abc import Mapping
from unittest import mock

import numpy as np
from mpmath import mpf

import stackbounce as sb
from fuzz.draw import EVENTS
from reference import precise, taylor
from reference.common import Outcome

SAME, DIFFERENT, DOUBTFUL, UNFINISHED = "same", "different", "doubtful", "not finished"
_EVENTS = 100  # with plain Python
_STEPS = 300  # of the reference
_EIGHTEEN_DIGITS = {  # of the reference, which has thirty otherwise and takes longer
    taylor: {"TERMS": 24, "PRECISION": -60, "CONVERGED": -20},
    precise: {"NEGLECTED": mpf(10) ** -18, "LEAST": mpf(10) ** -19},
}
_EQUAL = 1e-9  # velocities, in units of the largest
_SHIFT = 3e-11  # of a velocity, in that unit, to see what errors of the steps can become
_BEGUN = 1e-14  # of the momentum: what an interval under way has exerted if it counts


def plainly(result: sb.Result, options: Mapping[str, float]) -> str:
    """Return whether a drop has the same log, end and velocities in plain Python."""
    plain = sb.simulate(result.drop, **options, compiled=False)
    names = ("status", "end_time", "log", "final_velocities", "infinite")
    pairs = [(getattr(result, name), getattr(plain, name)) for name in names]
    return SAME if all(np.array_equal(*pair) for pair in pairs) else DIFFERENT


def can_be_compared_plainly(result: sb.Result) -> bool:
    """Return whether a drop is not too long a story for plain Python."""
    return result.status is not sb.Status.EVENT_LIMIT and len(result.events) < _EVENTS


def can_be_integrated(result: sb.Result) -> bool:
    """Return whether a drop has contacts, the reference knows all of them, and the drop its end."""
    laws = [law for law in result.drop.contacts if law is not None]
    known = laws and not any(isinstance(law, sb.StandardLinearSolid) for law in laws)
    return bool(known) and result.status in (sb.Status.FINISHED, sb.Status.TIME_REACHED)


def otherwise(result: sb.Result, options: Mapping[str, float]) -> str:
    """Return whether a drop has the velocities and counts of the reference.

    Where they differ, the reference begins again, each time with the velocity of one ball slightly
    changed: counts that change with it are doubtful, and velocities may differ as much. An
    interval that has only just begun at the end is not counted.
    """
    drop, options = result.drop, {**options, "rtol": 1e-12, "event_limit": EVENTS[1]}
    ours = sb.simulate(drop, **options, compiled=True)
    if ours.status not in (sb.Status.FINISHED, sb.Status.TIME_REACHED):
        return UNFINISHED
    if drop.gravity > 0.0:
        options |= {"until": ours.end_time}  # velocities are to be those of one time
    rows = ours.intervals
    counts = _counts(rows["contact"], rows["end"], rows["impulse"], drop)
    try:
        velocities, expected = _referred(drop, options)
        alike, unit = counts == expected, drop.reference_speed
        error = np.max(np.abs(velocities - ours.rebound_speeds)) / unit
        if alike and error < _EQUAL:
            return SAME
        moved = [_referred(drop, options, ball) for ball in range(len(drop.balls))]
    except ArithmeticError:
        return UNFINISHED
    if any(found != expected for _, found in moved):
        return DOUBTFUL
    shift = max(np.max(np.abs(velocities - other)) / unit for other, _ in moved)
    return SAME if alike and error < shift else DIFFERENT


def _counts(contact, end, impulse, drop):
    """Return how often each contact closed, without what is only just closed at the end."""
    momentum = sum(ball.mass for ball in drop.balls) * drop.reference_speed
    counted = np.isfinite(end) | (np.array(impulse) > _BEGUN * momentum)
    return np.bincount(np.array(contact, int)[counted], minlength=len(drop.balls)).tolist()


def _referred(drop, options, ball=-1):
    """Return the reference's velocities and counts, with another velocity of one ball if any."""
    velocities = list(drop.velocities)
    if ball >= 0:
        velocities[ball] += _SHIFT * drop.reference_speed
    (one, few), (other, more) = _EIGHTEEN_DIGITS.items()
    with mock.patch.multiple(one, **few), mock.patch.multiple(other, **more):
        found: Outcome = precise.run(
            [ball.mass for ball in drop.balls],
            [law and law.to_mapping() for law in drop.contacts],
            drop.gaps,
            velocities,
            drop.gravity,
            options.get("until"),
            _STEPS,
        )
    ends = [np.inf if i.end is None else float(i.end) for i in found.intervals]
    impulses = [float(i.impulse) for i in found.intervals]
    counts = _counts([i.contact for i in found.intervals], ends, impulses, drop)
    return np.array([float(v) for v in found.velocities]), counts
