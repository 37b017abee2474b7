"""The rows of a table of bounces -> the readings in it, a row each."""

import math
import re
import warnings
from collections.abc import Sequence
from dataclasses import replace
from decimal import Decimal
from itertools import pairwise, zip_longest
from typing import Any, NamedTuple

import numpy as np

from stackbounce.errors import InvalidValue
from stackbounce.fitting.rows import Row, decimal_comma
from stackbounce.fitting.series.columns import UNITS, WORDS, Column, check_balls, columns_of
from stackbounce.library_types import DataFrame
from stackbounce.measure.quantities import quantity_with_error
from stackbounce.measure.reading.roles import is_unit
from stackbounce.measure.reading.text import MISSING
from stackbounce.run.quantities import Array
from stackbounce.units import handy_text, quantity

STARTS = ("drop_height", "impact_speed")  # roles of what was before a bounce
MEASURED = ("rebound_height", "rebound_speed", "restitution")  # of what was measured after it

_RIGHT = "'drop height (cm)' and 'rebound height (cm)', or 'v (m/s)' and 'e'"
_NUMBER = re.compile(r"[-+]?[\d.,]*\d(?:[eE][-+]?\d+)?\s*([^\W\d_]{1,3}|%|±.*|\+/-.*|\(.*)?")
_WITH_UNIT = re.compile(r"[\d.,eE+-]+\s*([^\W\d_]{1,3}|%)")
_DIGITS = re.compile(r"\d*\.?\d+(?:[eE][-+]?\d+)?")
_SIZES = ((500.0, "mm"), (5.0, "cm"), (0.0, "m"))  # of the largest height, where no unit is told
_THOUSANDS = re.compile(r"[1-9]\d{0,2}\.\d{3}")
_WHOLE = re.compile(r"\d{1,3}(\.\d{3})?")  # a number of mm, read as one with thousands
_FINE = 1e-5  # of the largest number: nobody reads in such steps, and what has them was computed
_ENOUGH = 5  # numbers that all end in 0, or in 0 and 5, were not read more finely
_SUCCESSIVE = 0.5  # of the logarithm of the first ratio of heights: bounces in turn fall by more


def readings_of(rows: Sequence[Row]) -> tuple[DataFrame, str, list[str]]:
    """Return all readings, a row each, what was read (one of `MEASURED`), and notes.

    The columns are `line`, `group` and `drop`; the role of what was before the first bounce with
    its value `start`; `number`, that of the bounce; `value`, and the errors `start_error` and
    `error`, NaN where none is known; `digit`, the step in which it was read.
    """
    import pandas as pd

    notes: list[str] = []
    head, body = headed(rows)
    sums = [line for line, cells in body if any(map(WORDS["summary"].fullmatch, cells))]
    notes += [f"Row {line} has means or sums: left out." for line in sums]
    last = max(k for k, (_, cells) in enumerate(body) if any(map(_NUMBER.fullmatch, cells)))
    below = [line for line, _ in body[last + 1 :]]
    notes += [f"Row {line} has no number: left out." for line in below if line not in sums]
    body = [row for row in body[: last + 1] if row[0] not in sums]
    _carry_down(columns_of(head), body, notes)
    columns, words = _resolved(columns_of(head), body, notes)
    numbers = numbers_in(columns, body, notes)
    groups = [", ".join(filter(None, (_cell(cells, k) for k in words))) for _, cells in body]
    found, measured = _by_drop(columns, numbers, [line for line, _ in body], groups, notes)
    if not found:
        raise InvalidValue("it has no row with all that is needed: " + _listed(columns))
    readings = pd.DataFrame(found)
    _check(readings, measured)
    return readings, measured, notes


def headed(rows: Sequence[Row]) -> tuple[list[str], Sequence[Row]]:
    """Return the headings and the rows below them; what stands above is a title."""
    counts = [sum(bool(_NUMBER.fullmatch(cell)) for cell in cells) for _, cells in rows]
    first = next((k for k, count in enumerate(counts) if count > 1), None)
    if not first:
        what = "no row with two numbers" if first is None else "no heading above its numbers"
        raise InvalidValue(f"it has {what}: columns must have names, such as {_RIGHT}")
    roles = [[c.role for c in columns_of([*filter(None, cells)])] for _, cells in rows[:first]]
    at = next((k for k, known in enumerate(roles) if sum(map(bool, known)) > 1), first - 1)
    head, units = rows[at][1], rows[at + 1][1]
    if at + 1 < first and all(is_unit(cell) for cell in units if cell):
        pairs = zip_longest(head, units, fillvalue="")
        head = [f"{name} ({unit.strip('()[] ')})" if unit else name for name, unit in pairs]
        at += 1
    for line, cells in rows[at + 1 :]:
        if any(_NUMBER.fullmatch(cell) for cell in cells[len(head) :]):
            raise InvalidValue(
                f"row {line} has {len(cells)} cells below {len(head)} headings: each column needs "
                "one, and numbers with decimal commas need semicolons between them"
            )
    return head, rows[at + 1 :]


