"""Figures 7, 8 and 9: the tennis ball on the basketball."""

from typing import TYPE_CHECKING

import numpy as np

from stackbounce.cross2007.bench import Bench
from stackbounce.cross2007.curves import sample_forces
from stackbounce.cross2007.drops import force_above
from stackbounce.cross2007.force_panels import draw_one_panel, draw_two_panels, format_ms
from stackbounce.cross2007.stacks import better_fit, hollow_pair, hollow_record, spring_record
from stackbounce.cross2007.style import (
    BLACK,
    FLOOR,
    GREY,
    UPPER,
    Feature,
    Picture,
    bracket,
    make_axes,
    note,
)
from stackbounce.model.drop import Drop
from stackbounce.model.laws import HollowBall, Spring

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_TIMES = np.linspace(0.0, 0.040, 401)  # s


def draw_figure_7(bench: Bench) -> Picture:
    """Draw force against compression, from the points that the text gives."""
    figure, (ax,) = make_axes()
    force = bench("static.force")
    for key, text, color, place in (
        ("static.tennis", "tennis ball", UPPER, (0.4, 29.0)),
        ("static.basketball", "basketball", FLOOR, (-5.9, 29.4)),
        ("static.both", "tennis ball\non basketball", BLACK, (-6.0, 18.0)),
    ):
        compression = 1e3 * bench(key)
        ax.plot([0.0, compression], [0.0, force], color=color)
        ax.plot([compression], [force], "o", color=color, ms=4.5)
        ax.text(compression + place[0], place[1], text, color=color)
    ax.set(xlabel="compression (mm)", ylabel=r"$F$ (N)", xlim=(0, 30), ylim=(0, 35))
    stiffness = force / bench("static.tennis")
    return Picture(
        "7",
        "Static compression",
        "Force against compression between parallel plates: the three points that the text gives "
        "at 30 N, with the linear fit that it suggests.",
        (
            "Straight lines: the measured curves, which bend slightly, are lost.",
            "Both axes: from zero to a little beyond the points.",
        ),
        (Feature("tennis ball's stiffness", "1.03e4 N/m", f"{1e-4 * stiffness:.3f}e4 N/m"),),
        figure,
    )


def draw_figure_8(bench: Bench) -> Picture:
    """Draw the forces of tennis ball and basketball dropped from 30 cm."""
    figure, panels = make_axes(4.2, 2)
    result = draw_two_panels(bench, panels, spring_record(bench), _TIMES)
    apart = spring_record(bench, bench("stack.gap"))
    late = draw_two_panels(bench, panels, apart, _TIMES, dashed=True)
    _mark_measured(bench, panels)
    note(panels[0], "solid: touching\ndashed: 2 mm apart")
    return Picture(
        "8",
        "Tennis ball on basketball: forces",
        "Forces on the floor and between the balls after a fall of 30 cm, on Fig. 9's springs; the "
        "balls come in touching (solid) or 2 mm apart (dashed).",
        (
            "Stiffnesses: those of Fig. 9, without loss.",
            "Force axes: in newtons; the paper's signals are volts without a calibration.",
            "The measured floor signal's two peaks are left out: the text calls them spurious.",
        ),
        (
            Feature("floor force ends", "30 ms", format_ms(result.last_release[0])),
            Feature("balls touch, 2 mm apart", "7 ms", format_ms(late.first_touch[1])),
            Feature(
                "3 % of the ball-ball peak, touching",
                "7 ms",
                format_ms(force_above(result, 1, 0.03)[0]),
            ),
        ),
        figure,
    )


