"""The law that a press curve is: a table through its many points, by monotone least squares."""

from typing import Any

import numpy as np

from stackbounce.errors import InvalidValue, whole
from stackbounce.measure.quantities import Array
from stackbounce.model import Tabulated
from stackbounce.model.laws.tabulated import MOST_POINTS, monotone_spline

_FEWEST = 6
_ROUNDS = 3  # each fits what the spline of the last one leaves over
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
    whole("points", points, 3, MOST_POINTS)
    c, f = _pressed("loading", *loading)
    most = float(c.max())
    knots = np.linspace(0.0, most, points)
    force = _fitted_loading(knots, c, f)
    force = np.cumsum(np.maximum(np.diff(force, prepend=0.0), 0.0))
    force[1:] += _STEEP * force[-1] * np.arange(1, points) / points
    if unloading is None:
        return Tabulated(knots.tolist(), force.tolist())
    c, f = _pressed("unloading", *unloading)
    back = np.append(0.0, force[1:] * _fitted_shares(knots, c, f, _spline_at(knots, force, c)))
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


def _fitted_loading(knots: Array, c: Array, f: Array) -> Array:
    """Return the forces at the knots whose monotone spline from 0 fits points best."""
    from scipy.optimize import nnls

    ramps = np.clip((c[:, None] - knots[None, :-1]) / np.diff(knots), 0.0, 1.0)
    values = np.zeros(len(knots))
    wanted = f
    for _ in range(_ROUNDS):
        rises, _ = nnls(ramps, wanted)
        values = np.concatenate([[0.0], np.cumsum(rises)])
        straight = np.interp(c, knots, values)
        wanted = f - (_spline_at(knots, values, c) - straight)
    return values


def _fitted_shares(knots: Array, c: Array, f: Array, loading: Array) -> Array:
    """Return the shares of the loading at the knots, rising to 1, that fit points best."""
    from scipy.optimize import nnls

    ramps = np.clip((c[:, None] - knots[None, 1:-1]) / np.diff(knots)[1:], 0.0, 1.0)
    rows = loading[:, None] * np.column_stack([np.ones(len(c)), ramps])
    firm = _FIRM * len(c) ** 0.5 * loading.max()  # that all rises together are 1
    rises, _ = nnls(np.vstack([rows, np.full(rows.shape[1], firm)]), np.append(f, firm))
    shares: Array = np.minimum(np.cumsum(rises), 1.0)
    shares[-1] = 1.0
    return shares


def _spline_at(knots: Array, values: Array, c: Array) -> Array:
    """Return the monotone spline through the values at some compressions."""
    pieces = np.array(monotone_spline(knots.tolist(), values.tolist()))
    at = np.maximum(np.searchsorted(pieces[:, 0], c, side="right") - 1, 0)
    begin, a, b, s = pieces[at].T
    beyond = c - begin
    spline: Array = a + beyond * (b + beyond * s)
    return spline
