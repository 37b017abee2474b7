"""Heights of bounces as a kind of measurement: a table's column, or typed."""

import re
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from stackbounce.errors import InvalidValue
from stackbounce.measure.kinds import KINDS
from stackbounce.measure.kinds.heights.analysis import Heights, heights
from stackbounce.measure.messages import Message, OptionHint
from stackbounce.measure.setup import Setup

_MANY = 100  # heights of one drop
_LISTED = 6  # columns that are described
_PLACE = re.compile(r"(?i)(pos|heigh|höhe|altu|altit|haut|alte).*(?<!x)$|^[pc]?[yz]$|[ _][yz]$|^h$")


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
    return heights(
        drop_height,
        bounce_heights,
        diameter=setup.diameter,
        measured_to=setup.measured_to,
        height_error=setup.height_error,
        repeated=setup.repeated,
        drag=setup.drag,
    )


def _check_fall(heights: list[float]) -> None:
    """Refuse a column in which heights rise, but for that of a stack's upper ball."""
    rises = [k for k in range(1, len(heights)) if heights[k] > heights[k - 1]]
    if len(heights) > _MANY or [k for k in rises if k > 1]:
        at = max(rises, default=0)
        rise = f", {heights[at]:.4g} m after {heights[at - 1]:.4g} m in row {at + 1}" * bool(rises)
        raise InvalidValue(
            Message(
                "a table of heights must hold those of one ball's bounces, each below the one "
                f"before and up to {_MANY} of them, got {len(heights)} heights{rise}: positions "
                "over time are a track, ",
                OptionHint({"holds": "track"}),
                ", and drops that are repeated need ",
                OptionHint({"repeated": None}),
            )
        )


def _unrecognised(data: Any) -> Message:
    """Return why a table cannot be analysed: its columns, their first numbers, and what to type."""
    columns = list(data.data_vars.values())
    described = ", ".join(map(_described, columns[:_LISTED]))
    more = f" and {len(columns) - _LISTED} more" if len(columns) > _LISTED else ""
    said = f"its columns do not tell a kind of measurement: {described}{more}. "
    what, hint = _hint(data, columns)
    if hint is None:
        kinds = ", ".join(name for name in KINDS if name not in ("bounces", "table"))
        hint = OptionHint({"holds": None, "names": None})
        return Message(f"{said}If it is one of {kinds}: ", hint, " tell so")
    others = ", ".join(name for name in KINDS if name not in (what, "bounces", "table"))
    return Message(
        f"{said}For times{' and heights' * (what == 'track')} of a ball: ",
        hint,
        f"; other kinds: {others}",
    )


def _hint(data: Any, columns: Sequence[Any]) -> tuple[str, OptionHint | None]:
    """Return the kind and the call that names and units leave possible, if there is one."""
    bare = [c for c in columns if not (c.attrs["units"] or c.attrs["unit_in_file"])]
    unitless = [c.name for c in bare]
    times = [c for c in columns if c.name == "time" or c.attrs.get("units") == "s"]
    times += [c for c in bare if (np.diff(c.values) > 0.0).all()]
    if not times:
        return "", None
    clock = times[0]
    others = [c for c in columns if c is not clock]
    lengths = [c for c in others if c.attrs.get("units") in ("m", "px") or c.name in unitless]
    places = [c for c in lengths if _PLACE.search(re.split(r"\s*[(\[/]", c.attrs["long_name"])[0])]
    steps = np.diff(clock.values)
    uneven = 1 < len(steps) < _MANY and np.ptp(steps) > np.min(steps) > 0.0
    if uneven and not places and len(others) < 2:
        what, names = "knocks", {clock.attrs["column"]: "knock_time"}
    elif places or len(lengths) == len(others) == 1:
        place = (places or lengths)[0]
        what, names = "track", {clock.attrs["column"]: "time", place.attrs["column"]: "y"}
    else:
        return "", None
    file = str(data.attrs.get("source", "FILE"))
    return what, OptionHint({"holds": what, "names": names}, file)


def _described(column: Any) -> str:
    """Return the name of a column, or its number, and its first numbers."""
    values = np.asarray(column.values, dtype=np.float64).ravel()
    first = ", ".join(f"{value:.5g}" for value in values[np.isfinite(values)][:3])
    name = str(column.attrs.get("long_name", column.name))
    shown = name if re.fullmatch(r"column \d+", name) else f"{name[:40]!r}"
    return f"{shown} ({first})"
