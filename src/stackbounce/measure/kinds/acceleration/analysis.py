"""An accelerometer that fell and bounced -> flights, restitution of each bounce, drop height."""

import math
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np

from stackbounce.errors import InvalidType, InvalidValue, positive
from stackbounce.measure.kinds.acceleration.result import Accelerometer
from stackbounce.measure.quantities import Array
from stackbounce.measure.samples import columns, runs
from stackbounce.model.drop import STANDARD_GRAVITY

__all__ = ["accelerometer"]

_HALF = 0.5  # of gravity: below it, it flies
_SHORTEST = 0.06  # s: a flight of 4 mm
_FEWEST = 4  # samples of a flight
_TOLD = 6  # samples of a contact whose duration can be told
_LONGEST = 0.12  # s: a contact; longer ones are hands, or a rest
_EQUAL = 3  # samples that have exactly the largest value are cut off
_AXES = ("acceleration_x", "acceleration_y", "acceleration_z")


def accelerometer(data: Any, *, gravity: float = STANDARD_GRAVITY) -> Accelerometer:
    """Analyse the fall and the bounces of an accelerometer.

    An accelerometer reads zero in free flight, g at rest, and a short high pulse in a bounce. The
    flights are found, and the speeds follow from their durations: the impact speed is ``g t`` after
    a fall of duration t, and ``g T/2`` at both ends of a flight of duration T.

    Parameters
    ----------
    data : Dataset or (times, values)
        As `stackbounce.read` gives it, or times in s and sizes of the acceleration in m/s², with
        gravity in it.
    gravity : float, optional
        In m/s², above 0.

    Returns
    -------
    Accelerometer

    Raises
    ------
    InvalidValue
        If no flights with bounces are found, or a number is out of its range.
    InvalidType
        If `data` holds no acceleration.

    Notes
    -----
    A flight begins and ends at an unknown time between two samples, which gives its error. The
    contact time of a pulse of fewer than six samples is not given, and its peak is uncertain. A
    sensor that averages over a time makes pulses longer, and flights shorter, by about this time.
    The longest series of flights with short pulses between them is used. Its first flight is a fall
    from rest if the sensor was at rest before it. Air and spin are neglected.

    Examples
    --------
    >>> import numpy as np
    >>> times = np.arange(0.0, 1.5, 0.0025)
    >>> values = np.where((times > 0.3) & (times < 1.3), 0.0, 9.81)
    >>> values[(times > 0.7) & (times < 0.705)] = 120.0  # after a fall of 0.4 s
    >>> found = accelerometer((times, values))
    >>> print(f"{found.drop_height:.1uS} m, e = {found.mean:.1uS}")
    0.775(4) m, e = 0.748(2)
    """
    g = positive("gravity", gravity, "m/s^2")
    times, values, notes = _sizes(data, g)
    series = _series(times, _flying(times, values, g))
    if not series:
        raise InvalidValue(
            "data must hold a free fall and a bounce, flights of 0.06 s or more with a short pulse "
            f"between them, got none: the least acceleration is {float(values.min()):.3g} m/s^2 "
            "(in flight it should be about 0)"
        )
    starts = [_edge(times, one.first) for one in series]
    ends = [_edge(times, one.last + 1) for one in series]
    lasting = [end - start for start, end in zip(starts, ends, strict=True)]
    held = _held(times, values, series[0].first, g)
    fall, flights = (lasting[0], lasting[1:]) if held else (None, lasting)
    speeds = [g * lasting[0]] * held + [g * one / 2.0 for one in flights]  # at the end of each
    before, after = speeds[:-1], speeds[1:]
    kept = [out / into for into, out in zip(before, after, strict=True)]
    pulses = list(pairwise(series))
    counts = [other.first - one.last - 1 for one, other in pulses]
    tops = [values[one.last + 1 : other.first] for one, other in pulses]
    notes += _notes(times, counts, kept, held)
    return Accelerometer(
        fall=fall,
        flights=tuple(flights),
        drop_height=None if fall is None else g * fall**2 / 2.0,
        apex_heights=tuple(g * one**2 / 8.0 for one in flights),
        impact_speeds=tuple(before),
        restitutions=tuple(kept),
        mean=(after[-1] / before[0]) ** (1.0 / len(kept)) if kept else None,
        contact_times=tuple(
            starts[k + 1] - ends[k] if count >= _TOLD else None for k, count in enumerate(counts)
        ),
        peaks=tuple(float(top.max()) for top in tops),
        notes=tuple(notes),
        times=times,
        values=values,
        spans=tuple((float(times[one.first]), float(times[one.last])) for one in series),
    )


