"""Which number makes how much of a variance."""

import numpy as np

from stackbounce.run.quantities import Array


def linear_shares(slopes: Array, covariance: Array) -> Array:
    """Return the shares in the variance of quantities that change in proportion to the numbers.

    Shares of correlated numbers contain half of what a pair makes together, and may be negative.

    Parameters
    ----------
    slopes : ndarray
        (parts, numbers) derivatives.
    covariance : ndarray
        (numbers, numbers) of the numbers.

    Returns
    -------
    ndarray
        (parts, numbers).

    Examples
    --------
    >>> linear_shares(np.array([[1.0, 1.0]]), np.diag([9.0, 1.0]))
    array([[0.9, 0.1]])
    """
    parts = slopes * (slopes @ covariance)
    with np.errstate(all="ignore"):
        return np.asarray(parts / np.sum(parts, axis=1, keepdims=True))


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
