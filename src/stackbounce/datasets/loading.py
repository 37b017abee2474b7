"""The datasets by name: what each says of itself, and each as an xarray Dataset in SI units."""

import functools
import tomllib
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeAlias

from stackbounce.errors import one_of, shown
from stackbounce.library_types import Dataset
from stackbounce.units import in_si, quantity

TEXT = "text"
"""The unit of a column of words."""

Value: TypeAlias = float | str | tuple[float, ...]
"""A cell: a number, a word, or repeated readings of a number."""
_OFFSETS = {"degC": (273.15, "K")}  # units whose zero is shifted


@dataclass(frozen=True)
class Column:
    """A column of a dataset, in the units of its source.

    Parameters
    ----------
    name : str
        Such as ``"drop_height"``.
    unit : str
        As the source writes it, such as ``"cm"``; ``"1"`` for a ratio and ``"text"`` for words.
    meaning : str
        What is measured.
    values : tuple
        One for each row: a number, a word, or a tuple of repeated readings.
    errors : tuple of float, optional
        One standard deviation of each value, as the source gives it; empty if it gives none.
    assumed_error : float, optional
        An error to reckon with where the source gives none; 0 if there is none.
    assumed_because : str, optional
        Why this error.

    Examples
    --------
    >>> Column("restitution", "1", "restitution", (0.81, 0.85)).errors
    ()
    """

    name: str
    unit: str
    meaning: str
    values: tuple[Value, ...]
    errors: tuple[float, ...] = ()
    assumed_error: float = 0.0
    assumed_because: str = ""


@dataclass(frozen=True)
class Description:
    """A dataset with its source, in the units of the source.

    Parameters
    ----------
    name : str
        Its name, as `load` takes it.
    title, measured, ball : str
        What it is about, how it was measured, and with what.
    source : str
        Authors, title and place.
    address : str
        Where it was read.
    seen : str
        What was read of it: ``"full text"``, ``"excerpt"``, ``"abstract"``, or a text that quotes
        it, ``"quoted"``.
    columns : tuple of Column
        The table, of equally many rows.
    kind : str, optional
        What the numbers are: ``"measured"``, or ``"rule"``: limits that the rules of a game set.
    surface : str, optional
        What the ball fell on.
    mass, mass_from, diameter, diameter_from : str, optional
        Of the ball, with their units, and where each comes from.
    doi, quoted_by, remarks : str, optional
        The source's DOI, the text that quotes it, and what else a user should know.
    licence : str, optional
        The source's licence; by default only its figures are quoted.

    Examples
    --------
    >>> from stackbounce.datasets import describe
    >>> describe("granite-spheres").seen
    'abstract'
    """

    name: str
    title: str
    measured: str
    ball: str
    source: str
    address: str
    seen: str
    columns: tuple[Column, ...]
    kind: str = "measured"
    surface: str = ""
    mass: str = ""
    mass_from: str = ""
    diameter: str = ""
    diameter_from: str = ""
    doi: str = ""
    quoted_by: str = ""
    remarks: str = ""
    licence: str = "figures quoted"


def _column(values: list[Any], errors: Any = (), **about: Any) -> Column:
    each = [errors] * len(values) if isinstance(errors, int | float) else errors
    found = tuple(_value(value) for value in values)
    return Column(values=found, errors=tuple(float(error) for error in each), **about)


def _value(value: Any) -> Value:
    if isinstance(value, list):
        return tuple(float(item) for item in value)
    return value if isinstance(value, str) else float(value)


def names() -> tuple[str, ...]:
    """Return the names of all datasets, in alphabetical order.

    Examples
    --------
    >>> "granite-spheres" in names()
    True
    """
    return tuple(sorted(_all()))


def describe(name: str) -> Description:
    """Return what a dataset says of itself, with its table in the units of its source.

    Parameters
    ----------
    name : str
        One of `names`.

    Raises
    ------
    InvalidValue
        If there is none of that name; the message suggests the nearest.

    Examples
    --------
    >>> describe("superball-knocks").doi
    '10.1119/1.4801369'
    """
    return _all()[one_of(name, names(), f"name must be that of a dataset, got {shown(name)}")]


