"""The tables of ``stackbounce simulate``: balls, contacts, highest points, energy."""

import math
from typing import TYPE_CHECKING

from rich.console import Console
from rich.table import Table

from stackbounce.cli.prediction_tables import print_how, print_prediction
from stackbounce.cli.scenario import Scenario
from stackbounce.cli.tables import (
    add_columns,
    incidence,
    label,
    law_text,
    meeting,
    new_table,
    number,
    percent,
    write_count,
)
from stackbounce.model import Tabulated
from stackbounce.model.drop import STANDARD_GRAVITY
from stackbounce.run.result import Result, Status

if TYPE_CHECKING:
    from stackbounce.prediction import Prediction

__all__ = ["print_simulation"]

_APEXES = 4  # highest points shown for each ball
_LONG = 5_000_000  # work of a run that is not repeated to find its conditioning


def print_simulation(
    console: Console,
    scenario: Scenario,
    result: Result,
    textbook: Result | None,
    prediction: "Prediction | None" = None,
) -> None:
    """Print the result of a drop, beside the result of separate collisions if there is one.

    With a prediction, the numbers have errors instead.
    """
    drop = scenario.drop
    console.print(incidence(scenario), style="bold")
    for i, source in enumerate(scenario.contact_sources):
        console.print(
            f"  contact {i}, {meeting(drop, i)}: {law_text(drop.contacts[i])}  [{source}]"
        )
    for i, source in enumerate(scenario.gap_sources):
        gap = f"{drop.gaps[i] * 1e3:.6g} mm"
        console.print(f"  gap {i}, {meeting(drop, i + 1)}: {gap}  [{source}]")
    if prediction is None:
        console.print(_bounces(result, textbook))
        console.print(_contacts(result))
        if len(result.apexes):
            console.print(_apexes(result))
        console.print(f"\nEnergy retained: {percent(result.energy_retained)}")
    else:
        print_prediction(console, prediction)
    _closing(console, result, textbook)
    if prediction is not None:
        print_how(console, prediction)


def _bounces(result: Result, textbook: Result | None) -> Table:
    drop = result.drop
    numbers = ("mass\ng", "before\nm/s", "after\nm/s", "ratio\nv/v0", "bounce\n/drop", "height\nm")
    table = new_table("Balls, the lowest first; speeds are upward", ["\nball"], numbers)
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
    times = ("times\nclosed", "touch\nms", "release\nms", "longest\nms")
    peaks = ("peak\nN", "peak\nmm", "impulse\nN s")
    table = new_table(
        "Contacts, with peak force and peak compression", ["\ncontact"], times + peaks
    )
    for i in range(len(drop.balls)):
        rows = result.intervals[result.intervals["contact"] == i]
        cells = ["–"] * 6
        if len(rows):
            cells = [
                number(1e3 * rows["start"].min()),
                _end(rows["end"].max()),
                _end((rows["end"] - rows["start"]).max()),
                number(rows["peak_force"].max()),
                number(1e3 * rows["peak_compression"].max()),
                number(rows["impulse"].sum()),
            ]
        table.add_row(meeting(drop, i), write_count(result.collisions[i]), *cells)
    return table


def _apexes(result: Result) -> Table:
    """Return the table of the first highest points of each ball, and how many it has."""
    points = [part for k in range(_APEXES) for part in (f"{k + 1}\ns", "\nm")]
    title = f"Highest points, the first {_APEXES} of each ball"
    table = new_table(title, ["\nball"], ["how\nmany", *points])
    for i, ball in enumerate(result.drop.balls):
        rows = result.apexes[result.apexes["ball"] == i]
        cells = [number(row[name]) for row in rows[:_APEXES] for name in ("time", "height")]
        cells += ["–"] * (2 * _APEXES - len(cells))
        table.add_row(label(ball.name, i), str(len(rows)), *cells)
    return table


def _end(time: float) -> str:
    return "not yet" if math.isinf(time) else number(time * 1e3)


def _closing(console: Console, result: Result, textbook: Result | None) -> None:
    if not any(law.loss for law in result.drop.contacts if law is not None):
        console.print(
            "Springs lose nothing. With losses: --contact 'Hysteretic stiffness=K restitution=E'"
        )
    _beyond_tables(console, result)
    if textbook is not None:
        values = [law.restitution for law in textbook.drop.contacts if law is not None]
        listed = ", ".join(f"{value:.4g}" for value in values)
        console.print(
            "Separate: the textbook's collisions one after the other, restitution "
            f"{listed} from the floor up: {_counts(textbook)}, "
            f"energy retained {percent(textbook.energy_retained)}"
        )
    _conditioning(console, result)
    for title, one in (("Status", result), ("Status of the separate collisions", textbook)):
        if one is not None and one.status is not Status.FINISHED:
            console.print(f"{title}: {one.status.name}: {one.advice}")


def _beyond_tables(console: Console, result: Result) -> None:
    """Say which contacts were pressed beyond the table of their law, or not to its first point."""
    for i, law in enumerate(result.drop.contacts):
        peaks = result.intervals["peak_compression"][result.intervals["contact"] == i]
        if not isinstance(law, Tabulated) or len(peaks) == 0:
            continue
        pressed = f"Contact {i} is pressed to {number(1e3 * max(peaks))} mm, but its table"
        if max(peaks) > law.compression[-1]:
            console.print(
                f"{pressed} ends at {number(1e3 * law.compression[-1])} mm: from there on the "
                "force rises straight."
            )
        elif max(peaks) < law.compression[1]:
            console.print(
                f"{pressed} begins at {number(1e3 * law.compression[1])} mm: how the force rises "
                "from 0 to there is a guess, and with it the contact time."
            )


def _conditioning(console: Console, result: Result) -> None:
    """Say from which time on no digit of the speeds is known, if there is one."""
    if result.work > _LONG or result.status is Status.INVALID:
        return
    if math.isfinite(result.known_until):
        console.print(
            f"Chaotic: no digit of the speeds is known after {number(result.known_until)} s, where "
            f"an error of {result.precision:.0e} of the numbers has grown to one of the speeds."
        )


def _counts(result: Result) -> str:
    counts = [write_count(count) for count in result.collisions]
    return f"{' + '.join(counts)} collision{'' if counts == ['1'] else 's'}"
