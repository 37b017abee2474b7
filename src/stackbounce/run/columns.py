"""The parameters of many drops, as arrays for the engine, and their validation."""

import itertools
import math
from collections.abc import Callable, Mapping
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from stackbounce.engine.records import Drops
from stackbounce.errors import InvalidType, InvalidValue
from stackbounce.model import STANDARD_GRAVITY, Drop
from stackbounce.model.laws import contact_numbers
from stackbounce.run.parameters import drop_numbers
from stackbounce.run.paths import Number, drop_at

Rows: TypeAlias = Mapping[Number, NDArray[np.float64]]
"""The numbers that vary, in SI units: arrays that broadcast with each other."""


def base_rows(drop: Drop, count: int) -> Drops:
    """Return the parameters of ``count`` equal drops, as arrays (count, balls) and (count,)."""
    return Drops._make(
        np.full((count, *np.shape(numbers)), numbers) for numbers in drop_numbers(drop)
    )


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
        _, first, second, third, fourth = contact_numbers(drop.contacts[i], varied)
        drops.first[..., i], drops.second[..., i] = first, second
        drops.third[..., i], drops.fourth[..., i] = third, fourth
    if drop.height is not None:
        height = next((v for n, v in rows.items() if n.field == "height"), drop.height)
        pull = np.where(drops.gravity > 0.0, drops.gravity, STANDARD_GRAVITY)
        drops.velocity[...] = -np.sqrt(2.0 * pull * height)[..., None]


def incidence(
    drop: Drop, rows: Rows, count: int
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the impact speeds in m/s and gravity in m/s**2 of some drops, (count,) each."""
    drops = base_rows(drop, count)
    fill(drops, drop, rows)
    return np.max(np.abs(drops.velocity), axis=1), drops.gravity


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
    for ranges in parts.values():
        for corner in itertools.product(*ranges.values()):
            try:
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
