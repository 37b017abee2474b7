"""The drag of the air in measured flights: heights and times ↔ speeds, with errors."""

import math
from collections.abc import Callable
from dataclasses import dataclass, fields, is_dataclass, replace
from typing import Any, TypeVar

from stackbounce.errors import InvalidValue, instance, non_negative, shown
from stackbounce.measure.messages import Message, OptionHint
from stackbounce.measure.quantities import Number, Row, measured, nominal
from stackbounce.model import drag
from stackbounce.model.air import Air
from stackbounce.model.drop import STANDARD_GRAVITY

Found = TypeVar("Found")

_THINNEST, _THICKEST = 1e-15, 1e6  # 1/m, of what is called a ball in air
_MOST = 1e12  # m/s, m, s
_LEAST_DRAG = 1e-3  # of the drag, taken where its error is nearly all of it


@dataclass(frozen=True)
class Drag:
    """The drag of the air on a ball that was measured.

    Parameters
    ----------
    mass : float or ufloat
        Of the ball, in kg.
    diameter : float or ufloat
        Of the ball, in m.
    coefficient : float or ufloat
        Drag over density/2, cross-section and the square of the speed, above 0.
    density : float or ufloat, optional
        Of the air, in kg/m**3, above 0; by default that of `stackbounce.Air`.

    Raises
    ------
    InvalidValue
        If a number is out of its range.
    InvalidType
        If one has the wrong type.

    Notes
    -----
    The formulas are those of `model/drag.py`, and errors follow from their derivatives.

    Examples
    --------
    A table tennis ball that flies for 0.75 s leaves the floor at 3.86 m/s and is back at 3.5 m/s:

    >>> table_tennis = Drag(2.7e-3, 0.040, 0.5)
    >>> [round(speed.nominal_value, 2) for speed in table_tennis.flight_speeds(0.75)]
    [3.86, 3.51]
    """

    mass: Number | float
    diameter: Number | float
    coefficient: Number | float
    density: Number | float = Air.density

    def __post_init__(self) -> None:
        units = {"mass": "kilograms", "diameter": "metres", "coefficient": "", "density": "kg/m**3"}
        for name, unit in units.items():
            object.__setattr__(self, name, measured(name, getattr(self, name), unit))
        try:
            rate = nominal(self.rate)
        except ArithmeticError:
            rate = math.inf
        if not _THINNEST < rate < _THICKEST:
            raise InvalidValue(
                "mass, diameter and drag_coefficient must be those of a ball in air, got "
                f"{rate:.3g} 1/m of drag (a table tennis ball has 0.13)"
            )

    @property
    def rate(self) -> Number:
        """Deceleration over the square of the speed in 1/m, ``k`` of `model/drag.py`."""
        return drag.sphere_drag(self.density, self.coefficient, self.diameter) / self.mass

    def exact(self, factor: float = 1.0) -> "Drag":
        """Return the drag without errors, or a drag that is larger by a factor."""
        mass, diameter, coefficient, density = map(nominal, vars(self).values())
        return Drag(mass, diameter, factor * coefficient, density)

    def fallen_speed(self, height: Any, gravity: Any = STANDARD_GRAVITY) -> Number:
        """Return the speed in m/s after a fall from rest by a height in m."""
        return self._found(drag.fallen_speed, height, gravity)

    def fall_time(self, height: Any, gravity: Any = STANDARD_GRAVITY) -> Number:
        """Return the time in s of a fall from rest by a height in m."""
        return self._found(drag.fall_time, height, gravity)

    def fall_height(self, speed: Any, gravity: Any = STANDARD_GRAVITY) -> Number | None:
        """Return the height in m of a fall from rest to a speed in m/s; None if none is enough."""
        if math.isinf(drag.fall_height(nominal(self.rate), nominal(speed), nominal(gravity))):
            return None
        return self._found(drag.fall_height, speed, gravity)

    def launch_speed(self, height: Any, gravity: Any = STANDARD_GRAVITY) -> Number:
        """Return the speed in m/s at which a ball left the floor that rose to a height in m."""
        return self._found(drag.launch_speed, height, gravity)

    def risen(self, speed: Any, gravity: Any = STANDARD_GRAVITY) -> Number:
        """Return the height in m to which a ball rises that leaves the floor at a speed in m/s."""
        return self._found(drag.risen, speed, gravity)

    def flight_speeds(self, time: Any, gravity: Any = STANDARD_GRAVITY) -> tuple[Number, Number]:
        """Return the speeds in m/s at which a flight of a time in s began and ended."""
        leaving = self._found(drag.flight_speed, time, gravity)
        return leaving, self._found(drag.landing_speed, leaving, gravity)

    def height_after(self, start: float, restitution: float, bounces: float) -> float:
        """Return the height in m after some bounces of one restitution, from a drop height in m.

        Parts of a bounce are allowed, to draw a curve. With ``p = 1/v**2`` a bounce makes
        ``p/e**2`` of p, and a flight ``p + k/g``.
        """
        rate = nominal(self.rate)
        g, q = STANDARD_GRAVITY, restitution**-2  # the height does not depend on g
        flights = (q**bounces - q) / (q - 1.0) if q != 1.0 else bounces - 1.0
        p = q**bounces / drag.fallen_speed(rate, start, g) ** 2 + rate / g * flights
        return drag.risen(rate, p**-0.5, g)

    def rows(self) -> list[Row]:
        """Return the numbers of the air, for the table of a result."""
        density = Row("density of the air", self.density, "kg/m^3")
        return [Row("drag coefficient", self.coefficient), density]

    def note(self, without: Any) -> str:
        """Return a note; `without` is the mean restitution if the air is left out."""
        return (
            f"The drag of the air is taken into account, with a coefficient of "
            f"{nominal(self.coefficient):.3g} at {nominal(self.density):.4g} kg/m^3; without it "
            f"the restitution would come out as {nominal(without):.4f}."
        )

    def _found(self, formula: Callable[[float, float, float], float], *given: Any) -> Number:
        from uncertainties import wrap

        try:
            found = wrap(formula)(self.rate, *given)
        except ArithmeticError:
            found = math.inf
        if nominal(found) < _MOST:
            return found
        raise InvalidValue(
            "mass, diameter and drag_coefficient must be those of a ball that can fly so far, got "
            f"{nominal(self.rate):.3g} 1/m of drag: its speed would be out of all range"
        )


