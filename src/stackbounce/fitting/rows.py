"""The rows of a table with words in it, as people type them: one way for all tables of a fit."""

import os
import re

from stackbounce.errors import FileError, InvalidValue, shown
from stackbounce.files import content_of
from stackbounce.measure.reading.limits import BYTES, COLUMNS, LINE, refuse_others
from stackbounce.measure.reading.tables import from_xlsx
from stackbounce.measure.reading.text import SPACES, decode, split

File = str | os.PathLike[str] | tuple[str, bytes]
"""A file, or its name and its content."""

Row = tuple[int, list[str]]
"""The number of a line, counted from 1, and its cells."""

_MARKED = re.compile(r"\d*(?:[.,]\d+)+")  # decimal mark, or marks between thousands
_MOST = 1000  # rows of a table
_TWO = re.compile(rb"(?m)(?:^|\t)\d[^\t\n]*\t(?:[^\n]*\t)?\d")  # cells with numbers in one row
_GROUPED = re.compile(r"[1-9]\d{0,2}(?:,\d{3})+")
_SPACED = re.compile(rf"(?<=\d)[{SPACES}](?=\d{{3}}(?!\d))")
_BOTH = re.compile(r"(?<![\d.,])[1-9]\d{0,2}([.,])\d{3}(?:\1\d{3})*(?=(?!\1)[.,]\d)")


def rows_of(path: File) -> tuple[str, list[Row]]:
    r"""Return a table's name, with its sheet if there are several, and the rows that are not blank.

    Parameters
    ----------
    path : str or path-like, or (str, bytes)
        A file, or its name and its content: text with tabs, semicolons or commas between its cells,
        or an Excel file, of which the first sheet with two numbers in a row is read.

    Raises
    ------
    FileError
        If it cannot be read, is no table, or is too large.

    Examples
    --------
    >>> path = getfixture("tmp_path") / "heights.csv"
    >>> _ = path.write_text("drop;rebound\n\n63,5;41\n")
    >>> rows_of(path)[1]
    [(1, ['drop', 'rebound']), (3, ['63,5', '41'])]
    """
    name, content = path if isinstance(path, tuple) else content_of(path, BYTES)
    content = bytearray(content)
    try:
        if content.startswith(b"PK\x03\x04"):
            sheets = from_xlsx(content).members
            first = next((s for s, table in sheets.items() if _TWO.search(table)), "")
            first = first or next(iter(sheets))
            name += f", sheet {shown(first)}" * (len(sheets) > 1)
            content = bytearray(sheets[first])
        refuse_others(content)
        return name, _split(decode(content))
    except FileError as error:
        raise FileError(f"{name}: {error}") from error


def decimal_comma(cells: list[tuple[str, str]]) -> bool:
    """Return whether commas are decimal marks; raise if a number could be read in two ways.

    Parameters
    ----------
    cells : list of (str, str)
        The text of each cell that holds a number, and where it stands.

    Examples
    --------
    >>> decimal_comma([("63,5", "row 2")]), decimal_comma([("63.5", "row 2")])
    (True, False)
    """
    numbers = [(mark[0], where) for text, where in cells for mark in _MARKED.finditer(text)]
    commas = [(text, where) for text, where in numbers if "," in text]
    point = next((text for text, _ in numbers if "." in text), "")
    for text, where in commas[:1]:
        if point:
            other = f"but {point} a decimal" if point != text else "and a"
            raise InvalidValue(f"{where}: {text} has a comma, {other} point: write only one mark")
        if all(_GROUPED.fullmatch(number) for number, _ in commas):
            raise InvalidValue(f"{where}: {text} can be read in two ways: write it without a comma")
    return bool(commas)


def _split(content: str) -> list[Row]:
    rows: list[Row] = []
    lines = content.split("\n")
    filled = [line for line in lines if line.strip(" \t;,")]
    lines_with = {mark: sum(mark in line for line in filled) for mark in "\t;,"}
    usual = (mark for mark, count in lines_with.items() if 2 * count >= len(filled) > 0)
    delimiter = next(usual, "\t")
    for number, text in enumerate(lines, 1):
        if len(text) > LINE:
            raise FileError(f"row {number} has more than {LINE} characters")
        if not text.strip(" \t;,"):
            continue
        if text.count(delimiter) >= COLUMNS or len(rows) > _MOST:
            raise FileError(f"it has more than {COLUMNS} columns or {_MOST} drops")
        rows.append((number, [_ungrouped(cell) for cell in split(text, delimiter)]))
    return rows


def _ungrouped(cell: str) -> str:
    """Return a cell without marks between thousands, where nothing else can be meant by them."""
    return _BOTH.sub(lambda found: found[0].replace(found[1], ""), _SPACED.sub("", cell))
