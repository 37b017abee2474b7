"""Units of user input: "58 mm" -> 0.058. Inside the package all numbers are SI floats."""

import functools
import math
import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from numbers import Real
from typing import Annotated, Any, get_args, get_origin, get_type_hints

from stackbounce.errors import InvalidType, InvalidValue, UnitError, all_real, finite, shown
from stackbounce.files import shipped_table
from stackbounce.library_types import UnitRegistry

_NUMBER = r"[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]{1,4})?"
_WRITTEN = re.compile(rf"({_NUMBER})\s*(.*)", re.DOTALL)
# What pint may parse: names with small powers, so that no input causes a long computation.
_TERM = r"[^\W\d_]+(?:(?:\*\*|\^)-?\d(?:\.\d{1,3})?)?"
_WITH_ERROR = re.compile(r"±|\+/-|[0-9] ?\([0-9.]+\)")  # 63 ± 1 cm, 63(1) cm
_COMMA = re.compile(r"\s*[-+]?\d+,\d")  # 1,5 m
_POWER = re.compile(r"(?<=[^\W\d_])(?=-\d)|(?<=[ms])(?=[23]\b)")  # m s-1, kg/m3
_SIGNS = str.maketrans("⁻¹²³μ", "-123µ", "{}")  # m s⁻¹, s^{-1}, a Greek letter for micro
_DOT = re.compile(r"(?<=[^\W\d_])\.(?=[^\W\d_])")  # m.s-1
_UNIT = re.compile(rf"%|{_TERM}(?:\s*[*/·\s]\s*{_TERM}){{0,5}}")
_TABLE = shipped_table(__package__, "units.toml")
_KINDS = {unit: (kind, example) for unit, (kind, example) in _TABLE["kinds"].items()}

WORDS = {"kilograms": "kg", "metres": "m", "seconds": "s", "newtons": "N", "pascals": "Pa"}
"""The unit of each of the words of messages."""

# The SI units that columns of measurements come in.
_SI = ("s", "m", "N", "V", "1", "m/s", "m/s^2", "kg", "J", "Pa", "Hz", "A", "N/m", "N s", "kg m/s")
# What needs no pint, whose import takes a quarter of a second: decimal powers of the prefixes, and
# of each unit the same and its powers of kg, m, s and A.
_POWERS = {"G": 9, "M": 6, "k": 3, "": 0, "c": -2, "m": -3, "µ": -6, "u": -6, "n": -9}
_DECIMAL = {
    "g": (-3, (1, 0, 0, 0)), "m": (0, (0, 1, 0, 0)), "s": (0, (0, 0, 1, 0)), "A": (0, (0, 0, 0, 1)),
    "N": (0, (1, 1, -2, 0)), "Pa": (0, (1, -1, -2, 0)), "J": (0, (1, 2, -2, 0)),
    "V": (0, (1, 2, -3, -1)), "Hz": (0, (0, 0, -1, 0)),
}  # fmt: skip
_NAMED = {
    p + unit: (_POWERS[p] + own[0], own[1]) for p in _POWERS for unit, own in _DECIMAL.items()
}
_NAMED |= {"%": (-2, (0, 0, 0, 0)), "1": (0, (0, 0, 0, 0))}
# pint takes these for lengths on paper, and for grains, which are 65 mg
_OTHERS = re.compile(r"px|pix|pixels?|dots?|grs?", re.IGNORECASE)
_COMMON = {p + unit: (float(f"1e{_POWERS[p]}"), unit) for p in ("", *"kcmµn") for unit in "smNV"}
_COMMON |= {unit: (1.0, unit) for unit in ("m/s", "m/s^2")}


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


@functools.cache
def units_of(kind: Any) -> dict[str, Unit]:
    """Return the units of a class's fields, by field; those without one are left out."""
    hints = get_type_hints(kind, include_extras=True)
    return {name: unit for name, hint in hints.items() if (unit := unit_of(hint))}


