"""Recordings of a bouncing ball, as `stackbounce.read` gives them."""

import math

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from synthetic import attributes
from synthetic.disturbances import coded, reverberated, wind_noise
from synthetic.falls import Falls

_TONES = 8  # of a knock
_LOW, _HIGH = 300.0, 6000.0  # Hz
_DECAY = 6e-3  # s
_LASTS = 10.0  # decays until a knock is over
_EXPONENT = 1.0  # loudness grows with the speed


def sound(
    falls: Falls,
    *,
    rate: float = 48000.0,
    bits: int = 16,
    level: float = 0.8,
    noise: float = 0.002,
    hum: float = 0.0,
    echo: tuple[float, float] | None = None,
    double: tuple[float, float] | None = None,
    speech: float = 0.0,
    alike: float = 0.0,
    uneven: float = 0.0,
    room: float = 0.0,
    wind: float = 0.0,
    coarse: float = 0.0,
    attack: float = 0.1e-3,
    before: float = 0.5,
    after: float = 0.5,
    seed: int = 0,
) -> xr.Dataset:
    """Return the recording of a bouncing ball, of full scale 1, from `before` its first touch.

    A knock is the sum of decaying tones of random pitch and phase, as loud as the impact is fast,
    of amplitude `level` for the first one, and rising within the `attack` (s). `noise`, a 50 Hz
    `hum` and `speech` before the first touch are amplitudes; an `echo` of everything and a `double`
    sound of each impact have a delay and a relative amplitude. `alike` is the share of tones that
    all knocks have in common, and `uneven` the deviation of the logarithm of a knock's loudness.
    """
    random = np.random.default_rng(seed)
    zero = falls.touches[0] - before
    count = math.ceil((falls.touches[-1] - zero + after) * rate)
    values = np.zeros(count)
    own = np.random.default_rng([seed, 2])  # of what spoils it, so that the tones stay the same
    common = _tones(own)[:, : round(_TONES * alike)]
    for time, speed in zip(falls.touches - zero, falls.speeds, strict=True):
        loud = level * (speed / falls.speeds[0]) ** _EXPONENT
        loud *= math.exp(uneven * own.standard_normal())
        tones = _tones(random)
        tones[:, : common.shape[1]] = common
        _add(values, time, loud, tones, rate, attack)
        if double:
            _add(values, time + double[0], loud * double[1], _tones(random), rate, attack)
    if echo:
        late = round(echo[0] * rate)
        values[late:] += echo[1] * values[: count - late]
    if room:
        values = reverberated(values, rate, room, own)
    times = np.arange(count) / rate
    values += noise * random.standard_normal(count) + hum * np.sin(2 * math.pi * 50.0 * times)
    if speech:
        values += speech * _speech(random, times, 0.5 * before)
    if wind:
        values += wind * wind_noise(count, rate, own)
    if coarse:
        values = coded(np.clip(values, -1.0, 1.0), rate, coarse)
    step = 2.0 ** (1 - bits)
    values = np.clip(np.round(values / step) * step, -1.0, 1.0 - step)
    said = {"units": "1", "long_name": "sound", "rate": rate}
    return xr.Dataset(
        {"sound": ("time", values.astype(np.float32), said)},
        {"time": ("time", times, {"units": "s", "long_name": "time"})},
        attributes("sound") | {"rate": rate},
    )


def _tones(random: np.random.Generator) -> NDArray[np.float64]:
    """Return pitch (Hz), phase, amplitude and decay (s) of the tones of a knock."""
    pitch = np.exp(random.uniform(math.log(_LOW), math.log(_HIGH), _TONES))
    phase = random.uniform(0.0, 2.0 * math.pi, _TONES)
    decay = _DECAY * random.uniform(0.5, 1.5, _TONES)
    return np.stack([pitch, phase, np.full(_TONES, math.sqrt(2.0 / _TONES) / 2.0), decay])


def _add(values, time, loud, tones, rate, attack):
    """Add a knock that begins at a time, between samples too."""
    first = math.ceil(time * rate)
    last = min(len(values), first + math.ceil(_LASTS * _DECAY * rate))
    since = np.arange(first, last) / rate - time
    pitch, phase, amplitude, decay = tones[:, :, None]
    waves = amplitude * np.sin(2 * math.pi * pitch * since + phase) * np.exp(-since / decay)
    rise = -np.expm1(-since / attack) if attack else 1.0
    values[first:last] += loud * rise * waves.sum(axis=0)


def _speech(random, times, until):
    """Return syllables of a few harmonics, with a swell of 30 ms, four a second."""
    pitch = random.uniform(100.0, 200.0)
    values = sum(
        np.sin(2 * math.pi * n * pitch * times + random.uniform(0, 6.3)) / n for n in range(1, 12)
    )
    swell = np.clip(np.sin(2 * math.pi * 4.0 * times + random.uniform(0, 6.3)), 0.0, None)
    return np.asarray(values * swell**2 * (times < until))
