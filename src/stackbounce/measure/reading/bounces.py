"""The one row of phyphox's (in)elastic collision: knocks, heights and energies."""

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

    numbers = np.nan_to_num(values)
    names = [column.heading.name.casefold() for column in columns]
    first = [name == "bounce 0" for name in names]
    heard = np.flatnonzero((numbers[:, first] > 0.0).any(axis=1))
    if not heard.size:
        raise FileError("phyphox heard no knock in it")
    found = dict(zip(names, numbers[heard[-1]].tolist(), strict=True))
    times = [found["bounce 0"]]
    while found.get(f"bounce {len(times)}", 0.0) > times[-1]:
        times.append(found[f"bounce {len(times)}"])
    count = len(times)
    heights, energies = (
        np.array([found.get(f"{name} {k}", 0.0) for k in range(count)])
        for name in ("height", "energy")
    )
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
        name: ("bounce", np.where(row > 0.0, row, np.nan), {"units": unit, "long_name": text})
        for name, (row, unit, text) in kept.items()
    }
    said = {"units": "s", "long_name": "Bounce: time of a knock"}
    return xr.Dataset({"knock_time": ("knock", np.array(times), said), **data})
