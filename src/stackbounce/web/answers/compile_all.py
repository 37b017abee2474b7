"""Compile, or load from numba's cache, all kernels that answers need."""

import numpy as np

from stackbounce.model import Ball, Drop, Hertz, Rigid, Spring
from stackbounce.run.driver import simulate
from stackbounce.sweeps import sweep

__all__ = ["warm"]

_MANY = 100  # fewer drops are run as plain Python
_LAWS = (Spring(1.0), Hertz(1.0), Rigid(1.0))  # one for each engine


def warm() -> None:
    """Run each engine once, for one drop and for several."""
    for law in _LAWS:
        drop = Drop([Ball(1.0), Ball(0.5)], [law, law], impact_speed=1.0)
        simulate(drop, compiled=True).sample([0.0])
        sweep(drop, {"balls.0.mass": np.linspace(1.0, 2.0, _MANY)})
