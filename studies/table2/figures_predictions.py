"""The study's figures of the energy bound and of measurements that discriminate between models."""

import math
from typing import TYPE_CHECKING

import numpy as np

from stackbounce.cross2007.style import BLACK, FLOOR, GREY, UPPER, Picture
from studies.table2 import inputs
from studies.table2.catalogue import AS_HEIGHTS, AS_PRINTED, CHOSEN
from studies.table2.comparison import FittedModels
from studies.table2.energy import EnergyBound
from studies.table2.figures import LINES, make_wide_figure, name_pair
from studies.table2.predictions import predict_restitutions, sweep_gap

if TYPE_CHECKING:
    from matplotlib.axes import Axes


def draw_energy(rows: list[EnergyBound]) -> Picture:
    """Draw the measured energy of each pair beside its bounds."""
    figure = make_wide_figure(2.5, 5.2)
    ax = figure.subplots()
    figure.subplots_adjust(left=0.12, right=0.98, bottom=0.13, top=0.97)
    for k, one in enumerate(rows):
        ax.plot(
            [k - 0.35, k + 0.35],
            [one.printed] * 2,
            color=UPPER,
            label=_first(k, "at most: 0.78, 0.90"),
        )
        ax.plot(
            [k - 0.35, k + 0.35],
            [one.heights] * 2,
            "--",
            color=FLOOR,
            label=_first(k, "at most: their roots"),
        )
        below = one.printed - one.printed_error
        ax.bar(k, 2.0 * one.printed_error, 0.7, below, color=UPPER, alpha=0.2, lw=0)
        tall = math.hypot(one.error, one.height_error)
        ax.errorbar(k, one.measured, tall, fmt="none", ecolor=GREY, capsize=2, lw=1.0)
        ax.errorbar(
            k, one.measured, one.error, fmt="o", color=BLACK, capsize=3, label=_first(k, "measured")
        )
    ax.set(xlim=(-0.6, len(rows) - 0.4), ylim=(0.2, 1.03), ylabel="energy left")
    ax.set_xticks(range(len(rows)), [name_pair(row.pair) for row in rows])
    ax.tick_params(axis="x", which="both", bottom=False, top=False)
    ax.legend(loc="lower left", frameon=False, fontsize=9)
    return Picture(
        "study-energy",
        "Energy that is left, and the most that can be left",
        "Lines: what remains if only the floor takes energy, with Table I's COR as restitutions "
        "(solid, ± 0.02) or as ratios of heights (dashed). Black error bars are those of the "
        "ratios, grey ones contain ± 1 cm of the drop height.",
        (),
        (),
        figure,
    )


def _first(k: int, text: str) -> str | None:
    return text if k == 0 else None


def draw_decisive(compared: FittedModels) -> Picture:
    """Draw B1's restitution against drop height, and e1 of B1 on B2 against the gap, by model."""
    figure = make_wide_figure(2.9)
    left, right = figure.subplots(1, 2)
    figure.subplots_adjust(left=0.075, right=0.99, bottom=0.165, top=0.9, wspace=0.22)
    _single(compared, left)
    gaps = np.linspace(1e-4, 8e-3, 160)
    for name in CHOSEN:
        lower, _, _ = sweep_gap(compared, name, "B1_on_B2", gaps)
        color, style = LINES[name]
        right.plot(1e3 * gaps, lower, style, color=color, label=name)
    right.axvline(2.0, color=GREY, lw=0.8, ls=":")
    right.set(xlabel="gap (mm)", ylabel="$e_1$ of B1 on B2", xlim=(0.0, 8.0))
    figure.legend(*right.get_legend_handles_labels(), loc="upper center", ncols=4, frameon=False)
    return Picture(
        "study-decisive",
        "Two measurements that would decide",
        "Left: B1 dropped alone; circles are Table I's 0.78 and its root, at 20 cm. Right: the "
        "small ball's rebound under B1 where the gap is set, not left to chance.",
        (),
        (),
        figure,
    )


def _single(compared: FittedModels, ax: "Axes") -> None:
    heights = np.geomspace(0.03, 1.0, 24)
    for name in CHOSEN:
        color, style = LINES[name]
        ax.plot(100.0 * heights, predict_restitutions(compared, name, heights), style, color=color)
    at = 100.0 * inputs.HEIGHT
    ax.plot([at, at], [AS_PRINTED["e_B1"], AS_HEIGHTS["e_B1"]], "o", mfc="white", mec=BLACK)
    ax.set(xscale="log", xlim=(3.0, 100.0), ylim=(0.55, 1.0), xlabel="drop height of B1 alone (cm)")
    ax.set_ylabel("restitution")
    ax.set_xticks([5, 10, 20, 50, 100], ["5", "10", "20", "50", "100"])
