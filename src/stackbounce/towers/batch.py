"""Batches: many drops with equal contact laws and different numbers, solved in one sweep."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from stackbounce.model import ContactLaw, Drop
from stackbounce.model.laws import contact_numbers
from stackbounce.run.paths import numbers_of
from stackbounce.sweeps import sweep

if TYPE_CHECKING:
    import xarray as xr


def solve_drops(drops: Sequence[Drop], gaps: Sequence[float] | None = None) -> "xr.Dataset":
    """Solve many drops and return their results as `sweep` does.

    Parameters
    ----------
    drops : sequence of Drop
        At least one. All have the same number of balls, the same gaps and the same impact speed.
    gaps : sequence of float, optional
        In m. Each drop is solved once for each value, which replaces all of its gaps. By default
        each drop keeps its own gaps.

    Returns
    -------
    xarray.Dataset
        As from `sweep`, with the dimensions (stack, ...), or (stack, gap, ...) with `gaps`.

    Examples
    --------
    >>> from stackbounce.model import Ball, Hysteretic, Spring
    >>> laws = Spring(1e4), Hysteretic(1e4, restitution=0.8)
    >>> drops = [Drop([Ball(1.0)], [law], impact_speed=1.0) for law in laws]
    >>> solve_drops(drops).rebound_ratio.values.round(6)
    array([[1. ],
           [0.8]])
    """
    import xarray as xr

    kinds: dict[Any, list[int]] = {}
    for i, drop in enumerate(drops):
        kinds.setdefault(_kind(drop), []).append(i)
    parts = []
    for places in kinds.values():
        own = [drops[i] for i in places]
        values = {path: xr.DataArray(row, dims="stack") for path, row in _varied(own).items()}
        if gaps is not None:
            one = xr.DataArray(list(gaps), dims="gap")
            values |= {f"gaps.{i}": one for i in range(len(own[0].gaps))}
        parts.append(sweep(own[0], values).drop_vars(values).assign_coords(stack=places))
    how: Any = {"data_vars": "all", "coords": "minimal", "compat": "override", "join": "outer"}
    return xr.concat(parts, "stack", **how).sortby("stack")


def _kind(drop: Drop) -> tuple[Any, ...]:
    """Return a key of a drop's contact laws: one sweep solves only drops with equal keys."""
    return tuple((type(law), contact_numbers(law)[0]) for law in drop.contacts)


def _varied(drops: Sequence[Drop]) -> dict[str, NDArray[np.float64]]:
    """Return the numbers of balls and contacts that differ between the drops, by their paths.

    The lowest ball's mass is always included, because a sweep needs at least one number.
    """
    found = {}
    for path, number in numbers_of(drops[0]).items():
        if number.part not in ("balls", "contacts") or not number.field:
            continue
        parts = [getattr(drop, number.part)[number.index] for drop in drops]
        first = parts[0]
        if isinstance(first, ContactLaw) and number.field == first.derived_field():
            continue
        if getattr(first, number.field) is None:
            continue  # a ball's size or material, which does not affect a run
        row = np.array([getattr(part, number.field) for part in parts], dtype=float)
        if path == "balls.0.mass" or np.ptp(row) > 0.0:
            found[path] = row
    return found
