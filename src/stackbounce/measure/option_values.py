"""Values of options as a face gives them -> values as `read` and `analyse` take them."""

import re
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

from stackbounce.errors import InvalidType, InvalidValue, nearest, shown
from stackbounce.measure.options import Option, options_for
from stackbounce.measure.quantities import quantity_with_error
from stackbounce.model.laws import law_named
from stackbounce.units import quantity

__all__ = ["read_options"]


def read_options(
    given: Mapping[str, Any],
    face: Callable[[Option], str],
    to: Sequence[str] = ("read", "analyse", "numbers"),
) -> dict[str, Any]:
    """Return options with values as `read` and `analyse` take them, those that are given.

    Parameters
    ----------
    given : mapping
        Values by the options' names: texts with units, or the values that they stand for. None and
        the empty text count as not given.
    face : callable
        From an option to what messages call it.
    to : sequence of str, optional
        Whose options are offered.

    Raises
    ------
    InvalidType, InvalidValue
        If one is unknown, or its value cannot be read.

    Examples
    --------
    >>> read_options({"height": "1 m", "law": "power-law exponent=1.3"}, lambda one: one.name)
    {'height': 1.0, 'law': <class 'stackbounce.model.laws.elastic.PowerLaw'>, 'exponent': 1.3}
    """
    known = options_for(*to)
    found: dict[str, Any] = {}
    for name, value in given.items():
        if name not in known:
            raise InvalidType(f"{shown(name)} is no option; {nearest(name, known)}")
        if value is None or (isinstance(value, str) and not value):
            continue
        one = known[name]
        if one.form == "law":
            told = _law(value, face(one))
        else:
            told = {name: _READERS[one.form](value, one, face(one))}
        twice = [key for key in told if key in found]
        if twice:
            raise InvalidValue(f"{twice[0]} is given twice, by {face(one)} and on its own")
        found |= told
    return found


def _number(value: Any, option: Option, called: str) -> Any:
    return quantity(value, option.unit, called)


def _measured(value: Any, option: Option, called: str) -> Any:
    read = quantity_with_error if isinstance(value, str) else quantity
    return read(value, option.unit, called)


def _lengths(text: str, option: Option, called: str) -> list[Any]:
    """Return lengths between commas or semicolons; a unit at the end is that of all."""
    words = [word.strip() for word in re.split(r"[,;]", text)]
    unit = re.sub(r"^[-+.\deE±/ ()]+", "", words[-1])
    bare = [not re.search(r"[^-+.\deE±/ ()]", word) for word in words]
    if any(bare) and not (all(bare) or all(bare[:-1])):
        raise InvalidValue(
            f"{called} must have a unit each, or one at the end for all, got {shown(text)}"
        )
    return [
        quantity_with_error(word + unit if is_bare else word, option.unit, f"{called} {k}")
        for k, (word, is_bare) in enumerate(zip(words, bare, strict=True))
    ]


def _flag(value: Any, option: Option, called: str) -> bool:  # noqa: ARG001
    if not isinstance(value, bool):
        raise InvalidType(f"{called} must be true or false, got {shown(value)}")
    return value


def _points(value: Any, option: Option, called: str) -> tuple[str, ...]:  # noqa: ARG001
    """Return the points that the drop's height and the bounces' were measured to."""
    from stackbounce.measure.kinds.heights.analysis import places

    if not isinstance(value, str):
        return places(value)
    words = tuple(word.strip() for word in value.split(","))
    if len(words) > 2:
        raise InvalidValue(f"{called} must be a point or two, got {shown(value)}")
    return places(words * 2 if len(words) == 1 else words)


def _law(value: Any, called: str) -> dict[str, Any]:
    """Return the law's class, and the exponent that may be told with its name."""
    name, *rest = (value.split() or [""]) if isinstance(value, str) else (value,)
    told: dict[str, Any] = {}
    for word in rest:
        key, _, number = word.partition("=")
        if key != "exponent" or not number or told:
            raise InvalidValue(
                f"{called} must be a law, or 'LAW exponent=NUMBER', got {shown(value)}; "
                "restitution and contact time have options of their own"
            )
        told[key] = quantity(number, "", f"{called}: exponent")
    return {"law": law_named(name), **told}


def _columns(value: Any, option: Option, called: str) -> Any:
    """Return a mapping of columns from ``COLUMN=VALUE`` texts, or as it is."""
    if isinstance(value, Mapping):
        return value
    texts = value.split(",") if isinstance(value, str) else value
    found: dict[Any, str] = {}
    for text in texts:
        name, _, told = (part.strip() for part in text.partition("="))
        if not (name and told):
            example = option.example.split(", ")[0]
            raise InvalidValue(
                f"{called} must be {option.value_name}, such as {example}, got {shown(text)}"
            )
        found[int(name) if name.isdecimal() else name] = told
    return found


def _text(value: Any, option: Option, called: str) -> str | int:  # noqa: ARG001
    if not isinstance(value, str | int):
        raise InvalidType(f"{called} must be a text, got {shown(value)}")
    return value


def _file(value: Any, option: Option, called: str) -> Any:  # noqa: ARG001
    """Return a path, or a name and a content: no text, which in a request would be a path too."""
    if not isinstance(value, Path | tuple):
        raise InvalidType(f"{called} must be a file, got {shown(value)}")
    return value


_READERS: dict[str, Callable[[Any, Option, str], Any]] = {
    "number": _number,
    "measured": _measured,
    "lengths": _lengths,
    "flag": _flag,
    "points": _points,
    "columns": _columns,
    "text": _text,
    "file": _file,
}
