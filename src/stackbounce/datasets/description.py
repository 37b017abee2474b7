"""What a dataset says of itself: its source, its columns, and the check of a file of it."""

from collections.abc import Mapping
from dataclasses import MISSING, dataclass, fields
from typing import Any, TypeAlias, TypeVar

from stackbounce.errors import InvalidValue, finite, nearest, non_negative, shown

SEEN = ("full text", "excerpt", "abstract", "quoted")
"""What was read of a source: all of it, a part, its abstract, or a text that quotes it."""

KINDS = ("measured", "rule")
"""What the numbers are: measured, or the limits that the rules of a game set."""

TEXT = "text"
"""The unit of a column of words."""

Value: TypeAlias = float | str | tuple[float, ...]
"""A cell: a number, a word, or repeated readings of a number."""

_T = TypeVar("_T")


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
        What was read of it, one of `SEEN`.
    columns : tuple of Column
        The table, of equally many rows.
    kind : str, optional
        One of `KINDS`.
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

    def column(self, name: str) -> Column | None:
        """Return the column of a name.

        Parameters
        ----------
        name : str
            Such as ``"drop_height"``.

        Returns
        -------
        Column or None
            None if there is none of that name.
        """
        return next((column for column in self.columns if column.name == name), None)


def read_description(name: str, mapping: Mapping[str, Any]) -> Description:
    """Return the dataset that the contents of a file describe.

    Parameters
    ----------
    name : str
        Its name; messages begin with it.
    mapping : mapping
        The keys are the fields of `Description` but the name, those in ``columns`` the fields of
        `Column`. A number as ``errors`` holds for all values.

    Returns
    -------
    Description

    Raises
    ------
    InvalidValue
        If a key is missing or unknown, or a value is not what it should be.

    Examples
    --------
    >>> read_description("bounce", {"titel": "A bounce"})
    Traceback (most recent call last):
    stackbounce.errors.InvalidValue: bounce: titel is unknown; did you mean title? ...
    """
    table = dict(mapping)
    columns = table.get("columns")
    if not isinstance(columns, list | type(None)) or columns == []:
        raise InvalidValue(f"{name}: columns must be a list of tables, got {shown(columns)}")
    if columns is not None:
        table["columns"] = tuple(
            _column(f"{name}: {column.get('name')}", column) for column in columns
        )
    made = _made(Description, name, table | {"name": name})
    for key, allowed in (("seen", SEEN), ("kind", KINDS)):
        if getattr(made, key) not in allowed:
            raise InvalidValue(f"{name}: {key} must be one of {', '.join(allowed)}")
    if (made.seen == "quoted") != bool(made.quoted_by):
        raise InvalidValue(f'{name}: quoted_by goes with seen = "quoted", and only with that')
    if len({len(column.values) for column in made.columns}) != 1:
        raise InvalidValue(f"{name}: all columns must have equally many values")
    if len({column.name for column in made.columns}) != len(made.columns):
        raise InvalidValue(f"{name}: two columns must not have the same name")
    return made


def _column(path: str, table: Mapping[str, Any]) -> Column:
    given = dict(table)
    values = given.get("values")
    if not isinstance(values, list) or not values:
        raise InvalidValue(f"{path}.values must be a list, got {shown(values)}")
    words = given.get("unit") == TEXT
    given["values"] = tuple(_value(f"{path}.values", value, words=words) for value in values)
    errors = given.get("errors", [])
    each = errors if isinstance(errors, list) else [errors] * len(values)
    if each and len(each) != len(values):
        raise InvalidValue(f"{path}.errors must be a number or one for each value")
    given["errors"] = tuple(non_negative(f"{path}.errors", error) for error in each)
    made = _made(Column, path, given)
    if bool(made.assumed_error) != bool(made.assumed_because):
        raise InvalidValue(f"{path}: assumed_error and assumed_because go together")
    if made.assumed_error and made.errors:
        raise InvalidValue(f"{path}: an error is either the source's or assumed, not both")
    if len({isinstance(value, tuple) and len(value) for value in made.values}) != 1:
        raise InvalidValue(f"{path}.values must have equally many readings in each row")
    return made


def _value(path: str, value: object, *, words: bool) -> Value:
    if words:
        if not isinstance(value, str) or not value:
            raise InvalidValue(f"{path} must be words, got {shown(value)}")
        return value
    if isinstance(value, list):
        return tuple(finite(path, item) for item in value)
    return finite(path, value)


def _made(kind: type[_T], path: str, given: Mapping[str, Any]) -> _T:
    known = {field.name: field for field in fields(kind)}  # type: ignore[arg-type]
    for key, value in given.items():
        if key not in known:
            raise InvalidValue(f"{path}: {key} is unknown; {nearest(key, list(known))}")
        if known[key].type is str and (not isinstance(value, str) or not value.strip()):
            raise InvalidValue(f"{path}: {key} must be a text, got {shown(value)}")
    missing = [key for key, field in known.items() if field.default is MISSING and key not in given]
    if missing:
        raise InvalidValue(f"{path}: {', '.join(missing)} must be given")
    return kind(**given)
