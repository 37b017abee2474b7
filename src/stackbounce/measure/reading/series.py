"""The times of a table: what they count, its runs, gaps and repeats, and times that were rounded.

Digits tell to what steps times were rounded, whether they are even, and what they were.
"""

from collections.abc import Sequence
from dataclasses import replace
from datetime import UTC, datetime
from decimal import Decimal
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from stackbounce.errors import InvalidValue, shown
from stackbounce.measure.kind import Kind
from stackbounce.measure.messages import Message, OptionHint, about_option
from stackbounce.measure.quantities import Array
from stackbounce.measure.reading.roles import Column

_UNITS = {"s": (1.0, "seconds"), "ms": (1e-3, "milliseconds"), "µs": (1e-6, "microseconds"),
          "ns": (1e-9, "nanoseconds")}  # fmt: skip
_EPOCH = (631152000.0, 4102444800.0)  # s since 1970, from 1990 to 2100
_RUNS = 50  # runs below each other, at most: with more, the column does not hold times
_COUNTED = 2000  # numbers whose digits are counted: nearly none of them may end in zeros
_SINGLE_DIGITS = 8  # that a float of 32 bits does not have, but that programs write of it
_NINTH_DIGIT = 5.1e-9  # relative: how far nine digits may be off the float they were written of
_UNSEEN = 1e-3  # of a step: times that are that even are left as they are
_ODD = 0.3  # of a step, by which odd steps differ from it
_FEW_ODD = 3  # odd steps: fewer are gaps or repeats, not the pattern that rounding makes
_SLACK = 0.1  # of what rounding moves times, by which the fitted even ones may be off more than it

_ANOTHER = Message(OptionHint({"names": None}), " tells which other column holds times")


_Rows: TypeAlias = NDArray[np.intp] | slice


def without_counts(columns: Sequence[Column], values: Array) -> list[Column]:
    """Return columns, those called ``bounce`` or ``event`` that count rows being no times.

    Parameters
    ----------
    columns : sequence of Column
        What they are.
    values : numpy.ndarray, shape (rows, columns)
        Their numbers.
    """
    found = list(columns)
    for k, column in enumerate(found):
        if column.role == "knock_time" and not (column.unit or column.heading.unit or column.named):
            steps = np.diff(values[:, k][np.isfinite(values[:, k])])
            if steps.size and (steps == 1.0).all():
                found[k] = replace(column, role="")
    return found


def on_the_clock(
    kind: Kind, columns: Sequence[Column], values: Array
) -> tuple[list[Column], list[str]]:
    """Return columns with one column of times in the unit that its numbers tell, and doubts.

    Times since 1970 are made relative to the first, in place. Where no unit is told, steps that are
    longer than any of such a measurement tell that they are not in seconds.

    Parameters
    ----------
    kind : Kind
        What is measured; its `longest_step` is compared with the steps.
    columns : sequence of Column
        What they are.
    values : numpy.ndarray, shape (rows, columns)
        Their numbers, as in the file.
    """
    found = list(columns)
    needed = {role for roles in kind.columns for role in roles}
    clocks = needed & {"time", "knock_time"}
    places = [k for k, column in enumerate(found) if column.role in clocks]
    if not places:
        return found, []
    since = {k: _epoch(found[k], values[:, k]) for k in places}
    at = min(places, key=lambda k: since[k] != "")  # seconds since the start, if there are some
    for k in places:
        if since[k] and k != at:
            found[k] = replace(found[k], role="", unit="", named=found[k].named or "date")
    if since[at]:
        factor, words = _UNITS[since[at]]
        times = values[:, at]
        first = times[np.isfinite(times)][0]
        times -= first
        when = datetime.fromtimestamp(factor * first, UTC).strftime("%Y-%m-%d %H:%M:%S UTC")
        name = found[at].heading.name or found[at].variable
        found[at] = replace(found[at], factor=factor, unit="s")
        return found, [f"{name} counts {words} since 1970: taken from the first on, {when}"]
    found[at], doubts = _by_steps(kind, found[at], values[:, at])
    return found, doubts


