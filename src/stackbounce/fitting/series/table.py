"""A table of bounces, as people type it -> data sets such as `series.make_series` takes."""

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from stackbounce.errors import InvalidValue, counted, nearest, placed, positive, shown
from stackbounce.fitting.rows import File, rows_of
from stackbounce.fitting.series.columns import UNITS, role_of
from stackbounce.fitting.series.readings import MEASURED, STARTS, assumed_error, readings_of
from stackbounce.fitting.series.series import DRAG_COEFFICIENT, pooled_variance
from stackbounce.library_types import DataFrame, Dataset
from stackbounce.measure.reading.dataset import dataset_of
from stackbounce.run.quantities import Array
from stackbounce.units import checked, handy_text, quantity, unit_written

_SAME = 6  # digits in which the heights of repeated drops are equal
_FAR = 6.0  # robust standard deviations: a reading that differs so much is named
_ROBUST = 1.4826  # the standard deviation over the median deviation, of a normal distribution


class Table(NamedTuple):
    """What a table of bounces holds.

    Parameters
    ----------
    name : str
        Of the file.
    groups : dict of str to xarray.Dataset
        By what its columns of words say, or ``""``; as `stackbounce.datasets.load` returns them.
    notes : tuple of str
        What was assumed or left out, a sentence each.
    """

    name: str
    groups: dict[str, Dataset]
    notes: tuple[str, ...]


def read_table(
    path: File,
    errors: Sequence[str] = (),
    *,
    mass: float | None = None,
    diameter: float | None = None,
) -> Table:
    r"""Return what a table of bounces of one or several balls holds.

    Parameters
    ----------
    path : str or path-like, or (str, bytes)
        A table with a heading, as `rows_of` reads it. One column has the height of the drop or the
        impact speed; others have the height after the bounce, or after several bounces in turn, the
        speed after it, or the restitution, with or without columns of their errors. Columns of
        words are groups. Rows that are repeated are readings of the same thing.
    errors : sequence of str, optional
        The error of each number that was measured, such as ``"5 mm"``, or of a column by its name,
        ``"drop height = 2 mm"``.
    mass, diameter : float, optional
        Of the ball, in kg and m: with both the drag of the air is corrected.

    Returns
    -------
    Table

    Raises
    ------
    FileError
        If the file cannot be read.
    InvalidValue
        If the columns do not tell what they hold, or a cell cannot be read; the message has row and
        column.

    Examples
    --------
    >>> path = getfixture("tmp_path") / "heights.csv"
    >>> _ = path.write_text("drop height (cm),rebound height (cm)\n100,64\n100,66\n50,33\n")
    >>> read_table(path).groups[""].rebound_height.values
    array([[0.33,  nan],
           [0.64, 0.66]])
    """
    name, rows = rows_of(path)
    with placed(f"{name}: "):
        told = told_errors(errors)
        known = {
            key: checked(positive, key, value, unit)
            for key, value, unit in (("mass", mass, "kg"), ("diameter", diameter, "m"))
            if value is not None
        }
        readings, measured, notes = readings_of(rows)
        groups: dict[str, Dataset] = {}
        for group, own in readings.groupby("group", sort=False):
            data = _dataset(own, measured, told, notes)
            title = str(group) or Path(name).name
            groups[str(group)] = data.assign_attrs(name=title, title=title, ball=title, **known)
    if len(known) == 2:
        notes.append(f"The drag of the air is corrected, with a coefficient of {DRAG_COEFFICIENT}.")
    if known and len(groups) > 1:
        notes.append(f"The {' and '.join(known)} are taken for all of {', '.join(groups)}.")
    return Table(Path(name).name, groups, tuple(dict.fromkeys(notes)))


def told_errors(errors: Sequence[str]) -> dict[str, float]:
    """Return the errors that are told beside the table, by role; ``""`` is what was measured."""
    found: dict[str, float] = {}
    for text in errors:
        name, _, value = (part.strip() for part in text.rpartition("="))
        role = role_of(name) if name else ""
        if name and not role:
            known = [key.replace("_", " ") for key in (*STARTS, *MEASURED)]
            hint = nearest(name, known)
            raise InvalidValue(f"an error must name its column, got {shown(name)}; {hint}")
        written = unit_written(value)
        unit = UNITS[role] if role else "" if not written else "m/s" if "/" in written else "m"
        found[role] = positive("the error", quantity(value, unit, "the error"), unit)
    return found


