"""Heights of successive bounces -> restitution of each, wherever on the ball they were read."""

import math
from collections.abc import Sequence
from typing import Any, Literal, TypeAlias

import numpy as np

from stackbounce.errors import InvalidType, InvalidValue, positive, shown
from stackbounce.measure.drag import Drag
from stackbounce.measure.kinds.heights.result import Heights
from stackbounce.measure.messages import Message, OptionHint
from stackbounce.measure.quantities import Number, deviation, nominal
from stackbounce.measure.statistics.regression import widening

__all__ = ["Place", "above_bottom", "fallen", "heights", "places"]

Place: TypeAlias = Literal["bottom", "centre", "top"]
"""The point of the ball that a height was read at."""

_UP = {"bottom": 0.0, "centre": 0.5, "top": 1.0}  # diameters above the lowest point


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
    size = _size(diameter, *points)
    listed = _listed(bounce_heights)
    start = _counted("drop_height", _number("drop_height", drop_height, error), points[0], size)
    names = [f"bounce_heights.{k}" for k in range(len(listed))]
    counted = [
        _counted(name, _number(name, one, error), points[1], size)
        for name, one in zip(names, listed, strict=True)
    ]
    before = [start] * len(counted) if repeated else [start, *counted[:-1]]
    kept = [_kept(first, after, drag) for first, after in zip(before, counted, strict=True)]
    mean = _mean(start, counted, repeated, drag)
    notes = _notes(before, counted)
    if drag is not None:
        notes.insert(0, drag.note(_mean(start, counted, repeated, None)))
    return Heights(start, tuple(counted), tuple(kept), mean, bool(repeated), tuple(notes), drag)


def above_bottom(measured_to: str, diameter: float | Number | None = None) -> Any:
    """Return how far the bottom, centre or top of a ball lies above its lowest point.

    Parameters
    ----------
    measured_to : {"bottom", "centre", "top"}
        Which point of the ball.
    diameter : float or ufloat, optional
        In m; needed but for the bottom.

    Returns
    -------
    float or ufloat
        In m.

    Raises
    ------
    InvalidValue
        If the diameter is missing or not above 0.

    Examples
    --------
    >>> above_bottom("centre", 0.066)
    0.033
    """
    return _UP[measured_to] * _size(diameter, measured_to)


def fallen(height: Any, measured_to: object, diameter: Any) -> Any:
    """Return the drop height of the ball's lowest point; None where none is given.

    Examples
    --------
    >>> fallen(1.0, "top", 0.065)
    0.935
    """
    if height is None:
        return None
    place, _ = places(measured_to)
    return _counted("height", _number("height", height, 0.0), place, _size(diameter, place))


def places(measured_to: object) -> tuple[str, str]:
    """Return the points that the drop's height and the bounces' were measured to.

    Raises
    ------
    InvalidType, InvalidValue
        If it is neither one of the three nor a pair of them.

    Examples
    --------
    >>> places("centre"), places(("bottom", "top"))
    (('centre', 'centre'), ('bottom', 'top'))
    """
    pair = (measured_to, measured_to) if isinstance(measured_to, str) else measured_to
    if not (isinstance(pair, tuple | list) and len(pair) == 2):
        raise InvalidType(
            f"measured_to must be bottom, centre or top, or a pair, got {shown(measured_to)}"
        )
    for place in pair:
        if place not in _UP:
            raise InvalidValue(f"measured_to must be bottom, centre or top, got {shown(place)}")
    return str(pair[0]), str(pair[1])


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


def _number(name: str, value: Any, error: float) -> Any:
    from uncertainties import UFloat, ufloat

    if isinstance(value, UFloat):
        positive(name, value.nominal_value, "metres")
        return value
    number = positive(name, value, "metres")
    return number if error == 0.0 else ufloat(number, error)


def _size(diameter: Any, *places: str) -> Any:
    if diameter is None:
        away = [place for place in places if _UP[place]]
        if away:
            raise InvalidValue(
                f"diameter must be given where a height was measured to the {away[0]}, got None"
            )
        return 0.0
    return _number("diameter", diameter, 0.0)  # a number is taken to be exact


def _counted(name: str, height: Any, place: str, size: Any) -> Any:
    """Return a height of the ball's lowest point."""
    counted = height - _UP[place] * size
    least, got = nominal(_UP[place] * size), nominal(height)
    if got <= least:
        raise InvalidValue(
            f"{name} must be more than the height of the ball's {place} on the floor "
            f"({least:g} m), got {got:g} m"
        )
    return counted


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
        values = np.array([one.nominal_value for one in counted])
        error = float(values.std(ddof=1)) / math.sqrt(len(values)) * widening(len(values) - 1)
        mean = ufloat(values.mean(), error) if error else mean
    return _kept(start, mean, drag)


def _notes(before: list[Any], counted: list[Any]) -> list[str]:
    notes: list[str] = []
    if any(math.isnan(one.std_dev) for one in [before[0], *counted]):
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
