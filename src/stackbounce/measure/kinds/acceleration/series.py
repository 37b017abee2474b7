"""An acceleration's columns -> what the sensor felt -> flights with bounces between them."""

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from stackbounce.errors import InvalidType, InvalidValue
from stackbounce.measure.finding import no_gain
from stackbounce.measure.quantities import Array
from stackbounce.measure.samples import columns, runs

_FEWEST = 4  # samples of a flight
_CLIPPED = 3  # samples of exactly the largest value: the range of the sensor ended
_AXES = ("acceleration_x", "acceleration_y", "acceleration_z")
_LINEAR = ("without g", "linear", "user acceleration", "ohne g")
_FLOOR_FELT = 1.5  # of gravity: beyond it a phone that subtracts gravity feels the floor
_WANTED = "data must hold a free fall and a bounce, got "
# Set by hand on the records of `tests/synthetic/accelerometer.py`, and on swings, jumps and rides
# (`tests/motions.py`), which must be refused.
_FLYING = 0.5  # of gravity: below it, it flies
_NEAR = (0.35, 0.5)  # of gravity: below it is at least this share of a flight
_LINEAR_NEAR = (0.15, 0.8)  # the same, if gravity was subtracted
_SHORTEST = 0.06  # s: a flight of 4 mm
_LONGEST = 0.12  # s: a contact; longer ones are hands, legs, or a rest
_PULSE = 1.9  # of gravity: the least top of a pulse; a sensor may end at 2
_TOP_SAMPLES = 3  # of a pulse, which show its top
_MOST_BOUNCES = 100  # of a drop


class Record(NamedTuple):
    """What an accelerometer felt.

    Attributes
    ----------
    times, felt : ndarray
        (n,) in s and m/s²: about 0 in flight, g at rest.
    linear : bool
        Whether gravity was subtracted, so that `felt` is computed from what is left.
    notes : list of str
        What a reader should know, a sentence each.
    """

    times: Array
    felt: Array
    linear: bool
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
    linear = told and _is_linear(data)
    known = np.isfinite(times) & np.isfinite(size)
    times, size = times[known], size[known]
    if len(times) < 2 * _FEWEST or (np.diff(times) <= 0.0).any():
        raise InvalidValue(
            f"data must hold {2 * _FEWEST} samples or more at ascending times, got "
            f"{len(times)} samples"
        )
    if cut:
        notes.append("the sensor's range ended in a pulse: peaks are higher than they look")
    if linear:
        size = np.where(size > _FLOOR_FELT * gravity, size + gravity, np.abs(size - gravity))
        notes.append(
            "gravity was subtracted, in a direction that is badly known in flight: record the "
            "acceleration with g"
        )
    return Record(times, size, linear, notes)


def _is_linear(data: Any) -> bool:
    """Return whether gravity was subtracted, by what the file says."""
    texts = [str(data.attrs.get("format", ""))]
    texts += [str(column.attrs.get("long_name", "")) for column in data.data_vars.values()]
    return any(word in text.casefold() for text in texts for word in _LINEAR)


class Flight(NamedTuple):
    """The first and the last sample of a flight."""

    first: int
    last: int


def series_of(record: Record, gravity: float) -> list[Flight]:
    """Return the longest series of two or more flights with only bounces between them.

    Raises
    ------
    InvalidValue
        If there is none.
    """
    best: list[Flight] = []
    own: list[Flight] = []
    for flight in _flights(record, gravity):
        own = [*own, flight] if own and _bounces(record, own[-1], flight, gravity) else [flight]
        longer = len(own) > max(len(best), 1)
        # Without gravity in the record it must be seen that the series begins from rest.
        if longer and (not record.linear or is_held(record, own[0].first, gravity)):
            best = own
    if not best:
        raise InvalidValue(_WANTED + _what_is_seen(record, gravity))
    return best


def is_held(record: Record, first: int, gravity: float) -> bool:
    """Return whether the sensor was at rest before a flight: for long enough, near gravity."""
    times = record.times
    before = slice(int(np.searchsorted(times, times[first] - _LONGEST, side="right")), first)
    known = first > 0 and times[first] - times[0] >= _LONGEST
    return bool(known and 0.5 * gravity < np.median(record.felt[before]) < 1.5 * gravity)


def refuse_gain(restitutions: Sequence[Any], moments: Sequence[float]) -> None:
    """Refuse restitutions that are too many for one drop, or above 1."""
    count = len(restitutions)
    many = f"{count} bounces, more than one drop has ({_MOST_BOUNCES}): a machine?"
    if wrong := many if count > _MOST_BOUNCES else no_gain(restitutions, moments):
        raise InvalidValue(_WANTED + wrong)


def _what_is_seen(record: Record, gravity: float) -> str:
    """Return what a record without bounces shows."""
    found = _flights(record, gravity, whole=False)
    times = record.times
    if not found:
        level = "g, as it is in flight where g is subtracted," if record.linear else "0"
        least = (
            "" if record.linear else f" (the least acceleration is {record.felt.min():.3g} m/s^2)"
        )
        return (
            f"no flight: nowhere is the acceleration near {level} for {_SHORTEST} s on end{least}; "
            "what swings or rides does not bounce"
        )
    lasting = [float(times[last] - times[first]) for first, last in found]
    long = int(np.argmax(lasting))
    first, last = found[long]
    flight = f"of {lasting[long]:.2g} s at {times[first]:.3g} s"
    if len(found) == 1:
        ends = last == len(times) - 1
        after = "to the end of the record, which lacks the bounce" if ends else "and no bounce"
        return (
            f"one free flight {flight} (a fall from rest of "
            f"{0.5 * gravity * lasting[long] ** 2:.2g} m) {after}"
        )
    return (
        f"{len(found)} stretches like flights, the longest {flight}, but no two with a pulse "
        f"between them that is shorter than {_LONGEST} s and above {_PULSE:.0f} g"
        f"{' after a rest' if record.linear else ''}: what swings, jumps, rides or is thrown does "
        "not bounce"
    )


def _flights(record: Record, gravity: float, *, whole: bool = True) -> list[Flight]:
    """Return the free flights; if `whole`, without those with the first or the last sample."""
    times, felt = record.times, record.felt
    within, most = _LINEAR_NEAR if record.linear else _NEAR
    return [
        Flight(int(a), int(b))
        for a, b in zip(*runs(felt < _FLYING * gravity), strict=True)
        if b + 1 - a >= _FEWEST
        and times[b] - times[a] >= _SHORTEST
        and not (whole and (a == 0 or b == len(times) - 1))
        and np.mean(felt[a : b + 1] < within * gravity) >= most
    ]


def _bounces(record: Record, before: Flight, after: Flight, gravity: float) -> bool:
    """Return whether what lies between two flights is a bounce: short and hard."""
    times, felt = record.times, record.felt
    if times[after.first] - times[before.last] >= _LONGEST:
        return False
    pulse = felt[before.last + 1 : after.first]
    return len(pulse) < _TOP_SAMPLES or bool(pulse.max() >= _PULSE * gravity)