def quantity(value: object, unit: str, name: str = "value") -> float:
    """Return a number, or a string that carries a unit, as a float in `unit`.

    Parameters
    ----------
    value : float, str or quantity
        A number or a string of a number, in `unit`, or a string of a number and a unit, such as
        ``"58 mm"`` or ``"9.81 m/s^2"``; or a quantity of pint, of any registry.
    unit : str
        The SI unit of the result, such as ``"m"``; empty for a pure number.
    name : str, optional
        The name of the value; messages begin with it.

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
        If the string cannot be parsed, its unit is unknown or of another dimension, or the number
        has an error.

    Examples
    --------
    >>> quantity("58 mm", "m")
    0.058
    >>> quantity(0.058, "m")
    0.058
    """
    number = magnitude(value, unit, name)
    value = str(value) if hasattr(number, "std_dev") else number
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
    from decimal import Decimal  # its arithmetic makes "24.8 g" exactly 0.0248

    times = factor(written, unit, name, value)
    return finite(name, float(Decimal(number) * Decimal(repr(times))), unit)


def in_unit(value: object, unit: str, name: str) -> Any:
    """Return a value as it is, but a float in `unit` for one that may have a unit of its own.

    So is each member of a list, and an array of pint becomes one of numpy. What has no unit is
    validated where it is used. See `quantity` for what is raised.

    Examples
    --------
    >>> in_unit("58 mm", "m", "diameter"), in_unit(["2 mm", 0], "m", "gaps")
    (0.058, [0.002, 0])
    """
    if type(value) is float or isinstance(value, Real):
        return value
    if isinstance(value, list | tuple):
        return [
            part if type(part) is float else in_unit(part, unit, f"{name}.{i}")
            for i, part in enumerate(value)
        ]
    if getattr(value, "ndim", 0):
        return magnitude(value, unit, name)
    own = isinstance(value, str) or any(hasattr(value, of) for of in ("m_as", "std_dev", "attrs"))
    return quantity(value, unit, name) if own else value


def checked(check: Callable[..., float], name: str, value: object, of: str = "") -> float:
    """Return a number, which may have a unit, as a float in SI units if it passes a check.

    Parameters
    ----------
    check : callable
        One of those in `stackbounce.errors`, such as `positive`.
    name : str
        The name of the value; messages begin with it.
    value : float, str or quantity
        As of `quantity`.
    of : str, optional
        The unit in words, as in messages; empty for a pure number.

    Examples
    --------
    >>> from stackbounce.errors import positive
    >>> checked(positive, "mass", "57 g", "kilograms")
    0.057
    """
    number = value if type(value) is float else in_unit(value, WORDS.get(of, of), name)
    return check(name, number, of) if of else check(name, number)


def magnitude(value: Any, unit: str, name: str) -> Any:
    """Return the number, or numbers, in `unit` of a quantity of pint or an array of xarray.

    What has no unit, of pint or as the attribute ``units``, is returned as it is.

    Examples
    --------
    >>> import pint
    >>> magnitude(pint.Quantity([1.0, 2.0], "mm"), "m", "gaps").tolist()
    [0.001, 0.002]
    """
    if hasattr(value, "m_as"):
        try:
            return value.m_as(unit)
        except Exception:  # each registry has classes of its own
            raise UnitError(_message(name, str(value), unit)) from None
    if not (hasattr(value, "attrs") and hasattr(value, "dtype")):
        return value
    import numpy as np

    written, numbers = str(value.attrs.get("units") or "1"), np.asarray(value)[()]
    return numbers if written in ("1", unit) else factor(written, unit, name) * numbers


