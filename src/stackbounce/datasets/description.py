"""What a dataset says of itself: its source and its columns."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, TypeAlias

TEXT = "text"
"""The unit of a column of words."""

Value: TypeAlias = float | str | tuple[float, ...]
"""A cell: a number, a word, or repeated readings of a number."""


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

    @property
    def repeated(self) -> bool:
        """Return whether each value is a tuple of repeated readings."""
        return isinstance(self.values[0], tuple)


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


def read_description(name: str, mapping: Mapping[str, Any]) -> Description:
    """Return the dataset that the contents of a file of the package describe.

    Parameters
    ----------
    name : str
        Its name.
    mapping : mapping
        The keys are the fields of `Description` but the name, those in ``columns`` the fields of
        `Column`. A number as ``errors`` holds for all values.

    Returns
    -------
    Description
    """
    columns = tuple(_column(**column) for column in mapping["columns"])
    return Description(name=name, **{**mapping, "columns": columns})


def _column(values: list[Any], errors: Any = (), **about: Any) -> Column:
    each = [errors] * len(values) if isinstance(errors, int | float) else errors
    found = tuple(_value(value) for value in values)
    return Column(values=found, errors=tuple(float(error) for error in each), **about)


def _value(value: Any) -> Value:
    if isinstance(value, list):
        return tuple(float(item) for item in value)
    return value if isinstance(value, str) else float(value)
