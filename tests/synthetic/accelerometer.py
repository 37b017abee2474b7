"""Records of an accelerometer in a ball, or a phone, that falls and bounces."""

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from synthetic import attributes
from synthetic.falls import Falls

_AXES = ("x", "y", "z")


def accelerometer(
    fall: Falls,
    *,
    rate: float = 200.0,
    before: float = 0.5,
    noise: float = 0.05,
    full_range: float = 157.0,
    spin: float = 0.0,
    linear: bool = False,
    missing: float = 0.0,
    seed: int = 0,
) -> xr.Dataset:
    """Return the record of an accelerometer that goes through a fall and its bounces.

    A pulse is half a sine and lasts for the law's contact time. The record begins `before` the
    release, with `noise` on each axis, clipped at `full_range` (m/s²); `spin` is an acceleration in
    flight, and `linear` subtracts gravity as it was before the release. A fraction of samples is
    `missing`.
    """
    step = 1.0 / rate
    random = np.random.default_rng(seed)
    last = fall.releases[-1] + 0.5 * (2.0 * fall.rebounds[-1] / fall.gravity)
    times = np.arange(-before + step * random.uniform(), last, step)
    size = _felt(fall, times, spin)
    tilt = random.normal(size=3)
    parts = (size - fall.gravity * linear) * (tilt / np.linalg.norm(tilt))[:, None]
    parts = parts + random.normal(0.0, noise, parts.shape)
    parts = np.clip(parts, -full_range, full_range)
    there = random.uniform(size=len(times)) >= missing
    parts, times = parts[:, there], times[there]
    said = {"units": "m/s^2"}
    columns = {f"acceleration_{axis}": ("time", parts[k], said) for k, axis in enumerate(_AXES)}
    columns["acceleration_absolute"] = ("time", np.sqrt(np.sum(parts**2, axis=0)), said)
    form = f"synthetic acceleration {'without' if linear else 'with'} g"
    attrs = attributes("acceleration", form) | {"release": float(-times[0])}
    return xr.Dataset(columns, {"time": ("time", times - times[0], {"units": "s"})}, attrs)


def _felt(fall: Falls, times: NDArray[np.float64], spin: float) -> NDArray[np.float64]:
    """Return the magnitude of the acceleration including gravity, in m/s²."""
    felt: NDArray[np.float64] = np.where(times < 0.0, fall.gravity, spin)
    pulses = zip(fall.touches, fall.releases, fall.speeds, fall.rebounds, strict=True)
    for touch, release, into, out in pulses:
        share = (times - touch) / (release - touch)
        peak = 0.5 * np.pi * (into + out) / (release - touch)
        inside = (share > 0.0) & (share < 1.0)
        felt = np.where(inside, fall.gravity + peak * np.sin(np.pi * share), felt)
    return felt
