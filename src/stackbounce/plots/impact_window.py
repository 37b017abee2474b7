"""The time window of the plot of an impact, and the motion in this window."""

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from stackbounce.run.result import Result

if TYPE_CHECKING:
    import xarray as xr

_BEFORE, _AFTER = 0.15, 0.35  # margins, over the duration of the impact
_INSTANT = 0.010  # s: used as the duration of an instantaneous impact


def choose_window(result: Result) -> tuple[float, float]:
    """Return the start and the end of the plot's time window in s; the first touch is at 0.

    Examples
    --------
    >>> import stackbounce as sb
    >>> drop = sb.Drop([sb.Ball(0.057)], [sb.Spring(22500.0)], impact_speed=3.5)
    >>> [round(1e3 * time, 2) for time in choose_window(sb.simulate(drop))]
    [-0.75, 6.75]
    """
    ends = result.intervals["end"]
    last = float(max([0.0, *ends[np.isfinite(ends)], result.end_time]))
    span = last if last > 0.0 else _INSTANT
    stopped = result.status.name in ("TIME_REACHED", "EVENT_LIMIT", "INVALID")
    return -_BEFORE * span, last if stopped else last + _AFTER * span


def sample_with_approach(result: Result, times: NDArray[np.float64]) -> "xr.Dataset":
    """Return `Result.sample` at given times, extended to times before the first touch.

    Examples
    --------
    >>> import numpy as np
    >>> import stackbounce as sb
    >>> drop = sb.Drop([sb.Ball(0.057)], [sb.Spring(22500.0)], impact_speed=3.5)
    >>> sample_with_approach(sb.simulate(drop), np.array([-1e-3])).position.values
    array([[0.0035]])
    """
    drop = result.drop
    sample = result.sample(np.maximum(times, 0.0))
    early = np.minimum(times, 0.0)
    fallen = np.array(drop.start_velocities)[:, None] * early - 0.5 * drop.gravity * early**2
    sample["position"] += fallen
    sample["velocity"] -= drop.gravity * early
    sample["compression"] -= np.diff(fallen, axis=0, prepend=0.0)
    sample["force"] *= times >= 0.0
    return sample.assign_coords(time=("time", times, sample.time.attrs))
