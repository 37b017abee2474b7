"""What is known of a measurement besides its file: the ball, its drop, the place."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Literal, TypeAlias

from stackbounce.errors import InvalidType, InvalidValue, positive, shown
from stackbounce.measure.drag import Drag, drag_of, speed_after_fall
from stackbounce.measure.quantities import Number, measured, nominal
from stackbounce.model.drop import STANDARD_GRAVITY
from stackbounce.model.laws import ContactLaw

Place: TypeAlias = Literal["bottom", "centre", "top"]
"""The point of the ball that a height was read at."""

_DIAMETERS_UP = {"bottom": 0.0, "centre": 0.5, "top": 1.0}  # above the lowest point


@dataclass(frozen=True, kw_only=True)
class Setup:
    """The options of a measurement, as `analyse` takes them, and what follows from them.

    What follows is calculated where a kind asks for it: a kind that has no use for an option does
    not refuse it either.

    Examples
    --------
    >>> Setup(height=1.0, measured_to="top", diameter=0.065).drop_height
    0.935
    """

    mass: Number | float | None = None
    diameter: Number | float | None = None
    contact_time: Number | float | None = None
    restitution: Number | float | None = None
    law: type[ContactLaw] | ContactLaw | str | None = None
    exponent: float | None = None
    height: Number | float | None = None
    speed: Number | float | None = None
    heights: Sequence[Number | float] = ()
    height_error: float | None = None
    repeated: bool = False
    measured_to: Place | tuple[Place, Place] = "bottom"
    floor: float | None = None
    tabulated: bool = False
    time_constant: float | None = None
    gravity: float = STANDARD_GRAVITY
    drag_coefficient: Number | float | None = None
    air_density: Number | float | None = None

    @classmethod
    def of(cls, names: Iterable[str], options: Mapping[str, Any]) -> "Setup":
        """Return the setup that the named options make, as far as they are given."""
        return cls(**{name: options[name] for name in names if options.get(name) is not None})

    def only(self, *names: str) -> dict[str, Any]:
        """Return some of the options, and of what follows from them, as arguments by name."""
        return {name: getattr(self, name) for name in names}

    @property
    def drop_height(self) -> Number | float | None:
        """The height in m from which the ball's lowest point fell; None where it is not known."""
        if self.height is None:
            return None
        point, _ = places(self.measured_to)
        return lowest_point("height", self.height, point, self.diameter)

    @property
    def drag(self) -> Drag | None:
        """The drag of the air on the ball; None where the options tell no air."""
        return drag_of(self.mass, self.diameter, self.drag_coefficient, self.air_density)

    @property
    def impact_speed(self) -> Number | float | None:
        """The impact speed in m/s, as given or of the drop height; None where neither is known."""
        if self.speed is not None or self.drop_height is None:
            return self.speed
        return speed_after_fall(self.drop_height, self.gravity, self.drag)


def places(measured_to: object) -> tuple[Place, Place]:
    """Return the points that the drop's height and the bounces' were measured to.

    Raises
    ------
    InvalidType, InvalidValue
        If it is neither one of the three nor a pair of them.

    Examples
    --------
    >>> places("centre"), places(("bottom", "top")), places("bottom, top")
    (('centre', 'centre'), ('bottom', 'top'), ('bottom', 'top'))
    """
    pair: Any = measured_to
    if isinstance(measured_to, str):
        points = [point.strip() for point in measured_to.split(",")]
        pair = points * 2 if len(points) == 1 else points
    if not (isinstance(pair, tuple | list) and len(pair) == 2):
        raise InvalidType(
            f"measured_to must be bottom, centre or top, or a pair, got {shown(measured_to)}"
        )
    for point in pair:
        if point not in _DIAMETERS_UP:
            raise InvalidValue(f"measured_to must be bottom, centre or top, got {shown(point)}")
    return pair[0], pair[1]


def above_bottom(point: Place, diameter: Number | float | None = None) -> Number | float:
    """Return how far in m the bottom, centre or top of a ball lies above its lowest point.

    Raises
    ------
    InvalidValue
        If the diameter is needed and missing, or not above 0.

    Examples
    --------
    >>> above_bottom("centre", 0.066)
    0.033
    """
    if diameter is not None:
        return _DIAMETERS_UP[point] * told("diameter", diameter)
    if point != "bottom":
        raise InvalidValue(
            f"diameter must be given where a height was measured to the {point}, got None"
        )
    return 0.0


def lowest_point(
    name: str, height: Number | float, point: Place, diameter: Number | float | None
) -> Number | float:
    """Return the height in m of a ball's lowest point from that of its bottom, centre or top.

    Raises
    ------
    InvalidValue
        If the lowest point is not above the floor, or the diameter is needed and missing.
    """
    up = above_bottom(point, diameter)
    height = height if hasattr(height, "std_dev") else told(name, height)
    positive(name, nominal(height), "metres")
    if nominal(height) <= nominal(up):
        raise InvalidValue(
            f"{name} must be more than the height of the ball's {point} on the floor "
            f"({nominal(up):g} m), got {nominal(height):g} m"
        )
    return height - up


def told(
    name: str, value: object, of: str = "metres", check: Callable[..., float] = positive
) -> Number | float:
    """Return a number as `measured` does, but one without an error as a float."""
    known = measured(name, value, of, check)
    return known if known.std_dev > 0.0 else known.nominal_value
