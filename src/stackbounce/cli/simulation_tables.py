"""What ``stackbounce simulate`` prints: balls, contacts, highest points, with errors or not."""

import math
from typing import Any

from rich.console import Console
from rich.table import Table

from stackbounce.cli.scenario import DEFAULT_HEIGHT, Scenario
from stackbounce.cli.tables import add_columns, new_table, number, percent, with_error, write_count
from stackbounce.model import Tabulated
from stackbounce.model.drop import STANDARD_GRAVITY, Drop
from stackbounce.model.laws import ContactLaw
from stackbounce.prediction import Prediction
from stackbounce.run.result import Result, Status

_BALLS = ("before\nm/s", "after\nm/s", "ratio\nv/v0", "bounce\n/drop", "height\nm")
_CONTACTS = ("touch\nms", "release\nms", "longest\nms", "peak\nN", "peak\nmm", "impulse\nN s")
_TIMES = _CONTACTS[:3]
_LONG = 5_000_000  # work of a run that is not repeated to find its conditioning


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


class Bounce:
    """The numbers of a drop as they are printed; those of a prediction have errors."""

    def __init__(self, result: Result, prediction: Prediction | None = None) -> None:
        self.result, self.prediction = result, prediction
        if prediction is None:
            self.numbers: Any = _numbers(result)
            return
        self.numbers = prediction.carry(_numbers)
        for i in range(len(result.drop.balls)):
            self.numbers["after\nm/s", i] = prediction[f"rebound_speeds.{i}"]
            self.numbers["ratio\nv/v0", i] = prediction[f"rebound_ratios.{i}"]

    def _cell(self, heading: str, i: int) -> str:
        value = self.numbers.get((heading, i))
        if value is None or self.prediction is not None:
            return with_error(value)
        return "not yet" if heading in _TIMES and math.isinf(value) else number(value)

    def balls(self, textbook: Result | None) -> Table:
        """Return the table of the balls, beside their separate collisions if there are some."""
        title = "Balls, the lowest first; speeds are upward"
        masses = self.prediction is None
        if not masses:
            title, textbook = f"{title}; (12) is the error of the last digits", None
        table = new_table(title, ["\nball"], [*(["mass\ng"] if masses else []), *_BALLS])
        other = textbook and Bounce(textbook)
        if other:
            add_columns(table, ("separate\nm/s", "separate\n/drop"), "dim")
        for i, ball in enumerate(self.result.drop.balls):
            row = [number(ball.mass * 1e3)] if masses else []
            row += [self._cell(heading, i) for heading in _BALLS]
            if other:
                row += [other._cell(heading, i) for heading in (_BALLS[1], _BALLS[3])]
            table.add_row(label(ball.name, i), *row)
        return table

    def contacts(self) -> Table:
        """Return the table of the contacts."""
        title = "Contacts, with peak force and peak compression"
        table = new_table(title, ["\ncontact"], ["times\nclosed", *_CONTACTS])
        for i, count in enumerate(self.result.collisions):
            counts = [int(count)]
            if self.prediction is not None and self.prediction.reason:
                counts = sorted(self.prediction.collisions[i])
            ends = dict.fromkeys((counts[0], counts[-1]))
            cells = [self._cell(heading, i) for heading in _CONTACTS]
            names = meeting(self.result.drop, i)
            table.add_row(names, "–".join(map(write_count, ends)), *cells)
        return table

    def apexes(self) -> Table | None:
        """Return the table of the first highest points of each ball, if there are any."""
        with_errors = self.prediction is not None
        shown = 3 if with_errors else 4
        rows: Any = self.result.apexes[["ball", "time", "height"]].tolist()
        if self.prediction is not None:
            rows = [(apex.ball, apex.time, apex.height) for apex in self.prediction.apexes]
        if not rows:
            return None
        points = [part for k in range(shown) for part in (f"{k + 1}\ns", "\nm")]
        title = f"Highest points, the first {shown} of each ball"
        table = new_table(title, ["\nball"], [*([] if with_errors else ["how\nmany"]), *points])
        for i, ball in enumerate(self.result.drop.balls):
            own = [value for b, *values in rows if b == i for value in values]
            cells = [with_error(v) if with_errors else number(v) for v in own[: 2 * shown]]
            cells += ["–"] * (2 * shown - len(cells))
            many = [] if with_errors else [str(len(own) // 2)]
            table.add_row(label(ball.name, i), *many, *cells)
        return table

    def energy(self) -> str:
        """Return the share of the energy that is retained."""
        if self.prediction is None:
            return percent(self.result.energy_retained)
        return f"{with_error(100.0 * self.prediction.energy_retained)} %"


def _numbers(result: Result) -> dict[tuple[str, int], float]:
    """Return the numbers of the tables by heading and ball or contact."""
    found: dict[tuple[str, int], float] = {}
    gravity = result.drop.gravity or STANDARD_GRAVITY
    speeds, ratios = result.rebound_speeds.tolist(), result.rebound_ratios.tolist()
    for i, before in enumerate(result.drop.start_velocities):
        balls = [before, speeds[i], ratios[i]]
        if not speeds[i] < 0.0:
            balls += [ratios[i] * ratios[i], speeds[i] * speeds[i] / (2.0 * gravity)]
        found |= {(heading, i): value for heading, value in zip(_BALLS, balls, strict=False)}
        rows = result.intervals[result.intervals["contact"] == i]
        if len(rows):
            contact = (
                1e3 * rows["start"].min(),
                1e3 * rows["end"].max(),
                1e3 * (rows["end"] - rows["start"]).max(),
                rows["peak_force"].max(),
                1e3 * rows["peak_compression"].max(),
                rows["impulse"].sum(),
            )
            found |= {(heading, i): v for heading, v in zip(_CONTACTS, contact, strict=True)}
    return found


def print_simulation(
    console: Console,
    scenario: Scenario,
    result: Result,
    textbook: Result | None,
    prediction: Prediction | None = None,
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
    bounce = Bounce(result, prediction)
    for table in (bounce.balls(textbook), bounce.contacts(), bounce.apexes()):
        if table is not None:
            console.print(table)
    console.print(f"\nEnergy retained: {bounce.energy()}")
    _closing(console, result, textbook)
    if prediction is not None:
        for text in (prediction.how, prediction.advice(), *prediction.notes):
            if text:
                console.print(f"{text[0].upper()}{text[1:]}.")


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
