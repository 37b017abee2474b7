"""Quantities with errors: read, of a function of measured numbers, and in rows of a result."""

import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from stackbounce.errors import InvalidValue, finite, positive
from stackbounce.units import WORDS, checked, magnitude, quantity, unit_written

# 1.64(2)e3 m: the number, its decimals, the error of its last digits, the power of ten, the unit.
_SHORT = re.compile(
    r"([-+]?[0-9]+)(?:\.([0-9]*))?\s*\(([0-9]+\.?[0-9]*)\)(?:[eE]([-+]?[0-9]{1,3}))?\s*([^±]*)"
)

_BOTH = re.compile(r"\(([^()]*)\)\s*([^()]*)")  # (57.0 ± 0.5) g

LARGEST = 1e100
"""The largest error in SI units, so that its square is a number, too."""

Array: TypeAlias = NDArray[np.float64]
Pair: TypeAlias = tuple[Array, Array]
Mask: TypeAlias = NDArray[np.bool_]
Samples: TypeAlias = NDArray[np.float32]

Number: TypeAlias = Any
"""A number with an error: a ``UFloat`` of `uncertainties`, which ships no types."""

_DERIVATIVE_STEP = 1e-4  # relative, of the central differences; runs repeat to about 1e-10
_ANY = (-np.inf, np.inf)


class Row(NamedTuple):
    """A quantity that was found: its name, its value (with an error if it has one) and SI unit."""

    name: str
    value: Number | float | int | str
    unit: str = ""


def known_rows(rows: Iterable[tuple[str, Any, str]]) -> list[Row]:
    """Return names, values and units as rows, those of None left out."""
    return [Row(*row) for row in rows if row[1] is not None]


def nominal(number: Any) -> float:
    """Return a number without its error.

    Examples
    --------
    >>> nominal(known_to(0.057, 0.001)), nominal(1)
    (0.057, 1.0)
    """
    return float(getattr(number, "nominal_value", number))


def known_to(value: float, error: float) -> Number:
    """Return a UFloat with an independent error, which may be 0.

    Examples
    --------
    >>> known_to(0.057, 0.001), known_to(0.057, 0.0)
    (0.057+/-0.001, 0.057+/-0)
    """
    from uncertainties import UFloat, ufloat
    from uncertainties.core import LinearCombination

    # ufloat warns of an error of 0
    return ufloat(value, error) if error > 0.0 else UFloat(value, LinearCombination({}))


def measured(
    name: str, value: object, of: str = "", check: Callable[..., float] = positive
) -> Number:
    """Return a number, or a number with an error, as one with an error (0 if it has none).

    Parameters
    ----------
    name : str
        What it is called; messages begin with it.
    value : float, str, UFloat or quantity
        The value, also with a unit, as of `stackbounce.units.quantity`, and an error. A UFloat
        is returned as the same variable, which keeps its correlations.
    of : str, optional
        The unit in words, for the message.
    check : callable, optional
        What its nominal value must pass: by default `stackbounce.errors.positive`. It takes the
        name, the value, and the unit if there is one.

    Returns
    -------
    UFloat

    Raises
    ------
    InvalidType
        If it is no number.
    InvalidValue
        If its nominal value is out of range, or its error not finite.

    Examples
    --------
    >>> from uncertainties import ufloat
    >>> measured("mass", 0.057), measured("mass", ufloat(0.057, 0.001))
    (0.057+/-0, 0.057+/-0.001)
    >>> measured("mass", "57 g", "kilograms"), measured("mass", "57(1) g", "kilograms")
    (0.057+/-0, 0.057+/-0.001)
    """
    from uncertainties import UFloat

    unit = WORDS.get(of, of)
    known: Any = magnitude(value, unit, name)
    if isinstance(known, str):
        known = quantity_with_error(known, unit, name)
    if not isinstance(known, UFloat):
        return known_to(checked(check, name, known, of), 0.0)
    checked(check, name, known.nominal_value, of)
    deviation(name, known.std_dev)
    return known


def deviation(name: str, value: object, *, zero: bool = True) -> float:
    """Return the error of a number, one standard deviation, if its square is a number, too.

    Raises
    ------
    InvalidType
        If it is no number.
    InvalidValue
        If it is below 0, or 0 where `zero` is false, or above 1e100.

    Examples
    --------
    >>> deviation("mass", 1e200)
    Traceback (most recent call last):
    stackbounce.errors.InvalidValue: mass's error must be at most 1e+100, got 1e+200
    """
    found = (finite if zero else positive)(f"{name}'s error", value)
    if found < 0.0:
        raise InvalidValue(f"{name}'s error must be 0 or above, got {found:g}")
    if found > LARGEST:
        raise InvalidValue(f"{name}'s error must be at most {LARGEST:g}, got {found:g}")
    return found


def spread_of(values: Sequence[Number]) -> Array:
    """Return how far each number changes by one standard deviation of each variable, (N, V).

    Examples
    --------
    >>> from uncertainties import ufloat
    >>> x = ufloat(1.0, 0.5)
    >>> spread_of([x, 2.0 * x]).tolist()
    [[0.5], [1.0]]
    """
    slopes = [value.derivatives for value in values]
    sources = dict.fromkeys(source for slope in slopes for source in slope)
    errors = [[slope.get(source, 0.0) * source.std_dev for source in sources] for slope in slopes]
    return np.reshape(np.array(errors, dtype=float), (len(slopes), len(sources)))


