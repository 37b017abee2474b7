"""A force record before the analysis: cleaned, with notes on what is odd about it."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from stackbounce.errors import InvalidValue, counted, positive
from stackbounce.library_types import Dataset
from stackbounce.measure.finding import force_channels
from stackbounce.measure.quantities import Array
from stackbounce.measure.samples import columns, resolution, spikes
from stackbounce.units import checked, in_si

_LEAST_SAMPLES = 8  # of a record
_UNEVEN = 0.01  # of a step, by which one may differ before a note says so


@dataclass(frozen=True, eq=False)
class Record:
    """Times and values of one channel, in order and without blanks.

    Parameters
    ----------
    times : ndarray
        (n,) in s, ascending.
    values : ndarray
        (n,) in `unit`.
    unit : str
        ``"N"``, ``"V"`` or empty.
    step : float
        The sampling interval in s, the middle one of all.
    quantum : float
        The step of the converter in `unit`; 0 where none is seen.
    notes : tuple of str
        What is odd, a sentence each.
    """

    times: Array
    values: Array
    unit: str
    step: float
    quantum: float
    notes: tuple[str, ...]


def read_record(data: Dataset | Sequence[ArrayLike]) -> Record:
    """Return the first force or voltage of a record, cleaned.

    Parameters
    ----------
    data : xarray.Dataset or (array_like, array_like)
        A waveform as `read` gives it, or times in s and values.

    Returns
    -------
    Record

    Raises
    ------
    InvalidType
        If `data` is neither.
    InvalidValue
        If it holds no waveform, fewer than 8 numbers, or numbers whose lengths do not fit.

    Examples
    --------
    >>> read_record(([0, 1, 2, 3, 4, 5, 6, 7], [0, 0, 1, 2, 1, 0, 0, 0])).quantum
    1.0
    """
    times, values, unit, others = _channel(data)
    notes = [f"only {others[0]} was analysed, not {', '.join(others[1:])}"] if others[1:] else []
    known = np.isfinite(times) & np.isfinite(values)
    if known.sum() < _LEAST_SAMPLES:
        raise InvalidValue(
            f"data must hold at least {_LEAST_SAMPLES} samples of a waveform, "
            f"got {int(known.sum())}"
        )
    if not known.all():
        notes.append(f"{int((~known).sum())} of {known.size} samples are blank and were left out")
    times, values = times[known], values[known]
    if (np.diff(times) <= 0.0).any():
        times, first = np.unique(times, return_index=True)
        values = values[first]
        notes.append("the times do not ascend: samples were sorted, repeated times left out")
        if len(times) < _LEAST_SAMPLES:
            raise InvalidValue(f"data must hold at least {_LEAST_SAMPLES} times, got {len(times)}")
    steps = np.diff(times)
    step = float(np.median(steps))
    if np.abs(steps - step).max() > max(_UNEVEN * step, 1e-6 * step * len(times)) and known.all():
        notes.append(f"the time steps are uneven, from {steps.min():.3g} s to {steps.max():.3g} s")
    spiky = spikes(values)
    if spiky.any():
        notes.append(f"{counted(int(spiky.sum()), 'spike')} of one sample left out")
        times, values = times[~spiky], values[~spiky]
    return Record(times, values, unit, step, resolution(values), tuple(notes))


def _channel(data: Any) -> tuple[Array, Array, str, list[str]]:
    """Return times, values, unit and the names of all channels, that of the values first."""
    if not hasattr(data, "data_vars"):
        times, values = columns(data, ("time", "force"))
        return times, values, "", ["values"]
    names = [name for name in force_channels(data) if data[name].dims == ("time",)]
    if not names:
        got = ", ".join(map(str, data.data_vars)) or "nothing"
        raise InvalidValue(f"data must hold a force or a voltage over time, got {got}")
    names.sort(key=lambda name: name.startswith("voltage"))  # forces come first
    times, values = columns(data, ("time", names[0]))
    shown = [str(data[name].attrs.get("long_name", name)) for name in names]
    written = str(data[names[0]].attrs.get("units", ""))
    return times, values, (in_si(written) or (1.0, written))[1], shown


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
    share = np.diff(times) / checked(positive, "time_constant", time_constant, "seconds")
    changes = (values[1:] - np.exp(-share) * values[:-1]) * share / -np.expm1(-share)
    return np.cumsum(np.concatenate([values[:1], changes]))
