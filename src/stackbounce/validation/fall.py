"""Falls and leaps through air, by the formulas of `model/drag.py`, for arrays."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from stackbounce.model.drag import (
    fallen_speed,
    flight_speed,
    landing_speed,
    launch_speed,
    sphere_drag,
)
from stackbounce.model.drop import STANDARD_GRAVITY

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

GRAVITY = STANDARD_GRAVITY
"""In m/s**2."""

AIR_DENSITY = 1.2
"""In kg/m**3."""

DRAG_COEFFICIENT, DRAG_ERROR = 0.45, 0.05
"""Of a sphere, at the Reynolds numbers of falling balls, about 10**3 to 10**5: 0.4 to 0.5."""


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
        return self._each(fallen_speed, height)

    def leaving_speed(self, height: Array) -> Array:
        """Return the speed in m/s at which a ball leaves the floor to reach heights in m."""
        return self._each(launch_speed, height)

    def flight(self, time: Array) -> tuple[Array, Array]:
        """Return the speeds in m/s at the start and at the end of flights of some times in s."""
        leaving = self._each(flight_speed, time)
        return leaving, self._each(landing_speed, leaving)

    def _each(self, formula: Callable[[float, float, float], float], values: Array) -> Array:
        found = [formula(self.drag, one, GRAVITY) for one in values.ravel().tolist()]
        return np.array(found, dtype=np.float64).reshape(values.shape)


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
    return Fall(sphere_drag(AIR_DENSITY, DRAG_COEFFICIENT, diameter) / mass)
