"""Figures 7 to 13: the basketball with a tennis ball, pairs of superballs, and their forces."""

from collections.abc import Callable

import numpy as np

from stackbounce.cross2007 import stacks, style
from stackbounce.cross2007.bench import Bench
from stackbounce.cross2007.drops import Array, force_above, peak_times
from stackbounce.cross2007.figures_models import sample_forces
from stackbounce.library_types import Axes, Figure
from stackbounce.model.drop import Drop
from stackbounce.model.laws import HollowBall, Spring
from stackbounce.run.result import Result

_LABELS = ("floor (P1)", "between the balls (P2)")
_TIMES = np.linspace(0.0, 0.040, 401)  # s
_POINTS = 401


def draw_two_panels(
    bench: Bench, panels: list[Axes], drop: Drop, times: Array, *, dashed: bool = False
) -> Result:
    """Draw both forces of a drop in two panels, the floor's above; return the drop's result."""
    curves, result = sample_forces(bench, drop, times)
    stroke, width = ("--", 1.0) if dashed else ("-", 1.25)
    colors = (style.FLOOR, style.UPPER)
    for ax, curve, color, label in zip(panels, curves, colors, _LABELS, strict=True):
        ax.plot(1e3 * times, curve, stroke, color=color, lw=width)
        if not dashed:
            ax.set(ylabel=r"$F$ (N)", xlim=(0, 1e3 * times[-1]), ylim=(0, 1.5 * curve.max()))
            ax.text(0.98, 0.95, label, transform=ax.transAxes, color=color, ha="right", va="top")
    panels[-1].set(xlabel=r"$t$ (ms)")
    return result


def draw_one_panel(
    bench: Bench, ax: Axes, drop: Drop, times: Array, labels: tuple[float, float]
) -> Result:
    """Draw both forces of a drop in one panel, labelled at two times in ms; return its result."""
    (floor, between), result = sample_forces(bench, drop, times)
    ms = 1e3 * times
    for curve, color, at, text, side, by in (
        (floor, style.FLOOR, labels[0], "$F_1$, floor", "right", -6),
        (between, style.UPPER, labels[1], "$F_2$, ball-ball", "left", 6),
    ):
        ax.plot(ms, curve, color=color)
        point = (at, float(np.interp(at, ms, curve)))
        style.beside(ax, text, point, (by, 1), color=color, ha=side)
    ax.set(xlabel=r"$t$ (ms)", ylabel=r"$F$ (N)", xlim=(0, ms[-1]), ylim=(0, 1.15 * floor.max()))
    return result


def number_contacts(panels: list[Axes], result: Result) -> None:
    """Number the contact intervals of both contacts in order of time, above their peaks."""
    for number, row in enumerate(result.intervals, start=1):
        ax = panels[int(row["contact"])]
        middle = 5e2 * (row["start"] + row["end"])
        if middle < ax.get_xlim()[1]:
            look = {"ha": "center", "color": style.GREY, "fontsize": 9}
            style.beside(ax, str(number), (middle, row["peak_force"]), (0, 2.5), **look)


def draw_figure_7(bench: Bench) -> style.Picture:
    """Draw force against compression, from the points that the text gives."""
    import xarray as xr

    figure, (ax,) = style.make_axes()
    force, points = bench("static.force"), {}
    for key, text, color, place in (
        ("static.tennis", "tennis ball", style.UPPER, (0.4, 29.0)),
        ("static.basketball", "basketball", style.FLOOR, (-5.9, 29.4)),
        ("static.both", "tennis ball\non basketball", style.BLACK, (-6.0, 18.0)),
    ):
        points[text.replace("\n", " ")] = bench(key)
        compression = 1e3 * bench(key)
        ax.plot([0.0, compression], [0.0, force], color=color)
        ax.plot([compression], [force], "o", color=color, ms=4.5)
        ax.text(compression + place[0], place[1], text, color=color)
    ax.set(xlabel="compression (mm)", ylabel=r"$F$ (N)", xlim=(0, 30), ylim=(0, 35))
    forces = ("load", [force] * len(points), {"units": "N"})
    curves = {"force": forces, "compression": ("load", list(points.values()), {"units": "m"})}
    bench.curves.append(xr.Dataset(curves, {"load": list(points)}))
    return style.describe("7", figure, stiffness=1e-4 * (force / bench("static.tennis")))


