"""The package's exceptions, which also derive from builtin ones, and the validators.

A message is one line: the name of the argument, what would be right, and what was got. It begins
with the name, so that the reader of a file can prefix the path (``mass must be …`` becomes
``balls.1.mass must be …``).
"""

import contextlib
import functools
import itertools
import math
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Set
from numbers import Integral, Real
from typing import Any, TypeVar

_Given = TypeVar("_Given")


class StackbounceError(Exception):
    """Base of everything that this package raises on purpose.

    Examples
    --------
    >>> import stackbounce as sb
    >>> try:
    ...     sb.Ball("16 cm")
    ... except sb.StackbounceError as error:
    ...     print(error)
    mass must be a mass (a number of kg or a string such as "150 g"), got '16 cm'
    """


class InvalidValue(StackbounceError, ValueError):
    """A value of the right type that is not allowed, such as a negative mass."""


class InvalidType(StackbounceError, TypeError):
    """A value of the wrong type, such as a string for a mass."""


class UnitError(InvalidValue):
    """A quantity whose unit is unknown or does not fit, such as a height in kilograms."""


class ScenarioError(InvalidValue):
    """A scenario (TOML file or mapping) that is not valid."""


class UnknownName(InvalidValue, KeyError):
    """A name that is not among those that there are, such as that of a ball."""

    __str__ = Exception.__str__  # that of a KeyError has quotes


class FileError(StackbounceError, OSError):
    """A file or folder that cannot be read or written."""


class MissingExtra(StackbounceError, ImportError):
    """A library that an extra of the package brings, and that is not installed."""


@contextlib.contextmanager
def placed(place: str, kind: type[StackbounceError] | None = None) -> Iterator[None]:
    """Begin the message of a wrong value with its place, such as the name of a file.

    Parameters
    ----------
    place : str
        What the message begins with, as it is.
    kind : type, optional
        The class of the error that is raised; by default its own.

    Raises
    ------
    StackbounceError
        In place of any `InvalidValue` or `InvalidType` within the context.

    Examples
    --------
    >>> with placed("balls.1."):
    ...     _ = positive("mass", -1.0, "kilograms")
    Traceback (most recent call last):
        ...
    stackbounce.errors.InvalidValue: balls.1.mass must be a positive number of kilograms, got -1.0
    """
    try:
        yield
    except (InvalidValue, InvalidType) as error:
        raise (kind or type(error))(f"{place}{error}") from error


def instance(name: str, value: object, kind: type[_Given]) -> _Given:
    """Return a value if it is of a class.

    Raises
    ------
    InvalidType
        If it is not.

    Examples
    --------
    >>> instance("drop", 3.5, dict)
    Traceback (most recent call last):
        ...
    stackbounce.errors.InvalidType: drop must be a dict, got 3.5
    """
    if not isinstance(value, kind):
        raise InvalidType(f"{name} must be {a_or_an(kind.__name__)}, got {shown(value)}")
    return value


def listed(name: str, values: Any, most: int) -> tuple[Any, ...]:
    """Return the values of a list, which may have no end; raise if they are more than ``most``.

    Examples
    --------
    >>> listed("gaps", [0.0, 1e-3], 10)
    (0.0, 0.001)
    """
    if type(values) is list and len(values) <= most:  # as nearly always
        return tuple(values)
    if isinstance(values, str | bytes | Mapping | Set) or not isinstance(values, Iterable):
        raise InvalidType(f"{name} must be a list, got {shown(values)}")
    try:
        items = tuple(itertools.islice(values, most + 1))
    except TypeError:  # of an array of one number
        raise InvalidType(f"{name} must be a list, got {shown(values)}") from None
    if len(items) > most:
        raise InvalidValue(f"{name} must hold at most {most} values, got more")
    return items


def finite(name: str, value: object, of: str = "") -> float:
    """Return `value` as a float if it is a finite number.

    Parameters
    ----------
    name : str
        The name of the value; the message begins with it.
    value : object
        An int, a float or a numpy scalar; a bool, a string or None is refused.
    of : str, optional
        The unit in words, for the message.

    Returns
    -------
    float

    Raises
    ------
    InvalidType
        If `value` is not a real number.
    InvalidValue
        If it is NaN or infinite.

    Examples
    --------
    >>> finite("height", 2)
    2.0
    """
    return _checked(name, value, "a finite number" + _of(of), math.isfinite)


