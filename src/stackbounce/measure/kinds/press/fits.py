"""Power laws fitted to the points of a press curve by least squares."""

import numpy as np

from stackbounce.measure.quantities import Array

_FIRST_EXPONENTS = (0.7, 1.0, 1.5, 2.0, 3.0)  # of the grid on which the fit's start is sought
_FIRST_CONTACTS = 48  # places of the contact on the same grid
_GRID_POINTS = 300  # of the curve that are compared on that grid, for speed
LARGEST_LOG = 20.0  # of a parameter, so that no power overflows


def power(ratio: Array, exponent: float) -> Array:
    """Return a ratio to a power, 0 where it is not above 0.

    Examples
    --------
    >>> power(np.array([-1.0, 0.0, 0.25]), 1.5)
    array([0.   , 0.   , 0.125])
    """
    result = np.zeros_like(ratio)
    above = ratio > 0.0
    result[above] = ratio[above] ** exponent
    return result


def rough_contact(x: Array, y: Array) -> tuple[float, float]:
    """Return rough values of the contact and the exponent, independent of the force's zero.

    Parameters
    ----------
    x, y : ndarray
        (N,) compression and force of a loading.

    Returns
    -------
    tuple of float
    """
    some = np.linspace(0, len(x) - 1, min(len(x), _GRID_POINTS)).astype(int)
    x, y = x[some], y[some]
    low, high = float(x.min()), float(x.max())
    places = np.linspace(low - 0.5 * (high - low), high - 0.1 * (high - low), _FIRST_CONTACTS)
    best = (np.inf, low, 1.0)
    dy = y - y.mean()
    for p in _FIRST_EXPONENTS:
        rise = power((x[None, :] - places[:, None]) / (high - low), p)
        rise -= rise.mean(axis=1, keepdims=True)
        square = (rise**2).sum(axis=1) + 1e-300
        along = rise @ dy
        rest = dy @ dy - np.where(along > 0.0, along**2 / square, 0.0)
        i = int(rest.argmin())
        if rest[i] < best[0]:
            best = (float(rest[i]), float(places[i]), p)
    return best[1], best[2]


def power_law(x: Array, peak: float, values: Array) -> tuple[Array, Array]:
    """Return ``P ((x - peak + C)/C)**p``, and its derivatives by P, ln p and ln C.

    Parameters
    ----------
    x : ndarray
        (N,) compression.
    peak : float
        Where the force is P.
    values : ndarray
        P, ln p and ln C.

    Returns
    -------
    force : ndarray
        (N,).
    jacobian : ndarray
        (N, 3).
    """
    top, p, c = values[0], *np.exp(np.clip(values[1:], -LARGEST_LOG, LARGEST_LOG))
    ratio = 1.0 - (peak - x) / c
    unit = power(ratio, p)
    by_exponent = top * p * unit * np.log(np.where(ratio > 0.0, ratio, 1.0))
    by_length = top * p * power(ratio, p - 1.0) * (1.0 - ratio)
    return top * unit, np.column_stack([unit, by_exponent, by_length])


def fit_power_law(x: Array, y: Array, peak: float, first: Array, free: int, scale: Array) -> Array:
    """Return P, ln p and ln C of the `power_law` that fits points best.

    Parameters
    ----------
    x, y : ndarray
        (N,) compression, and force less its zero.
    peak : float
        Where the force is P.
    first : ndarray
        P, ln p and ln C to start from.
    free : int
        How many of them are fitted: 3, or 2 where C is known.
    scale : ndarray
        (N,) relative noise of the points.
    """
    from scipy.optimize import least_squares

    def curve(values: Array) -> tuple[Array, Array]:
        return power_law(x, peak, np.append(values, first[free:]))

    solved = least_squares(
        lambda values: (curve(values)[0] - y) / scale,
        first[:free],
        jac=lambda values: curve(values)[1][:, :free] / scale[:, None],
        method="lm",
        xtol=1e-10,
        ftol=1e-12,
        max_nfev=300,
    )
    values = np.append(solved.x, first[free:])
    return np.append(values[0], np.clip(values[1:], -LARGEST_LOG, LARGEST_LOG))
