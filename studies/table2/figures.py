"""The study's figures of the fits: BIC, misfits, and ratios against delays."""

import math
from typing import TYPE_CHECKING

import numpy as np

from stackbounce.cross2007.style import BLACK, FLOOR, GREY, UPPER, Picture
from studies.table2 import inputs
from studies.table2.catalogue import CHOSEN
from studies.table2.choice_fits import ChoiceFits
from studies.table2.choices import BASE, LATE
from studies.table2.comparison import FittedModels
from studies.table2.predictions import sweep_gap

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_WIDE = 7.4  # inches
_GREEN = "#009E73"
LINES = {"A": (FLOOR, "--"), "S": (BLACK, "-"), "H": (_GREEN, "-."), "B": (UPPER, ":")}
"""Colour and line style of each chosen model."""

_SHOWN = (-0.28, 0.28)  # of a ratio, around what was measured
_GAPS = {"B2_on_B1": 5e-3, "B1_on_B2": 9e-3, "B3_on_B1": 6e-3, "B1_on_B3": 26e-3, "B1_on_B1": 12e-3}
_MOST = 6.0  # errors: where the colours end


def make_wide_figure(height: float, width: float = _WIDE) -> "Figure":
    """Return an empty figure of a page's width."""
    from matplotlib.figure import Figure

    return Figure(figsize=(width, height))


def name_pair(pair: str) -> str:
    """Return a pair's name in words.

    Examples
    --------
    >>> name_pair("B2_on_B1")
    'B2 on B1'
    """
    return pair.replace("_", " ")


def draw_comparison(fits: ChoiceFits) -> Picture:
    """Draw BIC and chi squared of every model, for both delays of B1 on B3."""
    order = fits[BASE].order[::-1]
    figure = make_wide_figure(0.27 * len(order) + 0.75)
    ax = figure.subplots()
    figure.subplots_adjust(left=0.57, right=0.97, bottom=0.5 / figure.get_figheight(), top=0.99)
    places = np.arange(len(order))
    early, late = (
        [fits.cells[name][choice.name].score.bic for name in order] for choice in (BASE, LATE)
    )
    ax.hlines(places, early, late, color=GREY, lw=0.8)
    ax.plot(early, places, "o", color=BLACK, label="2 ms")
    ax.plot(late, places, "s", mfc="white", mec=UPPER, label="7 ms")
    ax.set(xscale="log", xlim=(30.0, 1500.0), ylim=(-0.6, len(order) - 0.4), xlabel="BIC")
    titles = fits[BASE].titles
    ax.set_yticks(places, [f"{name}: {titles[name]}" for name in order])
    ax.tick_params(axis="y", which="both", left=False, right=False)
    ax.legend(
        loc="upper right", frameon=False, handlelength=0.8, handletextpad=0.4, title="B1 on B3 at"
    )
    return Picture(
        "study-comparison",
        "Every model's BIC, with either delay of B1 on B3",
        "BIC is chi squared with a penalty for each fitted number; less is better, and 6 apart is "
        "strong evidence. The order is that of 2 ms. At 7 ms it is another one.",
        (),
        (),
        figure,
    )


def draw_misfits(compared: FittedModels) -> Picture:
    """Draw the pulls of all values for every model as a map."""
    pulls = compared.comparison.pulls
    order = compared.order
    table = pulls.sel(model=order).values
    figure = make_wide_figure(0.27 * len(order) + 1.1)
    ax = figure.subplots()
    high = figure.get_figheight()
    figure.subplots_adjust(left=0.13, right=0.95, bottom=0.05 / high, top=1.0 - 0.95 / high)
    shown = np.clip(table, -_MOST, _MOST)
    ax.imshow(shown, cmap="RdBu_r", vmin=-_MOST, vmax=_MOST, aspect="auto")
    for (i, j), pull in np.ndenumerate(table):
        color = "white" if abs(pull) > 0.6 * _MOST else BLACK
        text = f"{pull:z.1f}" if abs(pull) < 10.0 else f"{pull:.0f}"
        ax.text(j, i, text.replace("-", "−"), ha="center", va="center", fontsize=7.5, color=color)
    labels = [_datum(str(name)) for name in pulls["datum"].values]
    ax.set_xticks(range(len(labels)), labels, rotation=60, ha="left", rotation_mode="anchor")
    ax.set_yticks(range(len(order)), order)
    ax.xaxis.tick_top()
    ax.tick_params(which="both", length=0)
    ax.minorticks_off()
    return Picture(
        "study-misfits",
        "What each model gets wrong",
        "With B1 on B3 at 2 ms. Computed less measured, in errors: 0.02 of each ratio, and of each "
        f"delay what its text says. Colours end at {_MOST:.0f} errors.",
        (),
        (),
        figure,
    )


def _datum(name: str) -> str:
    pair, rest = name.split(".", 1)
    what = {"rebound_ratios.0": "$e_1$", "rebound_ratios.1": "$e_2$"}.get(rest, "delay")
    return f"{name_pair(pair)}: {what}"


def draw_delays(compared: FittedModels) -> Picture:
    """Draw e1 and e2 of each pair against the delay, with the measured values."""
    figure = make_wide_figure(4.0)
    panels = figure.subplots(2, len(inputs.PAIRS), sharex="col")
    figure.subplots_adjust(
        left=0.065, right=0.99, bottom=0.105, top=0.885, wspace=0.36, hspace=0.08
    )
    for pair, column in zip(inputs.PAIRS, panels.T, strict=True):
        _column(compared, pair, list(column[::-1]))
    panels[0, 0].set_ylabel("$e_2$")
    panels[1, 0].set_ylabel("$e_1$")
    figure.legend(
        *panels[0, 0].get_legend_handles_labels(), loc="upper center", ncols=4, frameon=False
    )
    return Picture(
        "study-delays",
        "Ratios against the delay between the two touches",
        "Bands: Table II's values ± 0.02 and the measured delays, for two balls B1 from 1 to 5 ms. "
        "A model is right where its curve is in both bands of a column at one delay. The narrow "
        "band of B1 on B3 at the right is the other delay that was recorded, 7 ms.",
        (),
        (),
        figure,
    )


def _column(compared: FittedModels, pair: str, panels: "list[Axes]") -> None:
    """Draw one pair: e1 below, e2 above."""
    gaps = np.linspace(1e-4, _GAPS[pair], 160)
    delay, spread = (1e3 * time for time in inputs.MEASURED[pair][inputs.DELAY])
    ends = []
    for name in CHOSEN:
        *ratios, touch = sweep_gap(compared, name, pair, gaps)
        color, style = LINES[name]
        for ax, ratio in zip(panels, ratios, strict=True):
            ax.plot(1e3 * touch, ratio, style, color=color, label=name)
        ends.append(1e3 * float(touch[-1]))
    for ax, measured in zip(panels, inputs.read_ratios(pair), strict=True):
        ax.axhspan(measured - inputs.ERROR, measured + inputs.ERROR, color=GREY, alpha=0.3, lw=0)
        ax.axvspan(delay - spread, delay + spread, color=GREY, alpha=0.15, lw=0)
        if pair == "B1_on_B3":
            late, error = (1e3 * time for time in inputs.LATE)
            ax.axvspan(late - error, late + error, color=UPPER, alpha=0.12, lw=0)
        ax.set_ylim(measured + _SHOWN[0], measured + _SHOWN[1])
        ax.set_xlim(0.5, math.floor(min(ends) * 2.0) / 2.0)
        ax.tick_params(labelsize=8.5)
    panels[0].set_xlabel("delay (ms)")
    panels[1].set_title(name_pair(pair), fontsize=10.5, pad=4)
