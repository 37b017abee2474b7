"""The droop of a piezo sensor: a high-pass of first order, and its inverse."""

import numpy as np

from stackbounce.errors import positive
from stackbounce.measure.quantities import Array


def undrooped(times: Array, values: Array, time_constant: float) -> Array:
    """Return the input of a high-pass of first order from its output.

    Parameters
    ----------
    times : ndarray
        (n,) in s, ascending.
    values : ndarray
        (n,) the output, without any offset of the recorder.
    time_constant : float
        RC in s, above 0, in which the response to a constant force decays to 1/e.

    Returns
    -------
    ndarray
        (n,) in the unit of `values`: ``y + (1/RC) ∫ y dt``, exact for a force that is
        linear in time between samples.

    Raises
    ------
    InvalidValue
        If `time_constant` is not positive and finite.
    InvalidType
        If it is no number.

    Notes
    -----
    An offset b in `values` becomes a drift b t/RC. White noise of the recorder becomes white noise
    plus a random walk, whose standard deviation is σ sqrt(Δt t)/RC.

    Examples
    --------
    >>> times = np.linspace(0.0, 2.0, 2001)
    >>> leaked = np.exp(-times / 0.5)  # the response to a constant force
    >>> float(np.abs(undrooped(times, leaked, 0.5) - 1.0).max().round(5))
    0.0
    """
    rc = positive("time_constant", time_constant, "seconds")
    share = np.diff(times) / rc
    changes = (values[1:] - np.exp(-share) * values[:-1]) * share / -np.expm1(-share)
    return np.cumsum(np.concatenate([values[:1], changes]))
