"""Panels of force against time, with labels: shared by the figures of both experiments."""

from typing import TYPE_CHECKING

import numpy as np

from stackbounce.cross2007.bench import Bench
from stackbounce.cross2007.curves import sample_forces
from stackbounce.cross2007.drops import Array
from stackbounce.cross2007.style import FLOOR, GREY, UPPER
from stackbounce.model.drop import Drop
from stackbounce.run.result import Result

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_LABELS = ("floor (P1)", "between the balls (P2)")


def draw_two_panels(
    bench: Bench, panels: "list[Axes]", drop: Drop, times: Array, *, dashed: bool = False
) -> Result:
    """Draw both forces of a drop in two panels, the floor's above; return the drop's result."""
    curves, result = sample_forces(bench, drop, times)
    style, width = ("--", 1.0) if dashed else ("-", 1.25)
    for ax, curve, color, label in zip(panels, curves, (FLOOR, UPPER), _LABELS, strict=True):
        ax.plot(1e3 * times, curve, style, color=color, lw=width)
        if not dashed:
            ax.set(ylabel=r"$F$ (N)", xlim=(0, 1e3 * times[-1]), ylim=(0, 1.5 * curve.max()))
            ax.text(0.98, 0.95, label, transform=ax.transAxes, color=color, ha="right", va="top")
    panels[-1].set(xlabel=r"$t$ (ms)")
    return result


def draw_one_panel(
    bench: Bench, ax: "Axes", drop: Drop, times: Array, labels: tuple[float, float]
) -> Result:
    """Draw both forces of a drop in one panel, labelled at two times in ms; return its result."""
    (floor, between), result = sample_forces(bench, drop, times)
    ms = 1e3 * times
    for curve, color, at, text, side in (
        (floor, FLOOR, labels[0], "$F_1$, floor", "right"),
        (between, UPPER, labels[1], "$F_2$, ball-ball", "left"),
    ):
        ax.plot(ms, curve, color=color)
        ax.annotate(
            text,
            xy=(at, float(np.interp(at, ms, curve))),
            xytext=(-6 if side == "right" else 6, 1),
            textcoords="offset points",
            color=color,
            ha=side,
        )
    ax.set(xlabel=r"$t$ (ms)", ylabel=r"$F$ (N)", xlim=(0, ms[-1]), ylim=(0, 1.15 * floor.max()))
    return result


def number_contacts(panels: "list[Axes]", result: Result) -> None:
    """Number the contact intervals of both contacts in order of time, above their peaks."""
    for number, row in enumerate(result.intervals, start=1):
        ax = panels[int(row["contact"])]
        middle = 5e2 * (row["start"] + row["end"])
        if middle < ax.get_xlim()[1]:
            ax.annotate(
                str(number),
                xy=(middle, row["peak_force"]),
                xytext=(0, 2.5),
                textcoords="offset points",
                ha="center",
                color=GREY,
                fontsize=9,
            )