def load(name: str) -> Dataset:
    """Return a dataset in SI units.

    Parameters
    ----------
    name : str
        One of `names`.

    Returns
    -------
    xarray.Dataset
        A variable for each column, of shape (row,), or (row, NAME_reading) where the source repeats
        a measurement. Its attributes are ``units``, ``long_name``, and ``assumed_error`` with
        ``assumed_because`` where the source gives no error. The variable ``NAME_error`` has the
        errors that the source gives. The attributes of the dataset say what was measured, where it
        was published and what was read of that.

    Raises
    ------
    InvalidValue
        If there is none of that name; the message suggests the nearest.

    Examples
    --------
    >>> granite = load("granite-spheres")
    >>> float(granite.restitution[0]), float(granite.restitution_error[0])
    (0.83, 0.06)
    >>> load("tennis-ball-rule").rebound_height.values.round(3), granite.attrs["seen"]
    (array([1.346, 1.473]), 'abstract')
    """
    import xarray as xr

    about = describe(name)
    variables: dict[str, Any] = {}
    for column in about.columns:
        variables |= _variables(column)
    attributes = {key: text for key, text in vars(about).items() if key != "columns" and text}
    for key, unit in (("mass", "kg"), ("diameter", "m")):
        if key in attributes:
            attributes[key] = quantity(attributes[key], unit)
    return xr.Dataset(variables, attrs=attributes)


def si_unit(column: Column) -> str:
    """Return the SI unit of a column; ``"1"`` for a ratio, empty for words.

    Examples
    --------
    >>> si_unit(Column("height", "inch", "height", (100.0,)))
    'm'
    """
    if column.unit == TEXT:
        return ""
    if column.unit in _OFFSETS:
        return _OFFSETS[column.unit][1]
    if column.unit == "1":
        return "1"
    found = in_si(column.unit)
    assert found is not None
    return found[1]


def _variables(column: Column) -> dict[str, Any]:
    """Return the variable of a column, and that of its errors if the source gives them."""
    import numpy as np

    unit = si_unit(column)
    dims = ("row", f"{column.name}_reading") if isinstance(column.values[0], tuple) else ("row",)
    attributes: dict[str, Any] = {"long_name": column.meaning} | ({"units": unit} if unit else {})
    if column.assumed_error:
        error = _in_si(column.assumed_error, column.unit, unit)
        attributes |= {"assumed_error": error, "assumed_because": column.assumed_because}
    if column.unit == TEXT:
        return {column.name: (dims, list(column.values), attributes)}
    shift = _OFFSETS.get(column.unit, (0.0, ""))[0]
    values = np.add(_in_si(column.values, column.unit, unit), shift)
    made: dict[str, Any] = {column.name: (dims, values, attributes)}
    if column.errors:
        errors = _in_si(column.errors, column.unit, unit)
        says = {"units": unit, "long_name": f"error of the {column.meaning}"}
        made[f"{column.name}_error"] = ("row", errors, says)
    return made


def _in_si(value: Any, unit: str, si: str) -> Any:
    """Return a number, or all those of tuples, in an SI unit."""
    if isinstance(value, tuple):
        return [_in_si(number, unit, si) for number in value]
    if unit in ("1", *_OFFSETS):
        return float(value)
    return quantity(f"{value!r} {unit}", "" if si == "1" else si)


@functools.cache
def _all() -> dict[str, Description]:
    """Return the datasets of the folder by their names.

    The keys of a file are the fields of `Description` but the name, those in ``columns`` the fields
    of `Column`. A number as ``errors`` holds for all values.
    """
    found = {}
    for path in Path(__file__).with_name("tables").glob("*.toml"):
        about = tomllib.loads(path.read_text("utf-8"))
        about["columns"] = tuple(_column(**column) for column in about["columns"])
        found[path.stem] = Description(path.stem, **about)
    return found
