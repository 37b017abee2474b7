"""How a compiled kernel receives a record of arrays: one pointer to a table of their addresses."""

import ctypes
from typing import Any

import numpy as np

_START = ctypes.c_char * 0  # of an array: to ask numpy for an address takes four times as long
COLUMNS = 3  # of the table: an array's address, its rows, and the numbers in each row


class Table:
    """A record of arrays as an argument of a compiled kernel; it keeps the arrays alive.

    Parameters
    ----------
    record : NamedTuple of arrays
        Contiguous arrays of one or two dimensions, of 64-bit floats or integers.

    Raises
    ------
    TypeError
        If an array is not contiguous.
    """

    def __init__(self, record: Any) -> None:
        self.record = record
        rows = []
        for array in record:
            address = ctypes.addressof(_START.from_buffer(array))
            rows.append((address, array.shape[0], array.shape[1] if array.ndim > 1 else 1))
        self.table = np.array(rows, dtype=np.int64)
        self.address: int = self.table.__array_interface__["data"][0]
        self._as_parameter_ = self.address  # what ctypes passes to a compiled kernel
