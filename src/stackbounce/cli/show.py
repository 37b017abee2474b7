"""Output for people: tables no wider than 100 columns, as readable in a file as on a screen."""

import math
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from rich import box
from rich.console import Console
from rich.table import Table

from stackbounce.cli.scenario import DEFAULT_HEIGHT, Scenario
from stackbounce.model.catalogue import BALLS, PAIRS
from stackbounce.model.drop import STANDARD_GRAVITY, Drop
from stackbounce.model.laws import ContactLaw
from stackbounce.run.result import Result, Status

if TYPE_CHECKING:
    from stackbounce.cross2007 import Audit

__all__ = [
    "add_columns",
    "audit",
    "catalogue",
    "incidence",
    "label",
    "law_text",
    "new_table",
    "number",
    "simulation",
]

_APEXES = 4  # highest points shown for each ball


def simulation(
    console: Console, scenario: Scenario, result: Result, textbook: Result | None
) -> None:
    """Print what happened to a drop, next to its separate collisions."""
    drop = scenario.drop
    console.print(incidence(scenario), style="bold")
    for i, source in enumerate(scenario.contact_sources):
        console.print(
            f"  contact {i}, {_between(drop, i)}: {law_text(drop.contacts[i])}  [{source}]"
        )
    for i, source in enumerate(scenario.gap_sources):
        gap = f"{drop.gaps[i] * 1e3:.6g} mm"
        console.print(f"  gap {i}, {_between(drop, i + 1)}: {gap}  [{source}]")
    console.print(_bounces(result, textbook))
    console.print(_contacts(result))
    if len(result.apexes):
        console.print(_apexes(result))
    _closing(console, result, textbook)


def catalogue(console: Console) -> None:
    """Print the catalogue: balls, pairs, and where each figure comes from."""
    table = new_table("Balls")
    table.add_column("\nball")
    add_columns(table, ("mass\ng", "diameter\nmm", "restitution\non floor", "contact time\nms"))
    add_columns(table, ("stiffness\nN/m", "static\nN/m"))
    for entry in BALLS:
        table.add_row(
            label(entry.ball.name, 0),
            number(entry.ball.mass * 1e3),
            number((entry.ball.diameter or math.nan) * 1e3),
            number(entry.restitution),
            number((entry.contact_time or math.nan) * 1e3),
            number(entry.stiffness),
            number(entry.static_stiffness),
        )
    console.print(table)
    for entry in BALLS:
        console.print(f"{entry.ball.name}: {_sources(entry.sources)}")
    table = new_table("Pairs: springs fitted to a drop of two balls")
    table.add_column("\nlower")
    table.add_column("\nupper")
    add_columns(table, ("floor\nN/m", "between\nN/m", "gap\nmm"))
    table.add_column("\nsource")
    for pair in PAIRS:
        table.add_row(
            pair.lower,
            pair.upper,
            number(pair.floor_stiffness),
            number(pair.stiffness),
            number(pair.gap * 1e3),
            pair.source,
        )
    console.print(table)


def audit(console: Console, done: "Audit", page: Path) -> None:
    """Print how many rows of the audit have which verdict, and where its page lies."""
    table = new_table("Audit of the paper")
    table.add_column("verdict")
    table.add_column("rows", justify="right")
    for verdict, count in (done.counts | {"all": len(done.rows)}).items():
        table.add_row(verdict, str(count))
    console.print(table)
    unexplained = sum(not row.explained for row in done.rows)
    console.print(f"\nRows that disagree without an explanation: {unexplained}")
    console.print(f"Open {page}", soft_wrap=True)


