"""A table of what the balls of a stack did, with a column for each ball -> drops with data."""

import math
import os
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from stackbounce.errors import InvalidValue
from stackbounce.fitting.notes import describe_freedom
from stackbounce.fitting.rows import rows_of
from stackbounce.fitting.series.columns import UNITS, columns_of
from stackbounce.fitting.series.readings import headed, numbers_in, with_unit
from stackbounce.fitting.series.table import told_errors
from stackbounce.model import Drop
from stackbounce.model.catalogue import catalogue_ball, stack
from stackbounce.run.quantities import Array

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
    FileError, InvalidValue
        As `read_table`.

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
    name, rows = rows_of(path)
    head, body = headed(rows)
    columns = [column for column in columns_of(head) if column.role or column.ball]
    balls = {column.ball for column in columns if column.ball}
    if len(balls) < 2:
        return None
    try:
        return _drops(columns, body, told_errors(errors), _in_order(balls))
    except InvalidValue as error:
        raise type(error)(f"{name}: {error}") from error


def _in_order(balls: set[str]) -> list[str]:
    """Return the names of balls, the heaviest first."""
    return sorted(balls, key=lambda ball: -catalogue_ball(ball).ball.mass)


def _drops(
    columns: Sequence[Any], body: Sequence[Any], told: dict[str, float], balls: list[str]
) -> StackTable:
    numbers = numbers_in(
        [column for column in columns if column.role in UNITS or column.role == "error"], body
    )
    start = next((column for column in columns if column.role in _FALLS), None)
    if start is None:
        raise InvalidValue("no column is a drop height or an impact speed")
    gap = next((column for column in columns if column.role == "gap"), None)
    parts, notes = stack(balls), [f"The balls are stacked {' below '.join(balls)}."]
    falls = numbers[start.index].values
    gaps = numbers[gap.index].values if gap else np.full(len(falls), math.nan)
    drops: dict[str, Drop] = {}
    data: dict[str, dict[str, tuple[float, float]]] = {}
    measured = {column: numbers[column.index] for column in columns if column.ball}
    known = {
        column: _errors(column, own, told, np.stack([falls, gaps]), notes)
        for column, own in measured.items()
    }
    for k, (line, _) in enumerate(body):
        found = {
            f"{column.role}s.{balls.index(column.ball)}": (
                float(measured[column].values[k]),
                float(known[column][k]),
            )
            for column in sorted(measured, key=lambda column: balls.index(column.ball))
            if math.isfinite(measured[column].values[k])
        }
        if not found or not math.isfinite(falls[k]):
            notes.append(f"Row {line} has no {start.text!r} or no height of a ball: left out.")
            continue
        own_gaps = parts.gaps if math.isnan(gaps[k]) else [float(gaps[k])] * len(parts.gaps)
        try:
            fall: Any = {_FALLS[start.role]: float(falls[k])}
            drops[f"row_{line}"] = Drop(parts.balls, parts.contacts, own_gaps, **fall)
        except InvalidValue as error:
            raise InvalidValue(f"row {line}: {error}") from error
        data[f"row_{line}"] = found
    return StackTable(drops, data, tuple(notes))


def _errors(column: Any, own: Any, told: dict[str, float], at: Array, notes: list[str]) -> Array:
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
    estimate = 0.5 * own.digit
    why = "half of the step in which they were written"
    if freedom and (scatter := math.sqrt(float(np.sum(np.square(apart))) / freedom)) > estimate:
        why = f"the scatter of repeated drops, with {describe_freedom(freedom)}"
        estimate = scatter
    notes.append(
        f"The error of {column.text!r} is {why}, {with_unit(estimate, unit)}; --error tells "
        "another."
    )
    return np.where(np.isnan(errors), estimate, errors)
