"""The numbers of one drop, or of many that vary, as the engine takes them; checked."""

import itertools
import math
from collections.abc import Callable, Mapping
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from stackbounce.engine.batch import Drops
from stackbounce.errors import InvalidType, InvalidValue
from stackbounce.model import STANDARD_GRAVITY, Drop
from stackbounce.model.laws import contact_numbers
from stackbounce.run.paths import Number, drop_at

__all__ = ["Rows", "base_rows", "check", "drop_numbers", "fill"]

Rows: TypeAlias = Mapping[Number, NDArray[np.float64]]
"""The numbers that vary, in SI units: arrays that broadcast with each other."""


def drop_numbers(drop: Drop) -> Drops:
    """Return a drop's numbers as the engine takes them, in lists."""
    rows = zip(*map(contact_numbers, drop.contacts), strict=True)
    kind, stiffness, exponent, law_parameter = map(list, rows)
    return Drops(
        mass=[ball.mass for ball in drop.balls],
        kind=kind,
        stiffness=stiffness,
        exponent=exponent,
        law_parameter=law_parameter,
        gap=[0.0, *drop.gaps],
        velocity=list(drop.start_velocities),
        gravity=drop.gravity,
    )


def base_rows(drop: Drop, count: int) -> Drops:
    """Return a drop's numbers so many times over, in arrays (count, balls) and (count,)."""
    return Drops._make(np.full((count, *np.shape(one)), one) for one in drop_numbers(drop))


def fill(drops: Drops, drop: Drop, rows: Rows) -> None:
    """Set the numbers that vary in drops that have all others.

    Parameters
    ----------
    drops : Drops
        Arrays (..., balls), and (...,) gravity, with the base's numbers.
    drop : Drop
        The base.
    rows : mapping
        The numbers that vary: they broadcast to (...,).
    """
    laws: dict[int, dict[str, Any]] = {}
    for number, values in rows.items():
        if number.part == "gaps":
            drops.gap[..., number.index + 1] = values
        elif number.part == "velocities":
            drops.velocity[..., number.index] = values
        elif number.field == "gravity":
            drops.gravity[...] = values
        elif number.field == "impact_speed":
            drops.velocity[...] = -values[..., None]
        elif number.field == "mass":
            drops.mass[..., number.index] = values
        elif number.part == "contacts":
            laws.setdefault(number.index, {})[number.field] = values
    for i, varied in laws.items():
        _, stiffness, exponent, law_parameter = contact_numbers(drop.contacts[i], varied)
        drops.stiffness[..., i], drops.exponent[..., i] = stiffness, exponent
        drops.law_parameter[..., i] = law_parameter
    if drop.height is not None:
        height = next((v for n, v in rows.items() if n.field == "height"), drop.height)
        pull = np.where(drops.gravity > 0.0, drops.gravity, STANDARD_GRAVITY)
        drops.velocity[...] = -np.sqrt(2.0 * pull * height)[..., None]


def check(drop: Drop, rows: Rows, where: Callable[[tuple[int, ...]], str]) -> None:
    """Raise for the first row of numbers that makes no drop.

    The valid values of a number are an interval, one end of which may depend on another number of
    the same part. So if all combinations of smallest and largest values are valid, all rows are.

    Parameters
    ----------
    drop : Drop
        The base.
    rows : mapping
        The numbers that vary.
    where : callable
        Returns the words of a message for the row with an index.

    Raises
    ------
    InvalidValue, InvalidType
        As `Drop` does, with the words for the row.
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
    """Tell whether all combinations of smallest and largest values are valid, part by part."""
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
    """Tell whether some ball moves in each row."""
    if drop.velocities is None:
        return True
    varied = {n.index: values for n, values in rows.items() if n.part == "velocities"}
    still: Any = True
    for i, velocity in enumerate(drop.velocities):
        still = still & np.equal(varied.get(i, velocity), 0.0)
    return not np.any(still)
