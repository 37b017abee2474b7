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

_SWAY_RATE = 0.7  # Hz, of a hand


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
    slowing: float = 0.0,
    sway: float = 0.0,
    lens: float = 0.0,
    down: bool = False,
    names: Sequence[str] | None = None,
    seed: int = 0,
) -> xr.Dataset:
    """Return the track of one ball (`Falls`) or of a stack (the `Result` of a run with gravity).

    The time of a `Result` is 0 when the lowest ball touches the floor; before that all of its balls
    fall from rest. They are held for a time `before` their release; below 0 the track begins as
    long after it. It ends at `until`, by default after the third bounce or with the run. `read_as`
    is a wrong frame rate; `correlation` that of the `noise` (m) of neighbours; positions are
    rounded to a `pixel` (m); a fraction is `missing`; the y axis has a `tilt` or points `down`; the
    ball has a horizontal speed, `drift`, and loses it at `slowing` (m/s², in proportion to it); a
    hand `sway`s the camera by so much (m) at 0.7 Hz; a `lens` (1/m²) shrinks what is far from the
    middle of the picture.
    """
    random = np.random.default_rng(seed)
    first, last = _span(source, before, until)
    times = np.arange(first + random.uniform(0.0, 1.0) / frame_rate, last, 1.0 / frame_rate)
    heights = _heights(source, times)
    loss = slowing / drift if slowing else 0.0
    side = np.broadcast_to(
        drift * (-np.expm1(-loss * times) / loss if loss else times), heights.shape
    )
    across = math.cos(tilt) * side + math.sin(tilt) * heights
    along = math.cos(tilt) * heights - math.sin(tilt) * side
    if sway:
        for values in (across, along):
            values += sway * np.sin(2.0 * math.pi * (_SWAY_RATE * times + random.uniform()))
    high = along - 0.5 * np.ptp(along)
    shrunk = 1.0 - lens * (across**2 + high**2)
    columns = {"x": across * shrunk, "y": (along + high * (shrunk - 1.0)) * (-1.0 if down else 1.0)}
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
