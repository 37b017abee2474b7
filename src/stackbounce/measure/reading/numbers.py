"""The rows of a table -> numbers. Cells that are not numbers are counted, never hidden."""

import csv
import io
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from stackbounce.errors import FileError
from stackbounce.measure.quantities import Array
from stackbounce.measure.reading.limits import CELLS, LINE
from stackbounce.measure.reading.text import MISSING, Text, number, split

_CHUNK = LINE  # characters that are parsed at once, so that no line in them is too long
_ODD = 2**23  # characters that are parsed cell by cell in Python, at most: some seconds
_BLANKS = sorted({form for word in MISSING for form in (word, word.upper(), word.title(), "NaN")})
# Sizes within the range of any instrument: oscilloscopes write 9.9E37 for what is beyond it.
_LEAST, _MOST = 1e-60, 1e30
_TRUTH = "uUsS"  # letters of "true" and "false" that occur in no number


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
    beyond : int
        How many numbers are beyond the range of any instrument.
    words : int
        How many lines have no number at all.
    word : str
        The first of these.
    longer : int
        How many rows have more cells than there are columns.
    """

    values: Array
    strange: NDArray[np.int64]
    first: str = ""
    beyond: int = 0
    words: int = 0
    word: str = ""
    longer: int = 0


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
        If a line is longer than `limits.LINE`, or there are more than `limits.CELLS` numbers.
    """
    table = Table(np.empty((0, len(used))), np.zeros(len(used), dtype=np.int64))
    blocks = [table.values]
    count = odd = 0
    for chunk in _chunks(text.content, text.starts[first]):
        block = _parsed(chunk, text, used)
        if block is None:
            odd += len(chunk)
            if odd > _ODD:
                raise FileError("too many of its lines are not just numbers")
            block = _cell_by_cell(chunk.split("\n"), text, used, table)
        count += block.size
        if count > CELLS:
            raise FileError(f"it has more than {CELLS} numbers: cut out what is of interest")
        blocks.append(block)
    values = np.concatenate(blocks)
    sizes = np.abs(values)
    beyond = (sizes > _MOST) | ((sizes < _LEAST) & (sizes > 0.0))
    values[beyond] = np.nan
    table.beyond = int(np.count_nonzero(beyond))
    there = np.flatnonzero(~np.isnan(values).all(axis=1))
    table.values = values[there[0] : there[-1] + 1] if there.size else values[:0]
    return table


def _chunks(content: str, start: int) -> Iterator[str]:
    """Yield whole lines, together at most `_CHUNK` characters, without chunks that are blank."""
    while start < len(content):
        end = content.rfind("\n", start, start + _CHUNK) if len(content) > start + _CHUNK else -1
        if end < 0 and len(content) > start + _CHUNK:
            raise FileError(f"it has a line of more than {LINE} characters")
        end = len(content) if end < 0 else end
        chunk = content[start:end]
        if chunk and not chunk.isspace():
            yield chunk
        start = end + 1


def _parsed(chunk: str, text: Text, used: Sequence[int]) -> Array | None:
    """Return rows whose wanted cells are all plain numbers or missing, else None.

    The parser is that of pandas, which rounds every number to the nearest float, as Python's
    ``float`` does: by its own choice since 3.1, where it is asked to before.
    """
    if "\0" in chunk:
        return None  # pandas before 3 ends a number there
    import pandas as pd

    blanks = text.delimiter == " "
    quoted = not blanks and '"' in chunk
    older = tuple(map(int, pd.__version__.split(".")[:2])) < (3, 1)
    nearest = {"float_precision": "round_trip"} if older else {}
    wanted = sorted(set(used))
    width = len(split(chunk.lstrip("\n").partition("\n")[0], text.delimiter))
    try:
        frame = pd.read_csv(
            io.StringIO(chunk),
            sep=r"\s+" if blanks else text.delimiter,
            decimal=text.decimal,
            header=None,
            usecols=None if wanted == list(range(width)) else wanted,
            # asked for floats, pandas reads "True" as 1.0
            dtype=None if any(letter in chunk for letter in _TRUTH) else np.float64,
            na_values=_BLANKS,
            keep_default_na=False,
            skipinitialspace=True,
            quoting=csv.QUOTE_MINIMAL if quoted else csv.QUOTE_NONE,
            low_memory=False,
            **nearest,
        )
    except (ValueError, OverflowError):
        return None
    if any(kind.kind not in "fiu" for kind in frame.dtypes):
        return None
    block: Array = frame[list(used)].to_numpy(dtype=np.float64)
    if quoted and len(block) != sum(not line.isspace() for line in chunk.split("\n") if line):
        return None  # a quotation mark joined lines
    return block


def _cell_by_cell(lines: list[str], text: Text, used: Sequence[int], table: Table) -> Array:
    """Parse lines cell by cell; count in `table` the cells that are not numbers."""
    rows = []
    need, nan = max(used) + 1, math.nan
    for line in lines:
        cells = split(line, text.delimiter)
        if not any(cells):
            continue
        table.longer += any(cells[need:])
        row = [number(cells[k], text.decimal) if k < len(cells) else nan for k in used]
        if None in row:
            # a line of words among the numbers
            if all(cell is None or cell != cell for cell in row):
                table.word = table.word or line[:60]
                table.words += 1
                continue
            odd = (cells[k] for k, one in zip(used, row, strict=True) if one is None)
            table.first = table.first or next(odd)
            table.strange += [cell is None for cell in row]
        rows.append(row)
    return np.array(rows, np.float64).reshape(len(rows), len(used))  # None becomes NaN
