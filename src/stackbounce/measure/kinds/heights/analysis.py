"""Heights of successive bounces -> restitution of each, wherever on the ball they were read."""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from stackbounce.errors import InvalidType, InvalidValue, positive, shown
from stackbounce.measure.drag import Drag
from stackbounce.measure.kinds.heights.result import Heights
from stackbounce.measure.messages import Message, OptionHint
from stackbounce.measure.quantities import Number, deviation
from stackbounce.measure.setup import Place, lowest_point, places
from stackbounce.measure.statistics.regression import widening


def heights(
    drop_height: float | Number,
    bounce_heights: float | Number | Sequence[float | Number],
    *,
    diameter: float | Number | None = None,
    measured_to: Place | tuple[Place, Place] = "bottom",
    height_error: float | None = None,
    repeated: bool = False,
    drag: Drag | None = None,
) -> Heights:
    """Return the restitution of each bounce from the heights between bounces.

    A ball that falls from a height h0 and rises to h1 has the restitution ``sqrt(h1/h0)``. With
    drag it is slower after the fall and was faster before the rise than these heights tell. Both
    are heights of the same point of the ball above where that point is while the ball touches the
    floor; so a height read at the centre counts from half a diameter above the floor, and one read
    at the top from a whole one.

    Parameters
    ----------
    drop_height : float or ufloat
        Above the floor, in m.
    bounce_heights : float or ufloat or sequence of them
        Above the floor, in m, after the first bounce, the second one and so on.
    diameter : float or ufloat, optional
        Of the ball, in m; needed where something was not measured to its bottom.
    measured_to : {"bottom", "centre", "top"} or a pair of them
        Where on the ball the heights were read; a pair has the drop's first and then the bounces'.
    height_error : float, optional
        The error in m of each height that has none of its own; without it the errors are unknown
        (NaN).
    repeated : bool, optional
        Whether `bounce_heights` are the first bounce's, from drop after drop, rather than
        successive ones.
    drag : Drag, optional
        Of the air on the ball; by default there is none.

    Returns
    -------
    Heights

    Raises
    ------
    InvalidValue
        If the height of the lowest point is not above 0, or the diameter is missing.
    InvalidType
        If something has the wrong type.

    Examples
    --------
    >>> found = heights(1.0, [0.64, 0.41], height_error=0.005)
    >>> [f"{kept:.1uS}" for kept in found.restitutions]
    ['0.800(4)', '0.800(6)']

    A drop measured to the bottom of a ball of 65 mm and a rebound measured to its top:

    >>> found = heights(
    ...     1.0, 0.64, diameter=0.065, measured_to=("bottom", "top"), height_error=0.005
    ... )
    >>> print(f"{found.mean:.1uS}")
    0.758(4)

    The first rebound of a table tennis ball in air:

    >>> air = Drag(2.7e-3, 0.040, 0.5)
    >>> print(f"{heights(1.0, 0.70, height_error=0.005, drag=air).mean:.1uS}")
    0.942(4)
    """
    points = places(measured_to)
    error = math.nan
    if height_error is not None:
        error = deviation("height", positive("height_error", height_error, "metres"))

    def counted_from_bottom(name: str, height: Any, point: Place) -> Number:
        return lowest_point(name, _with_error(name, height, error), point, diameter)

    start = counted_from_bottom("drop_height", drop_height, points[0])
    counted = [
        counted_from_bottom(f"the height of bounce {k + 1}", height, points[1])
        for k, height in enumerate(_listed(bounce_heights))
    ]
    before = [start] * len(counted) if repeated else [start, *counted[:-1]]
    kept = [_kept(first, after, drag) for first, after in zip(before, counted, strict=True)]
    mean = _mean(start, counted, repeated, drag)
    notes = _notes(before, counted)
    if drag is not None:
        notes.insert(0, drag.note(_mean(start, counted, repeated, None)))
    return Heights(start, tuple(counted), tuple(kept), mean, bool(repeated), tuple(notes), drag)


def _listed(values: Any) -> list[Any]:
    if isinstance(values, str | bytes):
        raise InvalidType(f"bounce_heights must be numbers of metres, got {shown(values)}")
    try:
        listed = list(values)
    except TypeError:
        listed = [values]
    if not listed:
        raise InvalidValue("bounce_heights must hold at least one height, got none")
    return listed


def _with_error(name: str, value: Any, error: float) -> Number:
    from uncertainties import UFloat, ufloat

    return value if isinstance(value, UFloat) else ufloat(positive(name, value, "metres"), error)


def _kept(first: Any, after: Any, drag: Drag | None) -> Any:
    """Return the restitution of a bounce between two heights."""
    if drag is None:
        return (after / first) ** 0.5
    return drag.launch_speed(after) / drag.fallen_speed(first)


def _mean(start: Any, counted: list[Any], repeated: bool, drag: Drag | None) -> Any:
    """Return the restitution of all bounces together."""
    from uncertainties import ufloat

    if not repeated:
        if drag is not None:
            return drag.restitution_between([start, *counted])
        return (counted[-1] / start) ** (0.5 / len(counted))
    mean = sum(counted) / len(counted)
    if len(counted) > 1:
        # The scatter of the heights includes their reading errors.
        values = np.array([height.nominal_value for height in counted])
        error = float(values.std(ddof=1)) / math.sqrt(len(values)) * widening(len(values) - 1)
        mean = ufloat(values.mean(), error) if error else mean
    return _kept(start, mean, drag)


def _notes(before: list[Any], counted: list[Any]) -> list[str]:
    notes: list[str] = []
    if any(math.isnan(height.std_dev) for height in [before[0], *counted]):
        notes.append(
            Message(
                "A height has no error, so that the restitutions' are unknown: give ",
                OptionHint({"height_error": None}),
                ".",
            )
        )
    for k, (first, after) in enumerate(zip(before, counted, strict=True)):
        if after.nominal_value > first.nominal_value:
            notes.append(
                f"Height {k} ({after.nominal_value:g} m) is above the one that the ball fell from "
                f"({first.nominal_value:g} m): it gained energy, as a stack's upper ball does; "
                "no restitution of one contact is above 1."
            )
    return notes
