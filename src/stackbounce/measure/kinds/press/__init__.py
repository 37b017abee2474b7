"""Press curves: static stiffness, exponent, energy loss and unloading exponent."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

from stackbounce.measure.kind import Kind

if TYPE_CHECKING:
    from stackbounce.measure.reading.roles import Column


def _recognised(columns: "Sequence[Column]") -> bool:
    """Return whether the columns have a force and a compression, or one length.

    Beside times, a length that is a position is none: that is a motion detector's.
    """
    roles = {column.role for column in columns}
    others = ("force", "x", "y") if "time" in roles else ("force",)
    lengths = [column for column in columns if column.unit == "m" and column.role not in others]
    return "force" in roles and ("compression" in roles or len(lengths) == 1)


PRESS = Kind(
    "press curve",
    "static stiffness, exponent, loss",
    f"{__name__}.analysis",
    options=("tabulated",),
    columns=(("force",), ("compression",)),
    dimension="point",
    recognised=_recognised,
)
