"""The numbers that a check lets through, found by asking it."""

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
    {'right': 'a number from 0 to 1', 'least': 0.0, 'most': 1.0}
    """
    right = ""
    try:
        check("x", None)
    except InvalidType as error:
        right = str(error).removeprefix("x must be ").removesuffix(", got None")

    def holds(value: float) -> bool:
        try:
            check("x", value)
        except InvalidValue:
            return False
        return True

    inside = next(value for value in (1.0, 0.5, 2.0, -1.0, 0.0, 1e3, 1e-3) if holds(value))
    return {
        "right": right,
        "least": _last(holds, inside, -sys.float_info.max),
        "most": _last(holds, inside, sys.float_info.max),
    }


def _last(holds: Callable[[float], bool], inside: float, outside: float) -> float:
    """Return the last number from `inside` towards `outside` for which something holds."""
    if holds(outside):
        return outside
    near, far = inside, outside
    middle = 0.5 * (near + far)
    while middle not in (near, far):
        if holds(middle):
            near = middle
        else:
            far = middle
        middle = 0.5 * (near + far)
    return near
