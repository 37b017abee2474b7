"""The report's figures, in the style of the paper's."""

import math
from collections.abc import Iterable
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from benchmarks.growth import LAWS, SHAPES, Cost
from benchmarks.pairs import LAWS as PAIR_LAWS
from benchmarks.pairs import Entry as PairEntry
from benchmarks.race import PEERS, Entry
from benchmarks.startup import Start
from benchmarks.work_precision import DROPS, FAMILIES, TOLERANCES, Spread, Work
from stackbounce.cross2007.style import BLACK, FLOOR, GREY, UPPER, use_style

GREEN, PURPLE = "#009E73", "#AA4499"
WIDE = 7.2  # inches
SMALLEST = 1e-17  # an error of zero is drawn here
SHOWN = 8  # balls; with fewer, one or a few intervals are hard to time
COLORS = {"rigid": BLACK, "springs": FLOOR, "Hertz": UPPER}
STROKES: dict[str, dict[str, Any]] = {
    "chain": {"linestyle": "-", "marker": "o", "markersize": 4},
    "gapped": {"linestyle": "--", "marker": "s", "markersize": 4, "markerfacecolor": "white"},
}
MARKS = dict(
    zip(FAMILIES, zip("osD^v", (UPPER, FLOOR, GREEN, PURPLE, BLACK), strict=True), strict=True)
)
STYLES = {
    "stackbounce, compiled": (UPPER, "o", "-"),
    "stackbounce, plain Python": (FLOOR, "s", "-"),
    "scipy, DOP853": (BLACK, "D", "--"),
}
WAYS = {
    "sweep": (UPPER, "o", "-"),
    "drop by drop": (FLOOR, "s", "-"),
    "loop by hand": (BLACK, "D", "-"),
    "CyRK": (GREEN, "^", "--"),
    "CVODE": (PURPLE, "v", "--"),
    "SciPy": (GREY, "X", "--"),
}
LINEUP = dict(
    zip(
        (peer.name for peer in PEERS),
        zip((UPPER, FLOOR, "#56B4E9", GREEN, PURPLE, BLACK, GREY), "osD^vDX", strict=True),
        strict=True,
    )
)


def growth(costs: list[Cost]) -> Figure:
    """Draw time per contact interval, and the size of a cluster, against the number of balls."""
    with use_style():
        figure = Figure(figsize=(WIDE, 3.3))
        time, size = figure.subplots(1, 2)
        for shape in SHAPES:
            for law in LAWS:
                row = [c for c in costs if (c.shape, c.law) == (shape, law) and c.balls >= SHOWN]
                balls = [c.balls for c in row]
                look = {"color": COLORS[law], "label": f"{shape}, {law}", **STROKES[shape]}
                if np.isfinite([c.per_interval for c in row]).sum() > 1:
                    time.loglog(balls, [1e6 * c.per_interval for c in row], **look)
                if law != "rigid":
                    size.loglog(balls, [c.cluster for c in row], **look)
        for ax in (time, size):
            ax.set_xlim(6.5, 2500)
            ax.set_xticks([10, 100, 1000], ["10", "100", "1000"])
            ax.set_xlabel("balls")
        time.set_ylim(0.15, 500)
        _plain(time, (1, 10, 100))
        time.set_ylabel("time per contact interval (µs)")
        size.set_ylim(0.8, 100)
        _plain(size, (1, 10, 100))
        size.set_ylabel("contacts that press at once")
        _name_all(figure, *time.get_legend_handles_labels())
        figure.subplots_adjust(left=0.085, right=0.985, top=0.89, bottom=0.145, wspace=0.24)
    return figure


def _plain(ax: Axes, ticks: Iterable[int]) -> None:
    ticks = list(ticks)
    ax.set_yticks(ticks, [str(tick) for tick in ticks])


def _name_all(figure: Figure, lines: Any, names: Any, **look: Any) -> None:
    kept = {
        "frameon": False,
        "fontsize": 9.5,
        "ncols": len(names),
        "loc": "upper center",
        "borderpad": 0.0,
        "columnspacing": 1.5,
    }
    figure.legend(lines, names, **(kept | look))


