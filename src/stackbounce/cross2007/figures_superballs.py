"""Figures 10 to 13: pairs of superballs."""

from typing import TYPE_CHECKING

import numpy as np

from stackbounce.cross2007.bench import Bench
from stackbounce.cross2007.drops import Array, peak_times
from stackbounce.cross2007.force_panels import draw_one_panel, draw_two_panels, number_contacts
from stackbounce.cross2007.stacks import (
    early_pair,
    early_twins,
    heavier_b1,
    late_pair,
    late_twins,
    parted_twins,
    reversed_pair,
    small_fit,
    smallest_fit,
)
from stackbounce.cross2007.style import BLACK, Picture, bracket, describe, make_axes, note
from stackbounce.model.drop import Drop
from stackbounce.run.result import Result

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_POINTS = 401


def draw_figure_10a(bench: Bench) -> Picture:
    """Draw the forces of B2 on B1."""
    drop = small_fit(bench, heavier_b1(bench))
    figure, panels, result = _draw_record(bench, drop, 0.008)
    _mark_duration(bench, panels[0], "B2_on_B1.duration")
    end = 1e3 * max(result.last_release)
    return describe("10a", figure, touch=1e3 * result.first_touch[1], end=end)


def draw_figure_10b(bench: Bench) -> Picture:
    """Draw the forces of B1 on B2."""
    drop = reversed_pair(bench, bench("superballs.gap"))
    figure, panels, result = _draw_record(bench, drop, 0.014)
    _mark_duration(bench, panels[0], "B1_on_B2.duration")
    return describe(
        "10b",
        figure,
        touch=1e3 * result.first_touch[1],
        upper_end=1e3 * result.last_release[1],
        end=1e3 * result.last_release[0],
        floor=len(peak_times(result, 0, result.end_time)),
        between=len(peak_times(result, 1, result.end_time)),
    )


def draw_figure_11a(bench: Bench) -> Picture:
    """Draw the forces of B3 on B1."""
    drop = smallest_fit(bench, heavier_b1(bench))
    figure, _, result = _draw_record(bench, drop, 0.008)
    return describe("11a", figure, touch=1e3 * result.first_touch[1])


def draw_figure_11b(bench: Bench) -> Picture:
    """Draw the forces of B1 on B3."""
    drop = late_pair(bench)
    figure, panels, result = _draw_record(bench, drop, 0.034, "superballs.late_delay", 2 * _POINTS)
    number_contacts(panels, result)
    rows = result.intervals
    met = np.flatnonzero(rows["contact"] == 1)
    early = bench.simulate(early_pair(bench))
    merged = early.intervals[early.intervals["contact"] == 1]
    return describe(
        "11b",
        figure,
        gap=1e3 * drop.gaps[0],
        meeting=met[-1] - met[0] + 1,
        contacts=len(rows),
        met=len(met),
        tenth=(1e3 * rows[9]["start"], rows[9]["peak_force"]),
        eleventh=(1e3 * rows[10]["start"], rows[10]["peak_force"]),
        merged=len(merged),
        subpeaks=len(peak_times(early, 1, early.end_time)),
        end=1e3 * merged[-1]["end"],
    )


def draw_figure_12(bench: Bench) -> Picture:
    """Draw the forces of two large balls, and whether they are in contact."""
    figure, panels = make_axes(5.0, 3, ratios=(3, 3, 1.4))
    times = np.linspace(0.0, 0.014, _POINTS)
    late = draw_two_panels(bench, panels[:2], late_twins(bench), times)
    early = draw_two_panels(bench, panels[:2], early_twins(bench), times, dashed=True)
    panels[1].set(xlabel="")
    duration = 1e3 * bench("superballs.twin_duration")
    bracket(panels[0], duration, f"measured: impact lasts {duration:.0f} ms")
    note(panels[1], "dashed: touching\nafter 1 ms")
    _contact(panels[2], late, times)
    parted = bench.simulate(parted_twins(bench))
    peaks = len(peak_times(late, 0, late.end_time))
    return describe(
        "12",
        figure,
        late_gap=1e3 * late.drop.gaps[0],
        early_gap=1e3 * early.drop.gaps[0],
        late=late.collisions[0],
        dip="yes" if peaks > late.collisions[0] else "no",
        touch=1e3 * late.first_touch[1],
        off=1e3 * late.intervals[0]["end"],
        parted_gap=1e3 * parted.drop.gaps[0],
        parted_end=1e3 * parted.last_release[0],
        early_end=1e3 * early.last_release[0],
        early=early.collisions[0],
        subpeaks=len(peak_times(early, 0, early.end_time)),
    )


def draw_figure_13(bench: Bench) -> Picture:
    """Draw section V's calculation for B2 on B1."""
    figure, (ax,) = make_axes()
    drop = small_fit(bench, heavier_b1(bench))
    result = draw_one_panel(bench, ax, drop, np.linspace(0.0, 0.007, _POINTS), (1.45, 4.7))
    lower, upper = result.rebound_ratios
    return describe("13", figure, lower=lower, upper=upper, touch=1e3 * result.first_touch[1])


def _draw_record(
    bench: Bench, drop: Drop, end: float, delay: str = "superballs.delay", points: int = _POINTS
) -> "tuple[Figure, list[Axes], Result]":
    """Draw the forces of a drop in two panels, up to `end` s, with the measured delay."""
    figure, panels = make_axes(4.2, 2)
    result = draw_two_panels(bench, panels, drop, np.linspace(0.0, end, points))
    measured = 1e3 * bench(delay)
    bracket(panels[1], measured, f"measured: {measured:.0f} ms delay")
    return figure, panels, result


def _mark_duration(bench: Bench, ax: "Axes", key: str) -> None:
    duration = 1e3 * bench(key)
    bracket(ax, duration, f"measured: impact lasts {duration:.1f} ms")


def _contact(ax: "Axes", result: Result, times: Array) -> None:
    """Draw whether two balls touch, as the paper's copper strips show it."""
    closed = np.zeros_like(times)
    for row in result.intervals[result.intervals["contact"] == 1]:
        closed[(times >= row["start"]) & (times <= row["end"])] = 1.0
    ax.step(1e3 * times, closed, color=BLACK)
    ax.set(xlabel=r"$t$ (ms)", ylabel="balls", ylim=(-0.25, 1.25), yticks=(0, 1))
    ax.set_yticklabels(("apart", "touch"))
    ax.tick_params(axis="y", which="minor", left=False, right=False)
