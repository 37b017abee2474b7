"""Heights of bounces as a kind of measurement: a table's column, or typed."""

from dataclasses import replace
from typing import Any

from stackbounce.errors import InvalidValue
from stackbounce.measure.kinds import KINDS
from stackbounce.measure.kinds.heights.analysis import heights
from stackbounce.measure.kinds.heights.result import Heights
from stackbounce.measure.messages import Message, OptionHint
from stackbounce.measure.setup import Setup
from stackbounce.measure.unrecognised import unrecognised

_MANY = 100  # heights of one drop


def analyse(data: Any, setup: Setup) -> Heights:
    """Analyse a table with one column of heights, the drop height above those of the bounces."""
    if "y" not in data:
        raise InvalidValue(unrecognised(data, KINDS))
    column = data["y"].values.tolist()
    if not setup.repeated:
        _check_fall(column)
    return of_numbers(replace(setup, heights=column))


def of_numbers(setup: Setup) -> Heights:
    """Return the restitutions that heights tell."""
    drop_height, *bounce_heights = setup.heights
    return heights(
        drop_height,
        bounce_heights,
        diameter=setup.diameter,
        measured_to=setup.measured_to,
        height_error=setup.height_error,
        repeated=setup.repeated,
        drag=setup.drag,
    )


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