def accuracy(spreads: list[Spread]) -> Figure:
    """Draw the errors of the velocities against the tolerance asked for."""
    with use_style():
        figure = Figure(figsize=(5.2, 3.8))
        ax = figure.subplots()
        every = [s for s in spreads if s.family == "all"]
        asked = [s.rtol for s in every]
        ax.fill_between(
            asked,
            _seen(s.ten for s in every),
            _seen(s.ninety for s in every),
            color="#d9d9d9",
            linewidth=0,
            label="all: 10 % to 90 %",
        )
        ax.loglog(asked, _seen(s.median for s in every), color=GREY, label="all: median")
        limit = np.array([TOLERANCES[0] * 3, TOLERANCES[-1] / 3])
        ax.loglog(limit, 10 * limit, color=BLACK, linestyle="--", linewidth=1)
        ax.text(1e-7, 6e-6, "10 × rtol", rotation=-31, ha="center", va="center")
        for name, (mark, color) in MARKS.items():
            worst = [s for s in spreads if s.family == name]
            ax.loglog(
                [s.rtol for s in worst],
                _seen(s.worst for s in worst),
                mark,
                color=color,
                markersize=4.5,
                markerfacecolor="none",
                label=f"{name}: worst of {worst[0].rows}",
            )
        ax.set_xlim(3e-3, 3e-15)
        ax.set_ylim(1e-16, 1e-1)
        ax.set_xlabel("tolerance asked for, rtol")
        ax.set_ylabel("error of the velocities / $v_0$")
        ax.legend(frameon=False, fontsize=8.5, loc="lower left")
        figure.subplots_adjust(left=0.125, right=0.98, top=0.975, bottom=0.125)
    return figure


def _seen(values: Iterable[float]) -> np.ndarray:
    return np.maximum(list(values), SMALLEST)


def work(runs: list[Work]) -> Figure:
    """Draw the error of two drops against the time that they take."""
    with use_style():
        figure = Figure(figsize=(WIDE, 3.3))
        panels = figure.subplots(1, 2, sharex=True, sharey=True)
        for ax, drop in zip(panels, DROPS, strict=True):
            for method, (color, mark, stroke) in STYLES.items():
                row = [r for r in runs if (r.drop, r.method) == (drop, method)]
                ax.loglog(
                    [1e3 * r.seconds for r in row],
                    _seen(r.error for r in row),
                    color=color,
                    marker=mark,
                    linestyle=stroke,
                    markersize=4,
                    label=method,
                )
            ax.set_xlabel("time per drop (ms)")
            ax.text(0.97, 0.95, f"two balls, {drop}", transform=ax.transAxes, ha="right", va="top")
        panels[0].set_xlim(0.15, 70)
        panels[0].set_ylim(3e-16, 3e-2)
        panels[0].set_xticks([1, 10], ["1", "10"])
        panels[0].set_ylabel("error of the velocities / $v_0$")
        _name_all(figure, *panels[0].get_legend_handles_labels())
        figure.subplots_adjust(left=0.09, right=0.985, top=0.89, bottom=0.145, wspace=0.06)
    return figure


