"""The times of the knocks of one recording, from the alignment of their loudness in bands."""

import math
from typing import NamedTuple

import numpy as np

from stackbounce.measure.quantities import Array, Mask, Pair, Samples

# Set by hand on the synthetic recordings of `benchmarks/coverage/sound.py`, so that the error bars
# hold the truth as often as they claim; `tests/measure/test_coverage_measure.py` guards it.
_LOWEST_HERTZ = 350.0  # below are wind, hum and steps
_HIGHEST_SHARE = 0.46  # of the sampling rate
_LONGEST_STEP = 1.0 / 32e3  # s between powers
_AMPLITUDE_STEPS = 8  # to a sample of a record of amplitudes
_SKIRT_SIGMAS = 4.5  # standard deviations of a filter's response in time that are kept
_SILENCE = 1e-10  # of the largest power
_SECONDS_BEFORE, _SECONDS_AFTER = 2e-3, 3e-3  # s of a knock, around its onset, that are compared
_FEWEST_SAMPLES = 8  # before and after, at a low sampling rate
_NOISE_SHARE = 0.4  # of the time before the onset, from its beginning: there is noise alone
_FARTHEST = 3e-3  # s by which a first time may be wrong
_FARTHEST_OF_FLIGHT = 0.2  # share of the shortest flight by which a first time may be wrong
_WIDE_ROUNDS, _ROUNDS = 3, 7  # rounds that search as far as that, and all rounds
_OUTLIER_SIGMAS = 3.0  # standard deviations at which a residual is cut off
_LEAST_VARIANCE = 0.6  # of ln(power), added to that of the residuals; noise in a band has 1.6
_VARIANCE_WINDOW = 0.2e-3  # s over which variances are averaged
_SLOPE_WINDOW = 0.5e-3  # s over which it is averaged whether a slope is chance
_LEAST_SHARE = 0.05  # of a knock that a template explains: less tells nothing of the template
_PRIOR_FREEDOM = 4.0  # degrees of freedom with which the expected scatter of bands counts
_POOLED = 0.3  # weight of the median variance of all knocks in the variance of each


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
    values: Samples,
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
    top, low = _HIGHEST_SHARE * rate, min(_LOWEST_HERTZ, rate / 16.0)
    edges = np.geomspace(low, top, max(2, round(math.log2(top / low))) + 1)  # Hz, about octaves
    widths = 0.5 * np.diff(edges)  # Hz, standard deviations
    lasts = 1.0 / (2.0 * math.pi * widths)
    finer = 2 ** max(0, math.ceil(math.log2(1.0 / (rate * _LONGEST_STEP))))
    skirt = _SKIRT_SIGMAS * lasts.max()
    before, after = (math.ceil((side + skirt) * rate) for side in (-start, stop))
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


def _windows(values: Samples, rate: float, about: Array, before: int, after: int) -> Pair:
    """Return samples around each time without their mean, and by how much a time is later."""
    nearest = np.round(about * rate).astype(np.int64)
    wanted = nearest[:, None] + np.arange(-before, after)
    inside = (wanted >= 0) & (wanted < len(values))
    around = np.where(inside, values[np.clip(wanted, 0, len(values) - 1)], 0.0)
    mean = around.sum(axis=1) / np.maximum(inside.sum(axis=1), 1)
    return np.where(inside, around - mean[:, None], 0.0), about - nearest / rate


def _amplitudes(values: Samples, rate: float, about: Array, start: float, stop: float) -> Bands:
    """Return a record of amplitudes as one band, interpolated."""
    from scipy.ndimage import map_coordinates

    step = 1.0 / (rate * _AMPLITUDE_STEPS)
    first, last = round(start / step), round(stop / step)
    wanted = about[:, None] * rate + np.arange(first, last + 1) / _AMPLITUDE_STEPS
    floor = math.sqrt(_SILENCE) * float(values.max()) + 1e-30
    logs = 2.0 * np.log(values.astype(np.float64) + floor)
    between = map_coordinates(logs, [wanted], order=1, mode="nearest")
    return Bands(between[:, None], first * step, step, np.array([float(_AMPLITUDE_STEPS)]))


class _Window(NamedTuple):
    """Steps of a knock that are compared: how many, and which are noise and which are loud."""

    first: int
    steps: int
    quiet: Mask
    loud: Mask


class _Comparison(NamedTuple):
    """What knocks and template say at one alignment, each (knocks, bands, steps).

    `wanted` is the template as loud as the knock and with the knock's noise, `residuals` are the
    knock less that, `slopes` and `seen` the time derivatives of the template and of the knock.
    `weights` are inverse variances, times `significance`, which is 0 where the slope of a template
    is chance.
    """

    wanted: Array
    residuals: Array
    slopes: Array
    seen: Array
    weights: Array
    significance: Array


