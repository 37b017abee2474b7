"""Force records as an instrument would write them, from a simulated drop."""

from collections.abc import Sequence
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from stackbounce.model import Drop
from stackbounce.run.driver import simulate
from stackbounce.run.result import Result
from synthetic import attributes

__all__ = ["drooped", "waveform"]


def waveform(
    drop: Drop | Result,
    *,
    rate: float,
    contacts: int | Sequence[int] = 0,
    duration: float | None = None,
    before: float | None = None,
    noise: float = 0.0,
    hum: float = 0.0,
    mains: float = 50.0,
    offset: float = 0.0,
    drift: float = 0.0,
    bits: int | None = None,
    full_scale: float | None = None,
    time_constant: float | None = None,
    sensitivity: float | None = None,
    sign: int = 1,
    seed: int = 0,
) -> xr.Dataset:
    """Return the record that force sensors at the contacts of a drop would give.

    Parameters
    ----------
    drop : Drop or Result
        What falls on the sensors.
    rate : float
        Samples per second, above 0.
    contacts : int or sequence of int, optional
        The contact that each sensor measures, a channel each; default one sensor, at the floor.
    duration : float, optional
        Of the record in s; default until the last release and as long again as `before`.
    before : float, optional
        How long in s it begins before the first touch; default half of the impact's duration. The
        first sample is up to one step later, at random, as recorders are not synchronised.
    noise : float, optional
        Standard deviation of normal noise, in N, or in V with a `sensitivity`.
    hum, mains : float, optional
        Amplitude of the mains' hum in the same unit, at a random phase; its frequency in Hz.
    offset, drift : float, optional
        The level without force, in the same unit, and its change over the record.
    bits : int, optional
        Of the converter, from 1 to 32; default no quantisation.
    full_scale : float, optional
        The converter's range, from minus to plus this, in the same unit; default no limit, or with
        `bits` the next power of two above all values.
    time_constant : float, optional
        RC in s of a piezo sensor and its amplifier; default no droop.
    sensitivity : float, optional
        In V/N: the record is a voltage; default a force in N.
    sign : int, optional
        -1 for a sensor whose compression is negative.
    seed : int, optional
        Of the noise, the phases and the first sample's time.

    Returns
    -------
    xarray.Dataset
        As `read` gives a waveform: `force` in N or `voltage` in V over `time` in s, with
        ``force_2`` and so on for further channels.

    Examples
    --------
    >>> import stackbounce as sb
    >>> drop = sb.Drop([sb.Ball(0.1)], [sb.Spring(6e4)], impact_speed=2.0)
    >>> record = waveform(drop, rate=1e5, noise=0.5, bits=12, full_scale=500.0)
    >>> record.attrs["holds"], 150.0 < float(record.force.max()) < 160.0
    ('waveform', True)
    """
    result = simulate(drop) if isinstance(drop, Drop) else drop
    random = np.random.default_rng(seed)
    times = _times(result, rate, duration, before, random)
    own = [contacts] if isinstance(contacts, int) else list(contacts)
    gain = sign * (sensitivity or 1.0)
    name, unit = ("force", "N") if sensitivity is None else ("voltage", "V")
    forces = result.sample(np.maximum(times, 0.0)).force.values * (times >= 0.0)
    columns: dict[str, Any] = {}
    for count, contact in enumerate(own, start=1):
        felt = gain * forces[contact]
        if time_constant is not None:
            felt = drooped(times, felt, time_constant)
        phase = random.uniform(0.0, 2.0 * np.pi)
        share = (times - times[0]) / max(times[-1] - times[0], 1e-300)
        out = felt + offset + drift * share
        wave = np.sin(2.0 * np.pi * mains * times + phase)
        out = out + hum * wave
        out = out + random.normal(0.0, noise, len(times))
        key = name if count == 1 else f"{name}_{count}"
        said = {"units": unit, "long_name": f"{key.capitalize()} ({unit})"}
        columns[key] = ("time", _converted(out, bits, full_scale), said)
    time = ("time", times - times[0], {"units": "s", "long_name": "time"})
    attrs = attributes("waveform") | {"touch": float(-times[0])}
    return xr.Dataset(columns, {"time": time}, attrs)


def _times(
    result: Result,
    rate: float,
    duration: float | None,
    before: float | None,
    random: np.random.Generator,
) -> NDArray[np.float64]:
    """Return the times of the samples, in s since the first touch."""
    step = 1.0 / rate
    ends = result.intervals["end"]
    last = max([0.0, *ends[np.isfinite(ends)].tolist()])
    lead = 0.5 * last if before is None else before
    stopped = result.status.name in ("TIME_REACHED", "EVENT_LIMIT", "INVALID")
    stop = min(last + lead, result.end_time) if stopped else last + lead
    span = lead + stop - step if duration is None else duration
    count = int(span / step) + 1
    return np.asarray(step * (np.arange(count) + random.uniform()) - lead, dtype=np.float64)


def _converted(
    values: NDArray[np.float64], bits: int | None, full_scale: float | None
) -> NDArray[np.float64]:
    """Return the values quantised to the converter's steps and clipped to its range."""
    if full_scale is not None:
        values = np.clip(values, -full_scale, full_scale)
    if bits is None:
        return values
    top = full_scale or 2.0 ** np.ceil(np.log2(max(float(np.max(np.abs(values))), 1e-300)))
    step = top / 2.0 ** (bits - 1)
    most = top / step
    steps: NDArray[np.float64] = np.clip(np.round(values / step), -most, most - 1.0)
    return step * steps


def drooped(times: NDArray[np.float64], values: NDArray[np.float64], time_constant: float) -> Any:
    """Return the output of a high-pass of first order: the exact inverse of `undrooped`.

    The values (n,) at times in s, ascending, are taken as linear between samples; the response to a
    constant force decays to 1/e in the time constant, in s.

    Examples
    --------
    >>> out = drooped(np.array([0.0, 0.1, 0.2]), np.ones(3), 0.1)
    >>> [round(one, 6) for one in out.tolist()]  # 1, 1/e, 1/e**2
    [1.0, 0.367879, 0.135335]
    """
    share = np.diff(times) / time_constant
    gained = np.diff(values) * -np.expm1(-share) / share
    out = [float(values[0])]
    for keep, gain in zip(np.exp(-share).tolist(), gained.tolist(), strict=True):
        out.append(keep * out[-1] + gain)
    return np.array(out)
