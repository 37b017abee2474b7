"""Records of an accelerometer in a ball, or a phone, that falls and bounces."""

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from synthetic import attributes
from synthetic.falls import Falls

__all__ = ["accelerometer"]

_AXES = ("x", "y", "z")


def accelerometer(
    fall: Falls,
    *,
    rate: float = 200.0,
    before: float = 0.5,
    noise: float = 0.05,
    full_range: float = 157.0,
    smear: float = 0.0,
    spin: float = 0.0,
    linear: bool = False,
    missing: float = 0.0,
    seed: int = 0,
) -> xr.Dataset:
    """Return the record of an accelerometer that goes through a fall and its bounces.

    Parameters
    ----------
    fall : Falls
        With a law that has a contact time; a pulse is half a sine and lasts for this time.
    rate : float, optional
        Samples per second; the first sample is at a random time within a step.
    before : float, optional
        How long in s it is held before its release.
    noise : float, optional
        Of each axis and sample, in m/s².
    full_range : float, optional
        Of each axis, in m/s²; larger values are clipped. 157 is 16 g.
    smear : float, optional
        The time in s over which the sensor averages.
    spin : float, optional
        Acceleration in m/s² that spinning adds while it flies.
    linear : bool, optional
        Whether gravity is subtracted, in the direction that it had before the release.
    missing : float, optional
        Fraction of samples that are missing, at random.
    seed : int, optional
        Of the random numbers.

    Returns
    -------
    xarray.Dataset
        As `read` gives phyphox's acceleration with g: `acceleration_x` … and
        `acceleration_absolute` in m/s² over `time` in s. It stops within the last flight.

    Examples
    --------
    >>> import stackbounce as sb
    >>> from synthetic.falls import falls
    >>> law = sb.calibrate(sb.Dashpot, mass=0.2, contact_time=0.01, restitution=0.6)
    >>> record = accelerometer(falls(0.5, law, mass=0.2, bounces=4), rate=400)
    >>> float(record.acceleration_absolute[:50].mean().round(1))
    9.8
    """
    step = 1.0 / rate
    random = np.random.default_rng(seed)
    last = fall.releases[-1] + 0.5 * (2.0 * fall.rebounds[-1] / fall.gravity)
    times = np.arange(-before + step * random.uniform(), last, step)
    shares = np.linspace(-0.5, 0.5, 41) * smear if smear else np.zeros(1)
    size = np.mean([_felt(fall, times + one, spin) for one in shares], axis=0)
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