def draw_figure_8_hollow(bench: Bench) -> Picture:
    """Draw the forces of Fig. 8 with a hollow ball at the floor, and those on springs in grey."""
    figure, panels = make_axes(4.2, 2)
    result = draw_two_panels(bench, panels, hollow_record(bench), _TIMES)
    apart = hollow_record(bench, bench("stack.gap"))
    late = draw_two_panels(bench, panels, apart, _TIMES, dashed=True)
    on_springs, springs = sample_forces(bench, spring_record(bench), _TIMES)
    for ax, curve in zip(panels, on_springs, strict=True):
        ax.plot(1e3 * _TIMES, curve, color=GREY, lw=0.8)
        ax.set(ylim=(0.0, 1.6 * curve.max()))
    _mark_measured(bench, panels)
    note(panels[0], "solid: touching\ndashed: 2 mm apart\ngrey: springs")
    film = hollow_pair(bench)
    lower, upper = bench.simulate(film).rebound_ratios
    rise, slower = (format_ms(force_above(run, 0, 0.5)[0]) for run in (result, springs))
    quiet = format_ms(force_above(late, 1, 0.03)[0])
    return Picture(
        "8-hollow",
        "Tennis ball on basketball: a hollow ball at the floor",
        "The drop of Fig. 8 with a basketball that is stiff until its wall buckles. The fast rise "
        "of the floor force comes out because it is put in. The 7 ms without a force between the "
        "balls do not: what stops the basketball early brings the balls together early.",
        _hollow_guesses(film),
        (
            Feature("floor force ends", "30 ms, set", format_ms(result.last_release[0])),
            Feature("v1/v0", "0.18, set", f"{lower:.3f}"),
            Feature("v2/v0", "1.64", f"{upper:.3f}"),
            Feature("floor force at half of its peak", "", f"{rise}; on springs {slower}"),
            Feature("balls touch, 2 mm apart", "7 ms", format_ms(late.first_touch[1])),
            Feature("3 % of the ball-ball peak, 2 mm apart", "7 ms", quiet),
            Feature("ball-ball force ends", "", format_ms(result.last_release[1])),
        ),
        figure,
    )


def _hollow_guesses(film: Drop) -> tuple[str, ...]:
    """Return what Fig. 8 with a hollow ball assumes."""
    floor, spring = film.contacts
    assert isinstance(floor, HollowBall)
    assert isinstance(spring, Spring)
    own = 1e3 * floor.contact_time_at(film.balls[0].mass, film.reference_speed)
    set_by = (
        f"The basketball's own contact time, {own:.0f} ms, and the spring between the balls, "
        f"{spring.stiffness:.0f} N/m: set so that the floor force lasts 30 ms and v1/v0 is 0.18."
    )
    return (
        "The wall buckles after 4 % of the basketball's own contact time, at half its peak force.",
        "The basketball has the restitution of its bounce alone; the spring loses nothing.",
        set_by,
        "The measured waveform is not available, only what the text says of it.",
    )


def _mark_measured(bench: Bench, panels: "list[Axes]") -> None:
    """Mark what the text reports of the force record: its duration, and the time without F2."""
    duration, quiet = bench("stack.duration"), bench("stack.delay")
    bracket(panels[0], 0.0, 1e3 * duration, f"measured: {1e3 * duration:.0f} ms on the floor")
    bracket(panels[1], 0.0, 1e3 * quiet, f"measured: no force for {1e3 * quiet:.0f} ms")


def draw_figure_9(bench: Bench) -> Picture:
    """Draw the two-spring solution that the paper sets beside Fig. 8."""
    figure, (ax,) = make_axes()
    result = draw_one_panel(bench, ax, better_fit(bench), _TIMES, (7.5, 28.5))
    lower, upper = result.rebound_speeds
    return Picture(
        "9",
        "Tennis ball on basketball: two springs",
        "Forces of the solution with 2500 N/m at the floor and 1000 N/m between the balls, "
        "v0 = 3.53 m/s.",
        (
            "The curves: force of the floor F1 and between the balls F2, in newtons.",
            "The time axis: from 0 to 40 ms.",
        ),
        (
            Feature("v1", "1.34 m/s", f"{lower:.3f} m/s"),
            Feature("v2", "6.37 m/s", f"{upper:.3f} m/s"),
            Feature("floor force ends", "30 ms", format_ms(result.last_release[0])),
            Feature(
                "3 % of the ball-ball peak", "5 ms", format_ms(force_above(result, 1, 0.03)[0])
            ),
        ),
        figure,
    )
