"""The numbers of a drop in tables: balls, contacts, highest points, with errors or not."""

import math
from typing import Any

from rich.table import Table

from stackbounce.cli.tables import add_columns, new_table, number, percent, with_error, write_count
from stackbounce.model.drawing import meetings, names_of
from stackbounce.prediction import Prediction
from stackbounce.run.result import Result

_BALLS = ("before\nm/s", "after\nm/s", "ratio\nv/v0", "bounce\n/drop", "height\nm")
_CONTACTS = ("touch\nms", "release\nms", "longest\nms", "peak\nN", "peak\nmm", "impulse\nN s")
_TIMES = _CONTACTS[:3]


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
        for i, name in enumerate(names_of(self.result.drop.balls)):
            row = [number(self.result.drop.balls[i].mass * 1e3)] if masses else []
            row += [self._cell(heading, i) for heading in _BALLS]
            if other:
                row += [other._cell(heading, i) for heading in (_BALLS[1], _BALLS[3])]
            table.add_row(name, *row)
        return table

    def contacts(self) -> Table:
        """Return the table of the contacts."""
        title = "Contacts, with peak force and peak compression"
        table = new_table(title, ["\ncontact"], ["times\nclosed", *_CONTACTS])
        for i, names in enumerate(meetings(self.result.drop.balls)):
            counts = [int(self.result.collisions[i])]
            if self.prediction is not None and self.prediction.reason:
                counts = sorted(self.prediction.collisions[i])
            ends = dict.fromkeys((counts[0], counts[-1]))
            cells = [self._cell(heading, i) for heading in _CONTACTS]
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
        for i, name in enumerate(names_of(self.result.drop.balls)):
            own = [value for b, *values in rows if b == i for value in values]
            cells = [with_error(v) if with_errors else number(v) for v in own[: 2 * shown]]
            cells += ["–"] * (2 * shown - len(cells))
            many = [] if with_errors else [str(len(own) // 2)]
            table.add_row(name, *many, *cells)
        return table

    def energy(self) -> str:
        """Return the share of the energy that is retained."""
        if self.prediction is None:
            return percent(self.result.energy_retained)
        return f"{with_error(100.0 * self.prediction.energy_retained)} %"


def _numbers(result: Result) -> dict[tuple[str, int], float]:
    """Return the numbers of the tables by heading and ball or contact."""
    found: dict[tuple[str, int], float] = {}
    speeds, ratios = result.rebound_speeds.tolist(), result.rebound_ratios.tolist()
    heights = result.rebound_heights.tolist()
    for i, before in enumerate(result.drop.start_velocities):
        balls = [before, speeds[i], ratios[i]]
        if not speeds[i] < 0.0:
            balls += [ratios[i] * ratios[i], heights[i]]
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
