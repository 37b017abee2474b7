"""An acceleration's columns -> the size of what the sensor feels, whether g is in it or not."""

from typing import Any, NamedTuple

import numpy as np

from stackbounce.errors import InvalidType, InvalidValue
from stackbounce.measure.quantities import Array
from stackbounce.measure.samples import columns

FEWEST = 4  # samples of a flight
_CLIPPED = 3  # samples of exactly the largest value: the range of the sensor ended
_AXES = ("acceleration_x", "acceleration_y", "acceleration_z")
_LINEAR = ("without g", "linear", "user acceleration", "ohne g")
# How a record without gravity is told. Set by hand on the records of `tests/synthetic`.
_REST_SECONDS = 1.0  # s: a rest; a fall of that duration is one of 5 m
_REST_MEAN, _REST_SCATTER = 0.2, 0.05  # of gravity: the most in a rest
_PULSE = 1.5  # of gravity: beyond it the phone feels the floor


class Record(NamedTuple):
    """What an accelerometer felt.

    Attributes
    ----------
    times, felt : ndarray
        (n,) in s and m/s²: about 0 in flight, g at rest.
    linear : bool
        Whether gravity was subtracted, so that `felt` is computed from what is left.
    clipped : float
        The end of the sensor's range in `felt`, infinite where it is not reached.
    notes : list of str
        What a reader should know, a sentence each.
    """

    times: Array
    felt: Array
    linear: bool
    clipped: float
    notes: list[str]


def record_of(data: Any, gravity: float) -> Record:
    """Return the size of the acceleration that a Dataset or arrays hold.

    Raises
    ------
    InvalidType
        If there is none.
    InvalidValue
        If there are too few samples, or times do not ascend.
    """
    told = hasattr(data, "data_vars")
    names = [str(name) for name in data.data_vars] if told else ["acceleration"]
    axes = [name for name in names if name.startswith("acceleration")]
    if not axes:
        raise InvalidType(
            f"data must hold an acceleration over time, got {', '.join(names) or 'nothing'}"
        )
    times, *felt = columns(data, ("time", *axes))
    notes: list[str] = []
    if set(_AXES) <= set(axes):
        size = np.sqrt(sum(felt[axes.index(axis)] ** 2 for axis in _AXES))
    else:
        size = np.abs(felt[-1])
        if told and axes[-1] != "acceleration_absolute":
            notes.append("only one axis is there: flights are where it shows nothing")
    cut = told and any(
        (size == np.nanmax(size)).sum() >= _CLIPPED for size in map(np.abs, felt) if size.size
    )
    linear = told and _is_linear(data, times, size, gravity)
    known = np.isfinite(times) & np.isfinite(size)
    times, size = times[known], size[known]
    if len(times) < 2 * FEWEST or (np.diff(times) <= 0.0).any():
        raise InvalidValue(
            f"data must hold {2 * FEWEST} samples or more at ascending times, got "
            f"{len(times)} samples"
        )
    if cut:
        notes.append("the sensor's range ended in a pulse: peaks are higher than they look")
    if linear:
        size = np.where(size > _PULSE * gravity, size + gravity, np.abs(size - gravity))
        notes.append(
            "gravity was subtracted, in a direction that is badly known in flight: record the "
            "acceleration with g"
        )
    return Record(times, size, linear, float(size.max()) if cut else np.inf, notes)


def _is_linear(data: Any, times: Array, size: Array, gravity: float) -> bool:
    """Return whether gravity was subtracted: by what the file says, or as a rest shows nothing."""
    texts = [str(data.attrs.get("format", ""))]
    texts += [str(column.attrs.get("long_name", "")) for column in data.data_vars.values()]
    if any(word in text.casefold() for text in texts for word in _LINEAR):
        return True
    step = float(np.median(np.diff(times))) if len(times) > 1 else 0.0
    wide = round(_REST_SECONDS / step) if step > 0.0 else 0
    if not FEWEST <= wide < len(size):
        return False
    sums = np.cumsum(np.stack([size, size**2]), axis=1)
    mean, square = (sums[:, wide:] - sums[:, :-wide]) / wide
    calm = square - mean**2 < (_REST_SCATTER * gravity) ** 2
    near = np.abs(mean[calm] / gravity - 1.0) < _REST_MEAN
    return bool((mean[calm] < _REST_MEAN * gravity).any() and not near.any())
