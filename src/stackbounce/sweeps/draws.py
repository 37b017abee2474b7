"""Tables of draws: each row is one drop, and each column a number of it by its path."""

import csv
import io
import re
from collections.abc import Mapping, Sequence
from decimal import Decimal
from pathlib import Path
from typing import Any

from stackbounce.errors import FileError, InvalidValue, shown
from stackbounce.files import content_of
from stackbounce.model import Drop
from stackbounce.run.paths import number_at
from stackbounce.units import factor

_DRAW = "draw"  # the dimension of draws in a sweep
_BYTES = 2**27  # of a table, at most
_HEADING = re.compile(r"([^\s(\[]+)\s*(?:[(\[](.*)[)\]])?")


def read_draws(drop: Drop, path: Path) -> dict[str, tuple[str, list[float]]]:
    """Return the draws of a table by path, each with the dimension that all of them share.

    Parameters
    ----------
    drop : Drop
        The drop that has the numbers.
    path : Path
        A table with commas, semicolons or tabs. Its first line has paths, with the unit if it is
        not SI: ``gaps.0 (mm)``.

    Raises
    ------
    FileError
        If the file cannot be read or is no table of numbers.
    InvalidValue
        If the drop has no such number, or a cell is no number; the message names the row.
    """
    name, content = content_of(path, _BYTES)
    try:
        text = content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise FileError(f"{name} is no table: it is not text in UTF-8") from error
    delimiter = max(",;\t", key=text.lstrip().partition("\n")[0].count)
    table = csv.reader(io.StringIO(text), delimiter=delimiter, skipinitialspace=True)
    try:
        rows = [(table.line_num, row) for row in table if any(row)]
        return _numbers(drop, rows, decimal="." if delimiter == "," else ",")
    except (csv.Error, InvalidValue) as error:
        raise InvalidValue(f"{name}: {error}") from error


def draws_text(drop: Drop, draws: Mapping[str, Any]) -> str:
    """Return draws, arrays by path, as such a table with all digits.

    Examples
    --------
    >>> import numpy as np
    >>> import stackbounce as sb
    >>> drop = sb.Drop([sb.Ball(0.1)], [sb.Spring(1e4)], height=0.3)
    >>> print(draws_text(drop, {"height": np.array([0.3, 0.31])}), end="")
    height (m)
    0.3
    0.31
    """
    units = {path: number_at(drop, path).unit for path in draws}
    headings = [f"{path} ({unit})" if unit else path for path, unit in units.items()]
    columns = [values.tolist() for values in draws.values()]
    rows = [",".join(map(repr, row)) for row in zip(*columns, strict=True)]
    return "\n".join([",".join(headings), *rows, ""])


def _columns(drop: Drop, headings: Sequence[str]) -> dict[str, Decimal]:
    """Return the factor to SI units of each column, by its path."""
    found: dict[str, Decimal] = {}
    for text in headings:
        parts = _HEADING.fullmatch(text.strip())
        number = number_at(drop, parts[1] if parts else text.strip())
        if number.path in found:
            raise InvalidValue(f"column {number.path} is there twice")
        unit = (parts and parts[2]) or number.unit
        one = 1.0 if unit == number.unit else factor(unit, number.unit, f"column {number.path}")
        found[number.path] = Decimal(repr(one))
    return found


def _numbers(
    drop: Drop, rows: Sequence[tuple[int, Sequence[str]]], decimal: str
) -> dict[str, tuple[str, list[float]]]:
    """Return the numbers of each column in SI units; the first row is the heading."""
    if len(rows) < 2:
        raise InvalidValue("it must have a heading, and a row for each draw")
    columns = _columns(drop, rows[0][1])
    found: dict[str, tuple[str, list[float]]] = {path: (_DRAW, []) for path in columns}
    for line, row in rows[1:]:
        if len(row) != len(columns):
            raise InvalidValue(f"row {line} must have {len(columns)} cells, got {len(row)}")
        for (path, size), cell in zip(columns.items(), row, strict=True):
            try:
                value = Decimal(cell.strip().replace(decimal, "."))
            except ArithmeticError:
                raise InvalidValue(
                    f"row {line}, {path}, must be a number, got {shown(cell)}"
                ) from None
            found[path][1].append(float(value if size == 1 else value * size))
    return found
