"""The tables of ``stackbounce simulate`` for a drop whose numbers have errors."""

import math
from typing import TYPE_CHECKING, Any

from rich.console import Console
from rich.table import Table

from stackbounce.cli.tables import label, meeting, new_table, number, write_count
from stackbounce.model.drop import STANDARD_GRAVITY
from stackbounce.run.result import Result

if TYPE_CHECKING:
    from stackbounce.prediction import Prediction

__all__ = ["print_how", "print_prediction", "with_error"]

_APEXES = 3  # highest points shown for each ball
_CONTACTS = {
    "touch\nms": "touch",
    "release\nms": "release",
    "longest\nms": "longest",
    "peak\nN": "force",
    "peak\nmm": "compression",
    "impulse\nN s": "impulse",
}


def print_prediction(console: Console, prediction: "Prediction") -> None:
    """Print the tables of a drop with errors."""
    drop = prediction.drop
    found = prediction.carry(_numbers)
    title = "Balls, the lowest first; speeds are upward; (12) is the error of the last digits"
    columns = ("before\nm/s", "after\nm/s", "ratio\nv/v0", "bounce\n/drop", "height\nm")
    table = new_table(title, ["\nball"], columns)
    for i, ball in enumerate(drop.balls):
        cells = [
            found.get(("before", i)),
            prediction[f"rebound_speeds.{i}"],
            prediction[f"rebound_ratios.{i}"],
            found.get(("bounce", i)),
            found.get(("height", i)),
        ]
        table.add_row(label(ball.name, i), *map(with_error, cells))
    console.print(table)
    console.print(_contacts(prediction, found))
    if prediction.apexes:
        console.print(_apexes(prediction))
    console.print(f"\nEnergy retained: {with_error(100.0 * prediction.energy_retained)} %")


def print_how(console: Console, prediction: "Prediction") -> None:
    """Print how the errors were found, and which number to measure better."""
    for text in (prediction.how, prediction.advice(), *prediction.notes):
        if text:
            console.print(f"{text[0].upper()}{text[1:]}.")


def with_error(one: Any) -> str:
    """Return a number with the error of its last digits in parentheses.

    Examples
    --------
    >>> from uncertainties import ufloat
    >>> with_error(ufloat(6.297, 0.017)), with_error(ufloat(1234.0, 56.0)), with_error(None)
    ('6.297(17)', '1234(56)', '–')
    """
    if one is None or not math.isfinite(one.nominal_value):
        return "–"
    return f"{one:.2uS}" if one.std_dev > 0.0 else number(one.nominal_value)


def _numbers(result: Result) -> dict[tuple[str, int], float]:
    """Return the numbers of the tables that are not quantities of a prediction."""
    found: dict[tuple[str, int], float] = {}
    gravity = result.drop.gravity or STANDARD_GRAVITY
    for i, (before, speed) in enumerate(
        zip(result.drop.start_velocities, result.rebound_speeds.tolist(), strict=True)
    ):
        found["before", i] = before
        if speed >= 0.0:
            found["bounce", i] = float(result.rebound_ratios[i]) ** 2
            found["height", i] = speed * speed / (2.0 * gravity)
        rows = result.intervals[result.intervals["contact"] == i]
        if len(rows):
            found["touch", i] = 1e3 * rows["start"].min()
            found["release", i] = 1e3 * rows["end"].max()
            found["longest", i] = 1e3 * (rows["end"] - rows["start"]).max()
            found["force", i] = rows["peak_force"].max()
            found["compression", i] = 1e3 * rows["peak_compression"].max()
            found["impulse", i] = rows["impulse"].sum()
    return found


def _contacts(prediction: "Prediction", found: dict[Any, Any]) -> Table:
    title = "Contacts, with peak force and peak compression"
    table = new_table(title, ["\ncontact"], ["times\nclosed", *_CONTACTS])
    for i in range(len(prediction.drop.balls)):
        counts = sorted(prediction.collisions[i]) if prediction.reason else []
        known = counts or [int(prediction.result.collisions[i])]
        ends = dict.fromkeys((known[0], known[-1]))
        cells = [with_error(found.get((name, i))) for name in _CONTACTS.values()]
        table.add_row(meeting(prediction.drop, i), "–".join(map(write_count, ends)), *cells)
    return table


def _apexes(prediction: "Prediction") -> Table:
    points = [part for k in range(_APEXES) for part in (f"{k + 1}\ns", "\nm")]
    title = f"Highest points, the first {_APEXES} of each ball"
    table = new_table(title, ["\nball"], points)
    for i, ball in enumerate(prediction.drop.balls):
        rows = [one for one in prediction.apexes if one.ball == i][:_APEXES]
        cells = [with_error(part) for one in rows for part in (one.time, one.height)]
        table.add_row(label(ball.name, i), *cells, *["–"] * (2 * _APEXES - len(cells)))
    return table
