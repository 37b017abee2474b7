"""The residuals of a fit: each measured number and each force record beside the fitted one."""

from typing import NamedTuple

import numpy as np

from stackbounce.fitting.objective import Objective, touch_name
from stackbounce.run.quantities import Array


class Residual(NamedTuple):
    """A measured number beside the fitted one.

    Parameters
    ----------
    drop : str
        The name of its drop; empty for a single drop and for a prior.
    name : str
        Such as ``rebound_ratios.1``.
    measured, error, fitted : float
        In SI units.
    pull : float
        Fitted less measured, in standard errors.
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

    @property
    def label(self) -> str:
        """The name with that of its drop, if it has one."""
        return f"{self.drop}.{self.name}" if self.drop else self.name


class Record(NamedTuple):
    """A force record beside the fitted one.

    Parameters
    ----------
    drop : str
        The name of its drop; empty for a single drop.
    name : str
        Such as ``force.0``.
    times : ndarray
        (n,) in s since the first touch.
    measured, fitted : ndarray
        (n,) in N, or in the record's own unit if its scale was fitted too.
    error : float
        The standard error of a sample, in the same unit.
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
    def label(self) -> str:
        """The name with that of its drop, if it has one."""
        return f"{self.drop}.{self.name}" if self.drop else self.name

    @property
    def scatter(self) -> float:
        """Root mean square of the residuals, in errors: about 1 if the model is right."""
        return float(np.sqrt(np.mean(((self.fitted - self.measured) / self.error) ** 2)))


def list_residuals(objective: Objective, x: Array) -> list[Residual]:
    """Return the numbers that were measured, then the priors, beside those of a trial."""
    found, measured = [], {key: own for key, own in objective.measured.items() if own.data}
    for key, predicted in objective.predict(measured, x[None]).items():
        for datum, value in zip(measured[key].data, predicted[0], strict=True):
            pull = (value - datum.value) / datum.error
            row = (datum.value, datum.error, float(value), float(pull), datum.unit)
            found.append(Residual(key, datum.name, *row))
    values = objective.values(x[None])
    for parameter, mean, error in objective.priors:
        fitted = float(values[parameter.name][0])
        row = (mean, error, fitted, (fitted - mean) / error, parameter.unit)
        found.append(Residual("", f"{parameter.name} (known)", *row))
    return found


def list_records(objective: Objective, x: Array) -> list[Record]:
    """Return the force records beside those of a trial."""
    found = []
    for key in objective.records:
        touch = float(objective.values(x[None])[touch_name(key)][0])
        waves, forces = objective.measured[key].waveforms, objective.forces(key, x)
        for wave, force in zip(waves, forces, strict=True):
            curves = (wave.times - touch, wave.force, wave.curve(force))
            found.append(Record(key, wave.name, *curves, wave.error, "" if wave.scaled else "N"))
    return found
