"""The onset of each knock of one ball, and its error."""

import math
from typing import NamedTuple

import numpy as np

from stackbounce.measure.quantities import Array, Pair, Samples

# Set by hand on the synthetic recordings of `benchmarks/coverage/sound.py`, as in `alignment.py`.
_RISE_TIMES = (0.0, 0.05e-3, 0.1e-3, 0.2e-3, 0.5e-3, 1e-3)  # s in which a knock may rise
_FAR, _NEAR = 1.5e-3, 0.65e-3  # s to both sides of the presumed onset: at first, and to refine it
_MOST_SAMPLES = 64  # on both sides together: at higher rates neighbours are averaged
_CLEAR_SIGMAS = 5.0  # an onset is refined within `_NEAR` if that is so many of its errors
_NOISE_SECONDS, _GUARD_SECONDS = 8e-3, 0.5e-3  # s before a knock for the noise, and between the two
_POWER_SECONDS = 2e-3  # s after the onset for the power of the knock
_COLOR_SECONDS = 4e-3  # s after the onset for the autocorrelation
_SILENT = 1e-9  # of a knock's power: the smallest noise
_LEAST_POWER = 1e-3  # of the noise: the smallest power of a knock
_ONE_SIGMA = (0.15865525, 0.84134475)  # probabilities at one sigma below and above the mean


class _Knock(NamedTuple):
    """Samples around a knock, the powers of the noise and of the knock, its autocorrelation."""

    first: int
    values: Array
    noise: float
    loud: float
    color: Array


def onsets(white: Samples, rate: float, about: Array, rounded: float, faint: float = 0.0) -> Pair:
    """Return the onsets of the knocks of one ball, and their errors.

    A knock is modelled as autocorrelated Gaussian noise that rises like ``1 - exp(-t/a)`` out of
    white noise. All knocks of a ball on a floor sound alike. The autocorrelation is therefore the
    mean of the knock's own and of the average over all knocks, and all have the rise time a that is
    the most likely of a list. A wrong rise time shifts all onsets by the same amount, which does
    not change the flights. The onset is the mean of its posterior. Its error is the standard
    deviation, or half the width of the central 68.3 % if that is smaller.

    Parameters
    ----------
    white : ndarray
        (N,), as of `ar_noise.whitened`.
    rate : float
        Samples per second.
    about : ndarray
        (K,) approximate onsets, within 1 ms, in s.
    rounded : float
        Variance of the quantisation error of a sample: the smallest possible noise.
    faint : float, optional
        Share of a knock's power that is taken for noise at least.

    Returns
    -------
    times, errors : ndarray
        (K,) in s.

    Notes
    -----
    Samples are autocorrelated. Assuming independence biases the onset of a slow wave late and makes
    its error too small. The likelihood is therefore that of a Gaussian process with the covariance
    ``power g_i g_j R_(i-j) + noise δ_ij`` from the onset on (g is the rise, R the autocorrelation).

    Examples
    --------
    >>> random = np.random.default_rng(1)
    >>> values = random.normal(0.0, np.where(np.arange(4800) < 2400, 0.01, 1.0))
    >>> times, errors = onsets(values.astype("f4"), 48000.0, np.array([0.0505]), 0.0)
    >>> bool(abs(times[0] - 0.05) < 3e-5), bool(errors[0] < 3e-5)
    (True, True)
    """
    errors = np.full(len(about), np.inf)
    far = 2.0 * _FAR * rate
    # Power and autocorrelation are measured after the onset, and improve with it.
    for reach in (_FAR, _FAR, _NEAR) if far > _MOST_SAMPLES else (_FAR, _FAR):
        thin = math.ceil(2.0 * reach * rate / _MOST_SAMPLES)
        knocks = [_knock(white, at, rate, reach, thin, rounded, faint) for at in about]
        times, sure = _improved(knocks, rate / thin)
        times += 0.5 * (thin - 1) / rate  # the middle of the samples that were taken together
        within = np.full(len(about), reach == _FAR) | (errors < reach / _CLEAR_SIGMAS)
        about, errors = np.where(within, times, about), np.where(within, sure, errors)
    return about, errors


