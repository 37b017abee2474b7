"""Tables of at most 100 columns, and how numbers, balls and laws are written in them."""

import math
from collections.abc import Sequence
from typing import Any

from rich import box
from rich.table import Table

from stackbounce.cli.scenario import DEFAULT_HEIGHT, Scenario
from stackbounce.model.drop import Drop
from stackbounce.model.laws import ContactLaw

__all__ = [
    "add_columns",
    "incidence",
    "label",
    "law_text",
    "meeting",
    "new_table",
    "number",
    "percent",
    "with_error",
    "write_count",
]


def new_table(title: str | None, texts: Sequence[str] = (), numbers: Sequence[str] = ()) -> Table:
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


def add_columns(table: Table, headings: Sequence[str], style: str = "") -> None:
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


def label(name: str | None, i: int) -> str:
    """Return the name of ball `i` in tables: printable, and at most 16 characters.

    Examples
    --------
    >>> label(None, 1), label("B1", 0)
    ('ball 1', 'B1')
    """
    text = "".join(c if c.isprintable() else "?" for c in name or f"ball {i}")
    return text if len(text) <= 16 else text[:15] + "…"


def incidence(scenario: Scenario) -> str:
    """Return the names of the balls, and their height or speed."""
    drop = scenario.drop
    names = " + ".join(label(ball.name, i) for i, ball in enumerate(drop.balls))
    if drop.velocities is not None:
        text = "coming in at " + ", ".join(number(v) for v in drop.velocities) + " m/s"
    elif drop.height is not None:
        text = f"from {drop.height:.6g} m, at {number(drop.reference_speed)} m/s"
    else:
        text = f"at {number(drop.reference_speed)} m/s"
    if scenario.speed_source == "default":
        text += f" ({DEFAULT_HEIGHT:g} m unless --height or --speed is given)"
    return f"{names} {text}"


def meeting(drop: Drop, contact: int) -> str:
    """Return the two sides of a contact: the floor or the ball below, and the ball above."""
    upper = label(drop.balls[contact].name, contact)
    below = "floor" if contact == 0 else label(drop.balls[contact - 1].name, contact - 1)
    return f"{below} – {upper}"


def law_text(law: ContactLaw | None) -> str:
    """Return a contact law in words.

    Examples
    --------
    >>> from stackbounce.model import Spring
    >>> law_text(Spring(2500))
    'Spring, stiffness 2500 N/m'
    """
    return "none" if law is None else law.described()
