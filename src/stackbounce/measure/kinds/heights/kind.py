"""Heights of bounces as a kind of measurement: a table's column, or typed."""

from typing import TYPE_CHECKING, Any

from stackbounce.errors import InvalidValue
from stackbounce.measure.kind import Kind

if TYPE_CHECKING:
    import xarray as xr

    from stackbounce.measure.kinds.heights.result import Heights

__all__ = ["TABLE"]


def _analyse(
    data: "xr.Dataset",
    *,
    height_error: float | None = None,
    repeated: bool = False,
    measured_to: Any = "bottom",
    diameter: Any = None,
) -> "tuple[Heights, ...]":
    """Analyse a table with one column of heights, the drop's above the bounces'."""
    if "y" not in data:
        from stackbounce.measure.kinds import KINDS

        raise InvalidValue(
            "there is no analysis of a table without heights: tell what it holds, one of "
            f"{', '.join(KINDS)}"
        )
    found = _of_numbers(
        heights=data["y"].values.tolist(),
        height_error=height_error,
        repeated=repeated,
        measured_to=measured_to,
        diameter=diameter,
    )
    return (found,)


def _of_numbers(
    *,
    heights: Any,
    height_error: float | None = None,
    repeated: bool = False,
    measured_to: Any = "bottom",
    diameter: Any = None,
) -> "Heights":
    from stackbounce.measure.kinds.heights import analysis

    dropped, *risen = heights
    return analysis.heights(
        dropped,
        risen,
        diameter=diameter,
        measured_to=measured_to,
        height_error=height_error,
        repeated=repeated,
    )


TABLE = Kind(
    "table",
    "restitution of each bounce, where its one column is heights",
    _analyse,
    dimension="row",
    of_numbers=_of_numbers,
    starts_with=("heights",),
    typed="heights of bounces",
)