def _carry_down(columns: Sequence[Column], body: Sequence[Row], notes: list[str]) -> None:
    """Write the name of a group also into the empty cells below it, which a sheet may join."""
    for column in (column for column in columns if column.role == "group"):
        for (_, above), (_, cells) in pairwise(body):
            if _cell(above, column.index) and cells[column.index : column.index + 1] == [""]:
                cells[column.index] = _cell(above, column.index)
                notes.append(f"Empty cells of {column.text!r} have the name above them.")


def _cell(cells: Sequence[str], index: int) -> str:
    """Return the text of a cell; empty where nothing is known."""
    text = cells[index] if index < len(cells) else ""
    return "" if text.casefold() in MISSING else text


def _resolved(
    columns: Sequence[Column], body: Sequence[Row], notes: list[str]
) -> tuple[list[Column], list[int]]:
    """Return the columns that are used, and the places of those whose words are groups."""
    check_balls(columns)
    used: list[Column] = []
    words: list[int] = []
    for column in columns:
        cells = list(filter(None, (_cell(row, column.index) for _, row in body)))
        count = sum(bool(_NUMBER.fullmatch(cell)) for cell in cells)
        of_numbers = column.role not in ("", "group", "reading")
        numeric = 2 * count > len(cells) or (count > 0 and of_numbers)
        if column.role == "group" or (cells and not numeric and column.role != "error"):
            differ = len(set(cells)) == len(cells) > 2 and column.role != "group"
            if differ or WORDS["remark"].fullmatch(column.text.casefold()):
                notes.append(f"The words of column {column.text!r} are not used: no groups.")
            else:
                words.append(column.index)
        elif column.role in ("mass", "diameter"):
            if len(cells) >= 2 * len(set(cells)) > 2:  # they tell balls apart
                words.append(column.index)
            else:
                notes.append(f"Column {column.text!r} is not used: an option tells it.")
        elif column.role not in ("", "reading") and column.number >= 0:
            used.append(column)
        elif cells and not column.role:
            notes.append(f"Column {column.text!r} is not used: its name tells nothing known here.")
    _check_numbers(used)
    started = any(column.role in STARTS for column in used)
    start = next((column.text for column in used if column.role == "height" and not started), "")
    for k, column in enumerate(used):
        generic = column.role == "height" and (not started or column.text == start)
        if generic or (column.role == "bounces" and not column.number):
            used[k] = replace(column, role="drop_height")
        elif column.role in ("height", "bounces"):
            used[k] = replace(column, role="rebound_height")
        elif column.role == "readings":
            of_heights = any(other.role == "drop_height" for other in used)
            role = "rebound_height" if of_heights else "restitution"
            used[k] = replace(column, role=role, number=0)
        started = started or used[k].role == "drop_height"
    return used, words


def _check_numbers(columns: Sequence[Column]) -> None:
    """Refuse two readings, or two bounces, of one number: they are not of the same ball."""
    known = dict[tuple[str, int], Column]()
    for column in columns:
        first = known.setdefault((column.role, column.number), column)
        alike = first.text == column.text and column.role != "readings"
        if column.number and first is not column and not alike:
            raise InvalidValue(
                f"{first.text!r} and {column.text!r} have one number: give each ball its own rows, "
                "and a column 'ball' for their names"
            )


class Numbers(NamedTuple):
    """The numbers of a column in SI, their errors, NaN if unknown, and the step of reading."""

    values: Array
    errors: Array
    digit: float


def numbers_in(
    columns: Sequence[Column], body: Sequence[Row], notes: list[str]
) -> dict[int, Numbers]:
    """Return the numbers of each column by its index, with the errors that other columns tell."""
    known = {column.index for column in columns if column.role != "error"}
    columns = [column for column in columns if {column.index, column.number} & known]
    usual = _usual(columns, body, notes)
    numbers = {column.index: _numbers(column, columns, body, usual) for column in columns}
    for column in columns:
        if column.role == "error" and column.number in numbers:
            told = numbers[column.number]
            errors = np.where(np.isnan(told.errors), numbers[column.index].values, told.errors)
            numbers[column.number] = told._replace(errors=errors)
    for column in columns:
        for k in np.flatnonzero(numbers[column.index].errors <= 0.0).tolist():
            raise InvalidValue(f"row {body[k][0]}: the error of {column.text!r} must be above 0")
    return numbers


