"""What spoils a recording: a room, wind, and the coding of a phone."""

import math

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

_ECHOES = 4
_FIRST, _LAST = 2e-3, 40e-3  # s of the echoes
_DECAY, _ROOM = 50e-3, 150e-3  # s of the tail's decay, and of the response
_TAIL = 0.1  # of the echoes
_SLOW = 150.0  # Hz of the wind
_GUST = 0.1  # s
_BLOCK = 13e-3  # s of a block of an encoder


def ar_noise(random: np.random.Generator, shape: tuple[int, ...], correlation: float) -> Array:
    """Return AR(1) noise of unit deviation along the last axis, by the neighbours' correlation."""
    from scipy.signal import lfilter

    fresh = random.standard_normal(shape)
    fresh[..., 1:] *= math.sqrt(1.0 - correlation**2)
    return np.asarray(lfilter([1.0], [1.0, -correlation], fresh))


def reverberated(values, rate, amplitude, random):
    """Return a sound in a room: four echoes, the strongest of an amplitude, and a tail of noise."""
    from scipy.signal import fftconvolve

    response = np.zeros(math.ceil(_ROOM * rate))
    since = np.arange(len(response)) / rate
    tail = random.standard_normal(len(response)) * np.exp(-since / _DECAY)
    response += amplitude * _TAIL * math.sqrt(48e3 / rate) * tail
    response[0] = 1.0
    for late in random.uniform(_FIRST, _LAST, _ECHOES):
        response[round(late * rate)] += amplitude * random.uniform(0.1, 1.0)
    return np.asarray(fftconvolve(values, response)[: len(values)])


def wind_noise(count: int, rate: float, random: np.random.Generator) -> Array:
    """Return wind in a microphone: low noise in gusts, of a standard deviation of about 1."""
    from scipy.signal import lfilter

    keep = math.exp(-2.0 * math.pi * _SLOW / rate)
    slow = lfilter([math.sqrt(1.0 - keep**2)], [1.0, -keep], random.standard_normal(count))
    times = np.arange(count) / rate
    gusts = np.arange(0.0, times[-1] + 2.0 * _GUST, _GUST)
    return np.asarray(
        slow * np.exp(np.interp(times, gusts, 0.7 * random.standard_normal(len(gusts))))
    )


def coded(values: Array, rate: float, coarse: float) -> Array:
    """Return a sound as an encoder like that of MP3 leaves it, with an echo before each knock.

    Overlapping blocks of 26 ms are transformed by a modified discrete cosine transform, and its
    coefficients rounded to `coarse` of their root mean square in a block.
    """
    half = round(_BLOCK * rate)
    place, pitch = np.arange(2 * half), np.arange(half)
    window = np.sin(math.pi * (place + 0.5) / (2 * half))
    angles = math.pi / half * np.outer(place + 0.5 + 0.5 * half, pitch + 0.5)
    basis = window[:, None] * np.cos(angles) * math.sqrt(2.0 / half)
    blocks = math.ceil(len(values) / half) + 1
    padded = np.zeros((blocks + 1) * half)
    padded[half : half + len(values)] = values
    out = np.zeros_like(padded)
    for first in range(0, blocks * half, half):
        tones = padded[first : first + 2 * half] @ basis
        step = coarse * math.sqrt(float((tones**2).mean())) + 1e-30
        out[first : first + 2 * half] += basis @ (np.round(tones / step) * step)
    return out[half : half + len(values)]
