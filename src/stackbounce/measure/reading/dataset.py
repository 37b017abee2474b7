"""Columns -> the Dataset of what they hold."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

from stackbounce.errors import FileError, a_or_an
from stackbounce.library_types import Dataset
from stackbounce.measure.kind import Kind
from stackbounce.measure.kinds import KINDS
from stackbounce.measure.messages import Message, OptionHint, about_option
from stackbounce.measure.quantities import Array
from stackbounce.measure.reading.roles import ACCELERATIONS, ARBITRARY, FRAME, ROLES, Column
from stackbounce.measure.reading.series import in_time, on_the_clock
from stackbounce.measure.reading.video import rows_by_frame

_ASSUMED = {"time": "s", "knock_time": "s", "force": "N", "compression": "m", "x": "m", "y": "m"}
_OTHER_UNITS = {"s": "ms", "N": "kN", "m": "cm"}  # examples in doubts
_UNITS = _ASSUMED | {"voltage": "V", "sound": "1"} | dict.fromkeys(ACCELERATIONS, "m/s^2")


def holds_of(columns: Sequence[Column]) -> str:
    """Return the kind of measurement that the roles of columns make."""
    return next((kind.name for kind in KINDS.values() if _fits(kind, columns)), "table")


def _fits(kind: Kind, columns: Sequence[Column]) -> bool:
    if kind.recognised is not None:
        return kind.recognised(columns)
    needed = [
        any(_is(column, what) for column in columns for what in each) for each in kind.columns
    ]
    return bool(needed) and all(needed)


def _is(column: Column, what: str) -> bool:
    """Return whether a column has a role or, where that is none of the reader's, a name."""
    return column.role == what or (what not in _UNITS and column.variable == what)


def assemble(
    holds: str, columns: Sequence[Column], values: Array, run: object
) -> tuple[Dataset, list[str]]:
    """Return the Dataset of columns, without its attributes, and what is unsure.

    Parameters
    ----------
    holds : str
        What it is to hold, one of `stackbounce.measure.kinds.KINDS`.
    columns : sequence of Column
        What they are.
    values : numpy.ndarray, shape (rows, columns)
        Their numbers, as in the file.
    run : object
        The run that is wanted, where there are several below each other.

    Raises
    ------
    InvalidValue
        If the columns cannot hold that.
    FileError
        If there is no row of it.
    """
    if holds == "knocks" and len(columns) > 1 and {c.role for c in columns} == {"knock_time"}:
        data, coordinates, doubts = _bounces(values)
        return dataset_of(data, coordinates), doubts
    kind = KINDS[holds]
    # An analysis takes the first of several forces: one that an option names comes before others.
    normal = _normal_force(columns, values)
    order = sorted(range(len(columns)), key=lambda k: (columns[k].named not in ROLES, k != normal))
    columns, values = [columns[k] for k in order], values[:, order]
    over_time = {"time": _series, "track": _track}.get(kind.dimension)
    build = over_time or partial(_rows, kind)
    columns, unsure = on_the_clock(kind, _fitting(holds, columns), values)
    doubts = [column.doubt for column in columns if column.doubt] + unsure
    columns = _assumed(columns, doubts)
    clock = _at(columns, "time") if over_time else -1  # left as written: its digits tell
    for k, column in enumerate(columns):
        if column.factor != 1.0 and k != clock:
            values[:, k] *= column.factor
    data, coordinates, more = build(columns, values, run)
    return dataset_of(data, coordinates), doubts + more


def dataset_of(data: Mapping[str, Any], coordinates: Mapping[str, Any]) -> Dataset:
    """Return arrays of numpy as a Dataset, for which xarray imports neither dask nor pint.

    It imports them to see if an array is theirs, unless that is an index or takes the fast path.

    Examples
    --------
    >>> times = ("time", np.array([0.0, 0.1]), {"units": "s"})
    >>> dataset_of({"force": ("time", np.zeros(2))}, {"time": times}).force.dims
    ('time',)
    """
    import pandas as pd
    import xarray as xr

    return xr.Dataset(
        {
            name: xr.Variable(own[0], own[1], dict(*own[2:]), fastpath=True)
            for name, own in data.items()
        },
        {
            name: own if isinstance(own, list) else (own[0], pd.Index(own[1]), own[2])
            for name, own in coordinates.items()
        },
    )