def number(value: float) -> str:
    """Return a number with four digits that count, as people write it.

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


def label(name: str | None, i: int) -> str:
    """Return what a table calls ball `i`: its name, printable and not too long.

    Examples
    --------
    >>> label(None, 1), label("B1", 0)
    ('ball 1', 'B1')
    """
    text = "".join(c if c.isprintable() else "?" for c in name or f"ball {i}")
    return text if len(text) <= 16 else text[:15] + "…"


def law_text(law: ContactLaw | None) -> str:
    """Return a contact law as people write it.

    Examples
    --------
    >>> from stackbounce.model import Spring
    >>> law_text(Spring(2500))
    'Spring, stiffness 2500 N/m'
    """
    return "none" if law is None else law.described()


def incidence(scenario: Scenario) -> str:
    """Return what falls, and from where or how fast."""
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


def _between(drop: Drop, contact: int) -> str:
    upper = label(drop.balls[contact].name, contact)
    below = "floor" if contact == 0 else label(drop.balls[contact - 1].name, contact - 1)
    return f"{below} – {upper}"


def new_table(title: str) -> Table:
    """Return a table in the style of all of them, without columns."""
    return Table(
        title=f"\n{title}",
        title_justify="left",
        title_style="bold",
        box=box.SIMPLE_HEAD,
        show_edge=False,
        pad_edge=False,
        padding=(0, 1, 0, 0),
    )


def add_columns(table: Table, headings: Sequence[str], style: str = "") -> None:
    """Add columns of numbers."""
    for heading in headings:
        table.add_column(heading, justify="right", style=style, no_wrap=True)


def _bounces(result: Result, textbook: Result | None) -> Table:
    drop = result.drop
    table = new_table("Balls, the lowest first; speeds are upward")
    table.add_column("\nball")
    add_columns(table, ("mass\ng", "before\nm/s", "after\nm/s", "ratio\nv/v0", "bounce\n/drop"))
    add_columns(table, ("height\nm",))
    if textbook is not None:
        add_columns(table, ("separate\nm/s", "separate\n/drop"), "dim")
    for i, ball in enumerate(drop.balls):
        row = [label(ball.name, i), number(ball.mass * 1e3), number(drop.start_velocities[i])]
        row += [number(result.rebound_speeds[i]), *_ratios(result, i), number(_height(result, i))]
        if textbook is not None:
            row += [number(textbook.rebound_speeds[i]), _ratios(textbook, i)[1]]
        table.add_row(*row)
    return table


def _ratios(result: Result, i: int) -> tuple[str, str]:
    ratio = float(result.rebound_ratios[i])
    return number(ratio), number(ratio * ratio if ratio >= 0.0 else math.nan)


def _height(result: Result, i: int) -> float:
    speed = float(result.rebound_speeds[i])
    gravity = result.drop.gravity or STANDARD_GRAVITY
    return speed * speed / (2.0 * gravity) if speed >= 0.0 else math.nan


def _contacts(result: Result) -> Table:
    drop = result.drop
    table = new_table("Contacts, with peak force and peak compression")
    table.add_column("\ncontact")
    add_columns(table, ("times\nclosed", "touch\nms", "release\nms", "longest\nms"))
    add_columns(table, ("peak\nN", "peak\nmm", "impulse\nN s"))
    for i in range(len(drop.balls)):
        rows = result.intervals[result.intervals["contact"] == i]
        count = int(result.collisions[i])
        times = "∞" if count < 0 else str(count)
        if len(rows) == 0:
            table.add_row(_between(drop, i), times, *["–"] * 6)
            continue
        table.add_row(
            _between(drop, i),
            times,
            number(float(rows["start"].min()) * 1e3),
            _end(float(rows["end"].max())),
            _end(float((rows["end"] - rows["start"]).max())),
            number(float(rows["peak_force"].max())),
            number(float(rows["peak_compression"].max()) * 1e3),
            number(float(rows["impulse"].sum())),
        )
    return table


def _apexes(result: Result) -> Table:
    """Return the first highest points of each ball; the rest is a number."""
    table = new_table(f"Highest points, the first {_APEXES} of each ball")
    table.add_column("\nball")
    add_columns(table, ("how\nmany",))
    add_columns(table, [part for k in range(_APEXES) for part in (f"{k + 1}\ns", "\nm")])
    for i, ball in enumerate(result.drop.balls):
        rows = result.apexes[result.apexes["ball"] == i]
        first = rows[:_APEXES]
        cells = [number(float(row[name])) for row in first for name in ("time", "height")]
        cells += ["–"] * (2 * (_APEXES - len(first)))
        table.add_row(label(ball.name, i), str(len(rows)), *cells)
    return table


def _end(time: float) -> str:
    return "not yet" if math.isinf(time) else number(time * 1e3)


def _closing(console: Console, result: Result, textbook: Result | None) -> None:
    console.print(f"\nEnergy retained: {_percent(result.energy_retained)}")
    if not any(law.loss for law in result.drop.contacts if law is not None):
        console.print(
            "Springs lose nothing. With losses: --contact 'Hysteretic stiffness=K restitution=E'"
        )
    if textbook is not None:
        values = [law.restitution for law in textbook.drop.contacts if law is not None]
        listed = ", ".join(f"{value:.4g}" for value in values)
        console.print(
            "Separate: the textbook's collisions one after the other, restitution "
            f"{listed} from the floor up: {_counts(textbook)}, "
            f"energy retained {_percent(textbook.energy_retained)}"
        )
    for title, one in (("Status", result), ("Status of the separate collisions", textbook)):
        if one is not None and one.status is not Status.FINISHED:
            console.print(f"{title}: {one.status.name}: {one.status.advice}")


def _counts(result: Result) -> str:
    counts = ["∞" if count < 0 else str(count) for count in result.collisions.tolist()]
    return f"{' + '.join(counts)} collision{'' if counts == ['1'] else 's'}"


def _percent(value: float) -> str:
    return f"{100.0 * value:.1f} %" if math.isfinite(value) else number(value)


def _sources(sources: Sequence[tuple[str, str]]) -> str:
    by_source: dict[str, list[str]] = {}
    for figure, source in sources:
        by_source.setdefault(source, []).append(figure.replace("_", " "))
    return "; ".join(f"{', '.join(figures)}: {source}" for source, figures in by_source.items())
