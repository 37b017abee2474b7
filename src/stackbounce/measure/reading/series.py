"""The rows of a table in time: its runs, gaps and repeats, and times that were rounded."""

from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from stackbounce.errors import InvalidValue, shown
from stackbounce.measure.messages import Message, OptionHint, about_option
from stackbounce.measure.quantities import Array
from stackbounce.measure.reading.roles import Column
from stackbounce.measure.reading.rounding import even_times, rounding_of, spread

_RUNS = 50
"""Runs below each other, at most: with more, the column does not hold times."""

_ANOTHER = Message(
    OptionHint({"names": {2: "time"}}), " tells that it is another column, such as the second"
)


_Rows: TypeAlias = NDArray[np.intp] | slice


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
    rounded = rounding_of(own)
    even = even_times(own, rounded)
    repeated = int(np.count_nonzero(np.diff(own) == 0.0))
    if even is not None:
        step = factor * (own[-1] - own[0]) / (own.size - 1)
        digits = factor * float(rounded.steps(own[[0, -1]]).max())
        to = f"{digits:.2g} {unit}" + f" ({repeated} repeat)" * (repeated > 0)
        even_step = f"taken as even, with a step of {step:.6g} {unit}"
        return rows, factor * even, [*doubts, f"times are rounded to {to}: {even_step}"]
    if repeated:
        step = factor * float(np.median(rounded.steps(own)))
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
    if not usual > 0.0:
        return []
    off = steps - usual
    regular = np.mean(np.abs(off, out=off) < 0.01 * usual) > 0.5
    wide = np.flatnonzero(steps > 1.5 * usual)
    if not (regular and wide.size):
        return []
    return [f"{wide.size} gaps in time, the first after {own[wide[0]]:.6g} {unit}"]


def step_of(time: Array) -> float:
    """Return the step of times, their mean one if they have no gaps; NaN of fewer than two."""
    if time.size < 2:
        return float("nan")
    steps = np.diff(time)
    mean = float(time[-1] - time[0]) / steps.size
    return mean if steps.max() < 1.5 * mean else float(np.median(steps))


def _counted(run: object, count: int) -> int:
    if not str(run).isascii() or not str(run).isdigit() or not 1 <= int(str(run)[:9]) <= count:
        wrong = f" must be one of the {count} that there are, got {shown(run)}"
        raise InvalidValue(about_option("run", wrong))
    return int(str(run))
