"""The rows of a table, or an array of NumPy (.npy) -> numbers.

Cells that are not numbers are counted, never hidden. Of an array they are its columns, or the
fields of its records; nothing is unpickled.
"""

import csv
import io
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from tokenize import TokenError
from typing import Any

import numpy as np
from numpy.typing import NDArray

from stackbounce.errors import FileError
from stackbounce.measure.quantities import Array
from stackbounce.measure.reading.layouts import Layout, columns_of, guess
from stackbounce.measure.reading.limits import CELLS, COLUMNS, LINE
from stackbounce.measure.reading.text import MISSING, Text, number, split

_CHUNK = LINE  # characters that are parsed at once, so that no line in them is too long
_ODD = 2**23  # characters that are parsed cell by cell in Python, at most: some seconds
_BLANKS = sorted({form for word in MISSING for form in (word, word.upper(), word.title(), "NaN")})
_MOST = 1e30  # beyond any instrument's range, for which oscilloscopes write 9.9E37
_TRUTH = "uUsS"  # letters of "true" and "false" that occur in no number
_NUMBER_KINDS = "biuf"  # of NumPy
_BROKEN = (ValueError, TypeError, LookupError, SyntaxError, EOFError, RecursionError, TokenError)


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

    values: Array
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
        If a line is longer than `limits.LINE`, or there are more than `limits.CELLS` numbers.
    """
    table = Table(np.empty((0, len(used))), np.zeros(len(used), dtype=np.int64))
    start = text.starts[first]
    most = min(text.content.count("\n", start) + 1, CELLS // len(used) + 1)
    values = np.empty((len(used), most)).T  # columns are contiguous; rows not written cost nothing
    count = odd = 0
    for chunk in _chunks(text.content, start):
        block = _parsed(chunk, text, used, table)
        if block is None:
            odd += len(chunk)
            if odd > _ODD:
                raise FileError("too many of its lines are not just numbers")
            block = _cell_by_cell(chunk.split("\n"), text, used, table)
        if (count + len(block)) * len(used) > CELLS:
            raise FileError(f"it has more than {CELLS} numbers: cut out what is of interest")
        values[count : count + len(block)] = block
        count += len(block)
    values = values[:count]
    blank = np.isnan(values).all(axis=1)
    table.values = values[~blank] if blank.any() else values
    infinite = table.values > _MOST
    infinite |= table.values < -_MOST
    table.infinite = int(infinite.sum())
    if table.infinite:
        table.values[infinite] = np.nan
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


def _parsed(chunk: str, text: Text, used: Sequence[int], table: Table) -> Array | None:
    """Return rows whose wanted cells are all plain numbers or missing, else None.

    The parser is that of pandas, which since 3.1 rounds every number to the nearest float, as
    Python's ``float`` does.
    """
    import pandas as pd

    blanks = text.delimiter == " "
    if blanks and not chunk.isascii():  # Python splits at blanks that pandas takes for letters
        return None
    quoted = not blanks and '"' in chunk
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
        )
    except (ValueError, OverflowError):
        return None
    if any(kind.kind not in "fiu" for kind in frame.dtypes):
        return None
    block: Array = frame[list(used)].to_numpy(dtype=np.float64)
    need = max(used) + 1
    if quoted or np.isnan(block).any():
        widths = [len(split(line, text.delimiter)) for line in chunk.split("\n") if line.strip()]
        if len(widths) != len(block):  # a quotation mark that joined lines
            return None
        table.shorter += sum(width < need for width in widths)
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
        table.shorter += len(cells) < need
        row = [number(cells[k], text.decimal) if k < len(cells) else nan for k in used]
        if None in row:
            # a line of words among the numbers
            if all(cell is None or cell != cell for cell in row):
                table.word = table.word or line[:60]
                table.words += 1
                continue
            table.first = table.first or next(
                cells[k] for k, one in zip(used, row, strict=True) if one is None
            )
            table.strange += [cell is None for cell in row]
        rows.append(row)
    return np.array(rows, np.float64).reshape(len(rows), len(used))  # None becomes NaN


def is_array(content: bytes | bytearray) -> bool:
    """Return whether bytes are an array as `numpy.save` writes it."""
    return content.startswith(b"\x93NUMPY")


def array_in(content: bytes | bytearray) -> NDArray[Any]:
    """Return an array of columns, (rows, columns), or one of records, (rows,).

    Its size is checked before memory is taken for it.

    Raises
    ------
    FileError
        If it is cut off, too large, or holds no numbers.
    """
    try:
        shape, fortran, kind, begin = _header(content)
    except _BROKEN as error:
        why = " ".join(str(error).split())[:200]
        raise FileError(f"it is a NumPy array that cannot be read ({why})") from error
    kinds = [kind[name] for name in kind.names] if kind.names else [kind]
    if any(kind.kind not in _NUMBER_KINDS for kind in kinds):
        raise FileError(f"it is a NumPy array of {kind}: save one of plain numbers")
    count = math.prod(shape)
    if not 0 < count <= (len(content) - begin) // max(kind.itemsize, 1):
        raise FileError(f"it is a NumPy array of shape {shape} that is empty or cut off")
    flat = np.frombuffer(content, kind, count, begin)
    array = flat.reshape(shape, order="F" if fortran else "C")
    if kind.names is not None and array.ndim == 1:
        return array
    if array.ndim == 1:
        return array[:, None]
    if array.ndim != 2 or kind.names is not None:
        raise FileError(f"it is a NumPy array of shape {shape}: save one with rows and columns")
    return array.T if array.shape[1] > COLUMNS >= array.shape[0] else array


def _header(content: bytes | bytearray) -> tuple[tuple[int, ...], bool, np.dtype[Any], int]:
    """Return the shape of an array, whether its columns come first, its type, and where it is."""
    stream = io.BytesIO(content[:20000])
    version = np.lib.format.read_magic(stream)
    one, two = np.lib.format.read_array_header_1_0, np.lib.format.read_array_header_2_0
    shape, fortran, kind = (one if version[0] == 1 else two)(stream)
    return shape, fortran, kind, stream.tell()


def layout_of_array(array: NDArray[Any]) -> Layout:
    """Return the layout of an array: that of its fields' names, or what its numbers look like.

    Raises
    ------
    FileError
        If it has no rows, too many columns or too many numbers.
    """
    names = array.dtype.names
    width = len(names) if names else array.shape[1]
    if not array.size or width > COLUMNS or array.size > CELLS:
        raise FileError(f"it is a NumPy array of shape {array.shape}: cut out what is of interest")
    if names:
        why = f"a NumPy array with the fields {', '.join(names[:3])}"
        return Layout("NumPy", why, columns_of(names, width), 0)
    found = guess(np.asarray(array[:200], dtype=np.float64))
    return Layout("NumPy", "a NumPy array", columns_of([], width), 0, guess=found)


def rows_of_array(array: NDArray[Any], used: Sequence[int]) -> Table:
    """Return the numbers of some columns; rows without any number are left out."""
    names = array.dtype.names
    values = np.empty((len(used), len(array))).T
    for k, index in enumerate(used):
        values[:, k] = array[names[index]] if names else array[:, index]
    infinite = np.isinf(values)
    values[infinite] = np.nan
    values = values[~np.isnan(values).all(axis=1)]
    return Table(values, np.zeros(len(used), dtype=np.int64), infinite=int(infinite.sum()))


def joined(members: Mapping[str, bytes]) -> dict[str, bytes]:
    """Return the arrays of an .npz file; those with one column and equally long as one table."""
    found = {name.removesuffix(".npy"): array_in(member) for name, member in members.items()}
    single = {name: value for name, value in found.items() if value.shape[1:] == (1,)}
    lengths = {len(array) for array in single.values()}
    if len(single) < 2 or len(lengths) > 1:
        return dict(members)
    table = np.empty(lengths.pop(), dtype=[(name, np.float64) for name in single])
    for name, value in single.items():
        table[name] = value[:, 0]
    packed = io.BytesIO()
    np.save(packed, table, allow_pickle=False)
    rest = {
        name: member for name, member in members.items() if name.removesuffix(".npy") not in single
    }
    return {"arrays": packed.getvalue(), **rest}
