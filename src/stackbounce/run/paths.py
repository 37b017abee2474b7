"""The parameters of a drop by their paths: ``contacts.1.stiffness``, ``gaps.0``."""

import functools
import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any, get_type_hints

from stackbounce.errors import InvalidType, InvalidValue, nearest, shown
from stackbounce.model import Ball, ContactLaw, Drop
from stackbounce.units import unit_of

_SEVERAL = ("balls", "contacts", "gaps", "velocities")  # fields of a drop with many numbers


@dataclass(frozen=True)
class Number:
    """A single numerical parameter of a drop: where it is, and its unit.

    Parameters
    ----------
    path : str
        Such as ``contacts.1.stiffness``.
    part : str
        ``balls``, ``contacts``, ``gaps``, ``velocities``, or empty for the drop itself.
    index : int
        Which of them; 0 for the drop itself.
    field : str
        Its name there; empty for a gap or a velocity.
    unit : str
        Its SI unit.

    Examples
    --------
    >>> Number("balls.0.mass", "balls", 0, "mass", "kg").unit
    'kg'
    """

    path: str
    part: str
    index: int
    field: str
    unit: str


def numbers_of(drop: Drop) -> dict[str, Number]:
    """Return all parameters of a drop that can vary, by their paths.

    Examples
    --------
    >>> from stackbounce.model import Spring
    >>> list(numbers_of(Drop([Ball(1.0)], [Spring(1.0)], height=1.0)))[-3:]
    ['contacts.0.stiffness', 'height', 'gravity']
    """
    parts = [("balls", i, _units(Ball)) for i in range(len(drop.balls))]
    parts += [("contacts", i, law.units()) for i, law in enumerate(drop.contacts) if law]
    found = [
        Number(f"{part}.{i}.{name}", part, i, name, unit)
        for part, i, units in parts
        for name, unit in units.items()
    ]
    found += [Number(f"gaps.{i}", "gaps", i, "", "m") for i in range(len(drop.gaps))]
    count = len(drop.velocities or ())
    found += [Number(f"velocities.{i}", "velocities", i, "", "m/s") for i in range(count)]
    found += [
        Number(name, "", 0, name, unit)
        for name, unit in _units(Drop).items()
        if getattr(drop, name) is not None
    ]
    return {number.path: number for number in found}


def number_at(drop: Drop, path: object) -> Number:
    """Return the parameter of a drop at a path: its description, not its value.

    Raises
    ------
    InvalidType
        If the path is no string.
    InvalidValue
        If the drop has no such number; the message names the nearest and lists all.

    Examples
    --------
    >>> from stackbounce.model import Spring
    >>> number_at(Drop([Ball(1.0)], [Spring(1.0)], height=1.0), "contacts.0.stiffness").unit
    'N/m'
    """
    if not isinstance(path, str):
        raise InvalidType(f"a path must be a string, got {shown(path)}")
    known = numbers_of(drop)
    if path not in known:
        raise InvalidValue(f"{path[:60]} is not a parameter of this drop; {nearest(path, known)}")
    return known[path]


def value_in(drop: Drop, number: Number) -> float:
    """Return a number of a drop; nan for a diameter that is not given.

    Examples
    --------
    >>> from stackbounce.model import Spring
    >>> drop = Drop([Ball(1.0)], [Spring(1.0)], height=1.0)
    >>> value_in(drop, number_at(drop, "contacts.0.stiffness"))
    1.0
    """
    if number.part == "":
        return float(getattr(drop, number.field))
    part = getattr(drop, number.part)[number.index]
    value = getattr(part, number.field) if number.field else part
    return math.nan if value is None else float(value)


def drop_at(drop: Drop, values: Mapping[Number, float]) -> Drop:
    """Return a copy of a drop in which some parameters have other values.

    Raises
    ------
    InvalidValue, InvalidType
        As the parts of a `Drop` do; the message begins with the path.

    Examples
    --------
    >>> from stackbounce.model import Spring
    >>> drop = Drop([Ball(1.0)], [Spring(1.0)], height=1.0)
    >>> drop_at(drop, {number_at(drop, "balls.0.mass"): 2.0}).balls[0].mass
    2.0
    """
    changes: dict[str, Any] = {}
    parts: dict[str, Any] = {
        name: list(getattr(drop, name)) for name in ("balls", "contacts", "gaps")
    }
    parts["velocities"] = None if drop.velocities is None else list(drop.velocities)
    within: dict[tuple[str, int], dict[str, float]] = {}
    for number, value in values.items():
        if not number.part:
            changes[number.field] = value
        elif number.field:
            within.setdefault((number.part, number.index), {})[number.field] = value
        else:
            parts[number.part][number.index] = value
    for (part, index), chosen in within.items():
        parts[part][index] = _changed(parts[part][index], chosen, f"{part}.{index}")
    return replace(drop, **parts, **changes)


def _changed(part: Any, chosen: Mapping[str, float], path: str) -> Any:
    try:
        return part.replaced(chosen) if isinstance(part, ContactLaw) else replace(part, **chosen)
    except (InvalidValue, InvalidType) as error:
        raise type(error)(f"{path}.{error}") from error


@functools.cache
def _units(kind: Any) -> dict[str, str]:
    """Return the SI units of those fields of a class that are single numbers, by field."""
    hints = get_type_hints(kind, include_extras=True)
    found = {name: unit_of(hint) for name, hint in hints.items() if name not in _SEVERAL}
    return {name: unit.symbol for name, unit in found.items() if unit is not None}