def draw_figure_8(bench: Bench) -> style.Picture:
    """Draw the forces of tennis ball and basketball dropped from 30 cm."""
    figure, panels, result, late = _draw_record(bench, stacks.spring_record)
    style.note(panels[0], "solid: touching\ndashed: 2 mm apart")
    return style.describe(
        "8",
        figure,
        end=1e3 * result.last_release[0],
        touch=1e3 * late.first_touch[1],
        begin=1e3 * force_above(result, 1, 0.03)[0],
    )


def draw_figure_8_hollow(bench: Bench) -> style.Picture:
    """Draw the forces of Fig. 8 with a hollow ball at the floor, and those on springs in grey."""
    figure, panels, result, late = _draw_record(bench, stacks.hollow_record)
    on_springs, springs = sample_forces(bench, stacks.spring_record(bench), _TIMES)
    for ax, curve in zip(panels, on_springs, strict=True):
        ax.plot(1e3 * _TIMES, curve, color=style.GREY, lw=0.8)
        ax.set(ylim=(0.0, 1.6 * curve.max()))
    style.note(panels[0], "solid: touching\ndashed: 2 mm apart\ngrey: springs")
    film = stacks.hollow_pair(bench)
    lower, upper = bench.simulate(film).rebound_ratios
    floor, spring = film.contacts
    assert isinstance(floor, HollowBall)
    assert isinstance(spring, Spring)
    return style.describe(
        "8-hollow",
        figure,
        own=1e3 * floor.contact_time_at(film.balls[0].mass, film.reference_speed),
        stiffness=spring.stiffness,
        end=1e3 * result.last_release[0],
        lower=lower,
        upper=upper,
        rise=1e3 * force_above(result, 0, 0.5)[0],
        slower=1e3 * force_above(springs, 0, 0.5)[0],
        touch=1e3 * late.first_touch[1],
        begin=1e3 * force_above(late, 1, 0.03)[0],
        upper_end=1e3 * result.last_release[1],
    )


def _draw_record(
    bench: Bench, record: Callable[[Bench, float], Drop]
) -> tuple[Figure, list[Axes], Result, Result]:
    """Draw the drop of Fig. 8 with the balls touching and apart, and what the text reports of it.

    That is the duration, and the time without a force between the balls.
    """
    figure, panels = style.make_axes(4.2, 2)
    touching = draw_two_panels(bench, panels, record(bench, 0.0), _TIMES)
    apart = draw_two_panels(bench, panels, record(bench, bench("stack.gap")), _TIMES, dashed=True)
    _mark_time(bench, panels[0], "stack.duration", "{:.0f} ms on the floor")
    _mark_time(bench, panels[1], "stack.delay", "no force for {:.0f} ms")
    return figure, panels, touching, apart


def draw_figure_9(bench: Bench) -> style.Picture:
    """Draw the two-spring solution that the paper sets beside Fig. 8."""
    figure, (ax,) = style.make_axes()
    result = draw_one_panel(bench, ax, stacks.better_fit(bench), _TIMES, (7.5, 28.5))
    lower, upper = result.rebound_speeds
    return style.describe(
        "9",
        figure,
        lower=lower,
        upper=upper,
        end=1e3 * result.last_release[0],
        begin=1e3 * force_above(result, 1, 0.03)[0],
    )


def draw_figure_10a(bench: Bench) -> style.Picture:
    """Draw the forces of B2 on B1."""
    drop = stacks.small_fit(bench, stacks.heavier_b1(bench))
    figure, panels, result = _draw_pair(bench, drop, 0.008)
    _mark_time(bench, panels[0], "B2_on_B1.duration", "impact lasts {:.1f} ms")
    end = 1e3 * max(result.last_release)
    return style.describe("10a", figure, touch=1e3 * result.first_touch[1], end=end)


