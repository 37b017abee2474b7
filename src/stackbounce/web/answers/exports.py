"""A drop as files: its data, its picture, its scenario, and the lines of Python that make it."""

import csv
import io
from typing import Any

import numpy as np

from stackbounce.errors import InvalidValue
from stackbounce.model import Drop
from stackbounce.plots import bounce
from stackbounce.plots.impact_window import choose_window, sample_with_approach
from stackbounce.version import __version__
from stackbounce.web.answers.play import ran

__all__ = ["KINDS", "exported"]

KINDS = {
    "csv": "text/csv; charset=utf-8",
    "toml": "application/toml; charset=utf-8",
    "python": "text/x-python; charset=utf-8",
    "svg": "image/svg+xml",
    "png": "image/png",
}
"""The kinds of file, and what each is called on the web."""

_SAMPLES = 1001
_DPI = 150


def exported(kind: str, drop: Drop, until: float | None, events: int) -> bytes:
    """Return the content of a file.

    Parameters
    ----------
    kind : str
        One of `KINDS`.
    drop : Drop
        What is dropped.
    until : float or None
        In s: the end of the run, if not the balls' parting.
    events : int
        The limit of events.

    Returns
    -------
    bytes
        The same bytes for the same drop.
    """
    match kind:
        case "toml":
            return drop.to_toml().encode()
        case "python":
            return _python(drop, until).encode()
        case "csv":
            return _table(drop, until, events).encode()
    return _picture(kind, drop, until, events)


def _python(drop: Drop, until: float | None) -> str:
    """Return lines of Python that simulate a drop and draw it."""
    balls = ",\n        ".join(_call("Ball", ball) for ball in drop.balls)
    contacts = ",\n        ".join("None" if law is None else f"sb.{law!r}" for law in drop.contacts)
    plain = drop.to_mapping()
    rest = [f"{key}={plain[key]!r}" for key in plain if key not in ("balls", "contacts")]
    stop = "" if until is None else f", until={until!r}"
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
        f"result = sb.simulate(drop{stop})",
        'print("rebound ratios:", result.rebound_ratios)',
        'plots.bounce(result).savefig("bounce.svg")',
    ]
    return "\n".join(lines) + "\n"


def _call(name: str, value: Any) -> str:
    """Return the Python call that makes a ball, without what it leaves open."""
    given = {key: one for key, one in vars(value).items() if one is not None}
    return f"sb.{name}({', '.join(f'{key}={one!r}' for key, one in given.items())})"


def _table(drop: Drop, until: float | None, events: int) -> str:
    """Return positions, velocities, forces, compressions and energy over time, as CSV."""
    result = ran(drop, until, events)
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


def _picture(kind: str, drop: Drop, until: float | None, events: int) -> bytes:
    import matplotlib as mpl

    from stackbounce.plots.style import STYLE

    if kind not in ("svg", "png"):
        raise InvalidValue(f"kind must be one of {', '.join(KINDS)}, got {kind}")
    figure = bounce(ran(drop, until, events))
    stream = io.BytesIO()
    with mpl.rc_context(STYLE):
        metadata = {"Date": None} if kind == "svg" else None
        figure.savefig(stream, format=kind, dpi=_DPI, metadata=metadata)
    return stream.getvalue()
