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
    resonance: tuple[float, float] | None = None,
    sensitivity: float | None = None,
    sign: int = 1,
    seed: int = 0,
) -> xr.Dataset:
    """Return the record that force sensors at the contacts of a drop would give, a channel each.

    It begins `before` the first touch (default: half of the impact's duration) and lasts as long
    after the last release; the first sample is up to one step later. `noise`, `hum`, `offset`,
    `drift` and `full_scale` are in N, or in V with a `sensitivity` (V/N). The converter has some
    `bits`, by default with a range that is the next power of two above all values. A piezo
    sensor's droop has a `time_constant` (RC, s), a sensor that rings a `resonance`: frequency (Hz)
    and damping ratio.
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
        if resonance is not None:
            felt = rung(times, felt, *resonance)
        if time_constant is not None:
            felt = drooped(times, felt, time_constant)
        phase = random.uniform(0.0, 2.0 * np.pi)
        share = (times - times[0]) / max(times[-1] - times[0], 1e-300)
        out = felt + offset + drift * share
        out = out + hum * np.sin(2.0 * np.pi * mains * times + phase)
        out = out + random.normal(0.0, noise, len(times))
        key = name if count == 1 else f"{name}_{count}"
        said = {"units": unit, "long_name": f"{key.capitalize()} ({unit})"}
        columns[key] = ("time", _converted(out, bits, full_scale), said)
    time = ("time", times - times[0], {"units": "s", "long_name": "time"})
    attrs = attributes("waveform") | {"touch": float(-times[0])}
    return xr.Dataset(columns, {"time": time}, attrs)


def _times(result, rate, duration, before, random):
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


def _converted(values, bits, full_scale):
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


def rung(times: NDArray[np.float64], force: Any, frequency: float, damping: float) -> Any:
    """Return what a mass on a spring shows of a force at even times, linear between samples."""
    from scipy.signal import lsim

    turn = 2.0 * np.pi * frequency
    sensor = ([turn**2], [1.0, 2.0 * damping * turn, turn**2])
    return lsim(sensor, force, times - times[0])[1]


def drooped(times: NDArray[np.float64], values: NDArray[np.float64], time_constant: float) -> Any:
    """Return the output of a high-pass of first order: the exact inverse of `undrooped`.

    The values at ascending times are taken as linear between samples.
    """
    share = np.diff(times) / time_constant
    gained = np.diff(values) * -np.expm1(-share) / share
    out = [float(values[0])]
    for keep, gain in zip(np.exp(-share).tolist(), gained.tolist(), strict=True):
        out.append(keep * out[-1] + gain)
    return np.array(out)