def numbers_in(values: object, unit: str, name: str) -> Any:
    """Return numbers, which may have units of their own, as an array (n,) in an SI unit.

    Raises
    ------
    InvalidType
        If one is not a real number.
    InvalidValue
        If one is not finite, where they are no array, or they have more than one dimension.

    Examples
    --------
    >>> numbers_in(["10 ms", 0.02], "s", "times").tolist()
    [0.01, 0.02]
    """
    import numpy as np

    given = in_unit(all_real(name, values), unit, name)
    try:
        # Without an array's type, numpy would make one of [1.0, True] and of [1.0, "2"].
        table = np.asarray(given, dtype=None if hasattr(given, "dtype") else object)
    except Exception:
        raise InvalidType(f"{name} must be a list of numbers, got {shown(given)}") from None
    if table.ndim > 1:
        raise InvalidValue(f"{name} must be a list of numbers, got an array of {table.ndim} axes")
    if table.dtype.kind in "iuf" and table.ndim:
        return table.astype(float)
    of = next((word for word, known in WORDS.items() if known == unit), unit)
    if table.ndim == 0:
        return np.array([finite(name, table[()], of)])
    return np.array([finite(f"{name}.{i}", number, of) for i, number in enumerate(table)])


def unit_written(text: str) -> str | None:
    """Return the unit in the text of a quantity, empty if it has none; None of no quantity.

    Examples
    --------
    >>> unit_written("58 mm"), unit_written("58")
    ('mm', '')
    """
    found = _WRITTEN.fullmatch(text.strip())
    return found[2] if found and (not found[2] or _UNIT.fullmatch(_powers(found[2]))) else None


def _powers(written: str) -> str:
    """Return a unit in which the mark of a power stands before each: m s-1 -> m s^-1."""
    return _DOT.sub("·", _POWER.sub("^", written.translate(_SIGNS)))


def count_written(text: str) -> int | None:
    """Return the whole number that a text is; None of anything else, or of more than 18 digits.

    Examples
    --------
    >>> count_written("400"), count_written("-1"), count_written("9" * 5000)
    (400, None, None)
    """
    return int(text) if text.isdecimal() and len(text) <= 18 else None


def factor(written: str, unit: str, name: str = "value", of: str | None = None) -> float:
    """Return the factor that converts a unit to an SI unit; see `quantity`.

    Messages show the quantity that it is of, or else the unit.

    Examples
    --------
    >>> factor("g", "kg"), factor("kg m-3", "kg/m**3")
    (0.001, 1.0)
    """
    message, written = _message(name, of or written, unit), _powers(written)
    if not _UNIT.fullmatch(written) or _OTHERS.fullmatch(written):
        raise UnitError(message)
    known, right = _decimal(written), _decimal(unit)
    if known and right:
        if known[1] != right[1]:
            raise UnitError(message)
        if (power := known[0] - right[0]).is_integer():
            return float(f"1e{power:.0f}")
    import pint

    registry = _registry()
    try:
        units = registry.parse_units(written.replace("·", "*"))
        if registry.Quantity(0.0, units).m_as(unit) != 0.0:  # decibels and the like
            raise UnitError(message)
        return float(registry.Quantity(1.0, units).m_as(unit))
    except pint.UndefinedUnitError as error:
        raise UnitError(f"{message}, of unknown unit") from error
    except (pint.PintError, ArithmeticError, ValueError) as error:  # ValueError: of "nan"
        raise UnitError(message) from error


@functools.lru_cache(maxsize=1000)
def in_si(written: str, *, common: bool = False) -> tuple[float, str] | None:
    """Return the factor and the SI unit of a unit of any dimension.

    Parameters
    ----------
    written : str
        The unit, as in the header of a column.
    common : bool, optional
        Accept only the usual units of bounce measurements: seconds, metres, newtons and volts with
        prefixes. This is for headers in which a letter need not be a unit.

    Returns
    -------
    tuple of float and str, or None
        None for an unknown unit and for one that is not proportional to an SI unit, such as a pixel
        or a degree Celsius.

    Examples
    --------
    >>> in_si("ms"), in_si("kN"), in_si("px")
    ((0.001, 's'), (1000.0, 'N'), None)
    >>> in_si("m s-1"), in_si("m s⁻¹"), in_si("ms-2"), in_si("m/s²")
    ((1.0, 'm/s'), (1.0, 'm/s'), (1.0, 'm/s^2'), (1.0, 'm/s^2'))
    """
    written = _TABLE["written_out"].get(plain := _powers(written.strip()), plain)
    if written in _COMMON or common:
        return _COMMON.get(written)
    if not written or len(written) > 30 or _OTHERS.fullmatch(written):
        return None
    for unit in _SI:
        try:
            return factor(written, unit), unit
        except UnitError:
            continue
    return None


