"""A table of what the balls of a stack did, with a column for each ball -> drops with data."""

import math
import os
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from stackbounce.errors import FileError, InvalidValue, counted, placed
from stackbounce.fitting.rows import Row, rows_of
from stackbounce.fitting.series.columns import UNITS, Column, check_balls, columns_of
from stackbounce.fitting.series.readings import Numbers, assumed_error, headed, numbers_in
from stackbounce.fitting.series.table import told_errors
from stackbounce.fitting.tables import drop_of
from stackbounce.model import Drop
from stackbounce.model.catalogue import catalogue_ball, stacked
from stackbounce.run.quantities import Array
from stackbounce.units import handy_text

_FALLS = {"drop_height": "height", "height": "height", "impact_speed": "impact_speed"}
_SAME = 6  # digits in which the numbers of repeated drops are equal


class StackTable(NamedTuple):
    """The drops of a stack by name, what was measured of each as `fit` takes it, and notes."""

    drops: dict[str, Drop]
    data: dict[str, dict[str, tuple[float, float]]]
    notes: tuple[str, ...]


def read_stack(path: str | os.PathLike[str], errors: Sequence[str] = ()) -> StackTable | None:
    r"""Return the drops of a table with a column for each ball of a stack; None if it has none.

    Parameters
    ----------
    path : str or path-like
        A table as `read_table` reads it. A column has the drop height or the impact speed, maybe
        one the gap; others name a ball of the catalogue and have its height after the bounce, or
        its rebound ratio, ``tennis v/v0``. The heavier ball is the lower one.
    errors : sequence of str, optional
        As `read_table` takes them. Where none is told, the scatter of repeated drops tells it, or
        the step in which the numbers were written.

    Returns
    -------
    StackTable or None

    Raises
    ------
    InvalidValue
        As `read_table`, if the columns are those of a stack.

    Examples
    --------
    >>> path = getfixture("tmp_path") / "stack.csv"
    >>> _ = path.write_text("height (cm);tennis (cm);basketball (cm)\n63,5;108;4\n100;171;6\n")
    >>> found = read_stack(path, ["1 cm"])
    >>> [ball.name for ball in found.drops["row_2"].balls]
    ['basketball', 'tennis']
    >>> found.data["row_3"]
    {'rebound_heights.0': (0.06, 0.01), 'rebound_heights.1': (1.71, 0.01)}
    """
    try:
        name, rows = rows_of(path)
        head, body = headed(rows)
    except (FileError, InvalidValue):  # `read_table` says why
        return None
    used = (*_FALLS, "gap", "error", "rebound_height", "rebound_ratio")
    known = columns_of(head)
    columns = [column for column in known if column.role in used]
    named = {
        column.ball: catalogue_ball(column.ball).ball.mass for column in columns if column.ball
    }
    if len(named) < 2:
        return None
    balls = sorted(named, key=lambda ball: -named[ball])
    with placed(f"{name}: "):
        check_balls(known)
        return _drops(columns, body, told_errors(errors), balls)


def _drops(
    columns: Sequence[Column], body: Sequence[Row], told: dict[str, float], balls: list[str]
) -> StackTable:
    """Return the drops of a table whose columns are known."""
    notes = [f"The balls are stacked {' below '.join(balls)}."]
    numbers, parts = numbers_in(columns, body, notes), stacked(balls)
    base = Drop(parts.balls, parts.contacts, parts.gaps, height=1.0)
    start = next((column for column in columns if column.role in _FALLS), None)
    if start is None:
        raise InvalidValue("no column is a drop height or an impact speed")
    paths = {start.index: [_FALLS[start.role]]}
    paths |= {
        c.index: [f"gaps.{i}" for i in range(len(balls) - 1)] for c in columns if c.role == "gap"
    }
    places = np.stack([numbers[index].values for index in paths])
    measured = sorted((c for c in columns if c.ball), key=lambda c: balls.index(c.ball))
    heights = start.role == "drop_height" and all(c.role == "rebound_height" for c in measured)
    if heights and not any((numbers[c.index].values >= places[0]).any() for c in measured):
        notes[0] += " Were they dropped alone, give each its own rows, and a column 'ball'."
    errors = {c.index: _errors(c, numbers[c.index], told, places, notes) for c in measured}
    drops: dict[str, Drop] = {}
    data: dict[str, dict[str, tuple[float, float]]] = {}
    for k, (line, _) in enumerate(body):
        found = {
            f"{c.role}s.{balls.index(c.ball)}": (
                float(numbers[c.index].values[k]),
                float(errors[c.index][k]),
            )
            for c in measured
            if math.isfinite(numbers[c.index].values[k])
        }
        if not found or not math.isfinite(places[0, k]):
            notes.append(f"Row {line} has no {start.text!r} or no height of a ball: left out.")
            continue
        values = {
            path: float(place)
            for names, place in zip(paths.values(), places[:, k], strict=True)
            for path in names
            if math.isfinite(place)
        }
        drops[f"row_{line}"], data[f"row_{line}"] = drop_of(base, values, line), found
    return StackTable(drops, data, tuple(notes))


def _errors(
    column: Column, own: Numbers, told: dict[str, float], at: Array, notes: list[str]
) -> Array:
    """Return the error of each number of a column: its own, one that is told, or an estimate."""
    errors = np.where(
        np.isnan(own.errors), told.get(column.role, told.get("", math.nan)), own.errors
    )
    if not np.isnan(errors[np.isfinite(own.values)]).any():
        return errors
    groups: dict[tuple[str, ...], list[float]] = {}
    for place, value in zip(at.T, own.values, strict=True):
        if math.isfinite(value):
            groups.setdefault(tuple(f"{number:.{_SAME}g}" for number in place), []).append(value)
    apart = [value - np.mean(group) for group in groups.values() for value in group]
    freedom, unit = len(apart) - len(groups), UNITS[column.role]
    estimate, why = assumed_error(own.values, own.digit)
    if freedom and (scatter := math.sqrt(float(np.sum(np.square(apart))) / freedom)) > estimate:
        why = f"the scatter of repeated drops, with {counted(freedom, 'degree of freedom')}"
        estimate = scatter
    error = handy_text(estimate, unit, 3)
    notes.append(f"The error of {column.text!r} is {why}, {error}, unless another is given.")
    return np.where(np.isnan(errors), estimate, errors)
