"""The parameters of a drop by their paths, such as ``gaps.0``, and as arrays for the engine.

Those of many drops are checked and make columns, one row for each drop.
"""

import functools
import itertools
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from stackbounce.engine.records import Drops
from stackbounce.errors import InvalidType, InvalidValue, one_of, placed, shown
from stackbounce.model import STANDARD_GRAVITY, Ball, ContactLaw, Drop
from stackbounce.model.laws import contact_numbers
from stackbounce.units import units_of

_SEVERAL = ("balls", "contacts", "gaps", "velocities")  # fields of a drop with many numbers
_WORDS = {"height": "drop height", "impact_speed": "impact speed"}


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
    >>> Number("balls.0.mass", "balls", 0, "mass", "kg").attributes
    {'units': 'kg', 'long_name': 'mass of ball 0', 'path': 'balls.0.mass'}
    """

    path: str
    part: str
    index: int
    field: str
    unit: str

    @property
    def words(self) -> str:
        """What it is, in words; balls and contacts are counted from 0, as in its path."""
        if not self.part:
            return _WORDS.get(self.field, self.field)
        if self.part == "gaps":
            return f"gap between balls {self.index} and {self.index + 1}"
        whose = "contact" if self.part == "contacts" else "ball"
        return f"{self.field.replace('_', ' ') or 'velocity'} of {whose} {self.index}"

    @property
    def attributes(self) -> dict[str, str]:
        """The attributes of its values in a Dataset."""
        return {"units": self.unit, "long_name": self.words, "path": self.path}


Array: TypeAlias = NDArray[np.float64]
Rows: TypeAlias = Mapping[Number, Array]
"""The numbers that vary, in SI units: arrays that broadcast with each other."""


def identifier(path: str) -> str:
    """Return the name that a parameter has in a Dataset, an identifier.

    Examples
    --------
    >>> identifier("balls.0.mass")
    'balls_0_mass'
    """
    return path.replace(".", "_")


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
    return known[one_of(path, known, f"{path[:60]} is not a parameter of this drop")]


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
    parts: dict[str, Any] = {name: getattr(drop, name) for name in _SEVERAL}
    parts = {name: values and list(values) for name, values in parts.items()}
    within: dict[tuple[str, int], dict[str, float]] = {}
    for number, value in values.items():
        if not number.part:
            changes[number.field] = value
        elif number.field:
            within.setdefault((number.part, number.index), {})[number.field] = value
        else:
            parts[number.part][number.index] = value
    for (part, index), chosen in within.items():
        with placed(f"{part}.{index}."):
            parts[part][index] = _changed(parts[part][index], chosen)
    return replace(drop, **parts, **changes)


def _changed(part: Any, chosen: Mapping[str, float]) -> Any:
    return part.replaced(chosen) if isinstance(part, ContactLaw) else replace(part, **chosen)


@functools.cache
def _units(kind: Any) -> dict[str, str]:
    """Return the SI units of those fields of a class that are single numbers, by field."""
    return {name: unit.symbol for name, unit in units_of(kind).items() if name not in _SEVERAL}


def base_rows(drop: Drop, count: int) -> Drops:
    """Return the parameters of ``count`` equal drops, as arrays (count, balls) and (count,)."""
    return Drops._make(np.repeat([numbers], count, axis=0) for numbers in drop_numbers(drop))


def fill(drops: Drops, drop: Drop, rows: Rows) -> None:
    """Replace the parameters that vary, in drops that are copies of a base drop.

    Parameters
    ----------
    drops : Drops
        Arrays (..., balls), and (...,) gravity, with the parameters of the base drop; changed.
    drop : Drop
        The base drop.
    rows : mapping
        The values of the parameters that vary, by `Number`. They broadcast to (...,).
    """
    laws: dict[int, dict[str, Any]] = {}
    for number, values in rows.items():
        if number.part == "gaps":
            drops.gap[..., number.index + 1] = values
        elif number.field == "mass":
            drops.mass[..., number.index] = values
        elif number.part == "contacts":
            laws.setdefault(number.index, {})[number.field] = values
    for i, varied in laws.items():
        _, first, second, third, fourth = contact_numbers(drop.contacts[i], varied)
        drops.first[..., i], drops.second[..., i] = first, second
        drops.third[..., i], drops.fourth[..., i] = third, fourth
    _fill_motion(drops.velocity, drops.gravity, drop, rows)


def _fill_motion(velocity: Array, gravity: Array, drop: Drop, rows: Rows) -> None:
    """Replace what varies of the velocities (..., balls) and of gravity (...,)."""
    for number, values in rows.items():
        if number.part == "velocities":
            velocity[..., number.index] = values
        elif number.field == "gravity":
            gravity[...] = values
        elif number.field == "impact_speed":
            velocity[...] = -values[..., None]
    if drop.height is not None:
        height = next((v for n, v in rows.items() if n.field == "height"), drop.height)
        pull = np.where(gravity > 0.0, gravity, STANDARD_GRAVITY)
        velocity[...] = -np.sqrt(2.0 * pull * height)[..., None]


def incidence(drop: Drop, rows: Rows, count: int) -> tuple[Array, Array]:
    """Return the impact speeds in m/s and gravity in m/s**2 of some drops, (count,) each."""
    velocity = np.repeat([drop.start_velocities], count, axis=0)
    gravity = np.repeat(drop.gravity, count)
    _fill_motion(velocity, gravity, drop, rows)
    return np.max(np.abs(velocity), axis=1), gravity


def check(drop: Drop, rows: Rows, where: Callable[[tuple[int, ...]], str]) -> None:
    """Raise an error for the first row of parameters with which the drop is not valid.

    The valid values of a parameter are an interval. One end of it may depend on another parameter
    of the same ball or contact. All rows are therefore valid if all combinations of the smallest
    and the largest values are valid, which is tested first.

    Parameters
    ----------
    drop : Drop
        The base drop.
    rows : mapping
        The values of the parameters that vary, by `Number`.
    where : callable
        From the index of a row to the words that locate it in the error message.

    Raises
    ------
    InvalidValue, InvalidType
        As `Drop` does; the message ends with the words from `where`.
    """
    shape = np.broadcast_shapes(*(values.shape for values in rows.values()))
    if 0 in shape or (_corners_hold(drop, rows) and _all_move(drop, rows)):
        return
    wide = {number: np.broadcast_to(values, shape) for number, values in rows.items()}
    for index in np.ndindex(shape):
        try:
            drop_at(drop, {number: float(values[index]) for number, values in wide.items()})
        except (InvalidValue, InvalidType) as error:
            raise type(error)(f"{error} {where(index)}") from error


def _corners_hold(drop: Drop, rows: Rows) -> bool:
    """Return whether all combinations of smallest and largest values are valid for each part."""
    parts: dict[tuple[str, int], dict[Number, tuple[float, float]]] = {}
    for number, values in rows.items():
        ends = float(np.min(values)), float(np.max(values))
        if not (math.isfinite(ends[0]) and math.isfinite(ends[1])):
            return False
        if number.part != "velocities":
            parts.setdefault((number.part, number.index), {})[number] = ends
    for (part, index), ranges in parts.items():
        for corner in itertools.product(*ranges.values()):
            try:
                if part in ("balls", "contacts"):  # a drop takes any valid one of the same kind
                    chosen = {n.field: value for n, value in zip(ranges, corner, strict=True)}
                    _changed(getattr(drop, part)[index], chosen)
                else:
                    drop_at(drop, dict(zip(ranges, corner, strict=True)))
            except (InvalidValue, InvalidType):
                return False
    return True


def _all_move(drop: Drop, rows: Rows) -> bool:
    """Return whether some ball moves in each row."""
    if drop.velocities is None:
        return True
    varied = {n.index: values for n, values in rows.items() if n.part == "velocities"}
    still: Any = True
    for i, velocity in enumerate(drop.velocities):
        still = still & np.equal(varied.get(i, velocity), 0.0)
    return not np.any(still)


def drop_numbers(drop: Drop) -> Drops:
    """Return the parameters of a drop in the form that `prepare` takes, as lists."""
    form_and_four = map(list, zip(*map(contact_numbers, drop.contacts), strict=True))
    mass, gap = [ball.mass for ball in drop.balls], [0.0, *drop.gaps]
    return Drops._make([mass, *form_and_four, gap, list(drop.start_velocities), drop.gravity])


def drop_pieces(drop: Drop) -> list[list[float]]:
    """Return the pieces of the curves of each contact; none of one that is not a table."""
    return [[] if law is None else law.pieces() for law in drop.contacts]
