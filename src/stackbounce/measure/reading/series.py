"""The rows of a table in time: its runs, gaps and repeats."""

import numpy as np
from numpy.typing import NDArray

from stackbounce.errors import InvalidValue, shown
from stackbounce.measure.quantities import Array

__all__ = ["in_time", "step_of"]

_RUNS = 50
"""Runs below each other, at most: with more, the column does not hold times."""


def in_time(time: Array, run: object, *, gaps: bool) -> tuple[NDArray[np.intp] | slice, list[str]]:
    """Return the rows of one run, in which time never decreases, and what is unsure.

    Parameters
    ----------
    time : numpy.ndarray
        Times in s; rows where it is NaN are left out.
    run : object
        The run that is wanted, counted from 1, or None: the first.
    gaps : bool
        Whether missing rows are reported.

    Raises
    ------
    InvalidValue
        If times run backwards too often, or there is no such run.
    """
    known = np.isfinite(time)
    rows = slice(None) if known.all() else np.flatnonzero(known)  # a slice copies nothing
    own = time[rows]
    if not own.size:
        raise InvalidValue("time: there is none in any row")
    steps = np.diff(own)
    again = np.flatnonzero(steps < 0.0) + 1
    doubts = []
    if again.size >= _RUNS:
        raise InvalidValue(
            f"time runs backwards in {again.size} of {own.size} rows: "
            "names={…: 'time'} tells another column"
        )
    if again.size:
        at = 1 if run is None else _counted(run, again.size + 1)
        first, last = [0, *again, own.size][at - 1 : at + 1]
        rows = slice(first, last) if isinstance(rows, slice) else rows[first:last]
        own, steps = own[first:last], steps[first : last - 1]
        doubts.append(f"time starts again {again.size} times; run {at} of {again.size + 1} is read")
    elif run is not None:
        _counted(run, 1)
    repeated = int((steps == 0.0).sum())
    if repeated:
        doubts.append(f"{repeated} times are repeated: written with too few digits, perhaps")
    usual = float(np.median(steps)) if steps.size else 0.0
    if gaps and usual > 0.0:
        off = steps - usual
        regular = np.mean(np.abs(off, out=off) < 0.01 * usual) > 0.5
        wide = np.flatnonzero(steps > 1.5 * usual)
        if regular and wide.size:
            where = own[wide[0]]
            doubts.append(f"{wide.size} gaps in time, the first after {where:.6g} s")
    return rows, doubts


def step_of(time: Array) -> float:
    """Return the usual step of times, NaN of fewer than two."""
    return float(np.median(np.diff(time))) if time.size > 1 else float("nan")


def _counted(run: object, count: int) -> int:
    if not str(run).isascii() or not str(run).isdigit() or not 1 <= int(str(run)[:9]) <= count:
        raise InvalidValue(f"run must be one of the {count} that there are, got {shown(run)}")
    return int(str(run))
