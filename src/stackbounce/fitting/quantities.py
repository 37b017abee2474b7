"""What was measured of a drop: the names of quantities, and numbers with errors."""

from collections.abc import Sequence
from typing import Any

from stackbounce.errors import InvalidValue, one_of, shown
from stackbounce.measure.quantities import LARGEST, deviation, quantity_with_error
from stackbounce.model import Drop
from stackbounce.run.quantities import QUANTITIES
from stackbounce.units import magnitude, quantity


def find_quantity(drop: Drop, name: str, path: str) -> tuple[str, int]:
    """Return the quantity and the index of a name such as ``rebound_ratios.1``.

    Parameters
    ----------
    drop : Drop
        The drop, for the number of its balls.
    name : str
        A quantity, with the number of its ball or contact unless it belongs to the whole stack.
    path : str
        The name in messages.

    Returns
    -------
    quantity : str
    index : int
        0 for the whole stack.

    Raises
    ------
    InvalidValue
        If there is no such quantity, ball or contact.

    Examples
    --------
    >>> import stackbounce as sb
    >>> drop = sb.Drop([sb.Ball(1.0)], [sb.Spring(1.0)], height=1.0)
    >>> find_quantity(drop, "rebound_ratios.0", "measured")
    ('rebound_ratios', 0)
    """
    base, dot, index = name.partition(".")
    one_of(base, [*QUANTITIES, "force.0"], f"{path[:60]} is not a measured quantity")
    part = QUANTITIES[base].part
    if not part and dot:
        raise InvalidValue(f"{path}: {base} is of the whole stack and takes no number")
    return base, read_index(drop, part, index, path) if part else 0


def read_index(drop: Drop, part: str, index: str, path: str) -> int:
    """Return the number of a ball or contact at the end of a name.

    Examples
    --------
    >>> import stackbounce as sb
    >>> drop = sb.Drop([sb.Ball(1.0)], [sb.Spring(1.0)], height=1.0)
    >>> read_index(drop, "ball", "0", "rebound_ratios.0")
    0
    """
    last = len(drop.balls) - 1
    if index not in map(str, range(last + 1)):
        raise InvalidValue(f"{path[:60]} must end in the number of a {part} from 0 to {last}")
    return int(index)


def read_with_error(given: object, unit: str, name: str, right: str) -> tuple[float, float]:
    """Return a number and its error in SI units, from a text, a pair or a UFloat.

    Parameters
    ----------
    given : str, (float or str, float or str), or UFloat
        The number with its error, one standard deviation above 0.
    unit : str
        The SI unit.
    name, right : str
        The number, and the form that is expected, in error messages.

    Raises
    ------
    InvalidValue
        If it is no number with an error, the number is not finite, or the error not above 0.

    Examples
    --------
    >>> read_with_error("1.64 ± 0.02", "", "rebound_ratios.1", "a number with its error")
    (1.64, 0.02)
    """
    pair: Any = magnitude(given, unit, name)
    pair = quantity_with_error(pair, unit, name) if isinstance(pair, str) else pair
    if hasattr(pair, "nominal_value"):
        pair = (pair.nominal_value, pair.std_dev)
    if not isinstance(pair, Sequence) or isinstance(pair, str) or len(pair) != 2:
        raise InvalidValue(f"{name} must be {right}, got {shown(given)}")
    value, error = (quantity(part, unit, name) for part in pair)
    deviation(name, error, zero=False)
    if not abs(value) <= LARGEST * error:
        raise InvalidValue(f"{name} must be at most {LARGEST:g} of its errors, got {shown(given)}")
    return value, error