class _Flight(NamedTuple):
    """The first and the last sample of a flight."""

    first: int
    last: int


def _sizes(data: Any, gravity: float) -> tuple[Array, Array, list[str]]:
    """Return times, the magnitude of the acceleration including gravity, and notes."""
    notes: list[str] = []
    if not hasattr(data, "data_vars"):
        times, values = columns(data, ("time", "acceleration"))
    else:
        names = [str(name) for name in data.data_vars if str(name).startswith("acceleration")]
        if not names:
            raise InvalidType(
                "data must hold an acceleration over time, got "
                f"{', '.join(map(str, data.data_vars)) or 'nothing'}"
            )
        times, *axes = columns(data, ("time", *names))
        if all(axis in names for axis in _AXES):
            values = np.sqrt(sum(axes[names.index(axis)] ** 2 for axis in _AXES))
        else:
            values = np.abs(axes[-1])
            if names[-1] != "acceleration_absolute":
                notes.append("only one axis is there: flights are where it shows nothing")
        sizes = [np.abs(one) for one in axes if one.size]
        if any(int((one == np.nanmax(one)).sum()) >= _EQUAL for one in sizes):
            notes.append("the sensor's range ended in a pulse: peaks are higher than they look")
        if "without g" in data.attrs.get("format", ""):
            values = np.abs(values - gravity)
            notes.append(
                "the phone has subtracted gravity, whose direction it estimates badly in flight: "
                "record the acceleration with g"
            )
    known = np.isfinite(times) & np.isfinite(values)
    if known.sum() < 2 * _FEWEST or (np.diff(times[known]) <= 0.0).any():
        raise InvalidValue(
            f"data must hold {2 * _FEWEST} samples or more at ascending times, got "
            f"{int(known.sum())} samples"
        )
    return times[known], values[known], notes


def _flying(times: Array, values: Array, gravity: float) -> list[_Flight]:
    """Return the free flights, without those that contain the first or the last sample."""
    return [
        _Flight(int(a), int(b))
        for a, b in zip(*runs(values < _HALF * gravity), strict=True)
        if 0 < a <= b + 1 - _FEWEST and b < len(times) - 1 and times[b] - times[a] >= _SHORTEST
    ]


def _series(times: Array, flights: list[_Flight]) -> list[_Flight]:
    """Return the longest series of two or more flights with only bounces between them."""
    best: list[_Flight] = []
    own: list[_Flight] = []
    for one in flights:
        short = own and times[one.first] - times[own[-1].last] < _LONGEST
        own = [*own, one] if short else [one]
        best = own if len(own) > len(best) else best
    return best if len(best) > 1 else []


def _edge(times: Array, k: int) -> Any:
    """Return a time that is uniformly distributed between samples k - 1 and k."""
    from uncertainties import ufloat

    step = float(times[k] - times[k - 1])
    return ufloat(0.5 * float(times[k] + times[k - 1]), step / math.sqrt(12.0))


def _held(times: Array, values: Array, first: int, gravity: float) -> bool:
    """Tell whether the sensor was at rest before a flight: for long enough, near gravity."""
    before = (times > times[first] - _LONGEST) & (times < times[first])
    known = times[first] - times[0] >= _LONGEST
    return bool(known and 0.5 * gravity < np.median(values[before]) < 1.5 * gravity)


def _notes(times: Array, counts: list[int], kept: list[Any], held: bool) -> list[str]:
    step = float(np.median(np.diff(times)))
    notes = []
    if min(counts) < _TOLD:
        notes.append(
            f"it was sampled every {1e3 * step:.2g} ms: contact times and peaks of bounces with "
            f"fewer than {_TOLD} samples, {min(counts)} here, cannot be told from it"
        )
    if held:
        notes.append("the drop height supposes a fall from rest: a hand that follows adds to it")
    else:
        notes.append("what came before the first flight is not in the record: no drop height")
    if any(one.nominal_value > 1.0 + 2.0 * one.std_dev for one in kept):
        notes.append(
            "a restitution above 1: a bounce fell between two samples before it, or it was thrown"
        )
    return notes
