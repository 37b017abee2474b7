"""What can be wrong with the result of a random drop."""

from collections.abc import Iterator

import numpy as np

import stackbounce as sb
from stackbounce.engine import codes

FAULTS = (
    "a number is not finite",
    "energy rises",
    "momentum changes",
    "touch and release do not alternate",
    "a contact's events go back in time",
    "finished with a closed contact",
    "finished while a contact approaches",
    "invalid, though the clock could tell",
)
_LOOSE = 10.0  # times the precision, and a tenth of it per event: a rise of the energy, an approach
_ROUND = 1e-12  # and more than that of the first energy
_EPSILON = 2.0**-52
_SHAKE = 64.0 * _EPSILON  # of the largest momentum, per event
_SHORT = 1e-5  # of a contact's compression, that a ball goes in the resolution of the clock
_ENDED = (sb.Status.FINISHED, sb.Status.COLLAPSED)


def faults_of(result: sb.Result, stops: np.ndarray) -> list[str]:
    """Return in words what is wrong with a result; `stops` are parts of its time to look at."""
    if result.status is sb.Status.INVALID:
        return [] if _comes_too_late(result) else [FAULTS[7]]
    allowed = (_ROUND + _LOOSE * result.precision) * (1.0 + 0.1 * len(result.events))
    logged = list(_by_contact(result))
    found = (
        not np.isfinite(result.rebound_speeds).all() or np.isnan(result.log).any(),
        bool(_rise(result, stops) > allowed),
        _shake(result) > _SHAKE * (10.0 + len(result.events)),
        any(not _alternate(kinds) for kinds, _ in logged),
        any((np.diff(times) < 0.0).any() for _, times in logged)
        or bool((result.intervals["start"] > result.intervals["end"]).any()),
        result.status is sb.Status.FINISHED
        and any(kinds[-1:] == [codes.TOUCH] or np.inf in times for kinds, times in logged),
        result.status in _ENDED and _approach(result) > allowed,
    )
    return [name for name, wrong in zip(FAULTS, found, strict=False) if wrong]


def _comes_too_late(result: sb.Result) -> bool:
    """Return whether the clock cannot tell a contact's parts apart: stated to be invalid."""
    speed = result.drop.reference_speed
    masses = [ball.mass for ball in result.drop.balls]
    for i, law in enumerate(result.drop.contacts):
        if law is not None and not law.rigid:
            p, energy = law.exponent, 0.5 * min(masses[max(i - 1, 0) : i + 1]) * speed**2
            compression = ((p + 1.0) * energy / law.stiffness) ** (1.0 / (p + 1.0))
            if _EPSILON * result.end_time * speed > _SHORT * compression:
                return True
    return False


def _rise(result: sb.Result, stops: np.ndarray) -> float:
    """Return the largest rise of the energy over its size; of the kinetic one where that is all."""
    if not (result.drop.gravity or stops.any()) or not 0.0 < result.end_time < np.inf:
        return result.energy_retained - 1.0
    motion = result.sample([0.0, *(stops[stops > 0.0] * result.end_time), result.end_time])
    mass = np.array([ball.mass for ball in result.drop.balls])
    heights = mass @ np.abs(motion.position.values) * result.drop.gravity
    energy = motion.energy.values
    return float(np.max(np.diff(energy)) / (energy[0] + heights.max()))


def _shake(result: sb.Result) -> float:
    """Return the change of the momentum over its size, where nothing acts from outside."""
    if result.drop.contacts[0] is not None or result.drop.gravity:
        return 0.0
    mass = np.array([ball.mass for ball in result.drop.balls])
    before, after = np.array(result.drop.start_velocities), result.rebound_speeds
    return float(abs(mass @ (after - before)) / (mass @ np.maximum(abs(before), abs(after))))


def _approach(result: sb.Result) -> float:
    """Return the largest rate at which a contact closes at the end, over the largest speed."""
    before, after = np.array(result.drop.start_velocities), result.rebound_speeds
    rates = np.append(0.0, after[:-1]) - after
    there = [law is not None for law in result.drop.contacts]
    return float(rates[there].max(initial=0.0) / np.abs([before, after]).max())


def _by_contact(result: sb.Result) -> Iterator[tuple[list[float], np.ndarray]]:
    """Yield the kinds and the times of each contact's events, in the order of the log."""
    log = np.reshape(result.log, (-1, codes.LOG_COLUMNS))
    for i in range(len(result.drop.balls)):
        own = log[(log[:, codes.CONTACT] == i) & (log[:, codes.KIND] != codes.JOINED)]
        yield own[:, codes.KIND].tolist(), own[:, codes.TIME]


def _alternate(kinds: list[float]) -> bool:
    expected = [codes.TOUCH, codes.RELEASE] * len(kinds)
    return codes.COLLISION in kinds or kinds == expected[: len(kinds)]
