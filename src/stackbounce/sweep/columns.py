"""Rows of numbers that vary -> what the engine takes for many drops, checked."""

import itertools
import math
from collections.abc import Callable, Mapping
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from stackbounce.engine.many import Drops
from stackbounce.errors import InvalidType, InvalidValue
from stackbounce.model import STANDARD_GRAVITY, Drop, Hysteretic
from stackbounce.simulate import contact_numbers
from stackbounce.sweep.paths import Number, drop_at

__all__ = ["Rows", "check", "columns"]

Rows: TypeAlias = Mapping[Number, NDArray[np.float64]]
"""The numbers that vary, each with its value in every row."""


def columns(drop: Drop, rows: Rows, count: int) -> Drops:
    """Return `count` drops, the base one with other numbers in place, as the engine takes them.

    Parameters
    ----------
    drop : Drop
        The base.
    rows : mapping
        The numbers that vary: (count,) each, in SI units.
    count : int
        How many drops.

    Returns
    -------
    Drops
    """
    mass = np.tile([ball.mass for ball in drop.balls], (count, 1))
    laws = np.array([contact_numbers(law) for law in drop.contacts])
    kind = np.tile(laws[:, 0].astype(np.int64), (count, 1))
    stiffness, exponent, extra = (np.tile(laws[:, k], (count, 1)) for k in (1, 2, 3))
    gap = np.tile([0.0, *drop.gaps], (count, 1))
    velocity = np.tile(drop.start_velocities, (count, 1))
    gravity = np.full(count, drop.gravity)
    places: dict[str, Any] = {"mass": mass, "stiffness": stiffness, "exponent": exponent}
    for number, values in rows.items():
        if number.part == "gaps":
            gap[:, number.index + 1] = values
        elif number.part == "velocities":
            velocity[:, number.index] = values
        elif number.field == "gravity":
            gravity[:] = values
        elif number.field == "impact_speed":
            velocity[:] = -values[:, None]
        elif number.field in places:
            places[number.field][:, number.index] = values
        elif number.part == "contacts" and number.field != "restitution":
            extra[:, number.index] = values
    _set_restitutions(drop, rows, exponent, extra)
    if drop.height is not None:
        height = next((v for n, v in rows.items() if n.field == "height"), drop.height)
        pull = np.where(gravity > 0.0, gravity, STANDARD_GRAVITY)
        velocity[:] = -np.sqrt(2.0 * pull * height)[:, None]
    return Drops(mass, kind, stiffness, exponent, extra, gap, velocity, gravity)


def _set_restitutions(
    drop: Drop, rows: Rows, exponent: NDArray[np.float64], extra: NDArray[np.float64]
) -> None:
    """Fill in n of each Hysteretic contact that is known by its e: e^2 = (p + 1)/(n + 1)."""
    for i, law in enumerate(drop.contacts):
        own = {
            n.field: values for n, values in rows.items() if (n.part, n.index) == ("contacts", i)
        }
        if not isinstance(law, Hysteretic):
            if "restitution" in own:
                extra[:, i] = own["restitution"]
            continue
        known_by_e = law.derived == "unloading_exponent" and "unloading_exponent" not in own
        if "restitution" in own or (known_by_e and "exponent" in own):
            e, p = own.get("restitution", law.restitution), exponent[:, i]
            extra[:, i] = np.maximum(p, (p + 1.0) / e / e - 1.0)


def check(drop: Drop, rows: Rows, where: Callable[[int], str]) -> None:
    """Raise for the first row that makes no drop.

    What a number may be is an interval, and one end of it may depend on another number of the same
    part: if all combinations of smallest and largest values make a drop then so do all rows.

    Parameters
    ----------
    drop : Drop
        The base.
    rows : mapping
        The numbers that vary.
    where : callable
        Returns what a message says of the place of a row.

    Raises
    ------
    InvalidValue, InvalidType
        As `Drop` does, with the place of the row.
    """
    count = len(next(iter(rows.values()), ()))
    if count == 0 or (_corners_hold(drop, rows) and _all_move(drop, rows)):
        return
    for row in range(count):
        try:
            drop_at(drop, {number: float(values[row]) for number, values in rows.items()})
        except (InvalidValue, InvalidType) as error:
            raise type(error)(f"{error} {where(row)}") from error


def _corners_hold(drop: Drop, rows: Rows) -> bool:
    """Tell whether each part of the drop can be made of all smallest and largest values."""
    parts: dict[tuple[str, int], dict[Number, tuple[float, float]]] = {}
    for number, values in rows.items():
        ends = float(np.min(values)), float(np.max(values))
        if not (math.isfinite(ends[0]) and math.isfinite(ends[1])):
            return False
        if number.part != "velocities":
            parts.setdefault((number.part, number.index), {})[number] = ends
    for ranges in parts.values():
        for corner in itertools.product(*ranges.values()):
            try:
                drop_at(drop, dict(zip(ranges, corner, strict=True)))
            except (InvalidValue, InvalidType):
                return False
    return True


def _all_move(drop: Drop, rows: Rows) -> bool:
    """Tell whether in each row some ball moves."""
    if drop.velocities is None:
        return True
    moving = np.zeros(len(next(iter(rows.values()))), dtype=bool)
    for i, velocity in enumerate(drop.velocities):
        own = [values for n, values in rows.items() if (n.part, n.index) == ("velocities", i)]
        moving |= (own[0] if own else np.full(len(moving), velocity)) != 0.0
    return bool(moving.all())