def _numbers(column: Column, columns: Sequence[Column], body: Sequence[Row], usual: str) -> Numbers:
    """Read the cells of a column; ``usual`` is the unit of heights without one."""
    whose = next((c for c in columns if c.index == column.number), column)
    of = whose if column.role == "error" else column
    unit = UNITS[of.role]
    cells = [_cell(row, column.index) for _, row in body]
    texts = [
        (cell, f"row {line}, {column.text}") for cell, (line, _) in zip(cells, body, strict=True)
    ]
    if decimal_comma(texts):
        cells = [cell.replace(",", ".") for cell in cells]
    written = column.unit or (of.unit if of is not column else "")
    if not written and unit == "m":
        written = usual
    grouped, where = next(((c, at) for c, at in texts if _THOUSANDS.fullmatch(c)), ("", ""))
    if written == "mm" and grouped and all(map(_WHOLE.fullmatch, filter(None, cells))):
        raise InvalidValue(f"{where}: {grouped} mm can be read in two ways: write no point")
    filled = [(_NUMBER.fullmatch(cell), where) for cell, where in texts if cell]
    bare = [where for found, where in filled if found and not found[1]]
    has_units = any(found and (found[1] or "")[:1].isalpha() for found, _ in filled)
    if bare and has_units and not column.unit:
        raise InvalidValue(f"{bare[0]} has no unit, but others of its column have one")
    values, errors = np.full((2, len(cells)), math.nan)
    for k, (cell, (_, where)) in enumerate(zip(cells, texts, strict=True)):
        if cell:
            number: Any = quantity_with_error(cell, unit, where, written)
            values[k] = getattr(number, "nominal_value", number)
            errors[k] = getattr(number, "std_dev", math.nan)
    if column.error:
        told = quantity_with_error(column.error, unit, column.text, written)
        errors = np.where(np.isnan(errors), told, errors)
    steps = {f"1 {written}"}  # a unit of the last digit of each cell
    for cell in filter(None, cells):
        last = Decimal(_DIGITS.findall(cell)[0]).as_tuple().exponent
        own = found[1] if (found := _WITH_UNIT.fullmatch(cell)) else written
        steps.add(f"1e{max(last, -300)} {own}")
    digit = min(quantity(step.strip(), unit, column.text) for step in steps)
    return Numbers(values, errors, _step(values, digit))


def assumed_error(values: Array, step: float) -> tuple[float, str]:
    """Return the error of numbers that are told without one, and where it comes from."""
    if step < _FINE * (size := float(np.nanmax(np.abs(values)))):
        return 0.01 * size, "1 % of the largest, which has more digits than can be read"
    return 0.5 * step, "half of the step in which it was written"


def _step(values: Array, digit: float) -> float:
    """Return the step in which numbers were read: a unit of the last digit, or 5 or 10 of them."""
    there = values[np.isfinite(values)] / digit
    for count in (1000.0, 500.0, 100.0, 50.0, 10.0, 5.0):  # also of zeros that a program wrote
        if len(there) >= _ENOUGH and np.all(np.abs(there - count * np.rint(there / count)) < 0.01):
            return count * digit
    return digit


def _usual(columns: Sequence[Column], body: Sequence[Row], notes: list[str]) -> str:
    """Return the unit of heights without one: that of other heights, or by the size of all."""
    lengths = [c for c in columns if UNITS.get(c.role) == "m"]
    if others := [c.unit for c in lengths if c.unit]:
        return others[0]
    cells = [_cell(row, c.index) for c in lengths for _, row in body]
    sizes = [float(found[0]) for cell in cells if (found := re.match(r"\d+", cell))]
    unit = next(unit for least, unit in _SIZES if max(sizes, default=0.0) >= least)
    if any((found := _NUMBER.fullmatch(cell)) and not found[1] for cell in cells):
        notes.append(f"No unit is told for heights: taken as {unit}, by their size.")
    return unit


