"""Falls and leaps through air: heights and times of flight ↔ the speeds at the floor.

The drag is quadratic, ``k v**2`` for each kilogram, with ``k = ρ C A/(2 m)``. With the terminal
speed ``V = sqrt(g/k)`` all is in closed form. A fall from h ends at ``V sqrt(1 - exp(-2 k h))``,
and a leap at u reaches ``ln(1 + u**2/V**2)/(2 k)``.
"""

import math
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

__all__ = [
    "AIR_DENSITY",
    "DRAG_COEFFICIENT",
    "DRAG_ERROR",
    "GRAVITY",
    "Array",
    "Fall",
    "through_air",
]

Array: TypeAlias = NDArray[np.float64]

GRAVITY = 9.80665
"""In m/s**2."""

AIR_DENSITY = 1.2
"""In kg/m**3."""

DRAG_COEFFICIENT, DRAG_ERROR = 0.45, 0.05
"""Of a sphere, at the Reynolds numbers of falling balls, about 10**3 to 10**5: 0.4 to 0.5."""

_ROUNDS = 60  # of Newton's method, at most


@dataclass(frozen=True)
class Fall:
    """Falls of a ball with some drag.

    Parameters
    ----------
    drag : float
        k in 1/m; 0 for a fall without air.

    Examples
    --------
    >>> Fall(0.0).landing_speed(np.array([1.0])).round(4)
    array([4.4287])
    """

    drag: float = 0.0

    def landing_speed(self, height: Array) -> Array:
        """Return the speed in m/s after a fall from rest at some heights in m."""
        if self.drag == 0.0:
            return np.sqrt(2.0 * GRAVITY * height)
        return np.sqrt(-GRAVITY / self.drag * np.expm1(-2.0 * self.drag * height))

    def leaving_speed(self, height: Array) -> Array:
        """Return the speed in m/s at which a ball leaves the floor to reach heights in m."""
        if self.drag == 0.0:
            return np.sqrt(2.0 * GRAVITY * height)
        return np.sqrt(GRAVITY / self.drag * np.expm1(2.0 * self.drag * height))

    def flight(self, time: Array) -> tuple[Array, Array]:
        """Return the speeds in m/s at the start and at the end of flights of some times in s."""
        leaving = 0.5 * GRAVITY * time
        if self.drag == 0.0:
            return leaving, leaving
        for _ in range(_ROUNDS):
            wrong = self._time_of(leaving) - time
            step = wrong * 0.5 * GRAVITY  # the slope is 2/g without air, and a little less in it
            leaving = leaving - step
            if np.all(np.abs(step) <= 1e-14 * leaving):
                break
        return leaving, leaving / np.sqrt(1.0 + leaving**2 * self.drag / GRAVITY)

    def _time_of(self, leaving: Array) -> Array:
        """Return the time from the floor to the floor of leaps at some speeds."""
        terminal = math.sqrt(GRAVITY / self.drag)
        up = np.arctan(leaving / terminal)
        return terminal / GRAVITY * (up + np.arcsinh(leaving / terminal))


def through_air(attributes: dict[str, Any]) -> Fall | None:
    """Return the falls of a dataset's ball; None if its mass or its diameter is not known.

    Parameters
    ----------
    attributes : dict
        Those of the Dataset.

    Examples
    --------
    >>> through_air({"mass": 0.0027, "diameter": 0.040}).drag.__round__(3)
    0.126
    """
    mass, diameter = attributes.get("mass"), attributes.get("diameter")
    if mass is None or diameter is None:
        return None
    area = 0.25 * math.pi * diameter**2
    return Fall(0.5 * AIR_DENSITY * DRAG_COEFFICIENT * area / mass)
