"""Drops from a table: each row is a drop of the same stack with what was measured of it."""

import os
import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

from stackbounce.errors import InvalidValue, nearest, placed, shown
from stackbounce.fitting.files import Asked, check_name, read_force_record
from stackbounce.fitting.quantities import find_quantity, read_with_error
from stackbounce.fitting.rows import Row, decimal_comma, rows_of
from stackbounce.measure.quantities import without_error
from stackbounce.measure.reading.roles import heading
from stackbounce.measure.reading.text import MISSING
from stackbounce.model import Drop
from stackbounce.run.paths import drop_at, numbers_of
from stackbounce.run.quantities import QUANTITIES
from stackbounce.units import count_written, quantity

_ERROR = "error of "
_KINDS = ("name", "number", "data", "error", "count", "force")  # of columns
_FALLS = {"height": "m", "impact_speed": "m/s"}
_UNITLESS = re.compile(r"[-+.,\deE±/()\s]*")


class _Column(NamedTuple):
    """What a column holds: its kind, whole name, unit in the file and heading."""

    kind: str
    name: str
    unit: str
    text: str

    @property
    def numeric(self) -> bool:
        """Return whether its cells may have a decimal mark."""
        return self.kind in ("number", "data", "error")


class _Cell(NamedTuple):
    """A cell that is not empty: its text, with the unit of the heading, and its place."""

    text: str
    where: str


def read_drops(drop: Drop, path: str | os.PathLike[str]) -> Asked:
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
    name, rows = rows_of(path)
    with placed(f"{name}: "):
        return _drops(drop, rows, Path(name).parent)


def _drops(drop: Drop, rows: Sequence[Row], folder: Path) -> Asked:
    if not rows:
        raise InvalidValue("it has no heading")
    (_, first), *rows = rows
    columns = [_column(drop, cell) for cell in first]
    _check_columns(columns)
    if not rows:
        raise InvalidValue("it has a heading but no drop below it")
    units = {column.name: column.unit for column in columns if column.kind == "data"}
    in_si = _FALLS | {path: number.unit for path, number in numbers_of(drop).items()}
    comma = decimal_comma(
        [
            (cell, f"row {line}, {column.text}")
            for line, cells in rows
            for column, cell in zip(columns, cells, strict=False)
            if column.numeric
        ]
    )
    drops: dict[str, Drop] = {}
    data: dict[str, dict[str, Any]] = {}
    for k, (line, cells) in enumerate(rows, 1):
        if any(cells[len(columns) :]):
            raise InvalidValue(f"row {line} has more cells than the heading, {len(columns)}")
        row: dict[str, dict[str, _Cell]] = {kind: {} for kind in _KINDS}
        for column, cell in zip(columns, cells, strict=False):
            if cell.casefold() not in MISSING and column.kind:
                text = cell.replace(",", ".") if comma and column.numeric else cell
                unit = column.unit or units.get(column.name)  # an error has that of its number
                text = f"{text} {unit}" if unit and _UNITLESS.fullmatch(text) else text
                row[column.kind][column.name] = _Cell(text, f"row {line}, {column.text}")
        name = row["name"]["name"].text if row["name"] else f"drop_{k}"
        check_name(f"row {line}, name", name, drops)
        given = row["number"].items()
        values = {path: quantity(own.text, in_si[path], own.where) for path, own in given}
        drops[name] = drop_of(drop, values, line)
        data[name] = _data(row, folder)
        if not data[name]:
            raise InvalidValue(f"row {line} has nothing that was measured")
    return drops, data


def _column(drop: Drop, text: str) -> _Column:
    """Return the column that a heading describes."""
    of_error = text.casefold().startswith(_ERROR)
    head = heading(text[len(_ERROR) :] if of_error else text)
    base = head.name.partition(".")[0]
    known = list(dict.fromkeys([*numbers_of(drop), *_FALLS]))
    kind = ""
    if base in QUANTITIES:
        find_quantity(drop, head.name, f"column {shown(text)}")
        kind = "error" if of_error else "count" if base == "collisions" else "data"
    elif of_error:
        raise InvalidValue(
            f"column {shown(text)} does not belong to a measured quantity; {_known(head.name, [])}"
        )
    elif text:
        kind = base if base == "force" or head.name == "name" else "number"
        if kind == "number" and head.name not in known:
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
    names = [(column.kind, column.name) for column in columns if column.kind]
    for column in columns:
        if column.kind and names.count((column.kind, column.name)) > 1:
            raise InvalidValue(f"column {shown(column.text)} is there twice")
        if column.kind == "error" and ("data", column.name) not in names:
            raise InvalidValue(f"column {shown(column.text)} has no column {column.name} beside it")
    if not any(column.kind in ("data", "force", "count") for column in columns):
        raise InvalidValue(f"it has no column of what was measured; {_known('', [])}")


def drop_of(drop: Drop, values: Mapping[str, float], line: int) -> Drop:
    """Return a drop with the numbers of a row, in SI units by their paths.

    Raises
    ------
    InvalidValue, InvalidType
        If there is no such drop; the message names the row.
    """
    numbers = numbers_of(drop)
    falls = {name: value for name, value in values.items() if name in _FALLS}
    given = {numbers[path]: value for path, value in values.items() if path not in _FALLS}
    with placed(f"row {line}: "):
        return drop_at(drop.replace(**falls), given)


def _data(row: Mapping[str, Mapping[str, _Cell]], folder: Path) -> dict[str, Any]:
    """Return what was measured in a row."""
    found: dict[str, Any] = {
        name: _with_error(name, cell, row["error"].get(name)) for name, cell in row["data"].items()
    }
    for name, cell in row["count"].items():
        count = count_written(cell.text)
        if count is None:
            raise InvalidValue(f"{cell.where} must be a whole number, got {shown(cell.text)}")
        found[name] = count
    for name, cell in row["force"].items():
        found[name] = read_force_record(name, cell.text, folder)
    return found


def _with_error(name: str, cell: _Cell, beside: _Cell | None) -> tuple[float, float]:
    """Return a number and its error, from its own cell or the one in the column of errors."""
    if beside is not None and without_error(cell.text):
        raise InvalidValue(f"{cell.where} has an error in its cell and one beside it")
    right = f"a number with its error, '{cell.text} ± …', or one beside it, '{_ERROR}{name}'"
    given = cell.text if beside is None else (cell.text, beside.text)
    return read_with_error(given, QUANTITIES[name.partition(".")[0]].unit, cell.where, right)
