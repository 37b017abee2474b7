"""The tables of one file, each as the bytes of a file of its own."""

import io
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from stackbounce.errors import InvalidValue, nearest, shown
from stackbounce.measure.messages import about_option


@dataclass(frozen=True)
class Tables:
    """The tables of one file.

    Parameters
    ----------
    members : dict of str to bytes
        Each as the bytes of a table, by its name.
    program : str, optional
        Which program wrote the file, if that is known without its tables.
    why : str, optional
        By what it was recognised.
    kind : str, optional
        What the file is called in messages.
    decimal : str, optional
        The decimal mark of its tables, where that is known.
    """

    members: dict[str, bytes]
    program: str = ""
    why: str = ""
    kind: str = "archive"
    decimal: str | None = None


def as_text(rows: Iterable[Sequence[object]]) -> bytes:
    r"""Return rows of cells as the bytes of a table, with tabs and decimal points.

    Examples
    --------
    >>> as_text([("t (s)", "y"), (0.5, None)])
    b't (s)\ty\n0.5\t\n'
    """
    text = io.StringIO()
    for row in rows:
        text.write("\t".join(map(_cell, row)))
        text.write("\n")
    return text.getvalue().encode()


def _cell(value: object) -> str:
    if value is None:
        return ""
    if isinstance(value, float | np.floating):
        return repr(float(value))
    return " ".join(str(value).split())


def chosen(tables: Tables, table: object) -> str:
    """Return the name of the table that is asked for, by its name or the last part of it.

    Raises
    ------
    InvalidValue
        If there is none of that name, or more than one.
    """
    word = str(table).casefold()
    found = []
    for name in tables.members:
        whole = name.casefold()
        last = whole.rpartition("/")[2]
        if word in (whole, last, last.rpartition(".")[0]):
            found.append(name)
    if len(found) != 1:
        near = nearest(table, tables.members)
        wrong = f" must be one in the {tables.kind}, got {shown(table)}; {near}"
        raise InvalidValue(about_option("table", wrong))
    return found[0]