def _knock(
    values: Samples, time: float, rate: float, reach: float, thin: int, rounded: float, faint: float
) -> _Knock:
    rate /= thin
    at, half = round(time * rate), round(reach * rate)
    end = at - round(_GUARD_SECONDS * rate)
    before = _part(values, max(end - round(_NOISE_SECONDS * rate), 0), max(end, 1), thin)
    quiet = float((before**2).mean())
    loud = float((_part(values, at, at + round(_POWER_SECONDS * rate), thin) ** 2).mean())
    noise = max(quiet + _rounding(quiet, rounded / thin), max(faint, _SILENT) * loud, 1e-30)
    wave = _part(values, at, at + max(2 * half, round(_COLOR_SECONDS * rate)), thin)
    color = np.correlate(wave, wave, "full")[len(wave) - 1 :][: 2 * half]
    around = _part(values, at - half, at + half, thin)
    color = color / max(color[0], 1e-30)
    return _Knock(at - half, around, noise, max(loud, _LEAST_POWER * noise), color)


def _rounding(noise: float, variance: float) -> float:
    """Return the variance that quantisation adds to the noise.

    With noise of a variance σ² above a step s the quantisation errors are independent of the signal
    and have a variance of s²/12. Without noise those of a slow wave are correlated, and reach half
    a step. In between the correlated share is ``exp(-4 π² σ²/s²)`` (B. Widrow, I. Kollár,
    "Quantization Noise", 2008).
    """
    if variance == 0.0:
        return 0.0
    return variance * (1.0 + 2.0 * math.exp(-(math.pi**2) / 3.0 * noise / variance))


def _part(values: Samples, start: int, stop: int, thin: int) -> Array:
    """Return means of `thin` samples each, and zeros outside of the recording."""
    inside = values[max(start * thin, 0) : max(stop * thin, 0)].astype(np.float64)
    before = max(-start * thin, 0)
    after = (stop - start) * thin - before - len(inside)
    return np.asarray(np.pad(inside, (before, after)).reshape(-1, thin).mean(axis=1))


def _improved(knocks: list[_Knock], rate: float) -> Pair:
    """Return the posterior mean of each onset and its error, in s, with one common rise time."""
    common = np.mean([knock.color for knock in knocks], axis=0)
    logs = np.array([_logs(knock, 0.5 * (knock.color + common), rate) for knock in knocks])
    chances = np.exp(logs - logs.max(axis=(1, 2), keepdims=True))  # (knock, rise, onset)
    evidence = np.maximum(chances.sum(axis=2), 1e-300)
    rise = int(np.argmax(np.log(evidence).sum(axis=0)))
    each = chances[:, rise] / chances[:, rise].sum(axis=1, keepdims=True)
    places = np.arange(each.shape[1] + 1) - 1.0  # an onset lies between a sample and the next
    means = each @ (places[:-1] + 0.5)
    held = np.pad(np.cumsum(each, axis=1), ((0, 0), (1, 0)))
    low, high = np.array([np.interp(_ONE_SIGMA, shares, places) for shares in held]).T
    variances = (each * (places[:-1] + 0.5 - means[:, None]) ** 2).sum(axis=1)
    deviations = np.sqrt(variances + 1.0 / 12.0)
    first = np.array([knock.first for knock in knocks])
    return (first + means) / rate, np.minimum(deviations, 0.5 * (high - low)) / rate


def _logs(knock: _Knock, color: Array, rate: float) -> Array:
    """Return the log-likelihood of each rise and onset of a knock, (rises, onsets)."""
    from scipy.linalg import toeplitz

    count = len(color)
    since = (np.arange(max(count, round(_POWER_SECONDS * rate))) + 0.5) / rate
    grown = np.array(
        [-np.expm1(-since / rise) if rise else np.ones(len(since)) for rise in _RISE_TIMES]
    )
    share = (grown[:, : round(_POWER_SECONDS * rate)] ** 2).mean(axis=1)
    power = (knock.loud - knock.noise) / share
    power = np.maximum(power, _LEAST_POWER * knock.noise)
    wave = np.sqrt(power)[:, None] * grown[:, :count]
    covariances = toeplitz(color) * wave[:, :, None] * wave[:, None] + knock.noise * np.eye(count)
    # A leading block of a Cholesky factor factors the leading block: one serves all onsets.
    roots = np.linalg.cholesky(covariances)
    later = np.add.outer(np.arange(count), np.arange(count))  # sample, onset
    inside = later < count
    follows = np.where(inside, knock.values[np.minimum(later, count - 1)], 0.0)
    logs = 2.0 * np.log(np.diagonal(roots, axis1=1, axis2=2))
    unlike = (np.linalg.inv(roots) @ follows) ** 2 + logs[:, :, None]
    silent = np.cumsum(knock.values**2 / knock.noise + math.log(knock.noise))
    silent = np.concatenate([[0.0], silent])[:-1]
    return np.asarray(-0.5 * (silent + np.where(inside, unlike, 0.0).sum(axis=1)))
