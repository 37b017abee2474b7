"""Air, which slows down the balls of a drop in the fall and in the rise."""

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

from stackbounce.errors import InvalidType, InvalidValue, finite, non_negative, positive, shown
from stackbounce.model import drag
from stackbounce.model.ball import Ball
from stackbounce.model.drop import STANDARD_GRAVITY, Drop
from stackbounce.units import checked

_SPHERE = 0.5


class Flight(NamedTuple):
    """A flight in air from the floor to the floor.

    Parameters
    ----------
    height : float
        Of its apex, in m.
    rise_time, fall_time : float
        From the floor to the apex and back, in s.
    landing_speed : float
        In m/s, less than the speed at which it began.
    """

    height: float
    rise_time: float
    fall_time: float
    landing_speed: float


@dataclass(frozen=True)
class Air:
    """Air at rest, which slows down the balls while they fall and while they rise.

    Parameters
    ----------
    density : float, optional
        In kg/m**3, 0 or above; by default that of dry air at 20 °C and 101.325 kPa.
    drag_coefficient : float or mapping of str to float, optional
        Drag over density/2, cross-section and the square of the speed, 0 or above; a mapping has
        one for each ball by its name. By default 0.5, as of a smooth sphere.

    Raises
    ------
    InvalidValue
        If a number is negative or not finite.
    InvalidType
        If one has the wrong type.

    Notes
    -----
    The formulas solve ``v' = g - k v**2`` (`model/drag.py`). The density follows from the gas law
    with 28.965 g/mol. The coefficient is a usual round number for smooth spheres: collections of
    data have a nearly flat curve of 0.4 to 0.5 for Reynolds numbers ``v D/(1.5e-5 m**2/s)`` of 1e3
    to 3e5. The drag of slower or smaller balls is larger than this, and matters less.

    The methods take a `Ball` with a diameter, a height or a speed above 0, and gravity in m/s**2,
    above 0. They raise `InvalidValue` if a number is out of its range, or the ball has no diameter
    or no drag coefficient, and `InvalidType` if something has the wrong type.

    During the contacts the drag is left out. So are the buoyancy and the air that a ball sets in
    motion: see `docs/air.md` for how much they are.

    Examples
    --------
    A tennis ball that leaves the floor at 5.8 m/s rises to 1.66 m, and without air to 1.72 m:

    >>> ball = Ball(mass=0.057, diameter=0.066)
    >>> round(Air().rise(ball, 5.8), 3), round(Air(density=0.0).rise(ball, 5.8), 3)
    (1.664, 1.715)
    """

    density: float = 1.204
    drag_coefficient: float | Mapping[str, float] = _SPHERE

    def __post_init__(self) -> None:
        density = checked(non_negative, "density", self.density, "kg/m**3")
        object.__setattr__(self, "density", density)
        given = self.drag_coefficient
        if isinstance(given, Mapping):
            for name in given:
                if not isinstance(name, str):
                    raise InvalidType(
                        f"drag_coefficient must have names of balls as keys, got {shown(name)}"
                    )
            coefficients: object = {
                name: non_negative(f"drag_coefficient.{name}", value)
                for name, value in given.items()
            }
        else:
            coefficients = checked(non_negative, "drag_coefficient", given)
        object.__setattr__(self, "drag_coefficient", coefficients)

    def terminal_speed(self, ball: Ball, gravity: float = STANDARD_GRAVITY) -> float:
        """Return the speed in m/s at which the drag equals the weight; infinite without drag.

        Examples
        --------
        >>> round(Air().terminal_speed(Ball(mass=0.057, diameter=0.066)), 1)
        23.3
        """
        k = self._rate(ball)
        return math.sqrt(_pull(gravity) / k) if k > 0.0 else math.inf

    def impact_speed(self, ball: Ball, height: float, gravity: float = STANDARD_GRAVITY) -> float:
        """Return the speed in m/s of a ball that has fallen from rest by a height in m.

        Examples
        --------
        >>> round(Air().impact_speed(Ball(mass=0.057, diameter=0.066), 0.71), 3)
        3.708
        """
        h = checked(positive, "height", height, "metres")
        return drag.fallen_speed(self._rate(ball), h, _pull(gravity))

    def fall_time(self, ball: Ball, height: float, gravity: float = STANDARD_GRAVITY) -> float:
        """Return the time in s that a ball takes to fall from rest by a height in m.

        Examples
        --------
        >>> round(Air().fall_time(Ball(mass=0.057, diameter=0.066), 0.71), 4)
        0.3813
        """
        h = checked(positive, "height", height, "metres")
        return drag.fall_time(self._rate(ball), h, _pull(gravity))

    def rise(self, ball: Ball, speed: float, gravity: float = STANDARD_GRAVITY) -> float:
        """Return the height in m to which a ball rises that leaves at a speed in m/s.

        Examples
        --------
        >>> round(Air(density=0.0).rise(Ball(0.057, 0.066), 4.0, gravity=10.0), 9)
        0.8
        """
        v = checked(non_negative, "speed", speed, "m/s")
        return drag.risen(self._rate(ball), v, _pull(gravity))

    def launch_speed(self, ball: Ball, height: float, gravity: float = STANDARD_GRAVITY) -> float:
        """Return the speed in m/s at which a ball left that rises to a height in m.

        It turns a measured bounce into a speed: the inverse of `rise`.

        Examples
        --------
        >>> round(Air().launch_speed(Ball(mass=0.057, diameter=0.066), 1.72), 2)
        5.9
        """
        h = checked(positive, "height", height, "metres")
        try:
            return drag.launch_speed(self._rate(ball), h, _pull(gravity))
        except OverflowError:
            raise InvalidValue(
                f"height must be one that a ball can reach in this air, got {h!r}: its speed would "
                "be out of the range of numbers"
            ) from None

    def flight(self, ball: Ball, speed: float, gravity: float = STANDARD_GRAVITY) -> Flight:
        """Return the flight of a ball that leaves the floor at a speed in m/s, above 0.

        Examples
        --------
        >>> flight = Air().flight(Ball(mass=0.057, diameter=0.066), 4.0)
        >>> round(flight.height, 3), round(flight.landing_speed, 3)
        (0.804, 3.942)
        """
        v, g = checked(positive, "speed", speed, "m/s"), _pull(gravity)
        k = self._rate(ball)
        height, landing = drag.risen(k, v, g), drag.landing_speed(k, v, g)
        flight = Flight(height, drag.rise_time(k, v, g), drag.fall_time(k, height, g), landing)
        if not all(map(math.isfinite, flight)):
            raise InvalidValue(f"speed must give a flight in the range of numbers, got {v!r}")
        return flight

    def dropped(self, drop: Drop) -> Drop:
        """Return a drop from a height as it is in air at the first touch of the floor.

        Parameters
        ----------
        drop : Drop
            With `height`, and balls with diameters. All are released at rest at the same time; the
            height and the gaps are those of the release.

        Returns
        -------
        Drop
            The same drop with the velocities and the gaps at the first touch. A ball with more drag
            for its mass falls behind the one below it. One with less stays on it, if they touched:
            the two then fall as one body with the drag of both.

        Raises
        ------
        InvalidType
            If `drop` is no Drop.
        InvalidValue
            If it has no height, a ball has no diameter or no drag coefficient, or a ball would meet
            the one below it in the fall.

        Examples
        --------
        The paper's basketball and tennis ball: the tennis ball stays on the basketball.

        >>> from stackbounce.model.laws import Spring
        >>> balls = [Ball(0.150, 0.160), Ball(0.057, 0.066)]
        >>> in_air = Air().dropped(Drop(balls, [Spring(2500), Spring(1000)], height=0.71))
        >>> [round(v, 3) for v in in_air.velocities], in_air.gaps
        ([-3.687, -3.687], (0.0,))
        """
        if not isinstance(drop, Drop):
            raise InvalidType(f"drop must be a Drop, got {shown(drop)}")
        if drop.height is None:
            raise InvalidValue("drop must have a height from which it falls in air, got none")
        for i, law in enumerate(drop.contacts):
            if law is not None and law.pulls:
                raise InvalidValue(
                    f"contacts.{i} must not be a {type(law).__name__}: parts of one body fall "
                    "together, and their drag is that of the body"
                )
        g, drags = drop.gravity or STANDARD_GRAVITY, self._drags(drop.balls)
        rates = _falling_together([ball.mass for ball in drop.balls], drags, drop.gaps)
        time = drag.fall_time(rates[0], drop.height, g)
        ways = {k: (drag.fallen(k, time, g), drag.speed_after(k, time, g)) for k in rates}
        ways[rates[0]] = drop.height, drag.fallen_speed(rates[0], drop.height, g)
        fallen, speeds = zip(*(ways[k] for k in rates), strict=True)
        gaps = [gap + (fallen[i] - fallen[i + 1]) for i, gap in enumerate(drop.gaps)]
        for i, gap in enumerate(gaps):
            if gap < 0.0:
                raise InvalidValue(
                    f"gaps.{i} must be 0, or so large that ball {i + 1} does not meet ball {i} in "
                    f"the fall (more than {drop.gaps[i] - gap:.3g} m), got {drop.gaps[i]!r}"
                )
        return drop.replace(gaps=gaps, velocities=[-v for v in speeds])

    def rebound_heights(self, drop: Drop, speeds: Iterable[float]) -> list[float]:
        """Return the heights in m to which the balls of a drop rise in air.

        Parameters
        ----------
        drop : Drop
            Its gravity counts, or 9.80665 m/s**2 if that is 0.
        speeds : sequence of float
            The velocities after the impact in m/s, up-positive, as of `Result.rebound_speeds`.

        Returns
        -------
        list of float
            With a minus sign for a ball that moves down, as of the measured quantity of that name.

        Raises
        ------
        InvalidValue
            If there is not one speed for each ball, one is not finite, or a ball has no diameter.
        InvalidType
            If `drop` is no Drop, or a speed no number.

        Examples
        --------
        >>> from stackbounce.model.laws import Rigid
        >>> drop = Drop([Ball(0.057, 0.066)], [Rigid(0.75)], impact_speed=3.7)
        >>> [round(height, 4) for height in Air().rebound_heights(drop, [0.75 * 3.7])]
        [0.3899]
        """
        if not isinstance(drop, Drop):
            raise InvalidType(f"drop must be a Drop, got {shown(drop)}")
        given = [checked(finite, f"speeds.{i}", speed, "m/s") for i, speed in enumerate(speeds)]
        if len(given) != len(drop.balls):
            raise InvalidValue(
                f"speeds must hold one number per ball ({len(drop.balls)}), got {len(given)}"
            )
        g, drags = drop.gravity or STANDARD_GRAVITY, self._drags(drop.balls)
        rates = [force / ball.mass for force, ball in zip(drags, drop.balls, strict=True)]
        rises = [drag.risen(k, abs(v), g) for k, v in zip(rates, given, strict=True)]
        return [math.copysign(h, v) for h, v in zip(rises, given, strict=True)]

    def _drags(self, balls: Sequence[Ball]) -> list[float]:
        return [self._drag(ball, f"balls.{i}") for i, ball in enumerate(balls)]

    def _rate(self, ball: Ball) -> float:
        """Return k of a ball in 1/m, see `drag`."""
        return self._drag(ball) / ball.mass

    def _drag(self, ball: object, path: str = "ball") -> float:
        """Return the drag of a ball over the square of its speed, rho C A/2 in kg/m."""
        if not isinstance(ball, Ball):
            raise InvalidType(f"{path} must be a Ball, got {shown(ball)}")
        if ball.diameter is None:
            raise InvalidValue(f"{path}.diameter must be given for a flight in air, got None")
        coefficient = self.drag_coefficient
        if isinstance(coefficient, Mapping):
            if ball.name is None or ball.name not in coefficient:
                known = ", ".join(coefficient)
                raise InvalidValue(
                    f"{path}.name must be one of those in drag_coefficient ({known}), "
                    f"got {shown(ball.name)}"
                )
            coefficient = coefficient[ball.name]
        return drag.sphere_drag(self.density, coefficient, ball.diameter)


def _pull(gravity: object) -> float:
    return checked(positive, "gravity", gravity, "m/s**2")


def _falling_together(
    masses: Sequence[float], drags: Sequence[float], gaps: Sequence[float]
) -> list[float]:
    """Return k of each ball in the fall: that of all balls that stay together with it.

    A ball with a smaller k than the one below it, without a gap, presses on it: the two are one
    body then, of the mass and the drag of both.
    """
    bodies: list[tuple[float, float, int]] = []  # mass, drag, number of balls
    for i, (mass, one) in enumerate(zip(masses, drags, strict=True)):
        body = (mass, one, 1)
        touching = i > 0 and gaps[i - 1] == 0.0
        while touching and body[1] / body[0] < bodies[-1][1] / bodies[-1][0]:
            below = bodies.pop()
            body = (below[0] + body[0], below[1] + body[1], below[2] + body[2])
            lowest = i + 1 - body[2]
            touching = lowest > 0 and gaps[lowest - 1] == 0.0
        bodies.append(body)
    return [drag / mass for mass, drag, count in bodies for _ in range(count)]
