"""Sudden rises of a recording's loudness."""

from typing import NamedTuple

import numpy as np

from stackbounce.measure.quantities import Array, Samples

# Set by hand on the recordings of `benchmarks/coverage/sound.py` and `docs/lab`.
_HOP_SECONDS = 0.5e-3  # s, step of the search
_SETTLING_SECONDS = 0.03  # s after silence at the start: no noise rises above the recording's own
_QUIET_PERCENT = 20.0  # of the recording are quieter than its noise, or hardly louder
_HOPS_AFTER, _HOPS_BEFORE, _HOPS_BETWEEN = 4, 16, 1  # whose loudness is compared, and between them
_FALSE_ALARMS = 0.01  # rises of stationary noise in a recording, on average
_CHANCE_MARGIN = 1.2  # by which the energy must rise more than noise does by chance
_LEAST_RISE = 3.0  # of the energy: the amplitude rises by 1.7
_MOST_RISES = 250  # that are looked at, the clearest


class Rises(NamedTuple):
    """Times, their errors and amplitudes, (N,): in s, s and the recording's unit.

    `ratios` are amplitudes over the least that would count as a rise.
    """

    times: Array
    errors: Array
    amplitudes: Array
    ratios: Array


def find_rises(white: Samples, rate: float, rounded: float) -> Rises:
    """Return where a whitened recording becomes suddenly louder, to 0.5 ms or so.

    The amplitude must rise within 2 ms by a factor of 1.7 at least, and by more than stationary
    noise does in one recording of a hundred.

    Parameters
    ----------
    white : ndarray
        (N,), as of `ar_noise.whitened`.
    rate : float
        Samples per second.
    rounded : float
        Variance of the quantisation error of a sample: the smallest possible noise.

    Returns
    -------
    Rises
        At most the 250 clearest, ascending in time.
    """
    from scipy.ndimage import maximum_filter1d

    hop = max(1, round(_HOP_SECONDS * rate))
    rows = white[: len(white) // hop * hop].reshape(-1, hop)
    energy = np.einsum("ij,ij->i", rows, rows, dtype=np.float64) / hop
    if len(energy) < _HOPS_AFTER + _HOPS_BEFORE:
        return Rises(*(np.zeros(0) for _ in range(4)))
    before, after = _around(energy, rounded)
    ratio = after / before
    least = _least(hop, len(energy))
    highest = maximum_filter1d(ratio, 2 * _HOPS_AFTER + 3, mode="nearest")
    (peaks,) = np.nonzero((ratio == highest) & (ratio > least))
    peaks = peaks[peaks < len(energy) - _HOPS_AFTER]
    if len(peaks) > _MOST_RISES:
        peaks = np.sort(peaks[np.argsort(ratio[peaks])[-_MOST_RISES:]])
    return Rises(
        peaks.astype(np.float64) * (hop / rate),
        np.full(len(peaks), 0.5 * hop / rate),
        np.sqrt(np.maximum(after[peaks] - before[peaks], 1e-30)),
        np.sqrt(ratio[peaks] / least),
    )


def _around(energy: Array, rounded: float) -> tuple[Array, Array]:
    """Return the mean energy before and after the start of each hop."""
    import pandas as pd

    hops = pd.Series(energy)
    after = hops[::-1].rolling(_HOPS_AFTER, min_periods=1).mean()[::-1].to_numpy()
    earlier = hops.rolling(_HOPS_BEFORE, min_periods=1).mean()
    before = earlier.shift(1 + _HOPS_BETWEEN, fill_value=np.inf).to_numpy(copy=True)
    # At first a microphone or a codec is silent, or a gain settles; silence has a little noise.
    least = max(rounded, 1e-9 * float(energy.max()), 1e-30)
    first = before[: np.argmax(energy > least) + round(_SETTLING_SECONDS / _HOP_SECONDS)]
    first[:] = np.maximum(first, np.percentile(energy, _QUIET_PERCENT))
    return np.maximum(before, least), after


def _least(freedom: int, count: int) -> float:
    """Return the smallest ratio of the energies after and before that counts as a rise."""
    from scipy.special import fdtri

    chance = fdtri(_HOPS_AFTER * freedom, _HOPS_BEFORE * freedom, 1.0 - _FALSE_ALARMS / count)
    return max(_LEAST_RISE, _CHANCE_MARGIN * float(chance))
