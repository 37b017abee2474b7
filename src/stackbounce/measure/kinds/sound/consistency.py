"""By how much the errors of knocks are misjudged, as the flights between them tell."""

from collections.abc import Sequence

import numpy as np

from stackbounce.measure.quantities import Array
from stackbounce.measure.statistics.regression import half_width, widening

# The priors: set by hand on the synthetic recordings of `benchmarks/coverage/sound.py`.
_USUAL_FACTOR, _FACTOR_SPREAD = 2.2, 1.0  # median, and standard deviation of the logarithm
_SCATTERS = (2e-5, 0.1)  # of restitutions from bounce to bounce, log-uniform
_NO_SCATTER = 0.8  # probability of none
_GRID = 24  # factors, and scatters, at which the likelihood is calculated
_FEWEST = 3  # restitutions for a line and a scatter
_OUTLIER_SIGMAS = 6.0  # standard deviations at which a residual is cut off


def misjudgement(times: Array, errors: Array, missed: Sequence[int]) -> float:
    """Return the factor by which the errors of knocks are too small.

    Sounds that disturb all bands of a knock alike shift its time by more than its bands tell. Such
    a shift makes one flight longer and the next one shorter. The factor's prior is log-normal with
    a median of 2.2. The likelihood is that of the restitutions about a straight line over the
    speed. They may also scatter by themselves, which does not alternate.

    Parameters
    ----------
    times, errors : ndarray
        (K,) of the knocks, in s.
    missed : sequence of int
        How many bounces are missing after each knock but the last.

    Returns
    -------
    float
        With it 68.3 % of the times lie within their errors.

    Examples
    --------
    >>> times = np.cumsum(0.8 ** np.arange(12.0))
    >>> noise = 1e-3 * np.random.default_rng(1).standard_normal(12)
    >>> 5.0 < misjudgement(times + noise, np.full(12, 1e-4), [0] * 11) < 20.0
    True
    """
    factors = _USUAL_FACTOR * np.exp(_FACTOR_SPREAD * np.linspace(-3.0, 4.0, _GRID))
    logs = -0.5 * (np.log(factors / _USUAL_FACTOR) / _FACTOR_SPREAD) ** 2
    flights = np.diff(times)
    few = 1.0
    first = np.array([k for k in range(len(flights) - 1) if not (missed[k] or missed[k + 1])])
    if len(first) >= _FEWEST:
        kept = flights[first + 1] / flights[first]
        slopes = np.zeros((len(kept), len(times)))
        row = np.arange(len(kept))
        slopes[row, first] = kept / flights[first]
        slopes[row, first + 1] = -(1.0 + kept) / flights[first]
        slopes[row, first + 2] = 1.0 / flights[first]
        covariance = (slopes * errors**2) @ slopes.T
        design = np.stack([np.ones(len(kept)), flights[first]], axis=1)
        few = widening(max(len(kept) - 2, 1))
        logs = logs + _evidence(_limited(design, kept), design, covariance, factors)
    weights = np.exp(logs - logs.max())
    return few * half_width(weights / weights.sum(), np.zeros(_GRID), factors)


def _limited(design: Array, values: Array) -> Array:
    """Return values without outliers: their distance from a robust line is limited."""
    line: Array = np.zeros(2)
    weights: Array = np.ones(len(values))
    for _ in range(10):
        root = np.sqrt(weights)
        line = np.asarray(np.linalg.lstsq(design * root[:, None], values * root, rcond=None)[0])
        off = np.abs(values - design @ line)
        weights = 1.0 / np.maximum(off, 0.1 * np.median(off) + 1e-12)
    off = values - design @ line
    usual = 1.4826 * np.median(np.abs(off)) * len(values) / (len(values) - 2)  # two are fitted
    most = _OUTLIER_SIGMAS * usual + 1e-12
    return np.asarray(design @ line + np.clip(off, -most, most))


def _evidence(values: Array, design: Array, covariance: Array, factors: Array) -> Array:
    """Return the log-likelihood of each factor, over all lines and all scatters of the values."""
    scatters = np.concatenate([[0.0], np.geomspace(*_SCATTERS, _GRID)])
    prior = np.log([_NO_SCATTER, *[(1.0 - _NO_SCATTER) / _GRID] * _GRID])
    own = scatters[:, None, None] ** 2 * np.eye(len(values))
    logs = np.array([_likelihoods(values, design, f**2 * covariance + own) for f in factors])
    logs += prior
    top = logs.max()
    return np.asarray(np.log(np.exp(logs - top).sum(axis=1) + 1e-300) + top)


def _likelihoods(values: Array, design: Array, covariances: Array) -> Array:
    """Return the log-likelihood of values for each covariance, over all lines."""
    roots = np.linalg.cholesky(covariances)
    both = np.linalg.solve(roots, np.broadcast_to(np.c_[design, values], (*roots.shape[:2], 3)))
    lines, rest = both[..., :2], both[..., 2]
    normal = np.swapaxes(lines, -1, -2) @ lines
    projected = (np.swapaxes(lines, -1, -2) @ rest[..., None])[..., 0]
    fitted = np.linalg.solve(normal, projected[..., None])[..., 0]
    squares = (rest**2).sum(axis=-1) - (projected * fitted).sum(axis=-1)
    volume = np.log(np.diagonal(roots, axis1=-2, axis2=-1)).sum(axis=-1)
    return np.asarray(-0.5 * squares - volume - 0.5 * np.linalg.slogdet(normal)[1])
