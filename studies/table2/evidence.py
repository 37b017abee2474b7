"""Marginal likelihoods: the mean of a likelihood over its prior, from quasi-random draws.

Priors are written as functions of independent standard normal numbers, so that every prior has the
same draws. The draws are scrambled Sobol points in several independent sets; the differences
between the sets give the numerical error.
"""

from typing import NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

__all__ = ["Evidence", "average_sets", "draw_normal", "sum_logs"]

Array: TypeAlias = NDArray[np.float64]


class Evidence(NamedTuple):
    """The logarithm of a marginal likelihood, its numerical error, and the effective draws."""

    log: float
    error: float
    effective: float


def draw_normal(dimension: int, sets: int, each: int, seed: int) -> Array:
    """Return (sets, each, dimension) standard normal numbers, the same for the same seed.

    Parameters
    ----------
    dimension : int
        How many numbers a draw has.
    sets : int
        How many independent sets of Sobol points.
    each : int
        Points of a set, a power of two.
    seed : int
        Of the scrambling.

    Examples
    --------
    >>> draws = draw_normal(2, sets=4, each=256, seed=1)
    >>> draws.shape, bool(abs(draws.mean()) < 1e-2)
    ((4, 256, 2), True)
    """
    from scipy.special import ndtri
    from scipy.stats import qmc

    points = [
        qmc.Sobol(dimension, scramble=True, rng=np.random.default_rng([seed, k])).random(each)
        for k in range(sets)
    ]
    return np.asarray(ndtri(np.clip(points, 1e-12, 1.0 - 1e-12)))


def average_sets(log_likelihood: Array) -> Evidence:
    """Return the marginal likelihood from the logarithms of likelihoods at draws of the prior.

    Parameters
    ----------
    log_likelihood : ndarray
        (sets, each), at the draws of `draw_normal`. For draws of another density than the prior,
        the logarithm of the ratio of prior and density is added.

    Examples
    --------
    A measurement 1 ± 0.5 of a number with the prior 0 ± 1 has the marginal density N(1; 0, 1.25):

    >>> z = draw_normal(1, sets=8, each=512, seed=1)[..., 0]
    >>> found = average_sets(-0.5 * ((z - 1.0) / 0.5) ** 2 - np.log(0.5))
    >>> bool(abs(found.log - (-0.5 / 1.25 - 0.5 * np.log(1.25))) < 1e-3)
    True
    """
    top = float(np.max(log_likelihood))
    weights = np.exp(log_likelihood - top)
    means = weights.mean(axis=1)
    mean = float(means.mean())
    error = float(means.std(ddof=1) / np.sqrt(len(means)) / mean)
    effective = float(weights.sum() ** 2 / np.sum(weights**2))
    return Evidence(top + float(np.log(mean)), error, effective)


def sum_logs(values: Array) -> Array:
    """Return the logarithm of the sum of exponentials over the last axis."""
    top = np.max(values, axis=-1, keepdims=True)
    return np.asarray(top[..., 0] + np.log(np.sum(np.exp(values - top), axis=-1)))
