"""Heights of bounces as a kind of measurement: a table's column, or typed."""

from typing import Any

from stackbounce.errors import InvalidValue
from stackbounce.measure.kind import Kind
from stackbounce.measure.messages import Message, OptionHint

__all__ = ["TABLE"]

_MANY = 100  # heights of one drop


def _analyse(data: Any, **known: Any) -> Any:
    """Analyse a table with one column of heights, the drop height above those of the bounces."""
    if "y" not in data:
        from stackbounce.measure.kinds import KINDS
        from stackbounce.measure.unrecognised import unrecognised

        raise InvalidValue(unrecognised(data, KINDS))
    heights = data["y"].values.tolist()
    if not known.get("repeated"):
        _check_fall(heights)
    return _of_numbers(heights=heights, **known)


def _check_fall(heights: list[float]) -> None:
    """Refuse a column in which heights rise, but for that of a stack's upper ball."""
    rises = [k for k in range(1, len(heights)) if heights[k] > heights[k - 1]]
    if len(heights) > _MANY or [k for k in rises if k > 1]:
        at = max(rises, default=0)
        rise = f", {heights[at]:.4g} m after {heights[at - 1]:.4g} m in row {at + 1}" * bool(rises)
        raise InvalidValue(
            Message(
                "a table of heights must hold those of one ball's bounces, each below the one "
                f"before and up to {_MANY} of them, got {len(heights)} heights{rise}: positions "
                "over time are a track, ",
                OptionHint({"holds": "track"}),
                ", and drops that are repeated need ",
                OptionHint({"repeated": None}),
            )
        )


def _of_numbers(
    *,
    heights: Any,
    height_error: float | None = None,
    repeated: bool = False,
    measured_to: Any = "bottom",
    mass: Any = None,
    diameter: Any = None,
    drag_coefficient: Any = None,
    air_density: Any = None,
) -> Any:
    from stackbounce.measure.drag import drag_of
    from stackbounce.measure.kinds.heights import analysis

    known = {"diameter": diameter, "measured_to": measured_to, "height_error": height_error}
    known["drag"] = drag_of(mass, diameter, drag_coefficient, air_density)
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
