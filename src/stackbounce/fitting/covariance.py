"""How well the data determine the parameters: directions and the covariance matrix."""

import numpy as np

from stackbounce.fitting.objective import Objective
from stackbounce.run.quantities import Array

OPEN = 1.0
"""Root of chi squared's change between the bounds below which a direction is undetermined."""

_UNIFORM = 12.0**-0.5  # standard deviation of a uniform distribution of width 1


def find_directions(objective: Objective, slopes: Array) -> tuple[Array, Array]:
    """Return the principal directions of a linearised fit; see `Fit.directions`.

    Parameters
    ----------
    objective : Objective
        What is fitted.
    slopes : ndarray
        (residuals, parameters) derivatives of the residuals by the search coordinates.

    Returns
    -------
    sizes : ndarray
        (k,) root of chi squared's change from bound to bound, in falling order.
    directions : ndarray
        (k, parameters) unit vectors, in coordinates that run from 0 to 1 between the bounds.
    """
    _, sizes, directions = np.linalg.svd(slopes * objective.widths)
    return np.pad(sizes, (0, len(directions) - len(sizes))), directions


def estimate_covariance(objective: Objective, x: Array, sizes: Array, directions: Array) -> Array:
    """Return the covariance matrix (parameters, parameters) of the values at a trial.

    In an undetermined direction the standard deviation is that of a uniform distribution between
    the bounds.
    """
    spread = 1.0 / np.maximum(sizes, 1.0 / _UNIFORM)
    inner = (directions.T * spread**2) @ directions
    scale = objective.widths * objective.value_slopes(x)
    return np.asarray(inner * np.outer(scale, scale))


def find_leverages(objective: Objective, slopes: Array, sizes: Array, directions: Array) -> Array:
    """Return how far a linearised fit follows each number, from 0 to 1: (residuals,).

    Undetermined directions follow none.
    """
    known = sizes > OPEN
    along = (slopes * objective.widths) @ directions[known].T / sizes[known]
    return np.asarray(np.sum(along**2, axis=1))
