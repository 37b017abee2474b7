"""Samples as an analysis takes them: columns of a Dataset or arrays; runs; trapezoids."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from stackbounce.errors import InvalidType, InvalidValue, shown
from stackbounce.measure.quantities import Array

__all__ = ["columns", "runs", "trapezoid"]


def columns(data: Any, names: Sequence[str]) -> list[Array]:
    """Return the named variables of a Dataset, or the arrays that are given in their place.

    Parameters
    ----------
    data : xarray.Dataset or sequence of array_like
        What an analysis was given.
    names : sequence of str
        The variables, in order.

    Returns
    -------
    list of ndarray
        (N,) each.

    Raises
    ------
    InvalidType
        If `data` is neither, lacks a variable, or holds something else than numbers.
    InvalidValue
        If the arrays are not as many as the names, or not of one length.

    Examples
    --------
    >>> columns(([0, 1], [2, 3]), ("time", "force"))
    [array([0., 1.]), array([2., 3.])]
    """
    try:
        given = [data[name] for name in names] if hasattr(data, "data_vars") else list(data)
        arrays = [np.asarray(one, dtype=np.float64) for one in given]
    except (KeyError, TypeError, ValueError):
        got = ", ".join(map(str, getattr(data, "data_vars", ()))) or shown(data)
        raise InvalidType(
            f"data must be a Dataset with {' and '.join(names)}, or arrays of numbers in their "
            f"place, got {got}"
        ) from None
    if len(arrays) != len(names):
        raise InvalidValue(f"data must be ({', '.join(names)}), got {len(arrays)} arrays")
    if any(one.shape != arrays[0].shape or one.ndim != 1 for one in arrays):
        shapes = " and ".join(str(one.shape) for one in arrays)
        raise InvalidValue(
            f"data must hold {' and '.join(names)} of one length, got shapes {shapes}"
        )
    return arrays


def runs(mask: NDArray[np.bool_]) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Return the first and the last places of the runs of true values.

    Examples
    --------
    >>> runs(np.array([True, True, False, True]))
    (array([0, 3]), array([1, 3]))
    """
    edges = np.flatnonzero(np.diff(mask, prepend=False, append=False))
    return edges[::2], edges[1::2] - 1


def trapezoid(x: Array) -> Array:
    """Return the weights with which values at x add up to their integral along the path.

    Examples
    --------
    >>> trapezoid(np.array([0.0, 1.0, 3.0]))
    array([0.5, 1.5, 1. ])
    """
    steps = 0.5 * np.diff(x)
    weights: Array = np.append(steps, 0.0) + np.append(0.0, steps)
    return weights
