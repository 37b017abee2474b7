"""Force against compression as a kind of measurement."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

from stackbounce.measure.kind import Kind

if TYPE_CHECKING:
    import xarray as xr

    from stackbounce.measure.kinds.press.result import Press
    from stackbounce.measure.reading.roles import Column

__all__ = ["PRESS"]


def _analyse(data: "xr.Dataset", *, tabulated: bool = False) -> "Press":
    from stackbounce.measure.kinds.press.analysis import press

    return press(data, tabulated=tabulated)


def _recognised(columns: "Sequence[Column]") -> bool:
    """Return whether the columns have a force and a compression, or one length.

    Beside times, a length that is a position is none: that is a motion detector's.
    """
    roles = {one.role for one in columns}
    positions = ("x", "y") if "time" in roles else ()
    lengths = [one for one in columns if one.unit == "m" and one.role not in ("force", *positions)]
    return "force" in roles and ("compression" in roles or len(lengths) == 1)


PRESS = Kind(
    "press curve",
    "static stiffness, exponent, loss",
    _analyse,
    columns=(("force",), ("compression",)),
    dimension="point",
    recognised=_recognised,
)
