"""Figures 10 to 13: pairs of superballs."""

from typing import TYPE_CHECKING

import numpy as np

from stackbounce.cross2007.bench import Bench
from stackbounce.cross2007.drops import Array, peak_times
from stackbounce.cross2007.force_panels import (
    draw_one_panel,
    draw_two_panels,
    format_ms,
    number_contacts,
)
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
from stackbounce.cross2007.style import BLACK, Feature, Picture, bracket, make_axes, note
from stackbounce.run.result import Result

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_POINTS = 401
_HEAVIER = "Mass of B1: 105 g, which Table II's ratios ask for; Table I has 101 g."


def draw_figure_10a(bench: Bench) -> Picture:
    """Draw the forces of B2 on B1."""
    figure, panels = make_axes(4.2, 2)
    drop = small_fit(bench, heavier_b1(bench))
    result = draw_two_panels(bench, panels, drop, np.linspace(0.0, 0.008, _POINTS))
    duration = 1e3 * bench("B2_on_B1.duration")
    bracket(panels[0], 0.0, duration, f"measured: impact lasts {duration:.1f} ms")
    _delay(bench, panels[1], "superballs.delay")
    return Picture(
        "10a",
        "Middle ball B2 on large ball B1: forces",
        "Forces on the floor and between the balls by section V's model, with loss at the floor.",
        ("Parameters: those of Fig. 13.", _HEAVIER),
        (
            Feature("balls touch", "2 ms", format_ms(result.first_touch[1])),
            Feature("impact ends", "6.0 ms", format_ms(float(max(result.last_release)))),
        ),
        figure,
    )


def draw_figure_10b(bench: Bench) -> Picture:
    """Draw the forces of B1 on B2."""
    figure, panels = make_axes(4.2, 2)
    drop = reversed_pair(bench, bench("superballs.gap"))
    result = draw_two_panels(bench, panels, drop, np.linspace(0.0, 0.014, _POINTS))
    duration = 1e3 * bench("B1_on_B2.duration")
    bracket(panels[0], 0.0, duration, f"measured: impact lasts {duration:.1f} ms")
    _delay(bench, panels[1], "superballs.delay")
    floor, between = (len(peak_times(result, i, result.end_time)) for i in (0, 1))
    return Picture(
        "10b",
        "Large ball B1 on middle ball B2: forces",
        "Forces on the floor and between the balls on springs without loss, 1 mm apart at first. "
        "The small ball goes to and fro between the two without letting go of either.",
        (
            "Stiffnesses: B2's own dynamic one at the floor, Fig. 13's between the balls.",
            "No loss, as in the paper's own calculations for this order.",
        ),
        (
            Feature("balls touch", "2 ms", format_ms(result.first_touch[1])),
            Feature("ball-ball force ends", "9.0 ms", format_ms(result.last_release[1])),
            Feature("floor force ends", "9.0 ms", format_ms(result.last_release[0])),
            Feature("peaks at the floor", "three collisions", str(floor)),
            Feature("peaks between the balls", "three collisions", str(between)),
        ),
        figure,
    )


def draw_figure_11a(bench: Bench) -> Picture:
    """Draw the forces of B3 on B1."""
    figure, panels = make_axes(4.2, 2)
    drop = smallest_fit(bench, heavier_b1(bench))
    result = draw_two_panels(bench, panels, drop, np.linspace(0.0, 0.008, _POINTS))
    _delay(bench, panels[1], "superballs.delay")
    return Picture(
        "11a",
        "Small ball B3 on large ball B1: forces",
        "Forces on the floor and between the balls by section V's model, with loss at the floor.",
        (
            "Parameters: section V's for B3 on B1, 2.4 mm apart.",
            _HEAVIER,
            "No vibration of B1's top, which the text sees up to 2.5 ms and from 5 ms on.",
        ),
        (Feature("balls touch", "2 ms", format_ms(result.first_touch[1])),),
        figure,
    )


def draw_figure_11b(bench: Bench) -> Picture:
    """Draw the forces of B1 on B3."""
    figure, panels = make_axes(4.2, 2)
    result = draw_two_panels(bench, panels, late_pair(bench), np.linspace(0.0, 0.034, 2 * _POINTS))
    number_contacts(panels, result)
    _delay(bench, panels[1], "superballs.late_delay")
    rows = result.intervals
    met = np.flatnonzero(rows["contact"] == 1)
    early = bench.simulate(early_pair(bench))
    merged = early.intervals[early.intervals["contact"] == 1]
    subpeaks = len(peak_times(early, 1, early.end_time))
    gap = 1e3 * result.drop.gaps[0]
    return Picture(
        "11b",
        "Large ball B1 on small ball B3: forces",
        "Forces on the floor and between the balls on springs without loss, so far apart at first "
        "that they touch after the measured 7 ms. Contacts are numbered; the eleventh comes later.",
        (
            "Stiffnesses: B3's dynamic one at the floor, section V's between the balls; no loss.",
            f"Separation: {gap:.0f} mm, which gives the measured delay.",
            "The nine are counted from the first to the last contact between the balls.",
        ),
        (
            Feature("contacts, first to last ball-ball", "nine", str(met[-1] - met[0] + 1)),
            Feature("all contacts", "", str(len(rows))),
            Feature("ball-ball contacts", "a first and four last", str(len(met))),
            Feature("the tenth contact", "", _begins(rows[9])),
            Feature("the eleventh contact", "", _begins(rows[10])),
            Feature("ball-ball contacts, meeting at 2 ms", "one broad peak", str(len(merged))),
            Feature("its peaks", "four subpeaks", str(subpeaks)),
            Feature("it ends", "", format_ms(merged[-1]["end"])),
        ),
        figure,
    )