def draw_figure_10b(bench: Bench) -> style.Picture:
    """Draw the forces of B1 on B2."""
    drop = stacks.reversed_pair(bench, bench("superballs.gap"))
    figure, panels, result = _draw_pair(bench, drop, 0.014)
    _mark_time(bench, panels[0], "B1_on_B2.duration", "impact lasts {:.1f} ms")
    return style.describe(
        "10b",
        figure,
        touch=1e3 * result.first_touch[1],
        upper_end=1e3 * result.last_release[1],
        end=1e3 * result.last_release[0],
        floor=len(peak_times(result, 0, result.end_time)),
        between=len(peak_times(result, 1, result.end_time)),
    )


def draw_figure_11a(bench: Bench) -> style.Picture:
    """Draw the forces of B3 on B1."""
    drop = stacks.smallest_fit(bench, stacks.heavier_b1(bench))
    figure, _, result = _draw_pair(bench, drop, 0.008)
    return style.describe("11a", figure, touch=1e3 * result.first_touch[1])


def draw_figure_11b(bench: Bench) -> style.Picture:
    """Draw the forces of B1 on B3."""
    drop = stacks.late_pair(bench)
    figure, panels, result = _draw_pair(bench, drop, 0.034, "superballs.late_delay", 2 * _POINTS)
    number_contacts(panels, result)
    rows = result.intervals
    met = np.flatnonzero(rows["contact"] == 1)
    early = bench.simulate(stacks.early_pair(bench))
    merged = early.intervals[early.intervals["contact"] == 1]
    return style.describe(
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


def draw_figure_12(bench: Bench) -> style.Picture:
    """Draw the forces of two large balls, and whether they are in contact."""
    figure, panels = style.make_axes(5.0, 3, ratios=(3, 3, 1.4))
    times = np.linspace(0.0, 0.014, _POINTS)
    late = draw_two_panels(bench, panels[:2], stacks.late_twins(bench), times)
    early = draw_two_panels(bench, panels[:2], stacks.early_twins(bench), times, dashed=True)
    panels[1].set(xlabel="")
    _mark_time(bench, panels[0], "superballs.twin_duration", "impact lasts {:.0f} ms")
    style.note(panels[1], "dashed: touching\nafter 1 ms")
    _contact(panels[2], late, times)
    parted = bench.simulate(stacks.parted_twins(bench))
    peaks = len(peak_times(late, 0, late.end_time))
    return style.describe(
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


def draw_figure_13(bench: Bench) -> style.Picture:
    """Draw section V's calculation for B2 on B1."""
    figure, (ax,) = style.make_axes()
    drop = stacks.small_fit(bench, stacks.heavier_b1(bench))
    result = draw_one_panel(bench, ax, drop, np.linspace(0.0, 0.007, _POINTS), (1.45, 4.7))
    lower, upper = result.rebound_ratios
    return style.describe("13", figure, lower=lower, upper=upper, touch=1e3 * result.first_touch[1])


def _draw_pair(
    bench: Bench, drop: Drop, end: float, delay: str = "superballs.delay", points: int = _POINTS
) -> tuple[Figure, list[Axes], Result]:
    """Draw the forces of a drop in two panels, up to `end` s, with the measured delay."""
    figure, panels = style.make_axes(4.2, 2)
    result = draw_two_panels(bench, panels, drop, np.linspace(0.0, end, points))
    _mark_time(bench, panels[1], delay, "{:.0f} ms delay")
    return figure, panels, result


def _mark_time(bench: Bench, ax: Axes, key: str, words: str) -> None:
    """Draw a bracket as long as a measured time, with words that have its place in ms."""
    measured = 1e3 * bench(key)
    style.bracket(ax, measured, f"measured: {words.format(measured)}")


def _contact(ax: Axes, result: Result, times: Array) -> None:
    """Draw whether two balls touch, as the paper's copper strips show it."""
    closed = np.zeros_like(times)
    for row in result.intervals[result.intervals["contact"] == 1]:
        closed[(times >= row["start"]) & (times <= row["end"])] = 1.0
    ax.step(1e3 * times, closed, color=style.BLACK)
    ax.set(xlabel=r"$t$ (ms)", ylabel="balls", ylim=(-0.25, 1.25), yticks=(0, 1))
    ax.set_yticklabels(("apart", "touch"))
    ax.tick_params(axis="y", which="minor", left=False, right=False)