def pairs(entries: list[PairEntry]) -> Figure:
    """Draw error against time of all ways to solve random drops, a panel for each law."""
    laws = [law for law in dict.fromkeys(one.law for one in entries) if law in PAIR_LAWS]
    with use_style():
        figure = Figure(figsize=(WIDE, 5.0))
        panels = figure.subplots(2, 4, sharex=True, sharey=True)
        for ax, law in zip(panels.flat, laws, strict=False):
            for way, (color, mark, stroke) in WAYS.items():
                row = [one for one in entries if (one.law, one.way) == (law, way)]
                look = {"color": color, "marker": mark, "linestyle": stroke, "markersize": 4}
                times = [1e6 * one.seconds for one in row]
                ax.loglog(times, _seen(one.median for one in row), label=way, **look)
            ax.text(0.96, 0.05, law, transform=ax.transAxes, ha="right", fontsize=9)
        panels[0, 0].set(xlim=(0.4, 3e4), ylim=(2e-20, 1e-2))
        for ax in list(panels.flat)[len(laws) :]:
            ax.axis("off")
        for ax in panels[1]:
            ax.set_xlabel("time per drop (µs)")
        for ax in panels[:, 0]:
            ax.set_ylabel("median error / $v_0$")
        _name_all(figure, *panels[0, 0].get_legend_handles_labels(), columnspacing=1.0)
        figure.subplots_adjust(
            left=0.09, right=0.985, top=0.92, bottom=0.1, wspace=0.08, hspace=0.1
        )
    return figure


def peers(entries: list[Entry]) -> Figure:
    """Draw errors against time, median to worst, and the shares of wrong counts."""
    with use_style():
        figure = Figure(figsize=(WIDE, 3.6))
        work, wrong = figure.subplots(1, 2)
        shown = [entry for entry in entries if entry.rounds]
        for place, entry in enumerate(shown):
            color, mark = LINEUP[entry.peer.name]
            time, errors = 1e6 * entry.seconds, _seen((entry.median_error, entry.worst_error))
            look = {"color": color, "marker": mark, "markersize": 5}
            work.loglog([time, time], errors, linewidth=1, markevery=[0], **look)
            work.loglog(time, errors[1], color=color, marker="_", markersize=7)
            work.plot([], [], linestyle="", label=entry.peer.name, **look)
            sets = np.arange(len(entry.wrong))
            shares = [100.0 * share for share in entry.wrong.values()]
            wide = 0.84 / len(shown)
            left = sets - 0.42 + (place + 0.5) * wide
            wrong.bar(left, shares, 0.9 * wide, color=color)
        work.set_ylim(1e-17, 1e-1)
        work.margins(x=0.1)
        work.set_xlabel("time per drop (µs)")
        work.set_ylabel("error of the velocities / $v_0$, median to worst")
        keys = list(entries[0].wrong)
        names = [f"$10^{{{math.log10(key):.0f}}}$" if key else "random" for key in keys]
        wrong.set_xticks(range(len(keys)), names)
        wrong.tick_params(axis="x", which="minor", bottom=False, top=False)
        wrong.set_xlim(-0.5, len(keys) - 0.5)
        wrong.set_ylim(0.0, 60.0)
        wrong.set_xlabel("drops: random, or so far from a change")
        wrong.set_ylabel("drops with a wrong count (%)")
        _name_all(figure, *work.get_legend_handles_labels(), handletextpad=0.1, columnspacing=1.0)
        figure.subplots_adjust(left=0.09, right=0.985, top=0.89, bottom=0.135, wspace=0.2)
    return figure


def startup(starts: list[Start]) -> Figure:
    """Draw what each start takes in units of numpy's import."""
    with use_style():
        figure = Figure(figsize=(5.2, 0.6 + 0.3 * len(starts)))
        ax = figure.subplots()
        for place, start in enumerate(starts):
            ax.barh(place - 0.18, start.processor_ratio, 0.32, color=UPPER)
            ax.barh(place + 0.18, start.clock_ratio, 0.32, color=FLOOR)
        ax.set_yticks(range(len(starts)), [start.name for start in starts])
        ax.tick_params(axis="y", which="both", length=0)
        ax.invert_yaxis()
        ax.axvline(1.0, color=GREY, linewidth=0.8, linestyle=":")
        ax.set_xlim(0.0, 1.15 * max(max(s.processor_ratio, s.clock_ratio) for s in starts))
        ax.set_xlabel("time / that of numpy's import")
        ax.legend(ax.patches[:2], ["processor", "clock"], frameon=False, loc="upper right")
        figure.subplots_adjust(left=0.3, right=0.98, top=0.97, bottom=0.14)
    return figure
