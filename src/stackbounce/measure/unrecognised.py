"""A table of an unknown kind: what its columns are, and how to go on."""

import re
from collections.abc import Iterable
from typing import TYPE_CHECKING

import numpy as np

from stackbounce.measure.messages import Message, OptionHint

if TYPE_CHECKING:
    import xarray as xr

_LISTED = 6  # columns that are described


def unrecognised(data: "xr.Dataset", kinds: Iterable[str]) -> Message:
    """Return why a table cannot be analysed: its columns, their first numbers, and what to type.

    Parameters
    ----------
    data : xarray.Dataset
        A table as `read` gives it.
    kinds : iterable of str
        What a file can hold.

    Examples
    --------
    >>> import numpy as np
    >>> import xarray as xr
    >>> columns = {"CH1": ("row", np.array([3.0, 1.0]), {"column": 1, "long_name": "CH1"})}
    >>> data = xr.Dataset(columns, attrs={"source": "a.txt"})
    >>> print(unrecognised(data, ["track", "sound"]))
    its columns do not tell ... kind of measurement: 'CH1' (3, 1). For times and heights ...
    """
    columns = list(data.data_vars.values())
    shown = ", ".join(map(_described, columns[:_LISTED]))
    more = f" and {len(columns) - _LISTED} more" if len(columns) > _LISTED else ""
    file = str(data.attrs.get("source", "FILE"))
    hint = OptionHint({"holds": "track", "names": {1: "time", 2: "y"}}, file)
    others = ", ".join(name for name in kinds if name not in ("track", "bounces", "table"))
    return Message(
        f"its columns do not tell a kind of measurement: {shown}{more}. For times and heights of a "
        "ball: ",
        hint,
        f"; other kinds: {others}",
    )


def _described(one: "xr.DataArray") -> str:
    """Return the name of a column, or its number, and its first numbers."""
    values = np.asarray(one.values, dtype=np.float64).ravel()
    known = values[np.isfinite(values)]
    first = ", ".join(f"{value:.5g}" for value in known[:3])
    name = str(one.attrs.get("long_name", one.name))
    shown = name if re.fullmatch(r"column \d+", name) else f"{name[:40]!r}"
    return f"{shown} ({first})"
