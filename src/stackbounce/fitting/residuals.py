"""What was measured beside what was fitted."""

from typing import NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

__all__ = ["Record", "Residual"]

Array: TypeAlias = NDArray[np.float64]


class Residual(NamedTuple):
    """A number that was measured beside the fitted one.

    Parameters
    ----------
    drop : str
        Of which drop; empty where there is one, and for what is known beforehand.
    name : str
        Such as ``rebound_ratios.1``.
    measured, error, fitted : float
        In SI units.
    pull : float
        How far the fitted number is above the measured one, in errors.
    unit : str
        The SI unit.
    """

    drop: str
    name: str
    measured: float
    error: float
    fitted: float
    pull: float
    unit: str


class Record(NamedTuple):
    """A force record beside the fitted one.

    Parameters
    ----------
    drop : str
        Of which drop; empty where there is one.
    name : str
        Such as ``force.0``.
    times : ndarray
        (n,) in s since the first touch.
    measured, fitted : ndarray
        (n,) in N, or in the record's own unit where its scale was fitted too.
    error : float
        Of a sample, in the same unit.
    unit : str
        ``N``, or empty.

    Examples
    --------
    >>> Record("", "force.0", np.arange(3.0), np.array([1.0, -1, 1]), np.zeros(3), 0.5, "N").scatter
    2.0
    """

    drop: str
    name: str
    times: Array
    measured: Array
    fitted: Array
    error: float
    unit: str

    @property
    def scatter(self) -> float:
        """Root mean square of the differences, in errors: about 1 where the model is right."""
        return float(np.sqrt(np.mean(((self.fitted - self.measured) / self.error) ** 2)))
