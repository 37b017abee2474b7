"""Arrays of NumPy (.npy): their columns, or the fields of records; nothing is unpickled."""

import io
import math
from collections.abc import Mapping, Sequence
from tokenize import TokenError
from typing import Any

import numpy as np
from numpy.typing import NDArray

from stackbounce.errors import FileError
from stackbounce.measure.reading.layouts import Layout, columns_of, guess
from stackbounce.measure.reading.limits import CELLS, COLUMNS
from stackbounce.measure.reading.numbers import Table

_NUMBERS = "biuf"
_BROKEN = (ValueError, TypeError, LookupError, SyntaxError, EOFError, RecursionError, TokenError)


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
    if any(kind.kind not in _NUMBERS for kind in kinds):
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
