"""Units at the border: "58 mm" -> 0.058. Inside, everything is SI and a plain float."""

import functools
import math
import re
from collections.abc import Iterable
from dataclasses import dataclass
from decimal import Decimal
from typing import TYPE_CHECKING, Annotated, Any, get_args, get_origin

from stackbounce.errors import InvalidType, UnitError, finite, shown

if TYPE_CHECKING:
    import pint

__all__ = ["Unit", "factor", "handy", "in_si", "quantity", "rounded", "unit_of"]

_NUMBER = r"[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]{1,4})?"
_WRITTEN = re.compile(rf"({_NUMBER})\s*(.*)", re.DOTALL)
# What is handed to pint: names with small powers, nothing that could be a long computation.
_TERM = r"[^\W\d_]+(?:(?:\*\*|\^)-?\d(?:\.\d{1,3})?)?"
_UNIT = re.compile(rf"%|{_TERM}(?:\s*[*/·\s]\s*{_TERM}){{0,5}}")
_KINDS = {
    "": ("a pure number", "0.78"),
    "kg": ("a mass", "150 g"),
    "m": ("a length", "58 mm"),
    "s": ("a time", "30 ms"),
    "m/s": ("a speed", "3.53 m/s"),
    "m/s**2": ("an acceleration", "9.81 m/s^2"),
    "N/m": ("a stiffness", "20 kN/m"),
    "N s/m": ("a damping", "7 N s/m"),
    "s/m": ("a dissipation", "0.2 s/m"),
    "Pa": ("a pressure", "210 GPa"),
}

_HANDY = {  # unit: (from this value on, its name, how many of it the unit has), largest first
    "m": ((0.1, "m", 1.0), (1e-4, "mm", 1e3), (0.0, "µm", 1e6)),
    "s": ((1.0, "s", 1.0), (1e-3, "ms", 1e3), (0.0, "µs", 1e6)),
    "kg": ((1.0, "kg", 1.0), (1e-3, "g", 1e3), (0.0, "mg", 1e6)),
}

# The SI units that columns of measurements come in, and how programs write the commonest ones.
_SI = ("s", "m", "N", "V", "1", "m/s", "m/s^2", "kg", "J", "Pa", "Hz", "A", "N/m", "N s", "kg m/s")
_WRITTEN_OUT = {
    "m/s²": "m/s^2", "m/s/s": "m/s^2", "ms^-2": "m/s^2", "m/s2": "m/s^2", "g0": "standard_gravity",
    "sec": "s", "secs": "s", "second": "s", "seconds": "s", "Second": "s", "Seconds": "s",
    "msec": "ms", "us": "µs", "μs": "µs", "μm": "µm", "μV": "µV",
    "Volt": "V", "Volts": "V", "volt": "V", "volts": "V", "newton": "N", "Newton": "N", "lbs": "lb",
}  # fmt: skip
_PIXEL = re.compile(r"px|pix|pixels?|dots?", re.IGNORECASE)  # a length on paper to pint
_PREFIXES = {"k": 1e3, "": 1.0, "c": 1e-2, "m": 1e-3, "µ": 1e-6, "n": 1e-9}
_COMMON = {f"{p}{unit}": (size, unit) for p, size in _PREFIXES.items() for unit in "smNV"} | {
    "m/s": (1.0, "m/s"),
    "m/s^2": (1.0, "m/s^2"),
}


@dataclass(frozen=True)
class Unit:
    """The unit of a field, to be written as ``Annotated[float, Unit("kg")]``.

    Parameters
    ----------
    symbol : str
        The SI unit; empty for a pure number. ``exponent`` in it stands for the field of that name.

    Examples
    --------
    >>> Unit("kg").symbol
    'kg'
    """

    symbol: str = ""


def unit_of(hint: Any) -> Unit | None:
    """Return the unit that a type hint carries, however deep, or None.

    Examples
    --------
    >>> unit_of(Annotated[float, Unit("kg")] | None)
    Unit(symbol='kg')
    """
    if get_origin(hint) is Annotated:
        return next((note for note in hint.__metadata__ if isinstance(note, Unit)), None)
    return next((unit for unit in map(unit_of, get_args(hint)) if unit is not None), None)


