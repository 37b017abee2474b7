"""Bytes of plain numbers, as many in each line -> an array: most long files are that."""

import numpy as np
from numpy.typing import NDArray

from stackbounce.engine.compiler import kernel

__all__ = ["POWERS", "grid"]

POWERS = 10.0 ** np.arange(23)
"""Powers of ten that are exact."""

_FULL = 900719925474098  # ten times that and nine more is below 2**53


@kernel
def grid(
    raw: NDArray[np.uint8],
    delimiter: int,
    decimal: int,
    longest: int,
    places: NDArray[np.int64],
    powers: NDArray[np.float64],
    values: NDArray[np.float64],
) -> int:
    r"""Write the numbers of lines that all have as many; return how many lines, or -1.

    A whole number below 2**53 over, or times, an exact power of ten is rounded once: the result is
    the number that is nearest to the text, as Python's ``float`` gives it (W. D. Clinger, "How to
    read floating point numbers accurately", 1990). Whatever else there is makes it give up.

    Parameters
    ----------
    raw : ndarray
        (bytes,) lines with a line feed between them.
    delimiter, decimal : int
        Codes of what separates cells, and of the decimal mark (-1 for none).
    longest : int
        Bytes of a line, at most.
    places : ndarray
        (cells,) where each cell of a line goes, -1 for nowhere.
    powers : ndarray
        `POWERS`.
    values : ndarray
        (lines, columns) to write to.

    Returns
    -------
    int
        -1 where a cell is no plain number, or has more than 15 digits, or a line other cells.

    Examples
    --------
    >>> values = np.zeros((2, 2))
    >>> raw = np.frombuffer(b"0.1;-2\n1e-3;3.25", dtype=np.uint8)
    >>> grid(raw, ord(";"), ord("."), 100, np.array([1, 0]), POWERS, values), values.tolist()
    (2, [[-2.0, 0.1], [3.25, 0.001]])
    """
    at, row, size = 0, 0, len(raw)
    while at < size:
        if row == len(values):
            return -1
        start = at
        for column in range(len(places)):
            negative = at < size and raw[at] == 45  # -
            if at < size and (raw[at] == 45 or raw[at] == 43):  # +
                at += 1
            whole, digits, power = 0, 0, 0
            fraction = False
            while at < size:
                code = int(raw[at])
                if 48 <= code <= 57:  # 0 to 9
                    if whole > _FULL:
                        return -1
                    whole = 10 * whole + (code - 48)
                    digits += 1
                    power -= fraction
                elif code == decimal and not fraction:
                    fraction = True
                else:
                    break
                at += 1
            if digits == 0:
                return -1
            if at < size and (raw[at] == 69 or raw[at] == 101):  # E, e
                at += 1
                down = at < size and raw[at] == 45
                if at < size and (raw[at] == 45 or raw[at] == 43):
                    at += 1
                exponent, digits = 0, 0
                while at < size and 48 <= raw[at] <= 57 and digits < 4:
                    exponent = 10 * exponent + (int(raw[at]) - 48)
                    digits += 1
                    at += 1
                if digits == 0:
                    return -1
                power += -exponent if down else exponent
            if abs(power) >= len(powers):
                return -1
            mark = int(raw[at]) if at < size else 10  # line feed
            if mark != (delimiter if column < len(places) - 1 else 10):
                return -1
            at += 1
            if places[column] >= 0:
                value = whole / powers[-power] if power < 0 else whole * powers[power]
                values[row, places[column]] = -value if negative else value
        if at - start > longest:
            return -1
        row += 1
    return row
