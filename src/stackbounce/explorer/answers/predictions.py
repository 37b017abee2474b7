"""Drops whose numbers have errors: results with errors, and bands of curves."""

from collections.abc import Mapping

import numpy as np

from stackbounce.explorer.limits import LIMITS, RTOL
from stackbounce.json_values import as_json
from stackbounce.model import Drop
from stackbounce.plots.impact import choose_window
from stackbounce.prediction import predict
from stackbounce.prediction.inputs import add_value
from stackbounce.run.driver import simulate
from stackbounce.run.quantities import Array
from stackbounce.run.result import STOPPED, Result
from stackbounce.version import __version__

_INTERVALS = 60  # most contact intervals that get times of their own
_TIMES = 300  # of a band
_DRAWS = 300  # where derivatives do not do: each is a run, for its curves


def run_drop(drop: Drop, until: float | None) -> Result:
    """Return the result of a drop within the limits of a request."""
    return simulate(drop, until=until, rtol=RTOL, event_limit=LIMITS.events)


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
    known = add_values(drop, errors)
    found = predict(drop, known, until=until, rtol=RTOL, event_limit=LIMITS.events, draws=_DRAWS)
    times = _choose_times(found.result, until)
    names = ["position"] if drop.rigid else ["position", "force"]  # a rigid contact's is infinite
    answer = found.as_dict()
    del answer["shares"]
    bands = {name: found.band(times, name) for name in names}
    return as_json({"stackbounce": __version__, **answer, "band": {"time": times, **bands}})


def _choose_times(result: Result, until: float | None) -> Array:
    """Return times in s from the first touch on: even ones, and the starts and ends of contacts."""
    _, end = choose_window(result)
    spans, even, each = result.intervals[:_INTERVALS], _TIMES, 2
    if until is not None:
        end = min(until, result.end_time) if result.status in STOPPED else until
        even //= 2  # the other half samples the contacts, which are short
        each = max(8, even // max(1, len(spans)))
    times = [np.linspace(0.0, end, even)]
    times += [np.linspace(span["start"], min(span["end"], end), each) for span in spans]
    every: Array = np.unique(np.concatenate(times))
    return every[(every >= 0.0) & (every <= end)]


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
