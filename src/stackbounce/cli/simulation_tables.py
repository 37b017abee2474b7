"""The tables of ``stackbounce simulate``: balls, contacts, highest points, energy."""

import math

from rich.console import Console
from rich.table import Table

from stackbounce.cli.scenario import Scenario
from stackbounce.cli.tables import (
    add_columns,
    incidence,
    label,
    law_text,
    meeting,
    new_table,
    number,
)
from stackbounce.model.drop import STANDARD_GRAVITY
from stackbounce.run.result import Result, Status

__all__ = ["print_simulation"]

_APEXES = 4  # highest points shown for each ball


def print_simulation(
    console: Console, scenario: Scenario, result: Result, textbook: Result | None
) -> None:
    """Print what happened to a drop, next to its separate collisions."""
    drop = scenario.drop
    console.print(incidence(scenario), style="bold")
    for i, source in enumerate(scenario.contact_sources):
        console.print(
            f"  contact {i}, {meeting(drop, i)}: {law_text(drop.contacts[i])}  [{source}]"
        )
    for i, source in enumerate(scenario.gap_sources):
        gap = f"{drop.gaps[i] * 1e3:.6g} mm"
        console.print(f"  gap {i}, {meeting(drop, i + 1)}: {gap}  [{source}]")
    console.print(_bounces(result, textbook))
    console.print(_contacts(result))
    if len(result.apexes):
        console.print(_apexes(result))
    _closing(console, result, textbook)


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
            table.add_row(meeting(drop, i), times, *["–"] * 6)
            continue
        table.add_row(
            meeting(drop, i),
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
