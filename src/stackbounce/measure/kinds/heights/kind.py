"""Heights of bounces as a kind of measurement: a table's column, or typed."""

import re
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from stackbounce.errors import InvalidValue
from stackbounce.measure.kinds import KINDS
from stackbounce.measure.kinds.bounces.knocks import SHRINKS
from stackbounce.measure.kinds.heights.analysis import Heights, heights
from stackbounce.measure.messages import Message, OptionHint
from stackbounce.measure.quantities import Array
from stackbounce.measure.setup import Setup

_MANY = 100  # heights of one drop
_LISTED = 6  # columns that are described
_PLACE = re.compile(
    r"(?i)(pos|heigh|höhe|altu|altit|haut|alte|level|niveau).*(?<!x)$"
    r"|^[pc]?[yz](_?pix\w*)?$|[ _][yz]$|^h$"
)
_NAMELESS = re.compile(r"column \d+")
_LONGEST_SAMPLE, _LONGEST_FRAME = 1e-3, 0.2  # s, the steps of a sensor and of a video
_FEWEST_STEPS = 10  # of a track that has a fall and a bounce


def analyse(data: Any, setup: Setup) -> Heights:
    """Analyse a table with one column of heights, the drop height above those of the bounces."""
    if "y" not in data or {"kg", "N"} & {
        column.attrs.get("units") for column in data.data_vars.values()
    }:
        raise InvalidValue(_unrecognised(data))
    column = data["y"].values.tolist()
    if not setup.repeated:
        _check_fall(column)
    return of_numbers(replace(setup, heights=column))


def of_numbers(setup: Setup) -> Heights:
    """Return the restitutions that heights tell."""
    drop_height, *bounce_heights = setup.heights
    known = setup.only("diameter", "measured_to", "height_error", "repeated", "drag")
    return heights(drop_height, bounce_heights, **known)


def _check_fall(heights: list[float]) -> None:
    """Refuse a column in which heights rise, but for that of a stack's upper ball."""
    rises = [k for k in range(1, len(heights)) if heights[k] > heights[k - 1]]
    if len(heights) > _MANY or [k for k in rises if k > 1]:
        at = max(rises, default=0)
        rise = f", {heights[at]:.4g} m after {heights[at - 1]:.4g} m in row {at + 1}" * bool(rises)
        wrong = (
            "a table of heights must hold those of one ball's bounces, each below the one "
            f"before and up to {_MANY} of them, got {len(heights)} heights{rise}: positions "
            "over time are a track, "
        )
        track, repeated = OptionHint({"holds": "track"}), OptionHint({"repeated": None})
        raise InvalidValue(Message(wrong, track, ", and drops that are repeated need ", repeated))


def _unrecognised(data: Any) -> Message:
    """Return why a table cannot be analysed: its columns, their first numbers, and what to type."""
    columns = list(data.data_vars.values())
    described = ", ".join(map(_described, columns[:_LISTED]))
    more = f" and {len(columns) - _LISTED} more" if len(columns) > _LISTED else ""
    said = f"its columns do not tell a kind of measurement: {described}{more}. "
    what, hint = _hint(data, columns)
    kinds = ", ".join(name for name in KINDS if name not in (what, "table"))
    if hint is None:
        tell = OptionHint({"holds": None, "names": None})
        return Message(f"{said}If it is one of {kinds}: ", tell, " tell so")
    told = f"{said}For times {'and heights ' * (what == 'track')}of a ball: "
    return Message(told, hint, f"; other kinds: {kinds}")


def _hint(data: Any, columns: Sequence[Any]) -> tuple[str, OptionHint | None]:
    """Return the kind and the call that names, units and times leave possible, if there is one."""
    clock = next(filter(_is_clock, sorted(columns, key=_is_bare)), None)
    if clock is None:
        return "", None
    steps = np.diff(clock.values)
    in_seconds = clock.attrs["units"] == "s"
    slow = in_seconds and np.median(steps) > _LONGEST_FRAME
    others = [c for c in columns if c is not clock]
    lengths = [c for c in others if c.attrs["units"] in ("m", "px") or _is_bare(c)]
    places = [c for c in lengths if _PLACE.search(re.split(r"\s*[(\[/]", c.attrs["long_name"])[0])]
    if not places and len(others) == 1 and np.median(steps) > _LONGEST_SAMPLE:
        places = [c for c in lengths if c.units or _NAMELESS.fullmatch(c.long_name)]
    if (in_seconds or clock.name == "time") and not places and len(others) < 2 and _faster(steps):
        what, names = "knocks", {clock.attrs["column"]: "knock_time"}
    elif places and not slow and len(steps) >= _FEWEST_STEPS:
        what, names = "track", {clock.attrs["column"]: "time"}
        names |= {place.attrs["column"]: "y" for place in places}
    else:
        return "", None
    return what, OptionHint({"holds": what, "names": names}, str(data.attrs.get("source", "FILE")))


def _is_clock(column: Any) -> bool:
    """Return whether a column can be times: it rises, and its name, unit or steps say so."""
    steps = np.diff(column.values)
    if not ((steps >= 0.0).all() and steps.any()):
        return False
    told = column.attrs["units"] == "s" or column.name in ("time", "frame")
    return told or (_is_bare(column) and np.ptp(steps) < np.median(steps) <= _LONGEST_FRAME)


def _faster(steps: Array) -> bool:
    """Return whether intervals are those of a ball, whose bounces come faster and faster."""
    if not 1 < len(steps) < _MANY or not np.ptp(steps) > np.min(steps) > 0.0:
        return False
    return bool((steps[1:] < SHRINKS[1] * steps[:-1]).all())


def _is_bare(column: Any) -> bool:
    """Return whether a column has no unit, not even one that is unknown."""
    return not (column.attrs["units"] or column.attrs["unit_in_file"])


def _described(column: Any) -> str:
    """Return the name of a column, or its number, and its first numbers."""
    values = np.asarray(column.values, dtype=np.float64).ravel()
    first = ", ".join(f"{value:.5g}" for value in values[np.isfinite(values)][:3])
    name = str(column.attrs.get("long_name", column.name))
    shown = name if _NAMELESS.fullmatch(name) else f"{name[:40]!r}"
    return f"{shown} ({first})"
