"""Force records as data: the force of a contact over time, in newtons or on an unknown scale."""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from stackbounce.errors import InvalidType, InvalidValue, all_real, placed, positive, shown
from stackbounce.fitting.quantities import read_index
from stackbounce.measure.finding import force_channels
from stackbounce.measure.kinds.waveform.analysis import waveform as analysed
from stackbounce.measure.kinds.waveform.result import Waveform as Analysed
from stackbounce.measure.samples import columns
from stackbounce.model import Drop
from stackbounce.run.quantities import Array
from stackbounce.units import in_si, magnitude

# The fit seeks the touch this far from where the analysis finds it: the largest of the three.
_NEAR = 0.1  # of the first contact's duration
_SIGMAS = 5.0  # of the standard error
_SAMPLES = 3.0  # of the sampling interval
_CLIPPED = 3.0  # times the noise: how far below its top a clipped record is whole


@dataclass(frozen=True, eq=False)
class Waveform:
    """A force record of one contact.

    Parameters
    ----------
    name : str
        ``force.0`` for the floor's.
    index : int
        The number of the contact.
    times : ndarray
        (n,) in s, ascending, on the record's own clock.
    force : ndarray
        (n,) in N, or in any unit if the scale is free.
    error : float
        One standard deviation of a sample, in the same unit.
    scaled : bool
        Whether the scale, a factor between the record and newtons, is fitted.
    begins : (float, float)
        The bounds in s, on that clock, of the first touch of the floor.
    left_out : int
        How many samples were left out, because the record is clipped there.

    Examples
    --------
    >>> record = Waveform("force.0", 0, np.arange(3.0), np.ones(3), 1.0, False, (0.0, 1.0))
    >>> record.linear(np.zeros(3))  # all of it is baseline
    array([0., 0., 0.])
    """

    name: str
    index: int
    times: Array
    force: Array
    error: float
    scaled: bool
    begins: tuple[float, float]
    left_out: int = 0

    def linear(self, predicted: Array) -> Array:
        """Return the residuals (n,) in errors, with the best baseline and, if free, scale.

        Both are linear parameters and found exactly. The residuals are nan if a predicted force is
        not finite.
        """
        if not np.all(np.isfinite(predicted)):
            return np.full(len(predicted), np.nan)
        if not self.scaled:
            left = self.force - predicted
            return np.asarray((np.mean(left) - left) / self.error)
        basis = np.stack([np.ones_like(predicted), predicted], axis=1)
        best, *_ = np.linalg.lstsq(basis, self.force, rcond=None)
        return np.asarray((basis @ best - self.force) / self.error)

    def curve(self, predicted: Array) -> Array:
        """Return the predicted force with the best baseline and scale, in the record's unit."""
        return np.asarray(self.force + self.error * self.linear(predicted))


def read_waveform(drop: Drop, name: str, value: object, path: str) -> Waveform:
    """Return a force record, of a DataArray over time, what `read` returns, or two or three arrays.

    Parameters
    ----------
    drop : Drop
        What was dropped.
    name : str
        ``force.0`` and so on.
    value : DataArray, or (times, force), or (times, force, error)
        A DataArray has the dimension ``time`` in s. Its scale is known if its units are N, and
        fitted otherwise. Arrays are in s and N. Without an error (the attribute ``error``, or the
        third array) the scatter of the quiet parts is taken.
    path : str
        The name in messages.

    Raises
    ------
    InvalidValue
        If there is no such contact, no contact can be found in the record, or several of one ball
        without gravity, which makes one.
    InvalidType
        If the value is of another type.

    Notes
    -----
    `stackbounce.measure.waveform` removes baseline, drift and hum, and finds the touch, around
    which it is fitted. Samples at the top of a clipped record are left out. The record must end
    before the next bounce.

    Examples
    --------
    >>> import stackbounce as sb
    >>> drop = sb.Drop([sb.Ball(1.0)], [sb.Spring(1.0)], height=1.0)
    >>> times = np.arange(-2.0, 6.0, 0.01)
    >>> force = 4.43 * np.sin(np.clip(times, 0.0, np.pi))
    >>> noisy = force + np.random.default_rng(1).normal(0.0, 0.05, len(times))
    >>> read_waveform(drop, "force.0", (times, noisy), "force.0").scaled
    False
    """
    index = read_index(drop, "contact", name.partition(".")[2], path)
    times, force, error, scaled = _arrays(value, path)
    with placed(f"{path}: "):
        found = analysed((times, force))
    if not found.contacts or found.contacts[0].start is None:
        raise InvalidValue(f"{path} must begin before a contact and hold it: {len(times)} samples")
    if len(drop.balls) == 1 and not drop.gravity and (count := len(found.contacts)) > 1:
        raise InvalidValue(f"{path} must end before the next bounce, got {count} contacts")
    sigma = found.noise if error is None else positive(f"{path}'s error", error)
    if not sigma > 0.0:
        raise InvalidValue(f"{path} must have the error of a sample: its own scatter is 0")
    clipped = any(contact.clipped for contact in found.contacts)
    whole = found.force < (found.force.max() - _CLIPPED * found.noise if clipped else math.inf)
    seen = found.times[whole], found.force[whole]
    return Waveform(name, index, *seen, sigma, scaled, _begins(found, index), int(np.sum(~whole)))


def _begins(found: Analysed, index: int) -> tuple[float, float]:
    """Return the bounds in s of the first touch of the floor."""
    contact = found.contacts[0]
    assert contact.start is not None
    start, error = contact.start.nominal_value, contact.start.std_dev
    end = found.times[-1] if contact.end is None else contact.end.nominal_value
    near = max(_SIGMAS * error, _NEAR * (end - start), _SAMPLES * found.step)
    earliest = start - near if index == 0 else float(found.times[0])
    return earliest, start + near


def _arrays(value: Any, path: str) -> tuple[Any, Any, Any, bool]:
    """Return times, forces, their error, and whether the scale is free."""
    if hasattr(value, "data_vars"):
        value = next((value[name] for name in force_channels(value)), value)
    if hasattr(value, "dims"):
        if value.dims != ("time",):
            got = tuple(map(str, value.dims))
            raise InvalidValue(f"{path} must be a force over the time alone, got {got}")
        times, force = columns((value["time"], value), ("time", "force"))
        error, known = value.attrs.get("error"), in_si(str(value.attrs.get("units", "")))
        error = known[0] * error if known and error is not None else error
        return times, force, error, not known or known[1] != "N"
    all_real(path, value)
    try:
        times, force, error = value if len(value) == 3 else (*value, None)
    except (TypeError, ValueError) as problem:
        raise InvalidType(
            f"{path} must be a DataArray over time, or times, forces and their error, "
            f"got {shown(value)}"
        ) from problem
    error = error if error is None else magnitude(error, "N", f"{path}'s error")
    return magnitude(times, "s", path), magnitude(force, "N", path), error, False
