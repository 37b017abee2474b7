"""The one row of phyphox's (in)elastic collision: knocks, heights and energies."""

import re
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from stackbounce.errors import FileError
from stackbounce.measure.quantities import Array
from stackbounce.measure.reading.roles import Column

if TYPE_CHECKING:
    import xarray as xr

INFERRED = (
    "height 0, of the drop, was not measured: phyphox infers it from the bounces that followed"
)


def bounces(columns: Sequence[Column], values: Array) -> "xr.Dataset":
    """Return the knocks that were heard, and what phyphox derived of them.

    If it heard no knock k, phyphox computes height k and energy k from the time since knock k - 1;
    these are left out.

    Parameters
    ----------
    columns : sequence of Column
        ``Bounce 0 (s)``, ``Height 0 (m)`` … ``Energy 1`` …
    values : numpy.ndarray, shape (rows, columns)
        Their numbers; the last row with a knock counts.

    Raises
    ------
    FileError
        If no knock was heard.
    """
    import xarray as xr

    found: dict[tuple[str, int], float] = {}
    numbers = np.nan_to_num(values)
    first = [k for k, one in enumerate(columns) if one.heading.name.casefold() == "bounce 0"]
    heard = np.flatnonzero(numbers[:, first[0]] > 0.0) if first else np.array([])
    if not heard.size:
        raise FileError("phyphox heard no knock in it")
    for column, number in zip(columns, numbers[heard[-1]], strict=True):
        name = re.fullmatch(r"(bounce|height|energy) ([0-9]{1,3})", column.heading.name.casefold())
        if name:
            found[name[1], int(name[2])] = float(number)
    times = [found["bounce", 0]]
    while found.get(("bounce", len(times)), 0.0) > times[-1]:
        times.append(found["bounce", len(times)])
    count = len(times)
    heights = [found.get(("height", k), 0.0) for k in range(count)]
    energies = [found.get(("energy", k), 0.0) for k in range(count)]
    if count < 3:  # phyphox compares the first two flights to infer the drop
        heights[0] = 0.0
    energies[0] = 0.0
    if count > 1 and not energies[1]:
        energies[1] = 1.0  # phyphox sets the others in proportion to this one
    kept = {
        "height": (heights, "m", "Height: apex before this knock; of the drop at 0"),
        "energy": (energies, "1", "Energy, of that after knock 0"),
    }
    data = {
        name: (
            "bounce",
            np.where(np.array(row) > 0.0, row, np.nan),
            {"units": unit, "long_name": text},
        )
        for name, (row, unit, text) in kept.items()
    }
    said = {"units": "s", "long_name": "Bounce: time of a knock"}
    return xr.Dataset({"knock_time": ("knock", np.array(times), said), **data})