def _normal_force(columns: Sequence[Column], values: Array) -> int:
    """Return the largest of the three components of a force: no friction exceeds it; else -1."""
    parts = [k for k, column in enumerate(columns) if column.role == "force"]
    if "".join(columns[k].heading.name[-1:].lower() for k in parts) != "xyz":
        return -1
    return max(parts, key=lambda k: float(np.nanmax(np.abs(values[:, k]))))


def _fitting(holds: str, columns: Sequence[Column]) -> list[Column]:
    """Assign each missing role that the kind needs to a column with the right unit or none."""
    found = list(columns)
    taken: set[int] = set()
    missing = []
    for roles in KINDS[holds].columns:
        fit = [k for k, column in enumerate(found) if any(_is(column, role) for role in roles)]
        taken.update(fit[:1])
        missing += [] if fit else [roles]
    for roles in missing:
        wanted = _UNITS.get(roles[0], "")
        fits = ("", wanted, "V") if roles[0] == "sound" else ("", wanted)
        free = [k for k, c in enumerate(found) if k not in taken and _could(c, fits)]
        free.sort(key=lambda k: found[k].unit != wanted)
        if not free:
            needs = " and ".join(" or ".join(roles) for roles in KINDS[holds].columns)
            names = ", ".join(map(_name, found[:20]))
            said = f": {a_or_an(holds)} needs columns of {needs}; it has {names}: by their units "
            raise about_option("holds", f"{said}none of them is {' or '.join(roles)}")
        taken.add(free[0])
        same = [_name(found[k]) for k in free if found[k].unit == wanted]
        found[free[0]] = replace(found[free[0]], role=roles[0], named="")
        if same[1:]:
            doubt = f"{same[0]} is taken as {roles[0]}, not {', '.join(same[1:])}"
            found[free[0]] = replace(found[free[0]], doubt=doubt)
    return found


def _could(column: Column, units: Sequence[str]) -> bool:
    """Return whether the unit of a column, if it has one, is one of some SI units."""
    return column.unit in units and bool(column.unit or column.heading.unit in ("", *ARBITRARY))


def _assumed(columns: list[Column], doubts: list[str]) -> list[Column]:
    """Return columns; those in a role of `_ASSUMED` without a unit are assumed to be in SI."""
    untold = [column for column in columns if not (column.unit or column.heading.unit)]
    bare = [column for column in untold if column.role in _ASSUMED]
    if bare:
        names = dict.fromkeys(column.heading.name or column.variable for column in bare)
        units = dict.fromkeys(_ASSUMED[column.role] for column in bare)
        others = {
            column.heading.name or column.index + 1: _OTHER_UNITS[_ASSUMED[column.role]]
            for column in bare
        }
        said = f"no unit is told for {', '.join(names)}: taken as {', '.join(units)}; "
        doubts.append(Message(said, OptionHint({"units": others}), " tells another"))
    return [
        replace(column, unit=_ASSUMED[column.role]) if column in bare else column
        for column in columns
    ]


def _name(column: Column) -> str:
    return column.heading.text or f"column {column.index + 1}"


def _attributes(column: Column) -> dict[str, str | float]:
    """Return the attributes of a column in the Dataset.

    `column` is its number in the file, `unit_in_file` its unit there, known or not; `frame` is what
    a frame lasts, where times are frames.
    """
    frame = {"frame": column.factor} if column.heading.unit == FRAME else {}
    told = {"units": column.unit, "unit_in_file": column.heading.unit, "long_name": _name(column)}
    return {**told, "column": column.index + 1, **frame}


