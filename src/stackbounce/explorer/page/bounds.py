"""The numbers that a check lets through, found by asking it."""

import struct
import sys
from collections.abc import Callable
from typing import Any

from stackbounce.errors import InvalidType, InvalidValue


def limits_of(check: Callable[[str, object], float]) -> dict[str, Any]:
    """Return the least and the largest number that a check lets through, and its words.

    The numbers that a check lets through are an interval. Its ends are found by bisection, to the
    last bit.

    Examples
    --------
    >>> from stackbounce.errors import fraction
    >>> limits_of(fraction)
    {'words': 'a number from 0 to 1', 'least': 0.0, 'most': 1.0}
    """
    words = ""
    try:
        check("x", None)
    except InvalidType as error:
        words = str(error).removeprefix("x must be ").removesuffix(", got None")

    def holds(value: float) -> bool:
        try:
            check("x", value)
        except InvalidValue:
            return False
        return True

    inside = next(value for value in (1.0, 0.5, 2.0, -1.0, 0.0, 1e3, 1e-3) if holds(value))
    return {
        "words": words,
        "least": _last(holds, inside, -sys.float_info.max),
        "most": _last(holds, inside, sys.float_info.max),
    }


def _last(holds: Callable[[float], bool], inside: float, outside: float) -> float:
    """Return the last number from `inside` towards `outside` for which something holds."""
    if holds(outside):
        return outside
    near, far = _rank(inside), _rank(outside)
    while abs(far - near) > 1:
        middle = (near + far) // 2
        near, far = (middle, far) if holds(_ranked(middle)) else (near, middle)
    return _ranked(near)


def _rank(value: float) -> int:
    """Return the place of a number among all floats."""
    (bits,) = struct.unpack("<q", struct.pack("<d", abs(value)))
    return int(bits) if value >= 0.0 else -int(bits)


def _ranked(rank: int) -> float:
    (size,) = struct.unpack("<d", struct.pack("<q", abs(rank)))
    return float(size) if rank >= 0 else -float(size)
