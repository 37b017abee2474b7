"""Drops from a table: each row is a drop of the same stack with what was measured of it."""

import os
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, NamedTuple

from stackbounce.errors import FileError, InvalidType, InvalidValue, nearest, positive, shown
from stackbounce.fitting.files import read_force_record
from stackbounce.fitting.quantities import QUANTITIES, find_quantity
from stackbounce.measure.quantities import quantity_with_error
from stackbounce.measure.reading.headings import heading
from stackbounce.measure.reading.limits import COLUMNS, LINE, content_of, refuse_others
from stackbounce.measure.reading.text import decode, split
from stackbounce.model import Drop
from stackbounce.run.paths import Number, drop_at, numbers_of
from stackbounce.units import quantity

__all__ = ["read_drops"]

_MOST = 1000  # drops
_ERROR = "error of "
_FALLS = {"height": "m", "impact_speed": "m/s"}
_MARKED = re.compile(r"\d+(?:[.,]\d+)+")
_GROUPED = re.compile(r"[1-9]\d{0,2}(?:,\d{3})+")
_UNITLESS = re.compile(r"[-+.,\deE±/()\s]*")


class _Column(NamedTuple):
    """What a column holds: its kind, whole name, unit in the file and heading."""

    kind: str
    name: str
    unit: str
    text: str


def read_drops(
    drop: Drop, path: str | os.PathLike[str]
) -> tuple[dict[str, Drop], dict[str, dict[str, Any]]]:
    """Return the drops of a table, and what was measured of each, for `stackbounce.fit`.

    Parameters
    ----------
    drop : Drop
        What all drops have in common.
    path : str or path-like
        A table as spreadsheets write it, separated by commas, semicolons or tabs, with decimal
        points or commas. Its first line names the columns: numbers of the drop by their paths,
        ``height (cm)``, ``gaps.0 (mm)``; what was measured, ``rebound_ratios.1``,
        ``rebound_heights.1 (cm)``, ``collisions.0``, ``force.0`` (a file beside this one); and
        ``name``. The error stands in the cell, ``1.64 ± 0.02``, or in a column of its own,
        ``error of rebound_ratios.1``; the unit in the heading or in the cell. An empty cell means
        not measured, or the same as in `drop`.

    Returns
    -------
    drops : dict of str to Drop
        By name, or ``drop_1``, ``drop_2`` and so on.
    data : dict of str to dict
        By the same names.

    Raises
    ------
    FileError
        If the file cannot be read, is not a table, or has more than 1000 rows.
    InvalidValue
        If a column is unknown or a cell cannot be read; the message names column and row, counted
        as spreadsheets do.

    Examples
    --------
    >>> import stackbounce as sb
    >>> drop = sb.Drop([sb.Ball(1.0)], [sb.Spring(1.0)], height=1.0)
    >>> read_drops(drop, "no-such-file.csv")
    Traceback (most recent call last):
        ...
    stackbounce.errors.FileError: no-such-file.csv cannot be read: No such file or directory
    """
    name, content = content_of(path)
    try:
        refuse_others(content)
        rows = list(_rows(drop, decode(content)))
    except FileError as error:
        raise FileError(f"{name}: {error}") from error
    try:
        return _drops(drop, rows, Path(name).parent)
    except (InvalidValue, InvalidType) as error:
        raise type(error)(f"{name}: {error}") from error


def _rows(drop: Drop, content: str) -> Iterator[tuple[int, list[str]]]:
    """Yield the cells of each line that is not blank, with its number from 1; first the heading."""
    start, line, count, delimiter = 0, 0, 0, ""
    while start < len(content):
        end = content.find("\n", start, start + LINE)
        if end < 0 and len(content) > start + LINE:
            raise FileError(f"row {line + 1} has more than {LINE} characters")
        text = content[start : end if end >= 0 else None]
        start = end + 1 if end >= 0 else len(content)
        line += 1
        if not text.strip(" \t;,"):
            continue
        delimiter = delimiter or _delimiter(drop, text)
        if text.count(delimiter) >= COLUMNS or count > _MOST:
            raise FileError(f"it has more than {COLUMNS} columns or {_MOST} drops")
        count += 1
        yield line, split(text, delimiter)


