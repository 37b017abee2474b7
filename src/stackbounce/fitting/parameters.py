"""The parameters of a fit: the numbers that it varies, their bounds and priors."""

import keyword
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np

from stackbounce.errors import InvalidType, InvalidValue, nearest, shown
from stackbounce.fitting.formula import OWN_WORDS
from stackbounce.fitting.quantities import read_with_error
from stackbounce.measure.quantities import LARGEST
from stackbounce.model import Drop
from stackbounce.run.paths import Number, drop_at, numbers_of, value_in
from stackbounce.run.quantities import Array
from stackbounce.units import quantity

Drops: TypeAlias = Mapping[str, Drop]
"""Drops by name; a single one has the empty name."""

Places: TypeAlias = Sequence[tuple[str, Number]]
"""The drops that have a number, by name, and where it is in each."""

_WIDE = 100.0  # default bounds: the drop's own number divided and multiplied by this
_MOST_GAP = 0.02  # m: default upper bound of a gap, or ten times the drop's own if larger
_LOG = 5.0  # a ratio of positive bounds above this makes the search coordinate logarithmic
_RIGHT = (
    "varied between two bounds, such as '1e3 : 1e6', or around what is known of it, such as "
    "'1.3 ± 0.9 mm'"
)
_LEAST = 1e-12  # relative: closer bounds are one number to a search
_REACH = 6.0  # default bounds of a parameter with a prior, in its standard deviations


@dataclass(frozen=True)
class Range:
    """The bounds between which a fit varies a number, and its prior.

    Parameters
    ----------
    low, high : float or str
        The bounds, in SI units or with a unit.
    prior : str, (float, float) or UFloat, optional
        A value with its error, known from elsewhere. It counts as one more measurement.

    Examples
    --------
    >>> Range("0 mm", "5 mm", prior="1.3 ± 0.9 mm").high
    '5 mm'
    """

    low: Any
    high: Any
    prior: Any = None


@dataclass(frozen=True)
class Parameter:
    """A number that a fit varies.

    Parameters
    ----------
    name : str
        A path such as ``contacts.0.stiffness``; ``DROP.gaps.0`` for one of several drops; or a
        name chosen by the user, for use in ties.
    low, high : float
        Bounds in SI units.
    prior : (float, float) or None
        Mean and standard deviation of what is known beforehand.
    unit : str
        The SI unit; empty for a pure number or a name chosen by the user.

    Examples
    --------
    >>> Parameter("contacts.0.stiffness", 1e3, 1e6, None, "N/m").logarithmic
    True
    """

    name: str
    low: float
    high: float
    prior: tuple[float, float] | None
    unit: str

    @property
    def logarithmic(self) -> bool:
        """Return whether the search coordinate is the logarithm of the number."""
        return self.low > 0.0 and self.high > _LOG * self.low

    @property
    def span(self) -> tuple[float, float]:
        """The bounds in the search coordinate."""
        return self.coordinate(self.low), self.coordinate(self.high)

    def value(self, x: Array) -> Array:
        """Return the number at a search coordinate, kept within the bounds."""
        inside = np.exp(x) if self.logarithmic else x
        return np.asarray(np.clip(inside, self.low, self.high))

    def slope(self, x: float) -> float:
        """Return the derivative of the number by its search coordinate."""
        return math.exp(x) if self.logarithmic else 1.0

    def coordinate(self, value: float) -> float:
        """Return the search coordinate of a number."""
        return math.log(value) if self.logarithmic else value


def read_parameters(drops: Drops, vary: object) -> tuple[Parameter, ...]:
    """Check what a fit varies and return it as parameters.

    Parameters
    ----------
    drops : mapping of str to Drop
        By name; a single drop has an empty name.
    vary : mapping or sequence of str
        By name: a `Range`; a pair of bounds, or a text with a colon between them
        (``"0 mm : 5 mm"``); a prior, as text, pair or UFloat with an error (``"1.3 ± 0.9 mm"``);
        or None for bounds around the drop's own number. A sequence of names means None for each.

    Returns
    -------
    tuple of Parameter

    Raises
    ------
    InvalidValue
        If a name is not a parameter of the drops, or its bounds are not possible.
    InvalidType
        If something has the wrong type.

    Examples
    --------
    >>> import stackbounce as sb
    >>> drop = sb.Drop([sb.Ball(1.0)], [sb.Spring(1.0)], height=1.0)
    >>> (found,) = read_parameters({"": drop}, {"contacts.0.stiffness": (0.1, 10.0)})
    >>> found.high
    10.0
    """
    if isinstance(vary, Sequence) and not isinstance(vary, str):
        for name in vary:
            if not isinstance(name, str):
                raise InvalidType(f"vary must list names, got {shown(name)}")
        vary = dict.fromkeys(vary)
    if not isinstance(vary, Mapping) or not vary:
        raise InvalidType(
            "vary must name what may change, such as {'contacts.0.stiffness': (1e3, 1e6)}, "
            f"got {shown(vary)}"
        )
    found = tuple(_parameter(drops, name, given) for name, given in vary.items())
    places = {parameter.name: find_numbers(drops, parameter.name) for parameter in found}
    varied = [place for own in places.values() for place in own]
    for name, own in places.items():
        if any(varied.count(place) > 1 for place in own):
            raise InvalidValue(f"{name} is varied twice: only once for each drop")
    return found


