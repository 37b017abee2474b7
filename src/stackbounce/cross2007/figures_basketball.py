"""Figures 7, 8 and 9: the tennis ball on the basketball."""

import numpy as np

from stackbounce.cross2007.bench import Bench
from stackbounce.cross2007.drops import fallen_speed, force_above, spring_pair
from stackbounce.cross2007.force_panels import draw_one_panel, draw_two_panels, format_ms
from stackbounce.cross2007.stacks import better_fit, stack_masses
from stackbounce.cross2007.style import (
    BLACK,
    FLOOR,
    UPPER,
    Feature,
    Picture,
    bracket,
    make_axes,
    note,
)

__all__ = ["draw_figure_7", "draw_figure_8", "draw_figure_9"]

_POINTS = 401


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
    masses = stack_masses(bench)
    stiffnesses = bench("fig9.floor_stiffness"), bench("fig9.ball_stiffness")
    speed = fallen_speed(bench("fig8.drop_height"))
    together = spring_pair(masses, stiffnesses, speed=speed)
    apart = spring_pair(masses, stiffnesses, speed=speed, gap=bench("stack.gap"))
    figure, panels = make_axes(4.2, 2)
    times = np.linspace(0.0, 0.040, _POINTS)
    result = draw_two_panels(bench, panels, together, times)
    late = draw_two_panels(bench, panels, apart, times, dashed=True)
    duration, quiet = bench("stack.duration"), bench("stack.delay")
    bracket(panels[0], 0.0, 1e3 * duration, f"measured: {1e3 * duration:.0f} ms on the floor")
    bracket(panels[1], 0.0, 1e3 * quiet, f"measured: no force for {1e3 * quiet:.0f} ms")
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


def draw_figure_9(bench: Bench) -> Picture:
    """Draw the two-spring solution that the paper sets beside Fig. 8."""
    figure, (ax,) = make_axes()
    result = draw_one_panel(
        bench, ax, better_fit(bench), np.linspace(0.0, 0.040, _POINTS), (7.5, 28.5)
    )
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
