"""What a file of measurements does not say: numbers of the ball and the drop, with their units."""

from typing import Any

from stackbounce.units import quantity

__all__ = ["NUMBERS", "told_number"]

NUMBERS = {
    "mass": "kg",
    "diameter": "m",
    "height": "m",
    "speed": "m/s",
    "contact_time": "s",
    "restitution": "",
    "height_error": "m",
    "floor": "m",
    "time_constant": "s",
    "gravity": "m/s**2",
}
"""The numbers that `analyse` takes, and their SI units."""

_PLAIN = ("height_error", "floor", "time_constant", "gravity")  # have no error of their own


def told_number(name: str, value: Any, path: str) -> Any:
    """Return one of `NUMBERS` in its SI unit, with its error if a text has one.

    Parameters
    ----------
    name : str
        Which.
    value : float or str
        In the SI unit, or a text such as ``"57.0 ± 0.5 g"``.
    path : str
        What messages call it.

    Returns
    -------
    float or ufloat

    Raises
    ------
    InvalidValue, InvalidType
        If it cannot be read.

    Examples
    --------
    >>> print(told_number("mass", "57.0 ± 0.5 g", "mass"))
    0.0570+/-0.0005
    """
    from stackbounce.measure.uncertain_numbers import quantity_with_error

    if name in _PLAIN or not isinstance(value, str):
        return quantity(value, NUMBERS[name], path)
    return quantity_with_error(value, NUMBERS[name], path)