def measured_if_given(name: str, value: Any, of: str = "", **how: Any) -> Number | None:
    """Return `measured` of a number; None stays None.

    Examples
    --------
    >>> measured_if_given("mass", 0.057), measured_if_given("mass", None)
    (0.057+/-0, None)
    """
    return None if value is None else measured(name, value, of, **how)


def quantity_with_error(text: str, unit: str, name: str, written: str = "") -> float | Number:
    """Read a number with a unit and, if the text has one, an error: ``"57.0 ± 0.5 g"``.

    Parameters
    ----------
    text : str
        A number; after it, if known, ``±`` or ``+/-`` and its error, or the error of its last
        digits in parentheses. A unit that only one of the two has is that of both.
    unit : str
        The SI unit that is wanted.
    name : str
        What it is called; messages begin with it.
    written : str, optional
        The unit of a text that has none; SI by default.

    Returns
    -------
    float or UFloat
        In `unit`; a float if the text has no error.

    Raises
    ------
    InvalidValue
        If a number is not finite, or the error not above 0.
    UnitError
        If it cannot be read, or the unit is unknown or does not fit.

    Examples
    --------
    >>> quantity_with_error("57 g", "kg", "mass"), quantity_with_error("(57.0 ± 0.5) g", "kg", "m")
    (0.057, 0.057+/-0.0005)
    >>> quantity_with_error("57 g ± 5", "kg", "mass"), quantity_with_error("57(5) g", "kg", "mass")
    (0.057+/-0.005, 0.057+/-0.005)
    """
    value, error = _split(text)
    own = unit_of_both(text) or written
    if error is None:
        return quantity(_with_unit(value, own), unit, name)
    wide = deviation(name, quantity(_with_unit(error, own), unit, name), zero=False)
    return known_to(quantity(_with_unit(value, own), unit, name), wide)


def unit_of_both(text: str) -> str | None:
    """Return the unit of a number and its error, empty if there is none; None of no number.

    Examples
    --------
    >>> unit_of_both("70 ± 2 cm"), unit_of_both("70 cm ± 2"), unit_of_both("70 ± 2")
    ('cm', 'cm', '')
    """
    value, error = _split(text)
    own = unit_written(value)
    return unit_written(error or "") or "" if own == "" else own


def without_error(text: str) -> str | None:
    """Return the text of a quantity without its error; None if it has none.

    Examples
    --------
    >>> without_error("63 ± 1 cm"), without_error("63 cm")
    ('63 cm', None)
    """
    value, error = _split(text)
    return None if error is None else _with_unit(value, unit_of_both(text) or "").strip()


def _with_unit(text: str, unit: str) -> str:
    return f"{text} {unit}" if unit and unit_written(text) == "" else text


def _split(text: str) -> tuple[str, str | None]:
    """Return the texts of a number and of its error, None if it has none."""
    short = _SHORT.fullmatch(text.strip())
    if short:
        whole, decimals, digits, power, unit = short.groups("")
        last = int(power or 0) - (0 if "." in digits else len(decimals))
        return f"{whole}.{decimals}e{power or 0} {unit}", f"{digits}e{last} {unit}"
    both = _BOTH.fullmatch(text.strip())
    plain = f"{both[1]} {both[2]}" if both else text
    value, sign, error = plain.replace("+/-", "±").partition("±")
    return (value.strip(), error.strip()) if sign else (text, None)


def propagate(
    function: Callable[..., Any],
    given: Mapping[str, Any],
    bounds: Mapping[str, tuple[float, float]] | None = None,
) -> list[Any]:
    """Return the values of a function with their errors, by central differences.

    Parameters
    ----------
    function : callable
        Takes the nominal values by name, and returns a sequence of floats.
    given : mapping of str to float or UFloat
        Numbers, those with an error as UFloat.
    bounds : mapping of str to (float, float), optional
        The range of a number, in which the difference is one-sided at its ends.

    Returns
    -------
    list of UFloat
        Correlated with the numbers that were given.

    Examples
    --------
    >>> from uncertainties import ufloat
    >>> print(*propagate(lambda x, y: [x * y, x], {"x": ufloat(2.0, 0.1), "y": 3.0}))
    6.00+/-0.30 2.00+/-0.10
    """
    at = {name: nominal(value) for name, value in given.items()}
    result: Any = [known_to(value, 0.0) for value in function(**at)]
    for name, one in given.items():
        if getattr(one, "std_dev", 0.0) > 0.0:
            x = at[name]
            step = min(max(_DERIVATIVE_STEP * abs(x), 1e-3 * one.std_dev), 0.1 * abs(x))
            low, high = np.clip((x - step, x + step), *(bounds or {}).get(name, _ANY)).tolist()
            if high <= low:  # a number that is 0
                high = low + _DERIVATIVE_STEP
            ends = (function(**(at | {name: value})) for value in (low, high))
            for k, (below, above) in enumerate(zip(*ends, strict=True)):
                result[k] = result[k] + (above - below) / (high - low) * (one - x)
    return list(result)