def aligned(
    values: Samples, rate: float, about: Array, least: float = 0.0, faint: float = 0.0
) -> Pair:
    """Return the times of the knocks of one ball, consistent with each other, and their errors.

    Each knock is shifted until the logarithms of its power in bands of an octave agree best with
    the mean of all other knocks. Loudness and noise may differ from knock to knock. Only what
    other knocks have in common counts: the rise, and resonances and echoes as far as they repeat.

    Parameters
    ----------
    values : ndarray
        (N,) samples of one channel.
    rate : float
        Samples per second.
    about : ndarray
        (K,) approximate times in s, at least two, within 3 ms.
    least : float, optional
        Variance of the quantisation error of a sample.
    faint : float, optional
        Share of the largest power of a knock, in each band, below which nothing is compared.

    Returns
    -------
    times, errors : ndarray
        (K,) in s. A shift that all knocks have in common, which no flight contains, is not
        determined: the median shift is none. It is not in the errors either.

    Notes
    -----
    An error follows from how well the bands of a knock agree with each other about its time, and
    from how well the knocks agree about each band. A disturbance that shifts all bands alike is not
    in it; `consistency.misjudgement` looks for that in the flights.

    Examples
    --------
    >>> random = np.random.default_rng(1)
    >>> true = np.array([0.05, 0.15, 0.2402])
    >>> since = np.arange(16000) / 48000.0 - true[:, None]
    >>> knock = np.where(since > 0.0, np.exp(-since / 3e-3), 0.0) * np.sin(3e4 * since)
    >>> values = knock.sum(axis=0) + 1e-3 * random.standard_normal(16000)
    >>> times, errors = aligned(values.astype("f4"), 48000.0, true + [0.0, 3e-4, -2e-4])
    >>> bool(np.ptp(times - true) < 5e-6), bool(errors.max() < 1e-5)
    (True, True)
    """
    few = _FEWEST_SAMPLES / rate
    before, after = max(_SECONDS_BEFORE, few), max(_SECONDS_AFTER, few)
    shortest = float(np.diff(about).min())
    reach = max(min(_FARTHEST, _FARTHEST_OF_FLIGHT * shortest), 0.5 * few)
    start, stop = -before - 2.0 * reach, after + 2.0 * reach
    bands = band_powers(values, rate, about, start, stop, least, faint)
    window = _window(bands, before, after)
    shifts: Array = np.zeros(len(about))
    compared, template = _compared(_shifted(bands, window, shifts), window, bands, None)
    for k in range(_ROUNDS):
        near = reach if k < _WIDE_ROUNDS else reach / 3.0
        found = _best(bands, window, compared, shifts, near)
        # The others move away from a knock as it moves towards them.
        shifts = shifts + (found - shifts) * (len(about) - 1.0) / len(about)
        shifts = np.clip(shifts - np.median(shifts), -reach, reach)
        compared, template = _compared(_shifted(bands, window, shifts), window, bands, template)
    more, errors = _averaged(*_by_band(compared))
    # Few bands tell the error of one knock: it is drawn to that of all.
    drawn = np.sqrt((1.0 - _POOLED) * errors**2 + _POOLED * np.median(errors) ** 2)
    return about + shifts + more, drawn


def _window(bands: Bands, before: float, after: float) -> _Window:
    first = round((-before - bands.start) / bands.step)
    since = bands.step * np.arange(round((before + after) / bands.step) + 1) - before
    loud = (since >= 0.0) & (since < after)
    return _Window(first, len(since), since < (_NOISE_SHARE - 1.0) * before, loud)


def _shifted(bands: Bands, window: _Window, shifts: Array) -> Array:
    """Return the logarithms at the window of each knock, interpolated by cubics."""
    whole = np.floor(shifts / bands.step).astype(np.int64)
    x = (shifts / bands.step - whole)[:, None, None]
    steps = window.first + whole[:, None] + np.arange(-1, window.steps + 2)
    steps = np.clip(steps, 0, bands.logs.shape[2] - 1)
    near = np.take_along_axis(bands.logs, steps[:, None], axis=2)
    a, b, c, d = (near[:, :, k : k + window.steps] for k in range(4))
    cubic = c - a + x * (2.0 * a - 5.0 * b + 4.0 * c - d + x * (3.0 * (b - c) + d - a))
    return np.asarray(b + 0.5 * x * cubic)


def _compared(
    logs: Array, window: _Window, bands: Bands, template: Array | None
) -> tuple[_Comparison, Array]:
    """Return how each knock compares with the mean of the others, and the mean of all."""
    level = logs[:, :, window.loud].mean(axis=2)[:, :, None]
    floor = logs[:, :, window.quiet].mean(axis=2)[:, :, None] - level
    logs = logs - level
    if template is None:
        template = np.median(logs, axis=0)
    for _ in range(3):
        share, off, most = _off(logs, template, floor)
        better = (share * off).sum(axis=0) / ((share**2).sum(axis=0) + _LEAST_SHARE)
        template = np.maximum(template + np.clip(better, -1.0, 1.0), floor.min(axis=0) - 3.0)
    share, off, most = _off(logs, template, floor)
    rest = (share**2).sum(axis=0) + _LEAST_SHARE - share**2
    without = ((share * off).sum(axis=0) - share * off) / np.maximum(rest, _LEAST_SHARE)
    others = np.logaddexp(template + np.clip(without, -2.0, 2.0), floor)
    residuals = np.clip(logs - others, -most, most)
    squares = (residuals**2).mean(axis=0)
    variances = _smooth(squares, _VARIANCE_WINDOW / bands.step) + _LEAST_VARIANCE
    slopes, seen = (np.gradient(logarithms, bands.step, axis=2) for logarithms in (others, logs))
    # What the slope of the others predicts of a knock's own: chance predicts nothing.
    wide = _SLOPE_WINDOW / bands.step
    common = _smooth((slopes * seen).mean(axis=0), wide)
    real = np.clip(common / np.maximum(_smooth((slopes**2).mean(axis=0), wide), 1e-30), 0.0, 1.0)
    weights = np.broadcast_to(real**2 / variances / bands.correlation[:, None], logs.shape)
    return _Comparison(others + level, residuals, slopes, seen, weights, real**2), template


