"""Force against compression as a kind of measurement."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

from stackbounce.measure.kind import Kind

if TYPE_CHECKING:
    import xarray as xr

    from stackbounce.measure.kinds.press.result import Press
    from stackbounce.measure.reading.roles import Column

__all__ = ["PRESS"]


def _analyse(data: "xr.Dataset") -> "Press":
    from stackbounce.measure.kinds.press.analysis import press

    return press(data)


def _recognised(columns: "Sequence[Column]") -> bool:
    """Tell whether the columns have a force and a compression, or one length and no time."""
    roles = {one.role for one in columns}
    lengths = [one for one in columns if one.unit == "m" and one.role != "force"]
    one_length = "time" not in roles and len(lengths) == 1
    return "force" in roles and ("compression" in roles or one_length)


PRESS = Kind(
    "press curve",
    "static stiffness, exponent, loss",
    _analyse,
    columns=(("force",), ("compression",)),
    dimension="point",
    recognised=_recognised,
)