def _decimal(written: str) -> tuple[float, tuple[float, ...]] | None:
    """Return a unit's power of ten and powers of kg, m, s and A; None if the table lacks it.

    Examples
    --------
    >>> _decimal("kN/m"), _decimal("inch")
    ((3.0, (1.0, 0.0, -2.0, 0.0)), None)
    """
    above, slash, below = written.replace("**", "^").partition("/")
    terms = [(term, 1.0) for term in re.split(r"[\s*·]+", above)] if above else []
    power, powers = 0.0, [0.0, 0.0, 0.0, 0.0]
    for term, sign in terms + [(below, -1.0)] * len(slash):
        name, _, times = term.partition("^")
        if name not in _NAMED or not re.fullmatch(r"(-?\d(\.\d{1,3})?)?", times):
            return None
        times = sign * float(times or 1)
        power += times * _NAMED[name][0]
        powers = [old + times * own for old, own in zip(powers, _NAMED[name][1], strict=True)]
    return power, tuple(powers)


def _message(name: str, value: object, unit: str) -> str:
    kind, example = _KINDS.get(unit.replace("^", "**"), ("a quantity", f"20 {unit}"))
    number = f"a number of {unit}" if unit else "a number"
    right = f'{kind} ({number} or a string such as "{example}")'
    if isinstance(value, str) and _WITH_ERROR.search(value):
        right = f'{kind} without an error here (predict takes one), such as "{example}"'
    message = f"{name} must be {right}, got {shown(value)}"
    comma = isinstance(value, str) and _COMMA.match(value)
    return f"{message}, which needs a decimal point" if comma else message


@functools.cache
def _registry() -> "UnitRegistry[float]":
    import pint

    return pint.UnitRegistry()


def examples() -> dict[str, tuple[str, str]]:
    """Return what a quantity of a unit is called in messages, and an example of it, by unit.

    Examples
    --------
    >>> examples()["kg"]
    ('a mass', '150 g')
    """
    return dict(_KINDS)


def handy(most: float, unit: str) -> tuple[str, float]:
    """Return the unit in which numbers up to some size are handy, and what to multiply them by.

    Examples
    --------
    >>> handy(0.002, "m"), handy(2500.0, "N/m")
    (('mm', 1000.0), ('N/m', 1.0))
    """
    choices = _TABLE["handy"].get(unit, ()) if most > 0.0 else ()
    return next(((name, by) for start, name, by in choices if most >= start), (unit, 1.0))


def handy_text(value: float, unit: str, digits: int = 6) -> str:
    """Return a number with so many digits in the unit in which it is handy.

    Examples
    --------
    >>> handy_text(0.15, "kg"), handy_text(0.002, "m"), handy_text(2500.0, "N/m")
    ('150 g', '2 mm', '2500 N/m')
    """
    name, by = handy(abs(value), unit)
    return f"{by * value:.{digits}g} {name.replace('**', '^')}".strip()


def rounded(values: Iterable[float], error: float) -> list[str]:
    """Return numbers as texts that end where an error of theirs has two digits.

    Examples
    --------
    >>> rounded((1048.807, 44.268), 44.268), rounded((0.99459, 0.0123), 0.0123)
    (['1049', '44'], ['0.995', '0.012'])
    >>> rounded((0.00963, 9.8e-7), 9.8e-7)
    ['0.00963000', '9.8e-07']
    """
    if not (math.isfinite(error) and error > 0.0):
        return [f"{value:.4g}" for value in values]
    places = 1 - math.floor(math.log10(error))
    if not -6 < places < 8:
        digits = ((value, places + 1 + math.log10(abs(value) or error)) for value in values)
        return [f"{x:#.{int(min(max(2, count), 17))}g}".removesuffix(".") for x, count in digits]
    return [f"{value:.{max(0, places)}f}" for value in values]