def _delimiter(drop: Drop, first: str) -> str:
    """Return the delimiter with which a heading has most known names."""
    numbers = {*numbers_of(drop), *_FALLS, "name"}

    def known(cell: str) -> bool:
        name = heading(cell.casefold().removeprefix(_ERROR)).name
        base, _, index = name.partition(".")
        measured = base == "force" or base in QUANTITIES
        return name in numbers or (measured and (not index or index.isdecimal()))

    return max("\t;,", key=lambda mark: sum(map(known, split(first[: LINE // 8], mark))))


def _drops(
    drop: Drop, rows: Sequence[tuple[int, list[str]]], folder: Path
) -> tuple[dict[str, Drop], dict[str, dict[str, Any]]]:
    if not rows:
        raise InvalidValue("it has no heading")
    (_, first), *rows = rows
    columns = [_column(drop, cell) for cell in first]
    _check_columns(columns)
    if not rows:
        raise InvalidValue("it has a heading but no drop below it")
    comma = _has_commas(columns, rows)
    drops: dict[str, Drop] = {}
    data: dict[str, dict[str, Any]] = {}
    for k, (line, cells) in enumerate(rows, 1):
        if any(cells[len(columns) :]):
            raise InvalidValue(f"row {line} has more cells than the heading, {len(columns)}")
        cells += [""] * (len(columns) - len(cells))
        table = {
            column: cell.replace(",", ".") if comma and _numeric(column) else cell
            for column, cell in zip(columns, cells, strict=False)
            if cell and column.kind
        }
        named = {column.kind: cell for column, cell in table.items() if column.kind == "name"}
        name = named.get("name", f"drop_{k}")
        if not name.isidentifier() or name in drops:
            raise InvalidValue(
                f"row {line}, name must be a name of its own in letters, digits and _, such as "
                f"B2_on_B1, got {shown(name)}"
            )
        drops[name] = _drop(drop, table, line)
        data[name] = _data(table, line, folder)
        if not data[name]:
            raise InvalidValue(f"row {line} has nothing that was measured")
    return drops, data


def _column(drop: Drop, text: str) -> _Column:
    """Return the column that a heading describes."""
    of_error = text.casefold().startswith(_ERROR)
    head = heading(text[len(_ERROR) :] if of_error else text)
    numbers, base = numbers_of(drop), head.name.partition(".")[0]
    known = [*numbers, *(name for name in _FALLS if name not in numbers)]
    if base in QUANTITIES:
        find_quantity(drop, head.name, f"column {shown(text)}")
        kind = "error" if of_error else "count" if base == "collisions" else "data"
    elif of_error:
        raise InvalidValue(
            f"column {shown(text)} does not belong to a measured quantity; {_known(head.name, [])}"
        )
    elif not text:
        kind = ""
    elif base == "force":
        kind = "force"
    elif head.name == "name":
        kind = "name"
    elif head.name in known:
        kind = "number"
    else:
        raise InvalidValue(
            f"column {shown(text)} is neither a number of the drop nor measured; "
            f"{_known(head.name, [*known, 'name'])}"
        )
    return _Column(kind, head.name, head.unit, text)


def _known(name: str, numbers: Sequence[str]) -> str:
    """Return a hint with the nearest known name, with the number of a ball or contact."""
    _, dot, index = name.partition(".")
    one = index if dot and index.isdecimal() else "0"
    measured = [f"{key}.{one}" if known.part else key for key, known in QUANTITIES.items()]
    return nearest(name, [*numbers, *measured, "force.0"] if numbers else measured)


def _check_columns(columns: Sequence[_Column]) -> None:
    names = [(one.kind, one.name) for one in columns if one.kind]
    for column in columns:
        if column.kind and names.count((column.kind, column.name)) > 1:
            raise InvalidValue(f"column {shown(column.text)} is there twice")
        if column.kind == "error" and ("data", column.name) not in names:
            raise InvalidValue(f"column {shown(column.text)} has no column {column.name} beside it")
    if not any(column.kind in ("data", "force", "count") for column in columns):
        raise InvalidValue(f"it has no column of what was measured; {_known('', [])}")


def _numeric(column: _Column) -> bool:
    return column.kind in ("number", "data", "error")


def _has_commas(columns: Sequence[_Column], rows: Sequence[tuple[int, list[str]]]) -> bool:
    """Tell whether commas are decimal marks; refuse numbers that could be read in two ways."""
    found = [
        (mark[0], f"row {line}, {column.text}")
        for line, cells in rows
        for column, cell in zip(columns, cells, strict=False)
        if _numeric(column)
        for mark in _MARKED.finditer(cell)
    ]
    commas = [(text, where) for text, where in found if "," in text]
    points = [text for text, _ in found if "." in text]
    if not commas:
        return False
    text, where = commas[0]
    if points:
        raise InvalidValue(f"{where}: {text} has a comma, but {points[0]} a decimal point")
    if all(_GROUPED.fullmatch(one) for one, _ in commas):
        raise InvalidValue(f"{where}: {text} can be read in two ways: write it without a comma")
    return True


def _drop(drop: Drop, table: Mapping[_Column, str], line: int) -> Drop:
    """Return the drop of a row."""
    numbers, values, falls = numbers_of(drop), {}, {}
    for column, cell in table.items():
        if column.kind != "number":
            continue
        known: Number | None = numbers.get(column.name)
        unit = _FALLS[column.name] if known is None else known.unit
        value = quantity(_with_unit(cell, column.unit), unit, f"row {line}, {column.text}")
        if column.name in _FALLS:
            falls[column.name] = value
        elif known is not None:
            values[known] = value
    others: dict[str, Any] = {name: falls.get(name) for name in (*_FALLS, "velocities")}
    try:
        return drop_at(replace(drop, **others) if falls else drop, values)
    except (InvalidValue, InvalidType) as error:
        raise type(error)(f"row {line}: {error}") from error


def _data(table: Mapping[_Column, str], line: int, folder: Path) -> dict[str, Any]:
    """Return what was measured in a row."""
    errors = {
        column.name: (column, cell) for column, cell in table.items() if column.kind == "error"
    }
    found: dict[str, Any] = {}
    for column, cell in table.items():
        where = f"row {line}, {column.text}"
        if column.kind == "force":
            found[column.name] = read_force_record(column.name, cell, folder)
        elif column.kind == "count":
            if not cell.isdecimal():
                raise InvalidValue(f"{where} must be a whole number, got {shown(cell)}")
            found[column.name] = int(cell)
        elif column.kind == "data":
            found[column.name] = _with_error(column, cell, errors.get(column.name), where, line)
    return found


def _with_error(
    column: _Column, cell: str, beside: tuple[_Column, str] | None, where: str, line: int
) -> tuple[float, float]:
    unit = QUANTITIES[column.name.partition(".")[0]].unit
    value: Any = quantity_with_error(_with_unit(cell, column.unit), unit, where)
    if hasattr(value, "nominal_value"):
        if beside is not None:
            raise InvalidValue(f"{where} has an error in its cell and one beside it")
        return value.nominal_value, value.std_dev
    if beside is None:
        raise InvalidValue(
            f"{where} must have an error, in its cell, such as '{cell} ± …', or in a column "
            f"'{_ERROR}{column.name}', got {shown(cell)}"
        )
    other, text = beside
    path = f"row {line}, {other.text}"
    error = quantity(_with_unit(text, other.unit or column.unit), unit, path)
    return value, positive(path, error)


def _with_unit(cell: str, unit: str) -> str:
    """Return a cell with the unit of its heading, unless it has its own."""
    return f"{cell} {unit}" if unit and _UNITLESS.fullmatch(cell) else cell
