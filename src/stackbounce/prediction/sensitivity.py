"""Which number makes how much of a variance: shares by derivatives, and Sobol indices."""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from stackbounce.run.quantities import Array

_ROUND_OFF = 1e-10  # relative: a standard deviation of this size is none


class Sensitivity(NamedTuple):
    """Shares of the numbers in the variance of quantities.

    Parameters
    ----------
    first, first_error : ndarray
        (parts, numbers) the share that a number makes on its own, and its standard error.
    total, total_error : ndarray
        The same with the share that it makes together with others; nan if it is not defined.
    """

    first: Array
    first_error: Array
    total: Array
    total_error: Array


def linear_shares(slopes: Array, covariance: Array, *, independent: bool) -> Sensitivity:
    """Return the shares in the variance of a quantity that changes in proportion to the numbers.

    Shares of correlated numbers contain half of what a pair makes together, and may be negative.

    Parameters
    ----------
    slopes : ndarray
        (parts, numbers) derivatives.
    covariance : ndarray
        (numbers, numbers) of the numbers.
    independent : bool
        Whether the numbers are; only then first and total indices are defined, and equal.

    Examples
    --------
    >>> linear_shares(np.array([[1.0, 1.0]]), np.diag([9.0, 1.0]), independent=True).first
    array([[0.9, 0.1]])
    """
    parts = slopes * (slopes @ covariance)
    with np.errstate(all="ignore"):
        share = parts / np.sum(parts, axis=1, keepdims=True)
    none = np.zeros_like(share)
    return Sensitivity(share, none, share if independent else np.full_like(share, np.nan), none)


def fit_slopes(draws: Array, answers: Array) -> Array:
    """Return the slopes (parts, numbers) of straight lines through draws; nan of too few.

    Parameters
    ----------
    draws : ndarray
        (n, numbers) of the numbers.
    answers : ndarray
        (n, parts) of a quantity; nan where a draw has none.

    Examples
    --------
    >>> draws = np.arange(6.0).reshape(3, 2) ** 2
    >>> fit_slopes(draws, 2.0 * draws[:, :1]).round(9) + 0.0
    array([[2., 0.]])
    """
    slopes = np.full((answers.shape[1], draws.shape[1]), np.nan)
    for part, column in enumerate(answers.T):
        known = np.isfinite(column)
        if np.count_nonzero(known) > draws.shape[1]:
            x, y = draws[known], column[known]
            size = np.std(x, axis=0)
            size[size == 0.0] = 1.0
            lines = np.linalg.lstsq((x - np.mean(x, axis=0)) / size, y - np.mean(y), rcond=None)
            slopes[part] = lines[0] / size
    return slopes


def sobol_indices(
    solve: Callable[[Array], Array], first: Array, second: Array, answers: Array
) -> Sensitivity:
    """Return the Sobol indices of independent numbers.

    Parameters
    ----------
    solve : callable
        From numbers (n, numbers) to quantities (n, parts); nan for what is not possible.
    first, second : ndarray
        (n, numbers) two independent sets of draws.
    answers : ndarray
        (2 n, parts) quantities of the first set, then of the second one.

    Returns
    -------
    Sensitivity

    Notes
    -----
    First indices by Saltelli et al., Comput. Phys. Commun. 181, 259 (2010), total ones by Jansen,
    Comput. Phys. Commun. 117, 35 (1999). The errors are standard errors of the means.
    """
    size, count = first.shape
    mixed = np.tile(first, (count, 1, 1))
    for k in range(count):
        mixed[k, :, k] = second[:, k]
    changed = solve(mixed.reshape(-1, count)).reshape(count, size, -1)
    own, other = answers[:size], answers[size:]
    whole = np.all(np.isfinite(own + other + changed), axis=0)
    found = np.full((4, count, answers.shape[1]), np.nan)
    for part in np.flatnonzero(np.any(whole, axis=0)):
        ok = whole[:, part]
        a, b, c = own[ok, part], other[ok, part], changed[:, ok, part]
        known = np.concatenate([a, b])
        mean, variance = np.mean(known), np.var(known)
        if variance > (_ROUND_OFF * mean) ** 2:
            for k, terms in ((0, (b - mean) * (c - a)), (2, 0.5 * (a - c) ** 2)):
                found[k, :, part] = np.mean(terms, axis=1) / variance
                found[k + 1, :, part] = np.std(terms, axis=1) / variance / np.sqrt(len(ok))
    return Sensitivity(*(rows.T for rows in found))