def quantity(value: object, unit: str, name: str = "value") -> float:
    """Return a number, or a string that carries a unit, as a float in `unit`.

    Parameters
    ----------
    value : float or str
        A number (or a string with nothing but a number), taken to be in `unit` already, or a
        string with a number and a unit, such as ``"58 mm"`` or ``"9.81 m/s^2"``.
    unit : str
        The SI unit that is wanted, such as ``"m"``; empty for a pure number.
    name : str, optional
        What the value is called; messages begin with it.

    Returns
    -------
    float
        The value in `unit`.

    Raises
    ------
    InvalidType
        If `value` is neither a number nor a string.
    InvalidValue
        If it is NaN or infinite.
    UnitError
        If the string cannot be read, or its unit is unknown or does not fit.

    Examples
    --------
    >>> quantity("58 mm", "m")
    0.058
    >>> quantity(0.058, "m")
    0.058
    """
    if not isinstance(value, str):
        try:
            return finite(name, value, unit)
        except InvalidType as error:
            raise InvalidType(_message(name, value, unit)) from error
    found = _WRITTEN.fullmatch(value.strip())
    if not found:
        raise UnitError(_message(name, value, unit))
    number, written = found[1], found[2]
    if not written:
        return finite(name, float(number), unit)
    factor = _factor(written, unit, _message(name, value, unit))
    # In decimals, so that "24.8 g" is 0.0248 to the last digit.
    return finite(name, float(Decimal(number) * Decimal(repr(factor))), unit)


def factor(written: str, unit: str, name: str = "value") -> float:
    """Return how much of an SI unit one of another unit is; see `quantity`.

    Examples
    --------
    >>> factor("g", "kg")
    0.001
    """
    return _factor(written, unit, _message(name, written, unit))


@functools.lru_cache(maxsize=1000)
def in_si(written: str, *, common: bool = False) -> tuple[float, str] | None:
    """Return how much of which SI unit one of a unit is, whatever it measures.

    Parameters
    ----------
    written : str
        The unit, as the header of a column has it.
    common : bool, optional
        Know only those units that measurements of bounces are written in: seconds, metres, newtons
        and volts with their prefixes, where any letter could be meant as a unit or not.

    Returns
    -------
    tuple of float and str, or None
        None where no unit is written that is known and proportional to an SI unit: a pixel and a
        degree Celsius are not.

    Examples
    --------
    >>> in_si("ms"), in_si("kN"), in_si("px")
    ((0.001, 's'), (1000.0, 'N'), None)
    """
    written = _WRITTEN_OUT.get(written.strip(), written.strip())
    if written in _COMMON or common:
        return _COMMON.get(written)
    if not written or len(written) > 30 or _PIXEL.fullmatch(written):
        return None
    for unit in _SI:
        try:
            return _factor(written, unit, ""), unit
        except UnitError:
            continue
    return None


def _factor(written: str, unit: str, message: str) -> float:
    import pint

    if not _UNIT.fullmatch(written):
        raise UnitError(message)
    registry = _registry()
    try:
        units = registry.parse_units(written.replace("·", "*"))
        if registry.Quantity(0.0, units).m_as(unit) != 0.0:  # decibels and the like
            raise UnitError(message)
        return float(registry.Quantity(1.0, units).m_as(unit))
    except pint.UndefinedUnitError as error:
        raise UnitError(f"{message}, of unknown unit") from error
    except (pint.PintError, ArithmeticError) as error:
        raise UnitError(message) from error


def _message(name: str, value: object, unit: str) -> str:
    kind, example = _KINDS.get(unit, ("a quantity", f"20 {unit}"))
    number = f"a number of {unit}" if unit else "a number"
    right = f'{kind} ({number} or a string such as "{example}")'
    return f"{name} must be {right}, got {shown(value)}"


@functools.cache
def _registry() -> "pint.UnitRegistry[float]":
    import pint

    return pint.UnitRegistry()


def handy(most: float, unit: str) -> tuple[str, float]:
    """Return the unit in which numbers up to some size are handy, and what to multiply them by.

    Examples
    --------
    >>> handy(0.002, "m"), handy(2500.0, "N/m")
    (('mm', 1000.0), ('N/m', 1.0))
    """
    choices = _HANDY.get(unit, ()) if most > 0.0 else ()
    return next(((name, by) for start, name, by in choices if most >= start), (unit, 1.0))


def rounded(values: Iterable[float], error: float) -> list[str]:
    """Return numbers as texts that end where an error of theirs has two digits.

    Examples
    --------
    >>> rounded((1048.807, 44.268), 44.268), rounded((0.99459, 0.0123), 0.0123)
    (['1049', '44'], ['0.995', '0.012'])
    """
    if not (math.isfinite(error) and error > 0.0):
        return [f"{value:.4g}" for value in values]
    places = 1 - math.floor(math.log10(error))
    if not -6 < places < 8:
        return [f"{value:.3g}" for value in values]
    return [f"{value:.{max(0, places)}f}" for value in values]