def _epoch(column: Column, times: Array) -> str:
    """Return the unit of times since 1970, or nothing if they are none."""
    known = times[np.isfinite(times)]
    if not known.size:
        return ""
    for unit, (factor, _) in _UNITS.items():
        told = not column.unit or abs(column.factor / factor - 1.0) < 1e-9
        if told and all(_EPOCH[0] < factor * time < _EPOCH[1] for time in known[[0, -1]]):
            return unit
    return ""


def _by_steps(kind: Kind, column: Column, times: Array) -> tuple[Column, list[str]]:
    """Return a column of times, in the longest unit whose steps are not too long for the kind."""
    steps = np.abs(np.diff(times[np.isfinite(times)]))
    # rounded times that repeat are counted too
    step = (float(np.median(steps)) or float(np.mean(steps))) if steps.size else 0.0
    fitting = [unit for unit in _UNITS if _UNITS[unit][0] * step <= kind.longest_step]
    if column.unit or column.heading.unit or not fitting or fitting[0] == "s":
        return column, []
    name = column.heading.name or column.index + 1
    said = (
        f"no unit is told for {name}: taken as {fitting[0]}, as steps of {step:.4g} s are too long "
        f"for a file of {kind.name}; "
    )
    doubt = Message(said, OptionHint({"units": {name: "s"}}), " tells another")
    return replace(column, factor=_UNITS[fitting[0]][0], unit="s"), [doubt]


def in_time(
    time: Array, column: Column, run: object, *, gaps: bool
) -> tuple[_Rows, Array, list[str]]:
    """Return the rows of one run, in which time never decreases, their times in s, and doubts.

    Times that are even within their rounding become even. Those that repeat are spread over what
    they were rounded to, as no sample of a record is another's double.

    Parameters
    ----------
    time : numpy.ndarray
        Times as written in the file; rows where it is NaN are left out.
    column : Column
        Whose they are; its factor converts them.
    run : object
        The run that is wanted, counted from 1, or None: the first.
    gaps : bool
        Whether missing rows are reported.

    Raises
    ------
    InvalidValue
        If times run backwards too often or never change, or there is no such run.
    """
    known = np.isfinite(time)
    rows = slice(None) if known.all() else np.flatnonzero(known)  # a slice copies nothing
    own = time[rows]
    if not own.size:
        raise InvalidValue("time: there is none in any row")
    rows, own, doubts = _of_run(rows, own, run)
    factor, unit = column.factor, column.unit or "s"
    if own.size > 1 and own[0] == own[-1]:
        constant = f"time is {factor * own[0]:.6g} {unit} in all of {own.size} rows: "
        raise InvalidValue(Message(constant, _ANOTHER))
    rounded = rounding_steps(own)
    even = even_times(own, rounded)
    repeated = int(np.count_nonzero(np.diff(own) == 0.0))
    if even is not None:
        step = factor * (own[-1] - own[0]) / (own.size - 1)
        digits = factor * float(rounded[[0, -1]].max())
        to = f"{digits:.2g} {unit}" + f" ({repeated} repeat)" * (repeated > 0)
        even_step = f"taken as even, with a step of {step:.6g} {unit}"
        return rows, factor * even, [*doubts, f"times are rounded to {to}: {even_step}"]
    if repeated:
        step = factor * float(np.median(rounded))
        doubts.append(
            f"{repeated} times are repeated: spread over the {step:.2g} {unit} of their digits"
        )
        own = spread(own, rounded)
    own = own if factor == 1.0 else factor * own
    if gaps:
        doubts.extend(_gaps(own, unit))
    return rows, own, doubts


def _of_run(rows: _Rows, own: Array, run: object) -> tuple[_Rows, Array, list[str]]:
    """Return the rows and times of one of the runs below each other."""
    again = np.flatnonzero(np.diff(own) < 0.0) + 1
    if again.size >= _RUNS:
        back = f"time runs backwards in {again.size} of {own.size} rows: "
        raise InvalidValue(Message(back, _ANOTHER))
    if not again.size:
        if run is not None:
            _counted(run, 1)
        return rows, own, []
    at = 1 if run is None else _counted(run, again.size + 1)
    first, last = [0, *again.tolist(), own.size][at - 1 : at + 1]
    rows = slice(first, last) if isinstance(rows, slice) else rows[first:last]
    doubt = f"time starts again {again.size} times; run {at} of {again.size + 1} is read"
    return rows, own[first:last], [doubt]


