"""Heights of successive bounces -> restitution of each, wherever on the ball they were read."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any, ClassVar

import numpy as np

from stackbounce.errors import InvalidValue, positive
from stackbounce.measure.drag import Drag, drag_given, speed_after_fall
from stackbounce.measure.finding import Finding, rigid_contact
from stackbounce.measure.messages import Message, OptionHint
from stackbounce.measure.quantities import Number, Row, deviation, known_to, measured, nominal
from stackbounce.measure.setup import Place, lowest_point, places
from stackbounce.measure.statistics.regression import widening
from stackbounce.model.drop import STANDARD_GRAVITY
from stackbounce.units import checked


@dataclass(frozen=True, repr=False)
class Heights(Finding):
    """Restitutions from the heights of bounces; made by `heights`.

    Attributes
    ----------
    drop_height : ufloat
        Of the ball's lowest point above the floor, in m.
    bounce_heights : tuple of ufloat
        Of its lowest point, in m.
    restitutions : tuple of ufloat
        Of each bounce. Neighbours share a height, so their errors are correlated.
    mean : ufloat
        The one restitution that leads from the drop height to the last height; in air, the
        geometric mean of all.
    repeated : bool
        Whether the heights are those of the first bounce in repeated drops.
    notes : tuple of str
        What a reader of the numbers should know, a sentence each.
    drag : Drag or None
        Of the air, where it was taken into account.
    """

    picture: ClassVar[str] = "heights"

    drop_height: Number
    bounce_heights: tuple[Number, ...]
    restitutions: tuple[Number, ...]
    mean: Number
    repeated: bool
    notes: tuple[str, ...]
    drag: Drag | None = None

    def rows(self) -> list[Row]:
        """Return the table, the most important first."""
        rows = [Row("restitution", self.mean), Row("drop height", self.drop_height, "m")]
        after, of = ("", "") if self.repeated else ("after bounce ", "of bounce ")
        for k, height in enumerate(self.bounce_heights):
            rows.append(Row(f"height {after}{k}", height, "m"))
            rows.append(Row(f"restitution {of}{k}", self.restitutions[k]))
        return [*rows, *(self.drag.rows() if self.drag else ())]

    def parts(self) -> dict[str, Any]:
        """Return the floor's contact and the drop height, as in a drop's TOML.

        In air it is the impact speed: a simulated drop falls without.
        """
        contact = rigid_contact(self.mean)
        if self.drag is not None:
            return {"impact_speed": nominal(self._speed), **contact}
        return {"height": nominal(self.drop_height), **contact}

    def law_arguments(self) -> dict[str, Any]:
        """Return the restitution and the impact speed, at standard gravity."""
        return {"restitution": self.mean, "impact_speed": self._speed}

    @property
    def _speed(self) -> Any:
        return speed_after_fall(self.drop_height, STANDARD_GRAVITY, self.drag)


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
    from uncertainties import ufloat

    points, drag = places(measured_to), drag_given(drag)
    error = math.nan
    if height_error is not None:
        error = deviation("height", checked(positive, "height_error", height_error, "metres"))

    def counted_from_bottom(name: str, height: Any, point: Place) -> Number:
        known = measured(name, height, "metres")
        known = known if known.std_dev > 0.0 else ufloat(known.nominal_value, error)
        return lowest_point(name, known, point, diameter)

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
    several = np.iterable(values) and not isinstance(values, str | bytes)
    listed = list(values) if several else [values]
    if not listed:
        raise InvalidValue("at least one bounce height is needed, got none")
    return listed


def _kept(first: Any, after: Any, drag: Drag | None) -> Any:
    """Return the restitution of a bounce between two heights."""
    if drag is None:
        return (after / first) ** 0.5
    return drag.launch_speed(after) / drag.fallen_speed(first)


def _mean(start: Any, counted: list[Any], repeated: bool, drag: Drag | None) -> Any:
    """Return the restitution of all bounces together."""
    if not repeated:
        kept = [_kept(first, after, drag) for first, after in pairwise([start, *counted])]
        return math.prod(kept) ** (1.0 / len(kept))
    mean = sum(counted) / len(counted)
    if len(counted) > 1:
        # The scatter of the heights includes their reading errors.
        values = np.array([height.nominal_value for height in counted])
        error = float(values.std(ddof=1)) / math.sqrt(len(values)) * widening(len(values) - 1)
        mean = known_to(values.mean(), error) if error else mean
    return _kept(start, mean, drag)


def _notes(before: list[Any], counted: list[Any]) -> list[str]:
    notes: list[str] = []
    if any(math.isnan(height.std_dev) for height in [before[0], *counted]):
        unknown = "A height has no error, so that the restitutions' are unknown: give "
        notes.append(Message(unknown, OptionHint({"height_error": None}), "."))
    for k, (first, after) in enumerate(zip(before, counted, strict=True)):
        if after.nominal_value > first.nominal_value:
            notes.append(
                f"Height {k} ({after.nominal_value:g} m) is above the one that the ball fell from "
                f"({first.nominal_value:g} m): it gained energy, as a stack's upper ball does; "
                "no restitution of one contact is above 1."
            )
    return notes
