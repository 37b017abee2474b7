"""What analyses make of synthetic measurements: values and errors for some seeds of each case.

The imports below are all that has to follow when modules move.
"""

from collections.abc import Callable, Iterable
from typing import Any

from benchmarks.coverage import (
    accelerometer,
    fit,
    floor_gap,
    heights,
    press,
    sound,
    stiffness,
    track,
    waveform,
)

KINDS = {
    "acceleration": accelerometer.CASES,
    "fit": fit.CASES,
    "floor gap": floor_gap.CASES,
    "heights": heights.CASES,
    "press": press.CASES,
    "sound": sound.CASES,
    "stiffness": stiffness.CASES,
    "track": track.CASES,
    "waveform": waveform.CASES | {f"limit: {name}": one for name, one in waveform.LIMITS.items()},
}
SEEDS = range(5)
FEWER = {"fit": range(2), "floor gap": range(2)}  # each takes a second or so
ALONE = {"fit": {"whole": False}}  # errors without intervals and draws


def answers() -> dict[str, Any]:
    """Return value and error of each quantity, by kind, case and seed."""
    return {
        kind: {name: _seeds(kind, trial) for name, trial in cases.items()}
        for kind, cases in KINDS.items()
    }


def _seeds(kind: str, trial: Callable[..., Any]) -> dict[str, Any]:
    seeds: Iterable[int] = FEWER.get(kind, SEEDS)
    return {str(seed): _quantities(trial(seed, **ALONE.get(kind, {}))) for seed in seeds}


def _quantities(found: Iterable[tuple[str, Any, float]]) -> dict[str, Any]:
    """Return the estimate, its error, and the truth of each quantity."""
    return {
        name: {"value": one.nominal_value, "error": one.std_dev, "truth": truth}
        for name, one, truth in found
    }