def positive(name: str, value: object, of: str = "") -> float:
    """Return `value` as a float if it is a finite number above 0; see `finite`.

    Examples
    --------
    >>> positive("mass", -0.057, "kilograms")
    Traceback (most recent call last):
        ...
    stackbounce.errors.InvalidValue: mass must be a positive number of kilograms, got -0.057
    """
    if type(value) is float and 0.0 < value < math.inf:  # without a message that nobody sees
        return value
    return _checked(name, value, "a positive number" + _of(of), lambda number: number > 0.0)


def non_negative(name: str, value: object, of: str = "") -> float:
    """Return `value` as a float if it is a finite number, 0 or above; see `finite`.

    Examples
    --------
    >>> non_negative("gap", 0)
    0.0
    """
    return between(name, value, 0.0, of=of)


def fraction(name: str, value: object, *, zero: bool = True) -> float:
    """Return `value` as a float if it lies from 0 to 1, with 0 itself allowed or not; see `finite`.

    Examples
    --------
    >>> fraction("restitution", 0.78)
    0.78
    """
    if zero:
        return between(name, value, 0.0, 1.0)
    right = "a number above 0 and at most 1"
    return _checked(name, value, right, lambda number: 0.0 < number <= 1.0)


def between(name: str, value: object, low: float, high: float = math.inf, of: str = "") -> float:
    """Return `value` as a float if it lies from `low` to `high`, both included; see `finite`.

    Examples
    --------
    >>> between("exponent", 1.5, 1.0)
    1.5
    """
    if type(value) is float and low <= value <= high and value < math.inf:
        return value
    right = "a number" + _of(of) + _range(low, high)
    return _checked(name, value, right, lambda number: low <= number <= high)


def whole(name: str, value: object, low: int = 0, high: float = math.inf) -> int:
    """Return `value` as an int if it is a whole number from `low` to `high`, both included.

    Raises
    ------
    InvalidType
        If `value` is not an integer; a bool, a string and 2.0 are refused.
    InvalidValue
        If it lies outside of the range.

    Examples
    --------
    >>> whole("event_limit", 100, 1)
    100
    """
    if type(value) is int and low <= value <= high:
        return value
    message = f"{name} must be a whole number{_range(low, high)}, got {shown(value)}"
    if not _is(Integral, value):
        raise InvalidType(message)
    number: int = int(value)  # type: ignore[call-overload]
    if not low <= number <= high:
        raise InvalidValue(message)
    return number


def all_real(name: str, values: _Given) -> _Given:
    """Return numbers as they are if they are real and numpy masks none of them; raise otherwise.

    A masked number is none, but its place in the array holds one, which numpy's functions take, as
    they take dates for a count of nanoseconds, and leave out imaginary parts.

    Parameters
    ----------
    name : str
        What the numbers are called; the message begins with it.
    values : object
        Anything: an array, or a list or tuple of numbers or arrays is looked through.

    Raises
    ------
    InvalidType
        If a number is masked, or complex, a date or a time of numpy.

    Examples
    --------
    >>> import numpy as np
    >>> all_real("gaps", np.ma.array([0.0, 9999.0], mask=[False, True]))
    Traceback (most recent call last):
        ...
    stackbounce.errors.InvalidType: gaps must have no masked numbers, got 1 of 2: leave them out
    """
    import numpy as np

    for given in values if isinstance(values, list | tuple) else (values,):
        part: Any = getattr(given, "magnitude", given)
        if getattr(getattr(part, "dtype", None), "kind", "f") in "mMc":
            raise InvalidType(f"{name} must be real numbers in SI units, got {part.dtype}")
        if isinstance(part, np.ma.MaskedArray) and (count := int(np.sum(part.mask))):
            right = f"{name} must have no masked numbers"
            raise InvalidType(f"{right}, got {count} of {part.size}: leave them out")
    return values


def nearest(name: object, known: Iterable[str]) -> str:
    """Return the end of a message about an unknown name: the closest match and all known names.

    Examples
    --------
    >>> nearest("sprung", ["Rigid", "Spring"])
    'did you mean Spring? Known: Rigid, Spring'
    """
    names = list(known)
    close = _closest(name, names)
    listed_names = ", ".join(names)
    return f"did you mean {close}? Known: {listed_names}" if close else f"known: {listed_names}"


