"""Output for machines: JSON with the API's names, in SI units; null for what is not finite."""

import dataclasses
import json
import math
from pathlib import Path
from typing import Any

import numpy as np

from stackbounce.cli.scenario import Scenario
from stackbounce.model.catalogue import BALLS, PAIRS
from stackbounce.result import Result
from stackbounce.version import __version__

__all__ = ["catalogue", "simulation", "text"]


def text(value: object) -> str:
    """Return `value` as JSON, indented.

    Parameters
    ----------
    value : object
        Dicts, lists, dataclasses, arrays, strings and numbers.

    Returns
    -------
    str

    Examples
    --------
    >>> print(text({"peak_force": float("inf")}))
    {
      "peak_force": null
    }
    """
    return json.dumps(_plain(value), indent=2, ensure_ascii=False, allow_nan=False)


def simulation(scenario: Scenario, result: Result, textbook: Result | None) -> dict[str, object]:
    """Return what ``stackbounce simulate --json`` prints."""
    return {
        "stackbounce": __version__,
        "drop": scenario.drop.to_mapping(),
        "contact_sources": scenario.contact_sources,
        "gap_sources": scenario.gap_sources,
        "reference_speed": scenario.drop.reference_speed,
        **_outcome(result),
        "intervals": result.intervals,
        "apexes": result.apexes,
        "separate": None if textbook is None else _outcome(textbook),
    }


def catalogue() -> dict[str, object]:
    """Return what ``stackbounce balls --json`` prints."""
    rows = [
        dataclasses.asdict(entry.ball)
        | dataclasses.asdict(entry)
        | {"sources": dict(entry.sources)}
        for entry in BALLS
    ]
    for row in rows:
        del row["ball"]
    return {"stackbounce": __version__, "balls": rows, "pairs": PAIRS}


def _outcome(result: Result) -> dict[str, object]:
    return {
        "status": result.status.name,
        "advice": result.status.advice,
        "rebound_speeds": result.rebound_speeds,
        "rebound_ratios": result.rebound_ratios,
        "collisions": result.collisions,
        "first_touch": result.first_touch,
        "last_release": result.last_release,
        "energy_retained": result.energy_retained,
        "end_time": result.end_time,
    }


def _plain(value: Any) -> Any:
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        return _plain({one.name: getattr(value, one.name) for one in dataclasses.fields(value)})
    if isinstance(value, dict):
        return {str(key): _plain(one) for key, one in value.items()}
    if isinstance(value, np.ndarray) and value.dtype.names:
        return [{name: _plain(row[name]) for name in value.dtype.names} for row in value]
    if isinstance(value, np.ndarray | np.generic):
        return _plain(value.tolist())
    if isinstance(value, list | tuple):
        return [_plain(one) for one in value]
    if isinstance(value, Path):
        return str(value)
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value
