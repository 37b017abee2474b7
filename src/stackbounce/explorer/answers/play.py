"""The motion of a drop at each moment, and the textbook's separate collisions beside it.

Of a drop whose numbers have errors: numbers with errors, and bands of curves.
"""

import dataclasses
import math
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from stackbounce.errors import InvalidValue, StackbounceError
from stackbounce.explorer.limits import LIMITS, RTOL
from stackbounce.json_values import as_json
from stackbounce.model import STANDARD_GRAVITY, Drop
from stackbounce.plots.impact import choose_window, sample_with_approach
from stackbounce.prediction import predict
from stackbounce.prediction.inputs import add_value
from stackbounce.run.collision import separate
from stackbounce.run.driver import simulate
from stackbounce.run.result import Result
from stackbounce.version import __version__

_Times = NDArray[np.float64]

_INTERVALS = 60  # most contact intervals that get frames of their own
_DIGITS = 9  # of a frame's largest number
_TIMES = 300  # of a band
_DRAWS = 300  # where derivatives do not do: each is a run, for its curves


def run_drop(drop: Drop, until: float | None) -> Result:
    """Return the result of a drop within the limits of a request."""
    return simulate(drop, until=until, rtol=RTOL, event_limit=LIMITS.events)


def play_drop(drop: Drop, until: float | None, frames: int) -> str:
    """Drop a stack of balls; return its motion at each moment, as JSON.

    Parameters
    ----------
    drop : Drop
        The drop to simulate.
    until : float or None
        End of the run in s, with falls and flights; None for the impact alone.
    frames : int
        Number of sample times; the starts and ends of contacts are added.

    Returns
    -------
    str
        JSON with what `Result.to_mapping` has, `rebound_heights` in m, `intervals`, `frames` (SI,
        a list per ball or contact) and `separate`, the same drop by separate collisions.
    """
    result = run_drop(drop, until)
    times = choose_times(result, until, frames)
    ends = result.intervals["end"]
    answer = {
        "stackbounce": __version__,
        "drop": drop.to_mapping(),
        "reference_speed": drop.reference_speed,
        **_list_numbers(result),
        "intervals": result.intervals,
        "impact": [0.0, max(ends[np.isfinite(ends)], default=0.0)],
        "frames": _sample_frames(result, times),
        "separate": None if drop.rigid else _play_separate(drop, until, times),
    }
    return as_json(answer)


def _list_numbers(result: Result) -> dict[str, Any]:
    speeds = result.rebound_speeds
    heights = speeds * np.abs(speeds) / (2.0 * STANDARD_GRAVITY)
    return result.to_mapping() | {"rebound_heights": heights}


def choose_times(result: Result, until: float | None, frames: int) -> _Times:
    """Return ascending times in s: evenly spaced, and the starts and ends of contacts."""
    begin, end = choose_window(result)
    drop = result.drop
    if until is not None:
        end = min(until, result.end_time) if _is_unfinished(result) else until
        if drop.gravity > 0.0 and drop.velocities is None:
            begin = -drop.reference_speed / drop.gravity  # from rest
        frames //= 2  # the other half samples the contacts, which are short
    times = [np.linspace(begin, end, frames), np.zeros(1)]
    spans = result.intervals[:_INTERVALS]
    each = max(8, frames // max(1, len(spans))) if until is not None else 2
    times += [np.linspace(span["start"], min(span["end"], end), each) for span in spans]
    every: _Times = np.unique(np.concatenate(times))
    return every[(every >= begin) & (every <= end)]


def _is_unfinished(result: Result) -> bool:
    return result.status.name in ("TIME_REACHED", "EVENT_LIMIT", "INVALID")


def _sample_frames(result: Result, times: _Times) -> dict[str, Any]:
    sample = sample_with_approach(result, times)
    mass = np.array([ball.mass for ball in result.drop.balls])[:, None]
    kinetic = 0.5 * mass * sample["velocity"] ** 2
    potential = np.sum(mass * result.drop.gravity * sample["position"], axis=0)
    total = sample["energy"]  # the same on the way down
    stored = np.maximum(total - np.sum(kinetic, axis=0) - potential, 0.0)
    energy = {"kinetic": kinetic, "stored": stored, "potential": potential, "total": total}
    names = ("position", "velocity", "force", "compression")
    return {
        "time": times,
        **{name: _round(sample[name]) for name in names},
        "energy": {name: _round(values) for name, values in energy.items()},
    }


def _round(values: NDArray[np.float64]) -> NDArray[np.float64]:
    """Round values to the digits that a picture can show, which halves the size of the answer."""
    largest = float(np.max(np.abs(values), initial=0.0))
    if not 1e-200 < largest < 1e200:
        return values
    return np.round(values, _DIGITS - 1 - math.floor(math.log10(largest)))


def _play_separate(drop: Drop, until: float | None, times: _Times) -> dict[str, Any] | None:
    """Return the separate collisions of a drop, at the same times."""
    try:
        textbook = separate(drop)
        if until is not None:  # a whole drop has flights
            textbook = dataclasses.replace(textbook, gravity=drop.gravity)
        result = run_drop(textbook, until)
        reached = result.end_time if _is_unfinished(result) else math.inf
        place = sample_with_approach(result, np.minimum(times, reached))["position"]
    except StackbounceError as error:
        return {"error": str(error)}
    laws = textbook.contacts
    return _list_numbers(result) | {
        "restitutions": [None if law is None else law.restitution for law in laws],
        "position": _round(place),
    }


def predict_drop(drop: Drop, errors: Mapping[str, float | str], until: float | None) -> str:
    """Carry the errors of a drop's numbers forward; return numbers and curves with errors, as JSON.

    Parameters
    ----------
    drop : Drop
        The drop, with the values of the numbers.
    errors : mapping
        The errors of some of its numbers by path, in SI units or as texts with a unit.
    until : float or None
        End of the run in s, with falls and flights; None for the impact alone.

    Returns
    -------
    str
        JSON with what `Prediction.as_dict` has but for the shares, and `band`: `time` in s, and the
        lower and the upper ends of one standard deviation of `position` and `force`.
    """
    if not 0 < len(errors) <= LIMITS.varied:
        raise InvalidValue(f"errors must be of 1 to {LIMITS.varied} numbers, got {len(errors)}")
    found = predict(
        drop,
        add_values(drop, errors),
        until=until,
        rtol=RTOL,
        event_limit=LIMITS.events,
        draws=_DRAWS,
    )
    times = choose_times(found.result, until, _TIMES)
    times = times[times >= 0.0]
    names = ["position"] if drop.rigid else ["position", "force"]  # a rigid contact's is infinite
    answer = found.as_dict()
    del answer["shares"]
    bands = {name: found.band(times, name) for name in names}
    return as_json({"stackbounce": __version__, **answer, "band": {"time": times, **bands}})


def add_values(drop: Drop, errors: Mapping[str, float | str]) -> dict[str, tuple[float, float]]:
    """Return numbers of a drop with their errors by path, in SI units; see `predict_drop`.

    Examples
    --------
    >>> import stackbounce as sb
    >>> drop = sb.Drop([sb.Ball(0.057)], [sb.Spring(2e4)], height=0.63)
    >>> add_values(drop, {"height": "1 cm"})
    {'height': (0.63, 0.01)}
    """
    return {
        path: add_value(drop, path, error, f"error of {path}") for path, error in errors.items()
    }
