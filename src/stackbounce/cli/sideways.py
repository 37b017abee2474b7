"""How balls leave sideways: the options --offset and --straight of ``stackbounce simulate``."""

import math
from typing import Any

import numpy as np
from rich.console import Console

from stackbounce.cli.tables import new_table, number, with_error
from stackbounce.errors import InvalidValue, between
from stackbounce.model import Drop
from stackbounce.model.drawing import names_of
from stackbounce.prediction import Prediction
from stackbounce.prediction.prediction import split_error
from stackbounce.run.result import Result
from stackbounce.run.sideways import LIMIT, REMARK
from stackbounce.units import quantity

_COLUMNS = 4  # balls beside each other in a table of 100 columns
_HEADINGS = {"angle": "angle\n°", "sideways_speed": "sideways\nm/s", "landing": "lands off\nm"}


class Sideways:
    """What is asked of a drop, and the answers.

    Parameters
    ----------
    drop : Drop
    offset, straight : str, optional
        The texts of the options.
    """

    def __init__(self, drop: Drop, offset: str | None, straight: str | None) -> None:
        self.names = names_of(drop.balls)
        self.moved = range(1, len(drop.balls))
        uncertain: dict[str, str] = {}
        self.offset = self.within = None
        if offset is not None:
            self.offset = quantity(split_error(offset, "", uncertain), "m", "--offset")
        if straight is not None:
            degrees = round(math.degrees(quantity(straight, "rad", "--straight")), 9)
            most = round(math.degrees(LIMIT), 9)
            self.within = between("--straight", degrees, 0.0, most, "degrees")
        if (offset or straight) and not self.moved:
            raise InvalidValue("--offset and --straight need two balls or more, got 1")
        self.errors = {f"offsets.{i}": text for text in uncertain.values() for i in self.moved}

    def found(self, result: Result) -> dict[str, list[dict[str, Any]]]:
        """Return the answers as plain values, for JSON.

        ``sideways``: how the uppermost ball leaves for each ball that lies off the middle alone.
        ``straight``: how far each ball alone may lie off, in m, for each ball to leave within the
        angle; nan for a ball that does not move up, or that would lie beside the one below first.
        """
        answers: dict[str, list[dict[str, Any]]] = {}
        if self.offset is not None and not self.errors:
            answers["sideways"] = [
                {"moved": i, **{str(name): float(x[-1]) for name, x in leaving.items()}}
                for i in self.moved
                for leaving in [result.sideways({i: self.offset})]
            ]
        if self.within is not None:
            upward = np.where(result.rebound_speeds > 0.0, result.rebound_speeds, math.nan)
            transfer = result.sideways().transfer.values
            with np.errstate(divide="ignore"):
                most = math.tan(math.radians(self.within)) * upward[:, None] / np.abs(transfer)
            sizes = [ball.diameter or 0.0 for ball in result.drop.balls]
            most[most > 0.5 * np.add(sizes, [math.inf, *sizes[:-1]])] = math.nan
            answers["straight"] = [{"moved": i, "most": most[:, i].tolist()} for i in self.moved]
        return answers

    def print(
        self,
        console: Console,
        answers: dict[str, list[dict[str, Any]]],
        prediction: Prediction | None,
    ) -> None:
        """Print the answers as tables; with an error of the offsets those of a prediction."""
        how_far = f"{1e3 * (self.offset or 0.0):.6g} mm off the middle"
        if "sideways" in answers:
            title = f"How the {self.names[-1]} leaves if a ball lies {how_far}"
            rows = answers["sideways"]
            _print_leaving(console, title, "ball that is off", self.names[1:], rows)
            if any(abs(row["angle"]) > LIMIT for row in rows):
                console.print(f"{REMARK[0].upper()}{REMARK[1:]}.")
        if self.errors and prediction is not None:
            offset = with_error(1e3 * prediction.inputs.offsets[1])
            title = f"How the balls leave if each above the lowest lies {offset} mm off the middle"
            found, balls = prediction.sideways, range(len(self.names))
            rows = [{key: found[f"{key}.{i}"] for key in _HEADINGS} for i in balls]
            _print_leaving(console, title, "ball", self.names, rows)
        if "straight" in answers:
            shown = range(len(self.names))[-_COLUMNS:]
            title = "How far off a ball alone may lie, in mm, for each to leave within"
            console.print(f"\n{title} {self.within:g}°", style="bold")
            table = new_table(None, ["\nball that is off"], [f"\n{self.names[i]}" for i in shown])
            for name, row in zip(self.names[1:], answers["straight"], strict=True):
                table.add_row(name, *(number(1e3 * row["most"][i]) for i in shown))
            console.print(table)
            most = [row["most"][-1] for row in answers["straight"]]
            if len(most) > 1 and not np.all(np.isnan(most)):
                worst = 1 + int(np.nanargmin(most))
                console.print(
                    f"For the {self.names[-1]}, the place of {self.names[worst]} matters most."
                )


def _print_leaving(
    console: Console, title: str, heading: str, names: list[str], rows: list[dict[str, Any]]
) -> None:
    """Print how balls leave; values may have errors."""
    console.print(f"\n{title}", style="bold")
    table = new_table(None, [f"\n{heading}"], _HEADINGS.values())
    for name, row in zip(names, rows, strict=True):
        values = (row[key] * (180.0 / math.pi if key == "angle" else 1.0) for key in _HEADINGS)
        write = with_error if hasattr(row["angle"], "std_dev") else number
        table.add_row(name, *map(write, values))
    console.print(table)
