"""Heights of bounces as a kind of measurement: a table's column, or typed."""

from typing import Any

from stackbounce.errors import InvalidValue
from stackbounce.measure.kind import Kind

__all__ = ["TABLE"]


def _analyse(data: Any, **known: Any) -> Any:
    """Analyse a table with one column of heights, the drop height above those of the bounces."""
    if "y" not in data:
        from stackbounce.measure.kinds import KINDS
        from stackbounce.measure.unrecognised import unrecognised

        raise InvalidValue(unrecognised(data, KINDS))
    return _of_numbers(heights=data["y"].values.tolist(), **known)


def _of_numbers(
    *,
    heights: Any,
    height_error: float | None = None,
    repeated: bool = False,
    measured_to: Any = "bottom",
    diameter: Any = None,
) -> Any:
    from stackbounce.measure.kinds.heights import analysis

    known = {"diameter": diameter, "measured_to": measured_to, "height_error": height_error}
    return analysis.heights(heights[0], heights[1:], repeated=repeated, **known)


TABLE = Kind(
    "table",
    "restitution of each bounce, where its one column is heights",
    _analyse,
    dimension="row",
    of_numbers=_of_numbers,
    starts_with=("heights",),
    typed="heights of bounces",
)
