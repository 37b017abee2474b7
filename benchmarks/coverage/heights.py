"""Coverage of what `heights` makes of heights with reading errors."""

from collections.abc import Callable
from typing import Any

import numpy as np

from stackbounce.measure.kinds.heights.analysis import heights

__all__ = ["CASES"]

Trial = Callable[[int], list[tuple[str, Any, float]]]

KEPT, SIZE, ERROR = 0.8, 0.065, 0.005


def successive(seed: int) -> list[tuple[str, Any, float]]:
    """Return restitutions of three bounces, the drop read at the bottom, the bounces at the top."""
    random = np.random.default_rng(seed)
    true = KEPT ** (2.0 * np.arange(4))
    read = true + np.array([0.0, SIZE, SIZE, SIZE]) + random.normal(0.0, ERROR, 4)
    found = heights(
        read[0], read[1:], diameter=SIZE, measured_to=("bottom", "top"), height_error=ERROR
    )
    kept = [(f"restitution {k}", one, KEPT) for k, one in enumerate(found.restitutions)]
    return [*kept, ("restitution", found.mean, KEPT)]


def repeated(seed: int) -> list[tuple[str, Any, float]]:
    """Return the restitution of one bounce, measured four times, the drop height being exact."""
    read = np.random.default_rng(seed).normal(KEPT**2, ERROR, 4)
    from uncertainties import ufloat

    found = heights(ufloat(1.0, 1e-6), list(read), height_error=ERROR, repeated=True)
    return [("restitution", found.mean, KEPT)]


CASES: dict[str, Trial] = {
    "heights, successive, bottom and top": successive,
    "heights, the same four times": repeated,
}