def draw_figure_12(bench: Bench) -> Picture:
    """Draw the forces of two large balls, and whether they are in contact."""
    figure, panels = make_axes(5.0, 3, ratios=(3, 3, 1.4))
    times = np.linspace(0.0, 0.014, _POINTS)
    late = draw_two_panels(bench, panels[:2], late_twins(bench), times)
    early = draw_two_panels(bench, panels[:2], early_twins(bench), times, dashed=True)
    panels[1].set(xlabel="")
    duration = 1e3 * bench("superballs.twin_duration")
    bracket(panels[0], 0.0, duration, f"measured: impact lasts {duration:.0f} ms")
    note(panels[1], "dashed: touching\nafter 1 ms")
    _contact(panels[2], late, times)
    parted = bench.simulate(parted_twins(bench))
    gaps = 1e3 * late.drop.gaps[0], 1e3 * early.drop.gaps[0]
    return Picture(
        "12",
        "Large ball B1 on another B1: forces and contact",
        "Forces on the floor and between the balls on springs without loss, and (b) whether the "
        "balls touch. Solid: so far apart at first that the impact lasts the measured 12 ms. "
        "Dashed: touching after 1 ms.",
        (
            "Stiffnesses: B1's dynamic one at the floor, half of it between two such balls.",
            "Masses: 105 g below, 101 g above, by the ratio 1.040; no loss.",
            f"Separations: {gaps[0]:.1f} mm (solid), {gaps[1]:.2f} mm (dashed), from 12 and 1 ms.",
        ),
        (
            Feature("floor contacts, 12 ms impact", "two peaks", str(late.collisions[0])),
            Feature("dip in the second peak", "yes", _dip(late)),
            Feature(
                "lower ball off the floor before they touch",
                "yes (Sec. VI)",
                f"no: touch {format_ms(late.first_touch[1])}, "
                f"off {format_ms(late.intervals[0]['end'])}",
            ),
            Feature(
                f"impact ends if it is ({1e3 * parted.drop.gaps[0]:.1f} mm apart)",
                "12 ms",
                format_ms(parted.last_release[0]),
            ),
            Feature("impact ends, meeting after 1 ms", "9 ms", format_ms(early.last_release[0])),
            Feature("floor contacts, meeting after 1 ms", "one peak", str(early.collisions[0])),
            Feature("its peaks", "two subpeaks", str(len(peak_times(early, 0, early.end_time)))),
        ),
        figure,
    )


def draw_figure_13(bench: Bench) -> Picture:
    """Draw section V's calculation for B2 on B1."""
    figure, (ax,) = make_axes()
    drop = small_fit(bench, heavier_b1(bench))
    result = draw_one_panel(bench, ax, drop, np.linspace(0.0, 0.007, _POINTS), (1.45, 4.7))
    lower, upper = result.rebound_ratios
    return Picture(
        "13",
        "Middle ball B2 on large ball B1: mass-spring model",
        "Forces by section V's model: 1 mm apart, loss at the floor (restitution 0.78), 5.6e4 and "
        "1.6e4 N/m.",
        (
            "The curves: force of the floor F1 and between the balls F2, in newtons.",
            "Impact speed: that of a fall of 20 cm.",
            _HEAVIER,
            "Time axis: from 0 to 7 ms.",
        ),
        (
            Feature("e1", "0.24", f"{lower:.3f}"),
            Feature("e2", "1.83", f"{upper:.3f}"),
            Feature("balls touch", "2 ms (Fig. 10a)", format_ms(result.first_touch[1])),
        ),
        figure,
    )


def _begins(row: np.void) -> str:
    return f"from {format_ms(row['start'])}, peak {row['peak_force']:.1f} N"


def _dip(result: Result) -> str:
    """Whether the floor's force has more peaks than contact intervals."""
    return "yes" if len(peak_times(result, 0, result.end_time)) > result.collisions[0] else "no"


def _delay(bench: Bench, ax: "Axes", key: str) -> None:
    delay = 1e3 * bench(key)
    bracket(ax, 0.0, delay, f"measured: {delay:.0f} ms delay")


def _contact(ax: "Axes", result: Result, times: Array) -> None:
    """Draw whether two balls touch, as the paper's copper strips show it."""
    closed = np.zeros_like(times)
    for row in result.intervals[result.intervals["contact"] == 1]:
        closed[(times >= row["start"]) & (times <= row["end"])] = 1.0
    ax.step(1e3 * times, closed, color=BLACK)
    ax.set(xlabel=r"$t$ (ms)", ylabel="balls", ylim=(-0.25, 1.25), yticks=(0, 1))
    ax.set_yticklabels(("apart", "touch"))
    ax.tick_params(axis="y", which="minor", left=False, right=False)