def _dataset(
    readings: DataFrame, measured: str, told: dict[str, float], notes: list[str]
) -> Dataset:
    """Return the readings of a group as a data set, those of the same thing in one row."""
    start = str(readings.start_role.iloc[0])
    what, before = measured.replace("_", " "), start.replace("_", " ")
    readings = readings.assign(
        error=readings.error.fillna(told.get(measured, told.get("", math.nan))),
        start_error=readings.start_error.fillna(told.get(start, math.nan)),
    )
    some = readings.error.notna()
    if some.any() and not some.all():
        line = readings.line[~some].iloc[0]
        raise InvalidValue(f"row {line} has no error of the {what}; others do")
    digit = float(readings.digit.max())
    merged = _repeated(readings) if not some.any() else None
    scatter = 0.0 if merged is None else math.sqrt(pooled_variance(merged[1])[0])
    if merged is None or scatter < digit / math.sqrt(12.0):  # equal as far as the digits tell
        rows = readings.sort_values(["start", "drop", "number"])
        values, dims = rows.value.to_numpy(), ["row"]
    else:
        (rows, values), dims = merged, ["row", "reading"]
    unit = UNITS[measured]
    data: dict[str, Any] = {
        start: ("row", rows.start.to_numpy()),
        measured: (dims, values, {"units": unit or "1"}),
    }
    if rows.number.max() > 1:
        data["drop"] = "row", rows["drop"].to_numpy(float)
    if rows.start_error.notna().all():
        data[f"{start}_error"] = "row", rows.start_error.to_numpy()
    else:
        notes.append(f"The {before}s are taken as exact, unless an error of theirs is given.")
    if some.any():
        data[f"{measured}_error"] = "row", rows.error.to_numpy()
    elif values.ndim == 2:
        notes.append(_said_of_scatter(readings, values, measured))
    else:
        error, why = assumed_error(values, digit)
        data[measured][2]["assumed_error"] = error
        notes.append(
            f"No error is told and no reading repeated: the error of a {what} is {why}, "
            f"{handy_text(error, unit, 3)}, unless another is given."
        )
    return dataset_of(data, {})


def _repeated(readings: DataFrame) -> tuple[DataFrame, Array] | None:
    """Return a row for each height and bounce, and its readings, padded; None if none repeats."""
    alike = ["drop", "number"]
    own = readings.assign(drop=readings.start.map(lambda start: float(f"{start:.{_SAME}g}")))
    each = own.groupby(alike)
    read = own.assign(turn=each.cumcount()).pivot(index=alike, columns="turn", values="value")
    if len(read.columns) < 2:
        return None
    return each[["start", "start_error"]].mean().reset_index(), read.to_numpy()


def _said_of_scatter(readings: DataFrame, values: Array, measured: str) -> str:
    """Return where errors come from, and which readings are far from the others."""
    variance, freedom = pooled_variance(values)
    what, unit = measured.replace("_", " "), UNITS[measured]
    of = f" of {readings.group.iloc[0]}" if readings.group.iloc[0] else ""
    said = (
        f"The error of one {what}{of} is the scatter of repeated readings, "
        f"{handy_text(math.sqrt(variance), unit, 3)}, with {counted(freedom, 'degree of freedom')}."
    )
    several = values[np.isfinite(values).sum(axis=1) > 2]
    if not len(several):
        return said
    apart = np.abs(several - np.nanmedian(several, axis=1, keepdims=True))
    usual = _ROBUST * float(np.nanmedian(apart))
    for value in several[apart > _FAR * usual] if usual > 0.0 else ():
        line = readings.line[np.isclose(readings.value, value, rtol=1e-12)].iloc[0]
        said += f" Row {line} is far from the other readings of its height: it is kept."
    return said