def _off(logs: Array, template: Array, floor: Array) -> tuple[Array, Array, Array]:
    """Return the template's share of each knock, the residuals, and to what they are limited."""
    wanted = np.logaddexp(template, floor)
    off = logs - wanted
    most = _OUTLIER_SIGMAS * (1.4826 * np.median(np.abs(off), axis=0) + 0.1)
    return np.exp(template - wanted), np.clip(off, -most, most), most


def _smooth(values: Array, wide: float) -> Array:
    from scipy.ndimage import uniform_filter1d

    return np.asarray(uniform_filter1d(values, int(wide) + 1, axis=-1, mode="nearest"))


def _best(
    bands: Bands, window: _Window, compared: _Comparison, shifts: Array, reach: float
) -> Array:
    """Return the shift of each knock, near the present one, that fits the template best.

    The weighted sum of squares at all shifts is a correlation, calculated by Fourier transforms.
    """
    from scipy.signal import fftconvolve

    most = round(reach / bands.step)
    now = np.round(shifts / bands.step).astype(np.int64)
    steps = window.first + now[:, None] + np.arange(-most, window.steps + most)
    steps = np.clip(steps, 0, bands.logs.shape[2] - 1)
    logs = np.take_along_axis(bands.logs, steps[:, None], axis=2)
    weights = compared.weights[..., ::-1]
    wanted = weights * compared.wanted[..., ::-1]
    pairs = ((logs**2, weights), (logs, wanted))
    squared, crossed = (fftconvolve(*pair, "valid", axes=-1) for pair in pairs)
    squares = (squared - 2.0 * crossed).sum(axis=1)
    at = np.clip(np.argmin(squares, axis=1), 1, 2 * most - 1)
    low, mid, high = (squares[np.arange(len(at)), at + k] for k in (-1, 0, 1))
    bend = low - 2.0 * mid + high
    between = np.where(bend > 0.0, 0.5 * (low - high) / np.where(bend > 0.0, bend, 1.0), 0.0)
    return np.asarray((now + at - most + np.clip(between, -1.0, 1.0)) * bands.step)


def _by_band(compared: _Comparison) -> Pair:
    """Return by how much each band would shift each knock, and the variance of that, (K, B)."""
    weights, slopes = compared.weights, compared.slopes
    information = (weights * slopes**2).sum(axis=2)
    common = (weights * slopes * compared.seen).sum(axis=2).mean(axis=0)
    real = np.maximum(common / np.maximum(information.mean(axis=0), 1e-30), _LEAST_SHARE)
    information = np.maximum(information * real, 1e-9)
    shifts = -(weights * slopes * compared.residuals).sum(axis=2) / information
    spread = (weights * slopes**2 * compared.significance).sum(axis=2)
    return shifts, np.maximum(spread / information**2, 1e-14)


def _averaged(shifts: Array, variances: Array) -> Pair:
    """Return the mean over the bands, and its error from how well the bands agree.

    The variance of each band is scaled to the scatter of the bands about the mean, over all knocks,
    and that of each knock to its own; a few degrees of freedom are those of the expected scatter.
    """
    scale = np.ones(shifts.shape[1])
    for _ in range(10):
        share, mean = _shares(shifts, variances * scale)
        squares = (shifts - mean[:, None]) ** 2 / variances
        free = (1.0 - share).sum(axis=0)
        scale = (_PRIOR_FREEDOM + squares.sum(axis=0)) / (_PRIOR_FREEDOM + free)
    share, mean = _shares(shifts, variances * scale)
    squares = (shifts - mean[:, None]) ** 2 / (variances * scale)
    own = (share * squares).sum(axis=1) / np.maximum((share * (1.0 - share)).sum(axis=1), 1e-3)
    freedom = 1.0 / (share**2).sum(axis=1) - 1.0
    factor = (_PRIOR_FREEDOM + freedom * own) / (_PRIOR_FREEDOM + freedom)
    return mean, np.sqrt(factor / (1.0 / (variances * scale)).sum(axis=1))


def _shares(shifts: Array, variances: Array) -> Pair:
    """Return the weight of each band, of 1 together, and the weighted mean."""
    weights = 1.0 / variances
    share = weights / weights.sum(axis=1, keepdims=True)
    return share, (share * shifts).sum(axis=1)
