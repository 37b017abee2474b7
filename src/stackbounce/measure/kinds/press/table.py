"""The law that a press curve is: a table through its many points, by monotone least squares."""

from typing import Any

import numpy as np

from stackbounce.errors import InvalidValue, whole
from stackbounce.measure.quantities import Array
from stackbounce.model import Tabulated
from stackbounce.model.laws.tabulated import MOST_POINTS

_FEWEST = 6
_STEEP = 1e-6  # of the mean rise: the smallest rise of the loading from point to point
_FIRM = 1e3  # weight of the condition that unloading begins where loading ends, over all points


def fitted_table(loading: Any, unloading: Any, points: int) -> Tabulated:
    """Return the law of the points of loading and, if they are known, of unloading.

    Parameters
    ----------
    loading, unloading : (ndarray, ndarray), or None
        Compression in m and force in N, in any order; where it is below 0 they are left out.
    points : int
        Of the table, 3 to 16, at equal distances from 0 to the largest compression.

    Raises
    ------
    InvalidValue
        If a branch has too few points.
    """
    from scipy.interpolate import PchipInterpolator

    whole("points", points, 3, MOST_POINTS)
    c, f = _pressed("loading", *loading)
    knots = np.linspace(0.0, float(c.max()), points)
    force, bulge = np.zeros(points), np.zeros(len(c))
    for _ in range(2):  # the second time by how much the law's spline is off straight lines
        force = np.append(0.0, np.cumsum(_rises(_ramps(knots, c), f - bulge)))
        bulge = PchipInterpolator(knots, force)(c) - np.interp(c, knots, force)
    force[1:] += _STEEP * force[-1] * np.arange(1, points) / points
    if unloading is None:
        return Tabulated(knots.tolist(), force.tolist())
    c, f = _pressed("unloading", *unloading)
    # The share of the loading rises to 1: all rises together are 1, by a firm condition.
    ramps = np.insert(_ramps(knots, c)[:, 1:], 0, 1.0, axis=1) * np.interp(c, knots, force)[:, None]
    firm = _FIRM * len(c) ** 0.5 * force[-1]
    shares = np.cumsum(_rises(np.vstack([ramps, np.full(points - 1, firm)]), np.append(f, firm)))
    shares[-1] = 1.0
    back = np.append(0.0, force[1:] * np.minimum(shares, 1.0))
    return Tabulated(knots.tolist(), force.tolist(), back.tolist())


def _pressed(name: str, c: Array, f: Array) -> tuple[Array, Array]:
    """Return the points of a branch at which the ball is pressed."""
    keep = c >= 0.0
    if np.count_nonzero(keep) < _FEWEST or not np.any(c[keep] > 0.0):
        raise InvalidValue(
            f"{name} must have at least {_FEWEST} points with a compression of 0 or above, "
            f"got {np.count_nonzero(keep)}"
        )
    return c[keep], f[keep]


def _ramps(knots: Array, c: Array) -> Array:
    """Return how far each point is within each interval of the knots, from 0 to 1, (N, K - 1)."""
    return np.asarray(np.clip((c[:, None] - knots[None, :-1]) / np.diff(knots), 0.0, 1.0))


def _rises(ramps: Array, wanted: Array) -> Array:
    """Return the rises, none below 0, whose sum along the ramps fits points best."""
    from scipy.optimize import nnls

    return np.asarray(nnls(ramps, wanted)[0])
