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
_PLACE = re.compile(
    r"(?i)(pos|heigh|höhe|altu|altit|haut|alte|level|niveau).*(?<!x)$"
    r"|^[pc]?[yz](_?pix\w*)?$|[ _][yz]$|^h$"
)
_NAMELESS = re.compile(r"column \d+")
_LONGEST_FRAME = 0.2  # s, the step of a video
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
    hint = _hint(columns)
    kinds = ", ".join(name for name in KINDS if name not in ("table", "track" if hint else ""))
    if hint is None:
        tell = OptionHint({"holds": None, "names": None})
        return Message(f"{said}If it is one of {kinds}: ", tell, " tell so")
    return Message(f"{said}For times and heights of a ball: ", hint, f"; other kinds: {kinds}")


def _hint(columns: Sequence[Any]) -> OptionHint | None:
    """Return the options of a track, where names, units and times leave one possible."""
    clock = next(filter(_is_clock, columns), None)
    lengths = [c for c in columns if c.attrs["units"] in ("m", "px") or _is_bare(c)]
    where = _NAMELESS if len(columns) == 2 and _NAMELESS.fullmatch(_name(columns[1])) else _PLACE
    places = [c for c in lengths if c is not clock and where.search(_name(c))]
    if clock is None or not places or len(clock) <= _FEWEST_STEPS:
        return None
    names = {clock.attrs["column"]: "time", places[0].attrs["column"]: "y"}
    return OptionHint({"holds": "track", "names": names})


def _is_clock(column: Any) -> bool:
    """Return whether a column can be times: it rises, and its name, unit or steps say so."""
    steps = np.diff(column.values)
    if column.name == "frame":
        return bool((steps >= 0.0).all())
    even = np.ptp(steps) < np.median(steps) if len(steps) else False
    told = column.attrs["units"] == "s" or _is_bare(column)
    return bool(told and even and np.median(steps) <= _LONGEST_FRAME)


def _name(column: Any) -> str:
    """Return the name of a column without its unit."""
    return str(re.split(r"\s*[(\[/]", column.attrs["long_name"])[0])


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
