"""A drop as files: its data, its picture, its scenario, and lines of Python that simulate it."""

import csv
import io
from collections.abc import Mapping
from typing import Any

import numpy as np

from stackbounce.explorer.answers.play import run_drop
from stackbounce.explorer.answers.predictions import add_values
from stackbounce.model import Drop
from stackbounce.plots import bounce
from stackbounce.plots.impact_window import choose_window, sample_with_approach
from stackbounce.plots.style import render
from stackbounce.prediction import write_scenario
from stackbounce.prediction.inputs import read_inputs
from stackbounce.version import __version__

__all__ = ["KINDS", "export_drop"]

KINDS = {
    "csv": "text/csv; charset=utf-8",
    "toml": "application/toml; charset=utf-8",
    "python": "text/x-python; charset=utf-8",
    "svg": "image/svg+xml",
    "png": "image/png",
}
"""Kinds of file, with their media types."""

_SAMPLES = 1001


def export_drop(
    kind: str, drop: Drop, until: float | None, errors: Mapping[str, float | str] | None = None
) -> bytes:
    """Return the content of a file.

    Parameters
    ----------
    kind : str
        One of `KINDS`.
    drop : Drop
        The drop to export.
    until : float or None
        End of the run in s; None ends it when the balls have separated.
    errors : mapping, optional
        The errors of some of its numbers by path, in SI units or as texts with a unit: they are in
        the scenario and in the lines of Python.

    Returns
    -------
    bytes
        The same bytes for the same drop.
    """
    match kind:
        case "toml":
            pairs = _checked(drop, errors or {})
            return (write_scenario(drop, pairs) if pairs else drop.to_toml()).encode()
        case "python":
            return _write_python(drop, until, _checked(drop, errors or {})).encode()
        case "csv":
            return _write_table(drop, until).encode()
    return _draw(kind, drop, until)


def _checked(drop: Drop, errors: Mapping[str, float | str]) -> dict[str, tuple[float, float]]:
    """Return numbers with their errors, which `predict` takes."""
    pairs = add_values(drop, errors)
    if pairs:
        read_inputs(drop, pairs)
    return pairs


def _write_python(
    drop: Drop, until: float | None, errors: Mapping[str, tuple[float, float]]
) -> str:
    """Return lines of Python that simulate a drop, or predict it with its errors, and draw it."""
    balls = ",\n        ".join(_write_call("Ball", ball) for ball in drop.balls)
    contacts = ",\n        ".join("None" if law is None else f"sb.{law!r}" for law in drop.contacts)
    plain = drop.to_mapping()
    rest = [f"{key}={plain[key]!r}" for key in plain if key not in ("balls", "contacts")]
    stop = "" if until is None else f", until={until!r}"
    pairs = [f"    {path!r}: {pair!r}," for path, pair in errors.items()]
    run = [f"result = sb.simulate(drop{stop})"]
    if errors:
        run = ["errors = {", *pairs, "}", f"result = sb.predict(drop, errors{stop})"]
    lines = [
        f"# Made by stackbounce {__version__}",
        "import stackbounce as sb",
        "from stackbounce import plots",
        "",
        "drop = sb.Drop(",
        f"    balls=[\n        {balls},\n    ],",
        f"    contacts=[\n        {contacts},\n    ],",
        *[f"    {one}," for one in rest],
        ")",
        *run,
        'print("rebound ratios:", result.rebound_ratios)',
        'plots.bounce(result).savefig("bounce.svg")',
    ]
    return "\n".join(lines) + "\n"


def _write_call(name: str, value: Any) -> str:
    """Return the Python call that makes a ball, without the fields that are None."""
    given = {key: one for key, one in vars(value).items() if one is not None}
    return f"sb.{name}({', '.join(f'{key}={one!r}' for key, one in given.items())})"


def _write_table(drop: Drop, until: float | None) -> str:
    """Return positions, velocities, forces, compressions and energy over time, as CSV."""
    result = run_drop(drop, until)
    begin, end = choose_window(result)
    times = np.linspace(begin, end, _SAMPLES)
    sample = sample_with_approach(result, times)
    columns: dict[str, Any] = {"time (s)": times}
    for b, path in enumerate(sample.position.values):
        columns[f"position {b} (m)"] = path
    for b, velocity in enumerate(sample.velocity.values):
        columns[f"velocity {b} (m/s)"] = velocity
    for i, force in enumerate(sample.force.values):
        columns[f"force {i} (N)"] = force
    columns["energy (J)"] = sample.energy.values
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerow(columns)
    writer.writerows(zip(*(values.tolist() for values in columns.values()), strict=True))
    return stream.getvalue()


def _draw(kind: str, drop: Drop, until: float | None) -> bytes:
    result = run_drop(drop, until)
    return render(lambda: bounce(result), kind)