def _gaps(own: Array, unit: str) -> list[str]:
    steps = np.diff(own)
    usual = float(np.median(steps)) if steps.size else 0.0
    regular = np.count_nonzero(np.abs(steps - usual) < 0.01 * usual) > 0.5 * steps.size
    wide = np.flatnonzero(steps > 1.5 * usual)
    if not (regular and wide.size):
        return []
    return [f"{wide.size} gaps in time, the first after {own[wide[0]]:.6g} {unit}"]


def _counted(run: object, count: int) -> int:
    if not str(run).isascii() or not str(run).isdigit() or not 1 <= int(str(run)[:9]) <= count:
        raise about_option("run", f" must be one of the {count} that there are, got {shown(run)}")
    return int(str(run))


def rounding_steps(values: Array) -> Array:
    """Return the distance of neighbouring numbers that could be written, at each finite value.

    The digits tell whether the numbers were rounded to decimals, to digits, or to a float of 32
    bits, of which programs write nine.

    Examples
    --------
    >>> rounding_steps(np.array([0.0025, 12.5678, 123.456])).tolist()
    [0.0001, 0.0001, 0.001]
    """
    some = values[:: max(1, len(values) // _COUNTED)]
    decimals, digits = -300, 1
    for value in some.tolist():
        if value:
            _, figures, exponent = Decimal(repr(value)).normalize().as_tuple()
            decimals = max(decimals, -int(exponent))
            digits = max(digits, len(figures))
    near = some.astype(np.float32).astype(np.float64)
    single = bool(np.all(np.abs(some - near) <= _NINTH_DIGIT * np.abs(some)))
    size = np.maximum(np.abs(values), 1e-300)
    steps = 10.0 ** (np.floor(np.log10(size) * (1.0 + 1e-15)) + 1 - digits)
    steps = np.maximum(steps, 10.0 ** float(-decimals))
    if single and digits > _SINGLE_DIGITS:
        steps += np.spacing(np.abs(values).astype(np.float32)).astype(np.float64)
    return np.asarray(steps)


def even_times(times: Array, steps: Array) -> Array | None:
    """Return even times that agree with all given ones within their rounding.

    Parameters
    ----------
    times, steps : ndarray
        (n,) as they are written, never decreasing, and what each was rounded to.

    Returns
    -------
    ndarray or None
        (n,); None where times are even as they are, or were not even before they were rounded.

    Examples
    --------
    >>> even_times(np.round(np.arange(100) / 30.0, 2), np.full(100, 0.01))[1:5].round(3)
    array([0.033, 0.067, 0.1  , 0.133])
    """
    count = len(times)
    step = (times[-1] - times[0]) / (count - 1) if count > 2 else 0.0
    if not step > 0.0:
        return None
    places = np.arange(count, dtype=np.float64)
    off = times[0] + step * places
    np.abs(np.subtract(times, off, out=off), out=off)
    half = np.maximum(0.5 * steps, _UNSEEN * step)
    if off.max() <= _UNSEEN * step or (off > 2.0 * half + half[-1] + half[0]).any():
        return None
    odd = np.abs(np.diff(times) - step) > _ODD * step
    if 0 < np.count_nonzero(odd) < _FEW_ODD:
        return None
    even = np.asarray(np.polyval(np.polyfit(places, times, 1, w=1.0 / half), places), np.float64)
    return even if (np.abs(times - even) <= (1.0 + _SLACK) * half).all() else None


def spread(times: Array, steps: Array) -> Array:
    """Return times in which those that repeat are spread over what they were rounded to.

    Parameters
    ----------
    times, steps : ndarray
        (n,) as they are written, never decreasing, and what each was rounded to.

    Examples
    --------
    >>> spread(np.array([0.0, 0.1, 0.1, 0.2]), np.full(4, 0.1)).round(3)
    array([0.   , 0.075, 0.125, 0.2  ])
    """
    _, first, of, counts = np.unique(times, True, True, True)
    place = (np.arange(len(times)) - first[of] + 0.5) / counts[of]
    return np.sort(times + steps * (place - 0.5))  # where fewer digits begin, steps overlap