def _data(
    columns: Sequence[Column], values: Array, dimensions: Sequence[str]
) -> dict[str, tuple[str, Array, dict[str, Any]]]:
    """Return the variables of columns along the first dimension, each by a name of its own.

    None is called as a dimension.
    """
    found: dict[str, tuple[str, Array, dict[str, Any]]] = {}
    for column, own in zip(columns, values.T, strict=True):
        name, count = column.variable, 1
        while name in found or name in dimensions:
            count += 1
            name = f"{column.variable}_{count}"
        found[name] = (dimensions[0], np.ascontiguousarray(own), _attributes(column))
    return found


_Built = tuple[Mapping[str, Any], Mapping[str, Any], list[str]]
"""The variables of a Dataset, its coordinates, and what is unsure."""


def _series(columns: Sequence[Column], values: Array, run: object) -> _Built:
    """Return waveforms, sounds and accelerations: anything over time."""
    at = _at(columns, "time")
    rows, times, doubts = in_time(values[:, at], columns[at], run, gaps=True)
    others = [k for k in range(len(columns)) if k != at]
    data = _data([columns[k] for k in others], values[rows][:, others], ["time"])
    if "sound" in data:
        lasting = np.ptp(times)
        data["sound"][2]["rate"] = (len(times) - 1) / lasting if lasting > 0.0 else np.nan
    return data, {"time": ("time", times, _attributes(columns[at]))}, doubts


def _track(columns: Sequence[Column], values: Array, run: object) -> _Built:
    """Return tracks: x, y and further columns of each."""
    columns, values, several = rows_by_frame(columns, values)
    at = _at(columns, "time")
    rows, times, doubts = in_time(values[:, at], columns[at], run, gaps=False)
    doubts = several + doubts
    values = values[rows]
    others = [k for k in range(len(columns)) if k != at]
    tracks = list(dict.fromkeys(columns[k].track for k in others))
    blank = np.full((len(values), len(tracks)), np.nan)
    data: dict[str, Any] = {
        axis: (("time", "track"), blank.copy(), {"units": "m", "long_name": axis}) for axis in "xy"
    }
    for k, track in enumerate(tracks):
        own = [j for j in others if columns[j].track == track]
        found = _data([columns[j] for j in own], values[:, own], ["time", "track"])
        for name, (_, numbers, said) in found.items():
            place = data.setdefault(name, (("time", "track"), blank.copy(), {}))
            place[1][:, k] = numbers
            place[2].update(said)
    coords = {
        "time": ("time", times, _attributes(columns[at])),
        "track": [track or f"track {k}" for k, track in enumerate(tracks, 1)],
    }
    if not any(columns[k].role == "x" for k in others):
        doubts.append("only one position: taken as the height y, upwards")
    return data, coords, doubts


def _rows(kind: Kind, columns: Sequence[Column], values: Array, run: object) -> _Built:
    """Return rows, without those that lack a needed number."""
    if run is not None:
        raise about_option("run", ": there is none to choose, as this holds no times")
    roles = [each[0] for each in kind.columns]
    whole = np.isfinite(values[:, [_at(columns, role) for role in roles]]).all(axis=1)
    if not whole.any():
        raise FileError(f"it has no row with {' and '.join(roles)}")
    numbers: dict[str, Any] = {kind.dimension: (kind.dimension, np.flatnonzero(whole) + 1.0, {})}
    return _data(columns, values[whole], [kind.dimension]), numbers, []


def _bounces(values: Array) -> _Built:
    """Return the times of the knocks that phyphox heard, a column each; the last row counts."""
    numbers = np.nan_to_num(values)
    heard = np.flatnonzero(numbers[:, 0] > 0.0)
    if not heard.size:
        raise FileError("phyphox heard no knock in it")
    times = numbers[heard[-1]]
    rising = np.diff(times, prepend=0.0, append=0.0) > 0.0  # 0 stands for what was not heard
    said = {"units": "s", "long_name": "Bounce: time of a knock"}
    return {"knock_time": ("knock", times[: np.argmin(rising)], said)}, {}, []


def _at(columns: Sequence[Column], role: str) -> int:
    return next(k for k, column in enumerate(columns) if _is(column, role))