def _by_drop(
    columns: Sequence[Column],
    numbers: dict[int, Numbers],
    lines: Sequence[int],
    groups: Sequence[str],
    notes: list[str],
) -> tuple[list[dict[str, Any]], str]:
    """Return the readings of a table with a drop in each row, and what was read."""
    starts = [column for column in columns if column.role in STARTS]
    if not starts:
        raise InvalidValue(f"no column is a drop height or an impact speed: {_listed(columns)}")
    measured = next((column.role for column in columns if column.role in MEASURED), "")
    if not measured:
        raise InvalidValue(f"no column is what was measured after a bounce: {_listed(columns)}")
    read = sorted((c for c in columns if c.role == measured), key=lambda column: column.number)
    read = [column for column in read if not column.mean] or read
    kind = "" if measured == "restitution" else measured.removeprefix("rebound")
    start = next((column for column in starts if column.role.endswith(kind)), None)
    if start is None:
        both = f"{starts[0].text!r} and {read[0].text!r}"
        raise InvalidValue(f"{both} are a height and a speed: give heights, or speeds, of both")
    if two := [column.text for column in starts if column.role == start.role][1:]:
        raise InvalidValue(f"{start.text!r} and {two[0]!r} are of two tables: give each a file")
    left_out = [c for c in columns if c.role in (*STARTS, *MEASURED) and c not in (start, *read)]
    notes += [f"Column {c.text!r} is not used: {read[0].text!r} is." for c in left_out]
    in_turn = _in_turn(read, numbers, start)
    if len(read) > 1 and read[0].number:  # no heading says which
        what = "those of bounces in turn" if in_turn else "repeated readings of one bounce"
        notes.append(f"Columns {_names(read)} are taken as {what}, by their numbers.")
    found: list[dict[str, Any]] = []
    for k, line in enumerate(lines):
        before = numbers[start.index]
        there = [column for column in read if math.isfinite(numbers[column.index].values[k])]
        if not there or not math.isfinite(before.values[k]):
            lacks = start if there else read[0]
            notes.append(f"Row {line} has no {lacks.text!r}: left out.")
            continue
        for number, column in enumerate(read if in_turn else there, 1):
            if column not in there:
                break  # the bounces after one that is missing have no fall that is known
            own, where = numbers[column.index], {"line": line, "group": groups[k], "drop": k}
            bounce = {"start_role": start.role, "number": number if in_turn else 1}
            begun = {"start": before.values[k], "start_error": before.errors[k]}
            then = {"value": own.values[k], "error": own.errors[k], "digit": own.digit}
            found.append(where | bounce | begun | then)
    return found, measured


def _in_turn(read: Sequence[Column], numbers: dict[int, Numbers], start: Column) -> bool:
    """Return whether several columns of heights are those of bounces in turn, not readings of one.

    Bounces in turn fall by about the same ratio each; readings are about equal.
    """
    if len(read) < 2 or read[0].role != "rebound_height":
        return False
    with warnings.catch_warnings(action="ignore"):  # of columns without a row in common
        heights = [np.log(numbers[column.index].values) for column in (start, *read[:2])]
        first, second = (np.nanmedian(heights[k + 1] - heights[k]) for k in (0, 1))
    return bool(second < _SUCCESSIVE * first)


def _names(columns: Sequence[Column]) -> str:
    return ", ".join(repr(column.text) for column in columns)


def _listed(columns: Sequence[Column]) -> str:
    """Return the end of a message: what the columns are, and what is right."""
    known = f"known are {_names(columns)}" if columns else "no name is known here"
    return f"name them, such as {_RIGHT}; {known}"


def _check(readings: DataFrame, measured: str) -> None:
    """Refuse numbers that are not above 0, and a bounce that gains speed."""
    for _, drop in readings.groupby("drop"):
        before = float(drop.start.iloc[0])
        for line, value in zip(drop.line, drop.value, strict=True):
            if not (before > 0.0 and value > 0.0):
                raise InvalidValue(
                    f"row {line}: numbers must be above 0, got {before:.4g} and {value:.4g}"
                )
            most = 1.0 if measured == "restitution" else before
            if value > most:
                got = handy_text(value, UNITS[measured], 3)
                after = f" after {handy_text(most, UNITS[measured], 3)}" * bool(UNITS[measured])
                raise InvalidValue(
                    f"row {line}: the {measured.replace('_', ' ')} is {got}{after}: one ball does "
                    "not gain speed in a bounce; the columns may be exchanged, or it is the upper "
                    "ball of a stack"
                )
            in_turn = measured == "rebound_height" and drop.number.max() > 1
            before = value if in_turn else before
