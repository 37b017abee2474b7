"""Tracks of bouncing balls as video analysis exports them, as `stackbounce.read` gives them."""

import math
from collections.abc import Sequence

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from stackbounce.run.result import Result
from synthetic import attributes
from synthetic.disturbances import ar_noise
from synthetic.falls import Falls

__all__ = ["track"]


def track(
    source: Falls | Result,
    *,
    frame_rate: float = 120.0,
    read_as: float | None = None,
    until: float | None = None,
    before: float = 0.1,
    noise: float = 1e-3,
    correlation: float = 0.0,
    pixel: float = 0.0,
    missing: float = 0.0,
    tilt: float = 0.0,
    drift: float = 0.0,
    down: bool = False,
    names: Sequence[str] | None = None,
    seed: int = 0,
) -> xr.Dataset:
    """Return the track of one ball (`Falls`) or of a stack (the `Result` of a run with gravity).

    Parameters
    ----------
    source : Falls or Result
        What the balls do. The time of a `Result` is 0 when the lowest ball touches the floor, and
        before that all of its balls fall from rest.
    frame_rate : float, optional
        Frames per second; the first frame is at a random time within a step.
    read_as : float, optional
        The frame rate from which the times are computed, to simulate a wrong one.
    until : float, optional
        The end of the track in s; by default after the third bounce, or at the end of the run.
    before : float, optional
        How long in s the balls are held before their release; below 0 the track begins as long
        after it.
    noise, correlation : float, optional
        Error of a point in m, and the correlation of neighbouring ones.
    pixel : float, optional
        To which positions are rounded, in m; 0 for none.
    missing : float, optional
        Fraction of points that are blank, at random.
    tilt : float, optional
        Angle of the y axis with the vertical, in radians.
    drift : float, optional
        Horizontal speed in m/s.
    down : bool, optional
        Whether y points down.
    names : sequence of str, optional
        Of the tracks.
    seed : int, optional
        Of the random numbers.

    Returns
    -------
    xarray.Dataset
        `x` and `y` against `time` and `track`.

    Examples
    --------
    >>> from synthetic.falls import falls
    >>> data = track(falls(1.0, 0.8), frame_rate=30, until=1.0)
    >>> data.y.dims, data.sizes["time"]
    (('time', 'track'), 33)
    """
    random = np.random.default_rng(seed)
    first, last = _span(source, before, until)
    times = np.arange(first + random.uniform(0.0, 1.0) / frame_rate, last, 1.0 / frame_rate)
    heights = _heights(source, times)
    side = np.broadcast_to(drift * times, heights.shape)
    columns = {
        "x": math.cos(tilt) * side + math.sin(tilt) * heights,
        "y": (math.cos(tilt) * heights - math.sin(tilt) * side) * (-1.0 if down else 1.0),
    }
    blank = random.uniform(size=heights.shape) < missing
    for name, values in columns.items():
        seen = values + noise * ar_noise(random, values.shape, correlation)
        if pixel:
            seen = np.round(seen / pixel) * pixel
        columns[name] = np.where(blank, np.nan, seen)
    clock = np.arange(len(times)) / (read_as or frame_rate)
    return xr.Dataset(
        {
            name: (("time", "track"), values.T, {"units": "m", "long_name": name})
            for name, values in columns.items()
        },
        {
            "time": ("time", clock, {"units": "s", "long_name": "t"}),
            "track": ("track", list(names or [f"ball {k}" for k in range(len(heights))])),
        },
        attributes("track"),
    )


def _span(source: Falls | Result, before: float, until: float | None) -> tuple[float, float]:
    if isinstance(source, Falls):
        third = source.touches[min(3, len(source.touches) - 1)]
        return -before, float(third) if until is None else until
    fall = source.drop.reference_speed / source.drop.gravity
    return -fall - before, source.end_time if until is None else until


def _heights(source: Falls | Result, times: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return heights of balls, (ball, time), in m."""
    if isinstance(source, Falls):
        return source.position(times)[None]
    drop = source.drop
    sizes = np.array([ball.diameter or 0.0 for ball in drop.balls])
    places = np.cumsum(sizes) - 0.5 * sizes
    start = np.array(drop.start_velocities)[:, None]
    held = np.clip(times, -drop.reference_speed / drop.gravity, 0.0)
    falling = start * held - 0.5 * drop.gravity * held**2
    moved = source.sample(np.maximum(times, 0.0)).position.values
    return np.asarray(places[:, None] + np.where(times < 0.0, falling, moved))
