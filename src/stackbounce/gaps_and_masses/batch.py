"""Drops of one kind with different numbers, solved together."""

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

__all__ = ["joined", "solved"]


def solved(drops: Sequence[Drop], gaps: Sequence[float] | None = None) -> "xr.Dataset":
    """Return what comes of many drops, as `sweep` does.

    Parameters
    ----------
    drops : sequence of Drop
        At least one; all have as many balls, the same gaps and the same impact speed.
    gaps : sequence of float, optional
        In m: each drop is solved with each of them between all neighbours; by default with its own.

    Returns
    -------
    xarray.Dataset
        As from `sweep`, (stack, ...), or (stack, gap, ...) where there are `gaps`.

    Examples
    --------
    >>> from stackbounce.model import Ball, Hysteretic, Spring
    >>> laws = Spring(1e4), Hysteretic(1e4, restitution=0.8)
    >>> drops = [Drop([Ball(1.0)], [law], impact_speed=1.0) for law in laws]
    >>> solved(drops).rebound_ratio.values.round(6)
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
    return joined(parts, "stack")


def joined(parts: "Sequence[xr.Dataset]", dim: str) -> "xr.Dataset":
    """Return sweeps along a dimension of all of them as one, in the order of its values."""
    import xarray as xr

    how: Any = {"data_vars": "all", "coords": "minimal", "compat": "override", "join": "outer"}
    return xr.concat(parts, dim, **how).sortby(dim)


def _kind(drop: Drop) -> tuple[Any, ...]:
    """Return what drops of one sweep have in common."""
    return tuple((type(law), contact_numbers(law)[0]) for law in drop.contacts)


def _varied(drops: Sequence[Drop]) -> dict[str, NDArray[np.float64]]:
    """Return the numbers of balls and contacts that are not the same in all drops, by their paths.

    The lowest ball's mass is one of them in any case, so that there is one.
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
            continue  # a ball's size or material, which no run depends on
        row = np.array([getattr(part, number.field) for part in parts], dtype=float)
        if path == "balls.0.mass" or np.ptp(row) > 0.0:
            found[path] = row
    return found
