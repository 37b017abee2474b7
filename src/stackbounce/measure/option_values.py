"""Option values from a user interface -> values as `read` and `analyse` take them."""

import re
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from stackbounce.errors import InvalidType, InvalidValue, nearest, shown
from stackbounce.measure.options import Option, options_for
from stackbounce.measure.quantities import nominal, quantity_with_error, unit_of_both
from stackbounce.measure.setup import places
from stackbounce.model.laws import ContactLaw, law_named
from stackbounce.units import quantity


def read_options(
    given: Mapping[str, Any],
    face: Callable[[Option], str],
    to: Sequence[str] = ("read", "analyse", "numbers"),
) -> dict[str, Any]:
    """Return the given options with values as `read` and `analyse` take them.

    Parameters
    ----------
    given : mapping
        Values by the options' names: texts with units, or the values that they stand for. None and
        the empty text count as not given.
    face : callable
        Takes an option; returns its name in error messages of the user interface.
    to : sequence of str, optional
        The functions whose options are accepted: see `Option.to`.

    Raises
    ------
    InvalidType, InvalidValue
        If one is unknown, or its value cannot be read.

    Examples
    --------
    >>> given = {"height": "1 m", "law": "power-law"}
    >>> found = read_options(given, lambda option: option.name)
    >>> found["height"], found["law"].__name__
    (1.0, 'PowerLaw')
    """
    known = options_for(*to)
    found: dict[str, Any] = {}
    for name, value in given.items():
        if name not in known:
            raise InvalidType(f"{shown(name)} is no option; {nearest(name, known)}")
        if value is None or (isinstance(value, str) and not value):
            continue
        option = known[name]
        found[name] = _READERS.get(option.form, _checked)(value, option, face(option))
    return found


def _checked(value: Any, option: Option, called: str) -> Any:
    """Return a value that needs no reading, its type checked."""
    flag = option.form == "flag"
    words = "true or false" if flag else "a text"
    if not isinstance(value, bool if flag else str | int):
        raise InvalidType(f"{called} must be {words}, got {shown(value)}")
    return value


def _number(value: Any, option: Option, called: str) -> Any:
    with_error = option.form == "measured" and isinstance(value, str)
    number = (quantity_with_error if with_error else quantity)(value, option.unit, called)
    option.check(called, nominal(number), *filter(None, [option.unit]))
    return number


def _lengths(text: str, option: Option, called: str) -> list[Any]:
    """Return lengths between commas, or semicolons; a unit at the end is that of all.

    Between semicolons a comma is a decimal one.
    """
    if re.search(r"\d,\d", text) and re.search(r",\s", text) and not set(";.") & set(text):
        raise InvalidValue(
            f"{called} can be read in two ways, got {shown(text)}: put semicolons between them"
        )
    listed = text.replace(",", ".").split(";") if ";" in text else text.split(",")
    words = [word.strip() for word in listed]
    units = [unit_of_both(word) for word in words]
    if any(units[:-1]) and "" in units:
        raise InvalidValue(
            f"{called} must have a unit each, or one at the end for all, got {shown(text)}"
        )
    return [
        quantity_with_error(word, option.unit, f"{called} {k}", units[-1] or "")
        for k, word in enumerate(words)
    ]


def _law(value: Any, _: Option, called: str) -> type[ContactLaw]:
    """Return the law's class."""
    if isinstance(value, str) and "=" in value:
        raise InvalidValue(
            f"{called} must be the name of a law alone, got {shown(value)}: an exponent or a "
            "restitution has an option of its own"
        )
    return law_named(value)


def _columns(value: Any, option: Option, called: str) -> Any:
    """Return a mapping of columns from ``COLUMN=VALUE`` texts, or as it is."""
    if isinstance(value, Mapping):
        return value
    found: dict[str | int, str] = {}
    for text in value.split(",") if isinstance(value, str) else value:
        name, _, meaning = (part.strip() for part in text.partition("="))
        if not (name and meaning):
            example = option.example.split(", ")[0]
            raise InvalidValue(
                f"{called} must be {option.value_name}, such as {example}, got {shown(text)}"
            )
        number = name.isdecimal() and len(name) < 10
        found[int(name) if number else name] = meaning
    return found


_READERS: dict[str, Callable[[Any, Option, str], Any]] = {
    "number": _number,
    "measured": _number,
    "lengths": _lengths,
    "points": lambda value, _, __: places(value),
    "law": _law,
    "columns": _columns,
}
