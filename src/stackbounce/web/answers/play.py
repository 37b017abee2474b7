"""A drop: where everything is at each moment, and the textbook's separate collisions beside it."""

import dataclasses
import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from stackbounce.calibration import separate
from stackbounce.errors import StackbounceError
from stackbounce.json_values import as_json
from stackbounce.model import STANDARD_GRAVITY, Drop
from stackbounce.plots.impact_window import choose_window, sample_with_approach
from stackbounce.run.driver import simulate
from stackbounce.run.result import Result
from stackbounce.version import __version__
from stackbounce.web.answers.compile_all import prepared

__all__ = ["ran", "simulation"]

_Times = NDArray[np.float64]

_INTERVALS = 60  # contact intervals that have frames of their own, at most
_RTOL = 1e-10
_DIGITS = 9  # of a frame's largest number


def ran(drop: Drop, until: float | None, events: int) -> Result:
    """Return the result of a drop, by compiled kernels if this process has them already."""
    swift = True if prepared() else None
    return simulate(drop, until=until, rtol=_RTOL, event_limit=events, compiled=swift)


def simulation(drop: Drop, until: float | None, frames: int, events: int) -> str:
    """Return, as JSON, what happens to a drop, moment by moment.

    Parameters
    ----------
    drop : Drop
        What is dropped.
    until : float or None
        In s: the whole story up to then, not the impact alone.
    frames : int
        How many times to look, and a few more at the beginnings and ends of contacts.
    events : int
        The limit of events.

    Returns
    -------
    str
        JSON with what `Result.to_mapping` has, `rebound_heights` in m, `intervals`, `frames` (SI,
        a list per ball or contact) and `separate`, the same drop by separate collisions.
    """
    result = ran(drop, until, events)
    times = _times(result, until, frames)
    answer = {
        "stackbounce": __version__,
        "drop": drop.to_mapping(),
        "reference_speed": drop.reference_speed,
        **_numbers(result),
        "intervals": result.intervals,
        "impact": [0.0, _last_release(result)],
        "frames": _frames(result, times),
        "separate": None if drop.rigid else _separate(drop, until, times, events),
    }
    return as_json(answer)


def _numbers(result: Result) -> dict[str, Any]:
    speeds = result.rebound_speeds
    heights = speeds * np.abs(speeds) / (2.0 * STANDARD_GRAVITY)
    return result.to_mapping() | {"rebound_heights": heights}


def _last_release(result: Result) -> float:
    ends = result.intervals["end"]
    return float(max([0.0, *ends[np.isfinite(ends)]]))


def _times(result: Result, until: float | None, frames: int) -> _Times:
    """Return times in s, ascending: evenly spread, and where contacts begin and end."""
    begin, end = choose_window(result)
    drop = result.drop
    if until is not None:
        end = min(until, result.end_time) if _stopped(result) else until
        if drop.gravity > 0.0 and drop.velocities is None:
            begin = -drop.reference_speed / drop.gravity  # from rest
        frames //= 2  # the other half goes to the contacts, which are short
    times = [np.linspace(begin, end, frames), np.zeros(1)]
    spans = result.intervals[:_INTERVALS]
    each = max(8, frames // max(1, len(spans))) if until is not None else 2
    times += [np.linspace(one["start"], min(one["end"], end), each) for one in spans]
    every: _Times = np.unique(np.concatenate(times))
    return every[(every >= begin) & (every <= end)]


def _stopped(result: Result) -> bool:
    return result.status.name in ("TIME_REACHED", "EVENT_LIMIT", "INVALID")


def _frames(result: Result, times: _Times) -> dict[str, Any]:
    sample = sample_with_approach(result, times)
    mass = np.array([ball.mass for ball in result.drop.balls])[:, None]
    kinetic = 0.5 * mass * sample.velocity.values**2
    potential = np.sum(mass * result.drop.gravity * sample.position.values, axis=0)
    total = sample.energy.values  # the same on the way down
    stored = np.maximum(total - np.sum(kinetic, axis=0) - potential, 0.0)
    energy = {"kinetic": kinetic, "stored": stored, "potential": potential, "total": total}
    names = ("position", "velocity", "force", "compression")
    return {
        "time": times,
        **{name: _short(sample[name].values) for name in names},
        "energy": {name: _short(values) for name, values in energy.items()},
    }


def _short(values: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return values without digits that no picture shows, which halves the answer."""
    largest = float(np.max(np.abs(values), initial=0.0))
    if not 1e-200 < largest < 1e200:
        return values
    return np.round(values, _DIGITS - 1 - math.floor(math.log10(largest)))


def _separate(drop: Drop, until: float | None, times: _Times, events: int) -> dict[str, Any] | None:
    """Return the textbook's version at the same times; None where there is none."""
    try:
        textbook = separate(drop)
        if until is not None:  # the whole story has flights
            textbook = dataclasses.replace(textbook, gravity=drop.gravity)
        result = ran(textbook, until, events)
        reached = result.end_time if _stopped(result) else math.inf
        place = sample_with_approach(result, np.minimum(times, reached)).position.values
    except StackbounceError as error:
        return {"error": str(error)}
    laws = textbook.contacts
    return _numbers(result) | {
        "restitutions": [None if one is None else one.restitution for one in laws],
        "position": _short(place),
    }
