"""Where a recording becomes suddenly louder, and when exactly."""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

__all__ = ["Rises", "find_rises", "whitened"]

_HOP = 0.5e-3  # s, step of the search
_AFTER, _BEFORE, _GUARD = 4, 16, 1  # hops whose loudness is compared, and between them
_ORDER = 24  # of the forecast that noise is removed by
_CHUNK = 1024
_LEAST_RISE = 3.0  # of the energy
_MOST = 250  # rises that are looked at
_SHORT, _LONG = 2e-3, 5e-3  # s around a rise where its onset is looked for
_LOUD = 2e-3  # s after the onset that tell how loud the knock is
_RISES = (0.0, 0.05e-3, 0.1e-3, 0.2e-3, 0.5e-3, 1e-3)  # s in which a knock may rise


class Rises(NamedTuple):
    """Times, their errors and amplitudes, (N,): in s, s and the recording's unit."""

    times: NDArray[np.float64]
    errors: NDArray[np.float64]
    amplitudes: NDArray[np.float64]
    ratios: NDArray[np.float64]


def whitened(samples: NDArray[np.float32]) -> NDArray[np.float32]:
    """Return what could not be foretold from what preceded, (channels, N).

    The forecast is linear, of the quiet half of the recording: it takes out hum and steady noise of
    any color, and lets through what comes suddenly.

    Examples
    --------
    >>> hum = np.sin(np.arange(48000) * 2 * np.pi * 50 / 48000).astype(np.float32)
    >>> bool(np.abs(whitened(hum[None])[0, 1000:]).max() < 0.01)
    True
    """
    from scipy.linalg import solve_toeplitz
    from scipy.signal import lfilter

    found = np.empty_like(samples)
    for channel, values in enumerate(samples):
        chunks = values[: len(values) // _CHUNK * _CHUNK].reshape(-1, _CHUNK)
        energies = np.einsum("ij,ij->i", chunks, chunks)
        middle = np.median(energies) if len(chunks) else 0.0
        quiet = chunks[(energies <= middle) & (energies > 0.0)]
        if not len(quiet):
            found[channel] = values
            continue
        some = quiet[:: max(1, len(quiet) // 512)].astype(np.float64)
        products = [
            float(np.einsum("ij,ij->", some[:, lag:], some[:, : _CHUNK - lag]))
            for lag in range(_ORDER + 1)
        ]
        products[0] *= 1.0 + 1e-7
        forecast = solve_toeplitz(products[:-1], products[1:])
        filter_ = np.concatenate([[1.0], -forecast]).astype(np.float32)
        found[channel] = lfilter(filter_, np.float32(1.0), values)
        found[channel, :_ORDER] = 0.0
    return found


def find_rises(white: NDArray[np.float32], rate: float, threshold: float | None) -> Rises:
    """Return where a whitened recording becomes suddenly louder.

    Parameters
    ----------
    white : ndarray
        (channels, N), as of `whitened`.
    rate : float
        Samples per second.
    threshold : float, optional
        By which factor the amplitude must rise within 2 ms; by default so that steady noise does so
        in one recording of a hundred, and at least by 1.7.

    Returns
    -------
    Rises
        At most the 250 clearest, ascending in time.
    """
    hop = max(1, round(_HOP * rate))
    energy = _energy(white, hop)
    if len(energy) < _AFTER + _BEFORE:
        return Rises(*(np.zeros(0) for _ in range(4)))
    before, after = _around(energy)
    ratio = after / before
    least = _least(threshold, hop * len(white), len(energy))
    wide = _AFTER + 1
    peaks = _maxima(ratio, wide)
    peaks = peaks[(ratio[peaks] > least) & (peaks < len(energy) - _AFTER)]
    if len(peaks) > _MOST:
        peaks = np.sort(peaks[np.argsort(ratio[peaks])[-_MOST:]])
    rows = []
    for peak in peaks:
        time, error = _onset(white, int(peak) * hop, rate, float(before[peak]))
        loud = math.sqrt(max(after[peak] - before[peak], 1e-30))
        rows.append((time, error, loud, math.sqrt(ratio[peak] / least)))
    return Rises(*np.array(rows).T) if rows else Rises(*(np.zeros(0) for _ in range(4)))


def _energy(white: NDArray[np.float32], hop: int) -> NDArray[np.float64]:
    """Return the mean square of each hop, all channels together."""
    count = white.shape[1] // hop
    energy = np.zeros(count)
    for values in white:
        rows = values[: count * hop].reshape(count, hop)
        energy += np.einsum("ij,ij->i", rows, rows, dtype=np.float64) / hop
    return energy / len(white)


def _around(energy: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the mean energy before and after the start of each hop."""
    sums = np.concatenate([[0.0], np.cumsum(energy)])
    at = np.arange(len(energy))
    end = np.minimum(at + _AFTER, len(energy))
    after = (sums[end] - sums[at]) / (end - at)
    stop = np.maximum(at - _GUARD, 0)
    start = np.maximum(stop - _BEFORE, 0)
    filled = stop > start
    before = np.where(filled, (sums[stop] - sums[start]) / np.maximum(stop - start, 1), np.inf)
    # The first hops have nothing before them; digital silence is given a little noise.
    floor = np.median(energy)
    before[: _BEFORE + _GUARD] = np.maximum(before[: _BEFORE + _GUARD], floor)
    return np.maximum(before, max(1e-9 * float(energy.max()), 1e-30)), after


def _least(threshold: float | None, freedom: int, count: int) -> float:
    """Return the least ratio of energies of a knock."""
    if threshold is not None:
        return threshold**2
    from scipy.stats import f

    chance = f.isf(0.01 / count, _AFTER * freedom, _BEFORE * freedom)
    return max(_LEAST_RISE, 1.2 * float(chance))


def _maxima(values: NDArray[np.float64], wide: int) -> NDArray[np.int64]:
    """Return where values are largest within `wide` to both sides."""
    from scipy.ndimage import maximum_filter1d

    top = maximum_filter1d(values, 2 * wide + 1, mode="nearest")
    at = np.flatnonzero((values == top) & (values > 0.0))
    return at[np.concatenate([[True], np.diff(at) > wide])] if len(at) else at


def _onset(
    white: NDArray[np.float32], sample: int, rate: float, before: float
) -> tuple[float, float]:
    """Return when the variance begins to grow near a sample, and the error of that, in s.

    The posterior of the onset, where the amplitude grows as ``1 - exp(-t/a)`` from there, with all
    rise times a of a list equally likely beforehand.
    """
    low = max(0, sample - round(_SHORT * rate))
    high = min(white.shape[1], sample + round(_LONG * rate))
    squares = (white[:, low:high].astype(np.float64) ** 2).mean(axis=0)
    later = max(8, round(_LOUD * rate))
    split = sample - low
    middle, variance = float(split), 1.0
    for _ in range(3):
        part = squares[: split + later]
        more = max(float(part[split:].mean()) - before, 1e-3 * before)
        chances = _chances(part, before, more, rate, len(white))
        places = np.arange(len(chances)) + 0.5  # between the sample before and this one
        middle = float(chances @ places)
        variance = float(chances @ (places - middle) ** 2) + 1.0 / 12.0
        best = int(np.argmax(chances))
        if best == split:
            break
        split = best
    return (low + middle - 1.0) / rate, math.sqrt(variance) / rate


def _chances(
    squares: NDArray[np.float64], before: float, more: float, rate: float, channels: int
) -> NDArray[np.float64]:
    """Return how probable it is that the knock begins at each sample."""
    count = len(squares)
    at = np.arange(count)
    since = np.maximum(np.subtract.outer(at, at), -1) + 1  # 0 before the onset; (sample, onset)
    logs = []
    for rise in _RISES:
        grown = (-np.expm1(-(at + 0.5) / rate / rise)) ** 2 if rise else np.ones(count)
        variance = before + more * np.concatenate([[0.0], grown])
        terms = squares[:, None] * (1.0 / variance)[since] + np.log(variance)[since]
        logs.append(-0.5 * channels * terms.sum(axis=0))
    likelihood = np.array(logs)
    chances = np.exp(likelihood - likelihood.max()).sum(axis=0)
    return np.asarray(chances / chances.sum())
