"""Tables of at most 100 columns, and how numbers are written in them."""

import math
from collections.abc import Iterable, Sequence
from typing import Any

from rich import box
from rich.table import Table

from stackbounce.library_types import DataFrame


def new_table(title: str | None, texts: Iterable[str], numbers: Iterable[str] = ()) -> Table:
    """Return a table in the style of all of them, with columns of texts, then of numbers."""
    table = Table(
        title=title and f"\n{title}",
        title_justify="left",
        title_style="bold",
        box=box.SIMPLE_HEAD,
        show_edge=False,
        pad_edge=False,
        padding=(0, 1, 0, 0),
    )
    for heading in texts:
        table.add_column(heading, overflow="fold")
    add_columns(table, numbers)
    return table


def add_columns(table: Table, headings: Iterable[str], style: str = "") -> None:
    """Add columns of numbers."""
    for heading in headings:
        table.add_column(heading, justify="right", style=style, no_wrap=True)


def number(value: float) -> str:
    """Return a number with four significant digits.

    Parameters
    ----------
    value : float
        Any number; nan stands for "none".

    Returns
    -------
    str

    Examples
    --------
    >>> [number(x) for x in (3.53, -0.057, 56000.0, 1e-17, float("inf"), float("nan"))]
    ['3.530', '-0.05700', '56000', '0', '∞', '–']
    >>> [number(x) for x in (1e-300, 1e-11, 0.1, 999.96, 1234.5, 123456.0, 1e12, -2.0)]
    ['0', '1.000e-11', '0.1000', '1000', '1234', '123456', '1.000e+12', '-2.000']
    """
    if math.isnan(value):
        return "–"
    if math.isinf(value):
        return "∞" if value > 0.0 else "-∞"
    if abs(value) < 1e-12:
        return "0"
    if 1e3 <= abs(value) < 1e7:
        return f"{value:.0f}"
    return f"{value:#.4g}".removesuffix(".")


def with_error(value: Any) -> str:
    """Return a number with the error of its last digits in parentheses.

    Examples
    --------
    >>> from uncertainties import ufloat
    >>> with_error(ufloat(6.297, 0.017)), with_error(ufloat(1234.0, 56.0)), with_error(None)
    ('6.297(17)', '1234(56)', '–')
    """
    if value is None or not math.isfinite(value.nominal_value):
        return "–"
    return f"{value:.2uS}" if value.std_dev > 0.0 else number(value.nominal_value)


def table_of(frame: DataFrame, title: str | None = None) -> Table:
    """Return a table of pandas, each number with four digits."""
    headings = [str(name).replace("_", "\n") for name in frame.columns]
    table = new_table(title, [str(frame.index.name or "").capitalize()], headings)
    for name, row in zip(frame.index, frame.itertuples(index=False), strict=True):
        cells = (number(cell) if isinstance(cell, float) else str(cell) for cell in row)
        table.add_row(str(name), *cells)
    return table


def table_of_rows(rows: Sequence[Any]) -> Table:
    """Return the table of results that have a name, a value, maybe with an error, and a unit."""
    table = new_table(None, [""], ("value", "error"))
    table.add_column("unit")
    for row in rows:
        table.add_row(row.name, *_value_and_error(row.value), row.unit)
    return table


def _value_and_error(value: Any) -> tuple[str, str]:
    """Return a value and its error as text, the error with two significant digits."""
    if isinstance(value, str):
        return value, ""
    if not hasattr(value, "nominal_value"):
        return (str(value) if isinstance(value, int) else number(value)), ""
    if not value.std_dev > 0.0:
        return number(value.nominal_value), ""
    body, _, power = f"{value:.2u}".replace("(", "").partition(")")
    one, _, other = body.partition("+/-")
    return one + power, other + power


def percent(share: float) -> str:
    """Return a share in percent.

    Examples
    --------
    >>> percent(0.5), percent(float("nan"))
    ('50.0 %', '–')
    """
    return f"{100.0 * share:.1f} %" if math.isfinite(share) else number(share)


def write_count(count: int) -> str:
    """Return how many collisions there were; a negative count stands for infinitely many.

    Examples
    --------
    >>> write_count(3), write_count(-1)
    ('3', '∞')
    """
    return "∞" if count < 0 else str(count)
