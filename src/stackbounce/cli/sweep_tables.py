"""The summary of ``stackbounce sweep``, for people and for machines."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr
from rich.console import Console

from stackbounce.run.batch import blocks, sides
from stackbounce.run.result import Status

_BLOCK = 2**18  # drops that are summarised together
_SPOKEN = ("rebound_ratio", "collisions", "energy_retained")


def summary(data: xr.Dataset, out: Path) -> dict[str, Any]:
    """Return the summary of a sweep for --json, read in blocks as it may exceed the memory."""
    dims, shape = data.status.dims, data.status.shape
    counts = np.zeros(max(Status) + 1, dtype=int)
    low: dict[str, Any] = dict.fromkeys(_SPOKEN, np.nan)
    high = low.copy()
    for block in blocks(shape, sides(shape, _BLOCK)):
        part = data.isel(dict(zip(dims, block, strict=True)))
        counts += np.bincount(part.status.values.ravel(), minlength=len(counts))
        for name in _SPOKEN:
            values = part[name].values
            rows = values.reshape(-1, *values.shape[len(dims) :])
            low[name] = np.fmin(low[name], np.fmin.reduce(rows))
            high[name] = np.fmax(high[name], np.fmax.reduce(rows))
    return {
        "store": str(out),
        "drops": data.status.size,
        "over": {str(dim): data.sizes[dim] for dim in dims},
        "status": {status.name: int(counts[status]) for status in Status if counts[status]},
        "ranges": {
            name: _ranges(data[name].dims[len(dims) :], low[name], high[name]) for name in _SPOKEN
        },
    }


def print_sweep(console: Console, data: xr.Dataset, found: dict[str, Any]) -> None:
    """Print the summary of a sweep."""
    console.print(f"{found['drops']} drops, over")
    for dim, size in found["over"].items():
        if dim in data.coords:
            console.print(f"  {dim}: {size}, {_span(data[dim])}")
            continue
        console.print(f"  {dim}: {size}, each with its own")
        for path, coord in data.coords.items():
            if coord.dims == (dim,):
                console.print(f"    {path}: {_span(coord)}")
    for name, ranges in found["ranges"].items():
        for part, (low, high) in ranges.items():
            console.print(f"  {name} {part}".rstrip() + f": {_range(low, high)}")
    for name, count in found["status"].items():
        console.print(f"  {count} {name}: {Status[name].advice}")
    console.print(f"Written: {found['store']}")


def _span(axis: xr.DataArray) -> str:
    """Return the smallest and the largest value of a number that varies, with its unit."""
    return f"{_range(axis.values.min(), axis.values.max())} {axis.attrs.get('units', '')}".rstrip()


def _range(low: float, high: float) -> str:
    one, other = f"{low:.6g}", f"{high:.6g}"
    return one if one == other else f"{one} to {other}"


def _ranges(own: Sequence[Any], low: Any, high: Any) -> dict[str, tuple[float, float]]:
    """Return smallest and largest values by ball or contact; `own` is that dimension, if any."""
    pairs = zip(np.atleast_1d(low).tolist(), np.atleast_1d(high).tolist(), strict=True)
    return {f"{own[0]} {k}" if own else "": pair for k, pair in enumerate(pairs)}
