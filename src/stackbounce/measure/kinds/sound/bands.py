"""Loudness in frequency bands around each knock."""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from stackbounce.measure.quantities import Array

# Set by hand on the synthetic recordings of `benchmarks/coverage/sound.py`, as in `alignment.py`.
_LOWEST_HERTZ = 350.0  # below are wind, hum and steps
_HIGHEST_SHARE = 0.46  # of the sampling rate
_LONGEST_STEP = 1.0 / 32e3  # s between powers
_AMPLITUDE_STEPS = 8  # to a sample of a record of amplitudes
_SKIRT_SIGMAS = 4.5  # standard deviations of a filter's response in time that are kept
_SILENCE = 1e-10  # of the largest power


class Bands(NamedTuple):
    """Logarithms of the power in each band around each knock.

    `logs` is (knocks, bands, steps). A step lasts `step` seconds, the first one is `start` seconds
    after the approximate time of the knock. `steps` (bands,) is the correlation time of noise in
    a band, in steps.
    """

    logs: Array
    start: float
    step: float
    correlation: Array


def band_powers(
    values: NDArray[np.float32],
    rate: float,
    about: Array,
    start: float,
    stop: float,
    least: float,
    faint: float = 0.0,
) -> Bands:
    """Return the power of a recording in bands of an octave, around each of some times.

    A band is a Gaussian in frequency and therefore in time, so that no sound is seen before it
    began. A record of amplitudes, without negative values, is its own and only band.

    Parameters
    ----------
    values : ndarray
        (N,) samples of one channel.
    rate : float
        Samples per second.
    about : ndarray
        (K,) times in s.
    start, stop : float
        What is wanted around each of them, in s.
    least : float
        Variance of a sample that is taken for silence.
    faint : float, optional
        Share of the largest power around each time, in each band, below which powers are hidden.

    Returns
    -------
    Bands

    Examples
    --------
    >>> values = np.zeros(4800, dtype=np.float32)
    >>> values[2400:] = np.sin(np.arange(2400.0))
    >>> bands = band_powers(values, 48000.0, np.array([0.05]), -0.001, 0.001, 1e-9)
    >>> bands.logs.shape[:2], bool(bands.logs[0, -2, -1] > bands.logs[0, -2, 0] + 10.0)
    ((1, 6), True)
    """
    if values.min() >= 0.0:
        return _amplitudes(values, rate, about, start, stop)
    edges = _edges(rate)
    widths = 0.5 * np.diff(edges)  # Hz, standard deviations
    lasts = 1.0 / (2.0 * math.pi * widths)
    finer = 2 ** max(0, math.ceil(math.log2(1.0 / (rate * _LONGEST_STEP))))
    before, after = (
        math.ceil((side + _SKIRT_SIGMAS * lasts.max()) * rate) for side in (-start, stop)
    )
    around, late = _windows(values, rate, about, before, after)
    size = 1 << math.ceil(math.log2(around.shape[1]))
    tones = np.fft.rfftfreq(size, 1.0 / rate)
    spectra = np.fft.rfft(around, size) * np.exp(2j * math.pi * tones * late[:, None])
    first, last = round(start * rate * finer), round(stop * rate * finer)
    part = slice(before * finer + first, before * finer + last + 1)
    powers = []
    for low, high, width in zip(edges[:-1], edges[1:], widths, strict=True):
        passed = 2.0 * spectra * np.exp(-0.5 * ((tones - 0.5 * (low + high)) / width) ** 2)
        waves = np.fft.ifft(passed, size * finer) * finer
        powers.append(np.abs(waves[:, part]) ** 2)
    power = np.stack(powers, axis=1)
    silence = least * 4.0 * math.sqrt(math.pi) * widths / rate + 1e-30
    floor = np.maximum(silence, _SILENCE * power.max(axis=(0, 2)))
    step = 1.0 / (rate * finer)
    correlation = np.maximum(math.sqrt(2.0 * math.pi) * lasts / step, 1.0)
    quiet = floor[:, None] + faint * power.max(axis=2, keepdims=True)
    return Bands(np.log(power + quiet), first * step, step, correlation)


def _edges(rate: float) -> Array:
    """Return the edges of bands of about an octave, in Hz."""
    top = _HIGHEST_SHARE * rate
    low = min(_LOWEST_HERTZ, rate / 16.0)
    return np.geomspace(low, top, max(2, round(math.log2(top / low))) + 1)


def _windows(
    values: NDArray[np.float32], rate: float, about: Array, before: int, after: int
) -> tuple[Array, Array]:
    """Return samples around each time without their mean, and by how much a time is later."""
    nearest = np.round(about * rate).astype(np.int64)
    wanted = nearest[:, None] + np.arange(-before, after)
    inside = (wanted >= 0) & (wanted < len(values))
    around = np.where(inside, values[np.clip(wanted, 0, len(values) - 1)], 0.0)
    mean = around.sum(axis=1) / np.maximum(inside.sum(axis=1), 1)
    return np.where(inside, around - mean[:, None], 0.0), about - nearest / rate


def _amplitudes(
    values: NDArray[np.float32], rate: float, about: Array, start: float, stop: float
) -> Bands:
    """Return a record of amplitudes as one band, interpolated."""
    from scipy.ndimage import map_coordinates

    step = 1.0 / (rate * _AMPLITUDE_STEPS)
    first, last = round(start / step), round(stop / step)
    wanted = about[:, None] * rate + np.arange(first, last + 1) / _AMPLITUDE_STEPS
    floor = math.sqrt(_SILENCE) * float(values.max()) + 1e-30
    logs = 2.0 * np.log(values.astype(np.float64) + floor)
    between = map_coordinates(logs, [wanted], order=1, mode="nearest")
    return Bands(between[:, None], first * step, step, np.array([float(_AMPLITUDE_STEPS)]))
