"""A force record before anything is looked for in it: cleaned, with what is odd about it said."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from stackbounce.errors import InvalidType, InvalidValue, shown

if TYPE_CHECKING:
    import xarray as xr

__all__ = ["Array", "Record", "read_record"]

Array = NDArray[np.float64]

_FEWEST = 8  # samples of a record
_UNEVEN = 0.01  # of a step
_SPIKE = 12.0  # noise levels of a second difference
_STEPS = 4096  # distinct values, beyond which no steps of a converter are looked for
_NAMES = ("force", "voltage")
_PAIR = 2


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


def read_record(data: "xr.Dataset | Sequence[ArrayLike]") -> Record:
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
    times, values, unit, others = _columns(data)
    notes = [f"only {others[0]} was analysed, not {', '.join(others[1:])}"] if others[1:] else []
    known = np.isfinite(times) & np.isfinite(values)
    if known.sum() < _FEWEST:
        raise InvalidValue(
            f"data must hold at least {_FEWEST} samples of a waveform, got {int(known.sum())}"
        )
    if not known.all():
        notes.append(f"{int((~known).sum())} of {known.size} samples are blank and were left out")
    times, values = times[known], values[known]
    if (np.diff(times) <= 0.0).any():
        times, first = np.unique(times, return_index=True)
        values = values[first]
        notes.append("the times do not ascend: samples were sorted, repeated times left out")
        if len(times) < _FEWEST:
            raise InvalidValue(f"data must hold at least {_FEWEST} times, got {len(times)}")
    steps = np.diff(times)
    step = float(np.median(steps))
    if np.abs(steps - step).max() > max(_UNEVEN * step, 1e-6 * step * len(times)) and known.all():
        notes.append(f"the time steps are uneven, from {steps.min():.3g} s to {steps.max():.3g} s")
    spiky = _spikes(values)
    if spiky.any():
        notes.append(f"{_counted(int(spiky.sum()), 'spike')} of one sample left out")
        times, values = times[~spiky], values[~spiky]
    return Record(times, values, unit, step, _quantum(values), tuple(notes))


def _columns(data: Any) -> tuple[Array, Array, str, list[str]]:
    """Return times, values, unit and the names of all channels, that of the values first."""
    if isinstance(data, (tuple, list)):
        if len(data) != _PAIR:
            raise InvalidValue(f"data must be times and values, got {len(data)} columns")
        times, values = (_numbers(one) for one in data)
        unit, names = "", ["values"]
    else:
        if not hasattr(data, "data_vars"):
            raise InvalidType(
                f"data must be a Dataset from read, or times and values, got {shown(data)}"
            )
        names = [
            str(name)
            for start in _NAMES
            for name in data.data_vars
            if str(name).split("_")[0] == start and data[name].dims == ("time",)
        ]
        if not names:
            got = ", ".join(map(str, data.data_vars)) or "nothing"
            raise InvalidValue(f"data must hold a force or a voltage over time, got {got}")
        times, values = _numbers(data["time"]), _numbers(data[names[0]])
        unit = str(data[names[0]].attrs.get("units", ""))
    if times.shape != values.shape or times.ndim != 1:
        raise InvalidValue(
            f"data must have a value for each time, got shapes {times.shape} and {values.shape}"
        )
    return times, values, unit, names


def _numbers(column: Any) -> Array:
    try:
        return np.asarray(column, dtype=float)
    except (TypeError, ValueError) as error:
        raise InvalidType(f"data must hold numbers, got {shown(column)}") from error


def _spikes(values: Array) -> NDArray[np.bool_]:
    """Tell which samples stand alone: far off both neighbours, which agree with their own.

    A spike makes second differences of 1, -2 and 1 times its height, and nothing else does.
    """
    found = np.zeros(len(values), dtype=bool)
    bend = np.diff(values, 2)
    quiet = float(np.median(np.abs(bend))) / 0.6745
    scale = max(quiet, 1e-9 * float(np.ptp(values)))
    before, here, after = bend[:-2], bend[1:-1], bend[2:]
    high = np.abs(here) > _SPIKE * scale
    like = (np.abs(before + 0.5 * here) < 0.15 * np.abs(here)) & (
        np.abs(after + 0.5 * here) < 0.15 * np.abs(here)
    )
    found[2:-2] = high & like
    return found


def _quantum(values: Array) -> float:
    """Return the step of the converter: the distance of neighbouring values if they have one."""
    distinct = np.unique(values)
    if not 1 < len(distinct) <= min(_STEPS, len(values) // 2):
        return 0.0
    gaps = np.diff(distinct)
    gaps = gaps[gaps > 1e-9 * np.ptp(distinct)]
    least = float(np.quantile(gaps, 0.05))
    multiples = gaps / least
    even = np.abs(multiples - np.round(multiples)) < 0.1 * np.maximum(multiples, 1.0) ** 0.5
    return least if even.mean() > 0.9 else 0.0


def _counted(count: int, what: str) -> str:
    """Return a count in words.

    Examples
    --------
    >>> _counted(1, "spike"), _counted(3, "peak")
    ('1 spike', '3 peaks')
    """
    return f"{count} {what}" if count == 1 else f"{count} {what}s"
