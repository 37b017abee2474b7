"""Samples as an analysis takes them: columns of a Dataset or arrays, runs, rounding, areas."""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from stackbounce.errors import InvalidType, InvalidValue, StackbounceError, all_real, shown
from stackbounce.measure.quantities import Array, Mask
from stackbounce.units import in_si, magnitude

_UNITS = {"time": "s", "knock": "s", "force": "N", "compression": "m", "x": "m", "y": "m"}
_UNITS |= {"acceleration": "m/s^2"}

# Set by hand on records of oscilloscopes and rulers (`tests/measure/test_samples.py`).
_MOST_NUMBERS = 2**18  # of which the step is looked for
_REPEATED = 0.8  # share of different numbers among rounded ones, unless these change quickly
_CHANGES = 5  # different changes between neighbours, which evenly moved numbers have not
_STRAY = 0.05  # share of the numbers that may lie between two steps
_STEP_UNEVEN, _DISTANCE_OFF = 0.1, 0.25  # in steps: of one step, and at most of a longer distance
_ON_STEPS = 0.9  # share of the distances that are whole numbers of steps
_SPIKE = 12.0  # noise levels of the second difference at a spike
_STUCK = 0.4  # of a step: scatter, with rounding, below which numbers are stuck at it


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
    UnitError
        If a unit of pint is of another dimension than the variable.
    InvalidType
        If `data` is neither, lacks a variable, or holds something else than numbers, or masked
        ones.
    InvalidValue
        If the arrays are not as many as the names, or not of one length.

    Examples
    --------
    >>> columns(([0, 1], [2, 3]), ("time", "force"))
    [array([0., 1.]), array([2., 3.])]
    >>> import pint, xarray
    >>> columns((pint.Quantity([0, 1], "ms"), pint.Quantity([2, 3], "kN")), ("time", "force"))
    [array([0.   , 0.001]), array([2000., 3000.])]
    >>> held = {"compression": ("i", [0, 2], {"units": "mm"}), "force": ("i", [0, 9])}
    >>> columns(xarray.Dataset(held), ("compression", "force"))
    [array([0.   , 0.002]), array([0., 9.])]
    """
    try:
        own = hasattr(data, "data_vars")  # what is a dimension only has no numbers
        given = [data.variables[name] for name in names] if own else list(data)
        all_real("data", given)
        given = [_in_si(array, *names[k : k + 1]) for k, array in enumerate(given)]
        arrays = [np.asarray(array, dtype=np.float64) for array in given]
    except StackbounceError:
        raise
    except (KeyError, TypeError, ValueError):
        got = ", ".join(map(str, getattr(data, "data_vars", ()))) or shown(data)
        raise InvalidType(
            f"data must be a Dataset with {' and '.join(names)}, or arrays of numbers in their "
            f"place, got {got}"
        ) from None
    if len(arrays) != len(names):
        raise InvalidValue(f"data must be ({', '.join(names)}), got {len(arrays)} arrays")
    if any(array.shape != arrays[0].shape or array.ndim != 1 for array in arrays):
        shapes = " and ".join(str(array.shape) for array in arrays)
        raise InvalidValue(
            f"data must hold {' and '.join(names)} of one length, got shapes {shapes}"
        )
    return arrays


def _in_si(array: Any, name: str = "") -> Any:
    """Return an array in SI units, by its unit if it has one."""
    known = in_si(str(getattr(array, "attrs", {}).get("units", "")))
    unit = known[1] if known else _UNITS.get(name.partition("_")[0], "")
    return magnitude(array, unit, name or "data") if known or hasattr(array, "m_as") else array


def runs(mask: Mask) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Return the first and the last places of the runs of true values.

    Examples
    --------
    >>> runs(np.array([True, True, False, True]))
    (array([0, 3]), array([1, 3]))
    """
    edges = np.flatnonzero(np.diff(mask, prepend=False, append=False))
    return edges[::2], edges[1::2] - 1


def resolution(values: NDArray[np.floating]) -> float:
    """Return the step of a converter, or of digits, that numbers were rounded to; 0 for none.

    It is the smallest distance of two of them, if the other distances are multiples of it. Numbers
    that neither repeat nor change by varying numbers of steps may just have been moved evenly.

    Examples
    --------
    >>> wave = np.sin(np.arange(100.0))
    >>> resolution(wave), resolution(np.round(8.0 * wave) / 8.0)
    (0.0, 0.125)
    """
    some = values[:: max(1, len(values) // _MOST_NUMBERS)]
    distinct = np.unique(some).astype(np.float64)
    gaps = np.diff(distinct)
    gaps = np.sort(gaps[gaps > 1e-9 * np.ptp(distinct)]) if len(gaps) else gaps
    for step in gaps[[0, int(_STRAY * len(gaps))]].tolist() if len(gaps) else ():
        multiples = gaps / step
        changes = np.unique(np.round(np.diff(some) / step))
        seen = len(distinct) <= _REPEATED * len(some) or len(changes) > _CHANGES
        off = np.abs(multiples - np.round(multiples))
        whole = off < np.minimum(_STEP_UNEVEN * np.sqrt(multiples), _DISTANCE_OFF)
        if seen and np.mean(whole) > _ON_STEPS:
            return float(step)
    return 0.0


def quantisation_error(step: float, noise: float) -> float:
    """Return the error of a mean of numbers that are rounded to a step, and hardly differ.

    More noise makes the rounding errors of the numbers independent, so that they average out.

    Examples
    --------
    >>> round(quantisation_error(0.1, 0.01), 3), quantisation_error(0.1, 0.1)
    (0.029, 0.0)
    """
    return step / math.sqrt(12.0) if noise < _STUCK * step else 0.0


def trapezoid(x: Array) -> Array:
    """Return the weights with which values at x add up to their integral along the path.

    Examples
    --------
    >>> trapezoid(np.array([0.0, 1.0, 3.0]))
    array([0.5, 1.5, 1. ])
    """
    steps = 0.5 * np.diff(x)
    return np.asarray(np.append(steps, 0.0) + np.append(0.0, steps))


def spikes(values: Array) -> Mask:
    """Return which samples are spikes: far from both neighbours, which agree with theirs.

    A spike makes second differences of 1, -2 and 1 times its height, and nothing else does.

    Parameters
    ----------
    values : ndarray
        (n,) samples at even times, n at least 3.

    Returns
    -------
    ndarray
        (n,) booleans; the first and last two samples are never spikes.

    Examples
    --------
    >>> spikes(np.array([0.0, 1.0, 3.0, 9.0, 8.0, 11.0, 15.0])).nonzero()[0].tolist()
    []
    >>> spikes(np.array([0.0, 1.0, 3.0, 99.0, 8.0, 11.0, 15.0, 20.0, 25.0])).nonzero()[0].tolist()
    [3]
    """
    found = np.zeros(len(values), dtype=bool)
    bend = np.diff(values, 2)
    quiet = float(np.median(np.abs(bend))) / 0.6745
    scale = max(quiet, 1e-9 * float(np.ptp(values)))
    before, here, after = bend[:-2], bend[1:-1], bend[2:]
    high = np.abs(here) > _SPIKE * scale
    off = np.maximum(np.abs(before + 0.5 * here), np.abs(after + 0.5 * here))
    found[2:-2] = high & (off < 0.15 * np.abs(here))
    return found