def find_numbers(drops: Drops, name: str) -> list[tuple[str, Number]]:
    """Return the drops that have a number of this name, each with its place in the drop."""
    found = []
    for key, drop in drops.items():
        known = numbers_of(drop)
        path = name.removeprefix(f"{key}.") if key and name not in known else name
        if path in known:
            found.append((key, known[path]))
    return found


def list_paths(drops: Drops) -> list[str]:
    """Return the paths of all numbers of some drops, each once."""
    return list(dict.fromkeys(path for drop in drops.values() for path in numbers_of(drop)))


def _parameter(drops: Drops, name: object, given: object) -> Parameter:
    if not isinstance(name, str):
        raise InvalidType(f"vary must have names for keys, got {shown(name)}")
    at = find_numbers(drops, name)
    if not at and not (name.isidentifier() and name.isascii()):
        raise InvalidValue(
            f"{name[:60]} is not a parameter of the drop; {nearest(name, list_paths(drops))}"
        )
    if name in OWN_WORDS or keyword.iskeyword(name):
        raise InvalidValue(f"{name} means something else in formulas: take another name")
    unit = at[0][1].unit if at else ""
    low, high, prior = _bounds(drops, at, name, given, unit)
    if not low < high:
        raise InvalidValue(
            f"{name} must have a lower bound below the upper one, got {low:g} and {high:g}"
        )
    found = Parameter(name, low, high, prior, unit)
    apart, size = high - low, max(1.0, abs(low), abs(high))
    if not (found.logarithmic or _LEAST * size < apart <= LARGEST):
        raise InvalidValue(
            f"{name} must have bounds above {_LEAST:g} (of their size, if that is above 1) and "
            f"at most {LARGEST:g} apart, got {low:g} and {high:g}"
        )
    for value in (low, high):
        if refusal := _refusal(drops, at, value):
            raise InvalidValue(f"{name} cannot be varied to {value:g}: {refusal}")
    return found


def _refusal(drops: Drops, at: Places, value: float) -> str:
    """Return why the drops cannot have a value of a number; empty if they can."""
    try:
        for key, number in at:
            drop_at(drops[key], {number: value})
    except (InvalidValue, InvalidType) as error:
        return str(error)
    return ""


def _bounds(
    drops: Drops, at: Places, name: str, given: Any, unit: str
) -> tuple[float, float, tuple[float, float] | None]:
    if isinstance(given, str) and given.count(":") == 1:
        given = given.split(":")
    if isinstance(given, tuple | list) and len(given) == 2:
        given = Range(*given)
    if isinstance(given, Range):
        low, high = (quantity(end, unit, name) for end in (given.low, given.high))
        prior = given.prior
        return low, high, None if prior is None else read_with_error(prior, unit, name, _RIGHT)
    if given is None:
        return *_default(drops, at, name), None
    mean, error = read_with_error(given, unit, name, _RIGHT)
    low, high = _legal(drops, at, mean, mean - _REACH * error, mean + _REACH * error)
    return low, high, (mean, error)


def _default(drops: Drops, at: Places, name: str) -> tuple[float, float]:
    """Return the default bounds, around the drop's own number."""
    if not at:
        raise InvalidValue(f"{name} needs bounds, such as {name}=0.1:10")
    key, number = at[0]
    own = value_in(drops[key], number)
    if number.part == "gaps":
        return 0.0, max(_MOST_GAP, 10.0 * own)
    if number.field == "restitution":
        return 0.01, 1.0
    if own == 0.0 or math.isnan(own):
        what = "not given" if math.isnan(own) else "0"
        raise InvalidValue(f"{name} is {what} in the drop and needs bounds, such as {name}=0.1:10")
    return _legal(drops, at, own, *sorted((own / _WIDE, own * _WIDE)))


def _legal(drops: Drops, at: Places, own: float, low: float, high: float) -> tuple[float, float]:
    """Return bounds moved towards the drop's own number until drops can be made at both."""

    def moved(end: float) -> float:
        for limit in (end, 1.0, 0.0):  # a drop's numbers are usually limited by 0 or 1
            if (
                limit != own
                and min(own, end) <= limit <= max(own, end)
                and not _refusal(drops, at, limit)
            ):
                return limit
        good, bad = own, end
        for _ in range(60):
            middle = 0.5 * (good + bad)
            good, bad = (good, middle) if _refusal(drops, at, middle) else (middle, bad)
        return good

    return moved(low), moved(high)
