"""Measurement files -> parameters with uncertainties.

============= ================================================================
reading/      files -> Dataset
kinds/        a folder for each kind of measurement: analysis, result, notes
kind          the record of a kind; `kinds.KINDS` lists all
finding       the shape that all results share
options       the table of options, for all user interfaces
option_values texts from a user interface -> values that the analyses take
setup         what is known of ball and drop besides the file, from the options
measurement   the right analysis for what a file holds; a file or typed numbers with the results
drag          the drag of the air in measured flights
constants     contact time, restitution or results -> stiffness, law, a ball to drop
messages      texts with options that they recommend, worded for each user interface
quantities    numbers with errors, and those of a function of them; a row of a table
samples       columns of a Dataset or arrays, runs, rounding, areas
statistics/   regression, AR noise
============= ================================================================
"""

from importlib import import_module
from typing import Any

from stackbounce.extras import MEASURING, need

# Each name is imported when it is first used: the command line's help needs only the options.
# Checkers of types read `__init__.pyi`.
_MODULES = {
    "measurement": "analyse", "constants": "dynamic_stiffness law_constants one_ball one_law",
    "drag": "Drag", "kinds.acceleration.analysis": "accelerometer",
    "kinds.bounces.analysis": "bounces", "kinds.heights.analysis": "heights",
    "kinds.press.analysis": "press", "kinds.press.series": "split_series",
    "kinds.sound.analysis": "knocks", "kinds.track.analysis": "track", "reading": "read",
    "kinds.waveform.analysis": "waveform", "kinds.waveform.gap": "gap_from_delay sensor_gap",
}  # fmt: skip
_HOMES = {name: module for module, names in _MODULES.items() for name in names.split()}
__all__ = list(_HOMES)


def __getattr__(name: str) -> Any:
    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    need(f"stackbounce.measure.{name}", *MEASURING)
    value = getattr(import_module(f"{__name__}.{_HOMES[name]}"), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
