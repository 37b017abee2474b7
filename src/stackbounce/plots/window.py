"""What a picture of an impact shows: from a little before it to a little after."""

import numpy as np
from numpy.typing import NDArray

from stackbounce.result import Result

__all__ = ["impact_window", "positions"]

_BEFORE, _AFTER = 0.15, 0.35  # of the impact's duration
_INSTANT = 0.010  # s, where it has none


def impact_window(result: Result) -> tuple[float, float]:
    """Return when to begin and to end in s, from a little before the first touch.

    Examples
    --------
    >>> import stackbounce as sb
    >>> drop = sb.Drop([sb.Ball(0.057)], [sb.Spring(22500.0)], impact_speed=3.5)
    >>> [round(1e3 * time, 2) for time in impact_window(sb.simulate(drop))]
    [-0.75, 6.75]
    """
    ends = result.intervals["end"]
    last = float(max([0.0, *ends[np.isfinite(ends)], result.end_time]))
    span = last if last > 0.0 else _INSTANT
    stopped = result.status.name in ("TIME_REACHED", "EVENT_LIMIT", "INVALID")
    return -_BEFORE * span, last if stopped else last + _AFTER * span


def positions(result: Result, times: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the position of each ball in m, (N, T), also on its way to the first touch.

    Examples
    --------
    >>> import numpy as np
    >>> import stackbounce as sb
    >>> drop = sb.Drop([sb.Ball(0.057)], [sb.Spring(22500.0)], impact_speed=3.5)
    >>> positions(sb.simulate(drop), np.array([-1e-3]))
    array([[0.0035]])
    """
    drop = result.drop
    early = np.minimum(times, 0.0)
    start = np.array(drop.start_velocities)[:, None]
    later: NDArray[np.float64] = result.sample(np.maximum(times, 0.0)).position.values
    return later + (start * early - 0.5 * drop.gravity * early**2)
