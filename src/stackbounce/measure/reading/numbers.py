"""The rows of a table -> an array; what is no number there is counted, not hidden."""

import math
import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from stackbounce.engine.compiler import compile_kernel
from stackbounce.errors import FileError
from stackbounce.measure.reading.grid import POWERS, grid
from stackbounce.measure.reading.limits import CELLS, LINE
from stackbounce.measure.reading.text import Text, number, split

__all__ = ["Table", "rows_of"]

_CHUNK = 2**22  # characters that are read at once
_ODD = 2**23  # characters that are looked at one by one, at most: some seconds


@dataclass
class Table:
    """The numbers of a table.

    Parameters
    ----------
    values : numpy.ndarray, shape (rows, columns)
        NaN where there is no number, or an infinite one.
    strange : numpy.ndarray, shape (columns,)
        How many cells of each column are neither numbers nor missing.
    first : str
        The first of these.
    infinite : int
        How many numbers are infinite: beyond the range of an instrument.
    words : int
        How many lines have no number at all.
    word : str
        The first of these.
    longer, shorter : int
        How many rows have more cells, or fewer, than there are columns.
    """

    values: NDArray[np.float64]
    strange: NDArray[np.int64]
    first: str = ""
    infinite: int = 0
    words: int = 0
    word: str = ""
    longer: int = 0
    shorter: int = 0


def rows_of(text: Text, first: int, used: Sequence[int]) -> Table:
    """Return the numbers of some columns, from one of the first lines to the end.

    Parameters
    ----------
    text : Text
        The table.
    first : int
        The first row of numbers, as an index to its first lines.
    used : sequence of int
        The columns that are wanted, in order.

    Raises
    ------
    FileError
        If a line is endless, or there are more than `limits.CELLS` numbers.
    """
    table = Table(np.empty((0, len(used))), np.zeros(len(used), dtype=np.int64))
    start = text.starts[first]
    most = min(text.content.count("\n", start) + 1, CELLS // len(used) + 1)
    values = np.empty((len(used), most)).T  # a column is one piece; what stays empty costs nothing
    plain = compile_kernel(grid) if len(text.content) - start > _CHUNK else None  # worth a second
    count, odd = 0, 0
    for chunk in _chunks(text.content, start):
        if not chunk or chunk.isspace():
            continue
        rows = _gridded(plain, chunk, text, used, values[count:]) if plain else -1
        if rows < 0:
            block, strange = _lines(chunk, text, used, table)
            odd += strange
            if odd > _ODD:
                raise FileError("too many of its lines are not just numbers")
            rows = len(block)
            if (count + rows) * len(used) > CELLS:
                raise FileError(f"it has more than {CELLS} numbers: cut out what is of interest")
            values[count : count + rows] = block
        count += rows
    values = values[:count]
    blank = np.isnan(values).all(axis=1)
    table.values = values[~blank] if blank.any() else values
    infinite = np.isinf(table.values)
    table.infinite = int(infinite.sum())
    if table.infinite:
        table.values[infinite] = np.nan
    return table


def _gridded(
    plain: Callable[..., int],
    chunk: str,
    text: Text,
    used: Sequence[int],
    values: NDArray[np.float64],
) -> int:
    """Write the numbers of a chunk that has nothing else; return how many rows, or -1."""
    chunk = chunk.strip("\n")
    places = np.full(len(split(chunk.partition("\n")[0], text.delimiter)), -1)
    if max(used) >= len(places) or len(set(used)) < len(used) or not chunk.isascii():
        return -1
    places[list(used)] = np.arange(len(used))
    decimal = ord(text.decimal) if text.decimal != text.delimiter else -1
    raw = np.frombuffer(chunk.encode(), dtype=np.uint8)
    return plain(raw, ord(text.delimiter), decimal, LINE, places, POWERS, values)


def _lines(
    chunk: str, text: Text, used: Sequence[int], table: Table
) -> tuple[NDArray[np.float64], int]:
    """Return the rows of a chunk, and how many of its characters had to be looked at one by one."""
    lines = chunk.split("\n")
    if len(max(lines, key=len)) > LINE:
        raise FileError(f"it has a line of more than {LINE} characters")
    block = _plain(lines, text, used)
    if block is None:  # perhaps for blank cells only
        block = _plain(_filled(chunk, text.delimiter), text, used)
    return (_any(lines, text, used, table), len(chunk)) if block is None else (block, 0)


def _chunks(content: str, start: int) -> Iterator[str]:
    while start < len(content):
        end = content.rfind("\n", start, start + _CHUNK) if len(content) > start + _CHUNK else -1
        if end < 0 and len(content) > start + _CHUNK:
            raise FileError(f"it has a line of more than {LINE} characters")
        end = len(content) if end < 0 else end
        yield content[start:end]
        start = end + 1


def _plain(lines: list[str], text: Text, used: Sequence[int]) -> NDArray[np.float64] | None:
    """Return rows in which each wanted cell is a plain number, or None where they are others."""
    if text.decimal == ",":
        if any("." in line for line in lines):  # between thousands
            return None
        lines = [line.replace(",", ".") for line in lines] if text.delimiter != "," else lines
    width = len(split(lines[0], text.delimiter))
    if width < 1 or max(used) >= width or not any(line.strip() for line in lines):
        return None
    every = list(used) == list(range(width))
    try:
        block = np.loadtxt(
            lines,
            delimiter=None if text.delimiter == " " else text.delimiter,
            comments=None,
            quotechar='"',
            usecols=None if every else list(used),
            ndmin=2,
        )
    except (ValueError, OverflowError):
        return None
    return block if block.shape[1] == len(used) else None


def _filled(chunk: str, delimiter: str) -> list[str]:
    """Return lines in which blank cells say that they are none."""
    if delimiter == " ":
        return chunk.split("\n")
    ends = rf"{delimiter}\n"
    return re.sub(rf"(?m)(?<={delimiter})(?=[{ends}]|\Z)|^(?={delimiter})", "nan", chunk).split(
        "\n"
    )


def _any(lines: list[str], text: Text, used: Sequence[int], table: Table) -> NDArray[np.float64]:
    """Return rows of whatever cells."""
    rows = []
    need, nan = max(used) + 1, math.nan
    for line in lines:
        cells = split(line, text.delimiter)
        if not any(cells):
            continue
        table.longer += any(cells[need:])
        table.shorter += len(cells) < need
        row = [number(cells[k], text.decimal) if k < len(cells) else nan for k in used]
        if None in row:
            if all(one is None or one != one for one in row):  # a line of words among the numbers
                table.word = table.word or line[:60]
                table.words += 1
                continue
            table.first = table.first or next(
                cells[k] for k, one in zip(used, row, strict=True) if one is None
            )
            table.strange += [one is None for one in row]
        rows.append([nan if one is None else one for one in row])
    return np.array(rows, dtype=np.float64).reshape(len(rows), len(used))