def speed_after_fall(height: Any, gravity: float, drag: Drag | None) -> Any:
    """Return the speed in m/s after a fall from rest by a height in m, in air or without.

    Examples
    --------
    >>> speed_after_fall(0.8, 10.0, None)
    4.0
    """
    return (2.0 * gravity * height) ** 0.5 if drag is None else drag.fallen_speed(height, gravity)


def drag_of(mass: Any, diameter: Any, drag_coefficient: Any, air_density: Any) -> Drag | None:
    """Return the drag that options tell, or None where they tell no air.

    Parameters
    ----------
    mass, diameter, air_density : float or ufloat or None
        In kg, m and kg/m**3.
    drag_coefficient : float or ufloat or None
        0 or None for no air.

    Raises
    ------
    InvalidValue
        If a number is out of its range, or one that the drag needs is missing.
    InvalidType
        If one has the wrong type.

    Examples
    --------
    >>> drag_of(0.057, 0.066, None, None) is None
    True
    >>> print(f"{drag_of(0.057, 0.066, 0.5, None).rate.nominal_value:.4f} 1/m")
    0.0181 1/m
    """
    coefficient = 0.0 if drag_coefficient is None else drag_coefficient
    known = measured("drag_coefficient", coefficient, check=non_negative)
    if known.nominal_value == 0.0:
        if known.std_dev > 0.0:
            raise InvalidValue(
                "drag_coefficient must be above 0 where it has an error, or 0 for no air, got "
                f"{shown(drag_coefficient)}"
            )
        if air_density is not None:
            hint = OptionHint({"drag_coefficient": None})
            wrong = Message("the density of the air counts with a ", hint, " only, got none")
            raise InvalidValue(wrong)
        return None
    if mass is None or diameter is None:
        needed = {"mass": mass, "diameter": diameter}
        missing = OptionHint({name: None for name, value in needed.items() if value is None})
        wrong = Message("a drag coefficient needs mass and diameter of the ball: give ", missing)
        raise InvalidValue(wrong)
    return Drag(mass, diameter, known, Air.density if air_density is None else air_density)


def drag_given(drag: Drag | None) -> Drag | None:
    """Return a drag, or None, as it is given; raise InvalidType if it is anything else."""
    return drag if drag is None else instance("drag", drag, Drag)


def with_error_of_drag(found: Found, found_with: Callable[[Drag], Found], drag: Drag) -> Found:
    """Return what was found with the error of the drag in each of its numbers with an error.

    The analysis is repeated with a drag that is larger, and smaller, by its error. Half the
    difference is the error of each number, and all of these errors are of one variable.

    Parameters
    ----------
    found : dataclass
        With the drag, but without its error. Numbers with errors may be in tuples and dataclasses.
    found_with : callable
        Finds the same with another drag.
    drag : Drag
        With its error.

    Returns
    -------
    dataclass

    Examples
    --------
    >>> from uncertainties import ufloat
    >>> from stackbounce.measure.kinds.bounces.analysis import bounces
    >>> times = [0.0, 0.45, 0.84, 1.18]
    >>> for coefficient in 0.5, ufloat(0.5, 0.05):
    ...     found = bounces(times, time_error=1e-4, drag=Drag(2.7e-3, 0.040, coefficient))
    ...     print(f"{found.mean:.1uS}")
    0.8928(2)
    0.893(2)
    """
    rate = drag.rate
    error = rate.std_dev / rate.nominal_value
    if not error > 0.0:
        return found
    least = max(1.0 - error, _LEAST_DRAG)
    low, high = found_with(drag.exact(least)), found_with(drag.exact(1.0 + error))
    off = (rate / rate.nominal_value - 1.0) / (1.0 + error - least)  # 0, with an error
    moved: Found = with_difference(found, low, high, off=off)
    return moved


def with_difference(value: Any, less: Any, more: Any, *, off: Any) -> Any:
    """Return a value with the error that makes it as the other two."""
    if less is None or more is None:
        return value
    if hasattr(value, "nominal_value"):
        return value + (nominal(more) - nominal(less)) * off
    if type(value) is tuple:
        rows = list(zip(value, less, more, strict=False))
        return (*(with_difference(*row, off=off) for row in rows), *value[len(rows) :])
    if is_dataclass(value) and not isinstance(value, type | Drag):
        changes: dict[str, Any] = {}
        for field in fields(value):
            row = (getattr(result, field.name) for result in (value, less, more))
            changes[field.name] = with_difference(*row, off=off)
        return replace(value, **changes)
    return value