def _closest(name: object, names: Iterable[str]) -> str:
    import difflib

    folded = {name.casefold(): name for name in names}
    word = name[:60] if isinstance(name, str) else shown(name)
    return "".join(folded[one] for one in difflib.get_close_matches(word.casefold(), folded, n=1))


def one_of(name: _Given, known: Collection[str], wrong: str) -> _Given:
    """Return a name if it is a known one; raise InvalidValue with the nearest ones otherwise.

    Examples
    --------
    >>> one_of("mas", ["mass", "gravity"], "'mas' is no number")
    Traceback (most recent call last):
        ...
    stackbounce.errors.InvalidValue: 'mas' is no number; did you mean mass? Known: mass, gravity
    """
    if name not in known:
        raise InvalidValue(f"{wrong}; {nearest(name, known)}")
    return name


def no_attribute(owner: Any, name: str) -> AttributeError:
    """Return the error for an attribute that is not there, with what to use in its place.

    Parameters
    ----------
    owner : type or module
        What lacks it; a table of ``attributes.toml`` has its name.
    name : str
        The attribute.

    Examples
    --------
    >>> from stackbounce.model import Drop
    >>> no_attribute(Drop, "heigth")
    AttributeError("Drop has no attribute 'heigth'; did you mean height?")
    >>> no_attribute(Drop, "run")
    AttributeError("Drop has no attribute 'run'; use stackbounce.simulate(drop)")
    """
    message = f"{owner.__name__} has no attribute {name!r}"
    if not name.startswith("_"):  # which programs ask for, not people
        tried = _tried(owner.__name__)
        known = sorted({*dir(owner), *vars(owner).get("__all__", ())})
        if name in tried:
            message += f"; use {tried[name]}"
        elif close := _closest(name, known):
            message += f"; did you mean {close}?"
    return AttributeError(message, name=name)  # with its name alone, Python adds no hint


@functools.cache
def _tried(owner: str) -> Any:
    import tomllib
    from importlib.resources import files

    return tomllib.loads((files(__package__) / "attributes.toml").read_text("utf-8"))[owner]


def shown(value: object) -> str:
    """Return any value as a short text on one line, for a message.

    Examples
    --------
    >>> shown("150 g")
    "'150 g'"
    """
    try:  # an int can have too many digits, and a `__repr__` can raise anything
        text = " ".join((str if _is(Real, value) else repr)(value).split())
    except Exception:
        text = f"<unprintable {type(value).__name__} object>"
    return text if len(text) <= 60 else text[:57] + "..."


def a_or_an(noun: str) -> str:
    """Return a noun with its indefinite article.

    Examples
    --------
    >>> a_or_an("acceleration"), a_or_an("press curve")
    ('an acceleration', 'a press curve')
    """
    return f"{'an' if noun[:1] in 'aeiouA' else 'a'} {noun}"


def counted(count: int, noun: str) -> str:
    """Return a number of things in words.

    Examples
    --------
    >>> counted(1, "drop"), counted(2, "degree of freedom")
    ('1 drop', '2 degrees of freedom')
    """
    one, of, rest = noun.partition(" of ")
    return f"{count} {one}{'' if count == 1 else 's'}{of}{rest}"


def _of(unit: str) -> str:
    return f" of {unit}" if unit else ""


def _range(low: float, high: float) -> str:
    return f" from {low:g} to {high:g}" if math.isfinite(high) else f", {low:g} or above"


def _is(kind: type, value: object) -> bool:
    """Return whether `value` is a number of a kind; a bool and numpy's timedelta64 are not."""
    number = isinstance(value, kind) and not isinstance(value, bool)
    return number and getattr(getattr(value, "dtype", None), "kind", "f") in "iuf"


def _checked(name: str, value: object, right: str, holds: Callable[[float], bool]) -> float:
    if not _is(Real, value):
        raise InvalidType(f"{name} must be {right}, got {shown(value)}")
    try:
        number = float(value)  # type: ignore[arg-type]
    except OverflowError:
        number = math.inf
    if not math.isfinite(number) or not holds(number):
        raise InvalidValue(f"{name} must be {right}, got {shown(value)}")
    return number
