"""Values and results that show themselves: tables with remarks, as text and in a notebook."""

from collections.abc import Callable, Sequence
from dataclasses import fields
from html import escape
from textwrap import fill, wrap
from typing import TYPE_CHECKING, Any, NamedTuple

from stackbounce.library_types import DataFrame

_WIDE = 80  # characters of a line
_NARROW = 20  # characters of a column of words, at least
_MOST = 24  # rows that are shown
_CELL = "padding:0.1em 0.6em;text-align:"
_DIGITS = tuple("+-–±.∞0123456789")


class Table(NamedTuple):
    """A caption, the headings of columns, and rows of texts; the first is a row's name.

    Examples
    --------
    >>> print(Table("Balls", ["", "mass"], [["tennis", "57 g"], ["basketball", "600 g"]]).text())
    Balls
                 mass
    tennis       57 g
    basketball  600 g
    """

    caption: str
    columns: Sequence[str]
    rows: Sequence[Sequence[str]]

    def shown(self) -> "Table":
        """Return the table without rows of its middle, if they are too many for a screen."""
        left_out = len(self.rows) - _MOST
        if left_out <= 0:
            return self
        dots = (f"… {left_out} more", *[""] * (len(self.columns) - 1))
        half = _MOST // 2
        return self._replace(rows=[*self.rows[:half], dots, *self.rows[-half:]])

    def of_numbers(self) -> list[bool]:
        """Return whether each column but the first has numbers, which are aligned on the right."""
        columns = list(zip(*self.rows, strict=True)) or [()] * len(self.columns)
        others = (all(cell.startswith(_DIGITS) for cell in own if cell) for own in columns[1:])
        return [False, *others]

    def text(self) -> str:
        """Return the table as lines of text; the widest column of words is broken to fit."""
        right = self.of_numbers()
        grid = [self.columns, *self.rows] if any(self.columns) else self.rows
        widths = [max(map(len, cells)) for cells in zip(*grid, strict=True)]
        broken = max((width, k) for k, width in enumerate(widths) if not right[k])[1]
        beside = sum(widths) - widths[broken] + 2 * len(widths) - 2
        widths[broken] = min(widths[broken], max(_NARROW, _WIDE - beside))
        lines = [self.caption] if self.caption else []
        for row in grid:
            for n, part in enumerate(wrap(row[broken], widths[broken]) or [""]):
                cells = [part if k == broken else "" if n else cell for k, cell in enumerate(row)]
                sides = ["<>"[of_numbers] for of_numbers in right]
                lines.append("  ".join(map("{:{}{}}".format, cells, sides, widths)).rstrip())
        return "\n".join(lines)

    def html(self) -> str:
        """Return the table for a notebook, with headings that a screen reader tells."""
        sides = ["right" if of_numbers else "left" for of_numbers in self.of_numbers()]

        def line(cells: Sequence[str], *tags: str) -> str:
            parts = zip(tags, sides, cells, strict=True)
            own = (f'<{t} style="{_CELL}{s}">{escape(c)}</{t[:2]}>' for t, s, c in parts)
            return f"<tr>{''.join(own)}</tr>"

        others = len(sides) - 1
        head = line(self.columns, *('th scope="col"' if name else "td" for name in self.columns))
        body = "".join(line(row, 'th scope="row"', *["td"] * others) for row in self.rows)
        above = f"<thead>{head}</thead>" if any(self.columns) else ""
        look = 'style="text-align:left;white-space:nowrap"'
        caption = f"<caption {look}>{escape(self.caption)}</caption>" if self.caption else ""
        return f"<table>{caption}{above}<tbody>{body}</tbody></table>"


class Shown:
    """A value that consists of tables and remarks, as text and as HTML.

    Examples
    --------
    >>> import pandas as pd
    >>> class Heights(Shown):
    ...     table = pd.DataFrame({"value": ["63 ± 1"], "unit": ["cm"]}, index=["height"])
    >>> Heights()
             value  unit
    height  63 ± 1  cm
    """

    if TYPE_CHECKING:
        table: Any
        """What was found, a row each, as a DataFrame, if there are no `_tables`."""

    def _tables(self) -> Sequence[Table]:
        """Return what is shown, in tables."""
        return (table_of(self.table),)

    def _drawing(self) -> str:
        """Return a drawing as SVG; none by default."""
        return ""

    @property
    def remarks(self) -> Sequence[str]:
        """What a reader should know of it, a sentence each: its notes."""
        return tuple(getattr(self, "notes", ()))

    def __repr__(self) -> str:
        """The tables and the remarks, as text."""
        remarks = [fill(remark, _WIDE) for remark in self.remarks]
        return "\n".join([*(table.shown().text() for table in self._tables()), *remarks])

    def _repr_html_(self) -> str:
        """The drawing, the tables and the remarks, for a notebook."""
        tables = "".join(table.shown().html() for table in self._tables())
        listed = "".join(f"<p>{escape(remark)}</p>" for remark in self.remarks)
        return f"{self._drawing()}{tables}{listed}"


def call_of(value: Any, *left_out: str, write: Callable[[Any], str] = repr) -> str:
    """Return the call that makes a dataclass, without defaults and the fields that are left out.

    Examples
    --------
    >>> from stackbounce.model import Ball
    >>> call_of(Ball(0.057, name="tennis"))
    "Ball(mass=0.057, name='tennis')"
    """
    given = [field for field in fields(value) if field.init and field.name not in left_out]
    numbers = [(field, getattr(value, field.name)) for field in given]
    said = [f"{field.name}={write(own)}" for field, own in numbers if own != field.default]
    return f"{type(value).__name__}({', '.join(said)})"


def table_of(frame: DataFrame) -> Table:
    """Return a table of pandas, each number with four digits.

    Examples
    --------
    >>> import pandas as pd
    >>> table_of(pd.DataFrame({"ratio": [1.0 / 3.0]}, index=["tennis"])).rows
    [['tennis', '0.3333']]
    """
    names = (" ".join(map(str, name)) if isinstance(name, tuple) else name for name in frame.index)
    rows = [
        [str(name), *(f"{cell:.4g}" if isinstance(cell, float) else str(cell) for cell in row)]
        for name, row in zip(names, frame.itertuples(index=False), strict=True)
    ]
    index = " ".join(str(name) for name in frame.index.names if name)
    return Table("", [index, *map(str, frame.columns)], rows)
