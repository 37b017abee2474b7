"""What a column of times counts: which one is taken, since when, and in which unit."""

from collections.abc import Sequence
from dataclasses import replace
from datetime import UTC, datetime

import numpy as np

from stackbounce.measure.kind import Kind
from stackbounce.measure.messages import Message, OptionHint
from stackbounce.measure.quantities import Array
from stackbounce.measure.reading.roles import Column

_UNITS = {"s": (1.0, "seconds"), "ms": (1e-3, "milliseconds"), "µs": (1e-6, "microseconds"),
          "ns": (1e-9, "nanoseconds")}  # fmt: skip
_EPOCH = (631152000.0, 4102444800.0)  # s since 1970, from 1990 to 2100
_LONGEST = 3600.0  # s: steps of times since 1970, which may be those of a slow sensor
_SHORTEST = 1e-9  # s: no step is shorter


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
    elapsed = [k for k in places if not since[k]]
    at = (elapsed or places)[0]
    for k in places if elapsed else ():
        if since[k]:  # seconds since the start stand beside it
            found[k] = replace(found[k], role="", unit="", named=found[k].named or "date")
    if since[at]:
        factor, words = _UNITS[since[at]]
        found[at], doubt = _relative(found[at], values[:, at], factor, words)
        return found, [doubt]
    found[at], doubts = _by_steps(kind, found[at], values[:, at])
    return found, doubts


def _epoch(column: Column, times: Array) -> str:
    """Return the unit of times since 1970, or nothing if they are none."""
    known = times[np.isfinite(times)]
    if not known.size:
        return ""
    first, last, step = float(known[0]), float(known[-1]), _step(known)
    for unit, (factor, _) in _UNITS.items():
        told = not column.unit or abs(column.factor / factor - 1.0) < 1e-9
        within = all(_EPOCH[0] < factor * time < _EPOCH[1] for time in (first, last))
        if told and within and factor * step <= _LONGEST:
            return unit
    return ""


def _relative(column: Column, times: Array, factor: float, words: str) -> tuple[Column, str]:
    first = float(times[np.isfinite(times)][0])
    times -= first
    when = datetime.fromtimestamp(factor * first, UTC).strftime("%Y-%m-%d %H:%M:%S UTC")
    name = column.heading.name or column.variable
    doubt = f"{name} counts {words} since 1970: taken from the first on, {when}"
    return replace(column, factor=factor, unit="s"), doubt


def _by_steps(kind: Kind, column: Column, times: Array) -> tuple[Column, list[str]]:
    """Return a column of times, in the longest unit whose steps are not too long for the kind."""
    step = _step(times[np.isfinite(times)])
    if column.unit or column.heading.unit or not kind.longest_step < step < 1e300:
        return column, []
    fit = ((unit, factor) for unit, (factor, _) in _UNITS.items())
    unit, factor = next(
        ((unit, factor) for unit, factor in fit if factor * step <= kind.longest_step), ("s", 1.0)
    )
    if unit == "s" or factor * step < _SHORTEST:
        return column, []
    name = column.heading.name or str(column.index + 1)
    doubt = Message(
        f"no unit is told for {name}: taken as {unit}, as steps of {step:.4g} s are too long for "
        f"a file of {kind.name}; ",
        OptionHint({"units": {name if column.heading.name else column.index + 1: "s"}}),
        " tells another",
    )
    return replace(column, factor=factor, unit="s"), [doubt]


def _step(times: Array) -> float:
    """Return the usual step of times: rounded ones that repeat are counted too."""
    steps = np.abs(np.diff(times))
    usual = float(np.median(steps)) if steps.size else 0.0
    return usual or (float(np.mean(steps)) if steps.size else 0.0)
