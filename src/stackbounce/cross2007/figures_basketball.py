"""Figures 7, 8 and 9: the tennis ball on the basketball."""

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from stackbounce.cross2007.bench import Bench
from stackbounce.cross2007.curves import sample_forces
from stackbounce.cross2007.drops import force_above
from stackbounce.cross2007.force_panels import draw_one_panel, draw_two_panels
from stackbounce.cross2007.stacks import better_fit, hollow_pair, hollow_record, spring_record
from stackbounce.cross2007.style import (
    BLACK,
    FLOOR,
    GREY,
    UPPER,
    Picture,
    bracket,
    describe,
    make_axes,
    note,
)
from stackbounce.model.drop import Drop
from stackbounce.model.laws import HollowBall, Spring
from stackbounce.run.result import Result

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
    return describe("7", figure, stiffness=1e-4 * stiffness)


def draw_figure_8(bench: Bench) -> Picture:
    """Draw the forces of tennis ball and basketball dropped from 30 cm."""
    figure, panels = make_axes(4.2, 2)
    result, late = _draw_record(bench, panels, spring_record)
    note(panels[0], "solid: touching\ndashed: 2 mm apart")
    return describe(
        "8",
        figure,
        end=1e3 * result.last_release[0],
        touch=1e3 * late.first_touch[1],
        begin=1e3 * force_above(result, 1, 0.03)[0],
    )


def draw_figure_8_hollow(bench: Bench) -> Picture:
    """Draw the forces of Fig. 8 with a hollow ball at the floor, and those on springs in grey."""
    figure, panels = make_axes(4.2, 2)
    result, late = _draw_record(bench, panels, hollow_record)
    on_springs, springs = sample_forces(bench, spring_record(bench), _TIMES)
    for ax, curve in zip(panels, on_springs, strict=True):
        ax.plot(1e3 * _TIMES, curve, color=GREY, lw=0.8)
        ax.set(ylim=(0.0, 1.6 * curve.max()))
    note(panels[0], "solid: touching\ndashed: 2 mm apart\ngrey: springs")
    film = hollow_pair(bench)
    lower, upper = bench.simulate(film).rebound_ratios
    floor, spring = film.contacts
    assert isinstance(floor, HollowBall)
    assert isinstance(spring, Spring)
    return describe(
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
    bench: Bench, panels: "list[Axes]", record: Callable[[Bench, float], Drop]
) -> tuple[Result, Result]:
    """Draw the drop of Fig. 8 with the balls touching and apart, and what the text reports of it.

    That is the duration, and the time without a force between the balls.
    """
    touching = draw_two_panels(bench, panels, record(bench, 0.0), _TIMES)
    apart = draw_two_panels(bench, panels, record(bench, bench("stack.gap")), _TIMES, dashed=True)
    duration, quiet = 1e3 * bench("stack.duration"), 1e3 * bench("stack.delay")
    bracket(panels[0], duration, f"measured: {duration:.0f} ms on the floor")
    bracket(panels[1], quiet, f"measured: no force for {quiet:.0f} ms")
    return touching, apart


def draw_figure_9(bench: Bench) -> Picture:
    """Draw the two-spring solution that the paper sets beside Fig. 8."""
    figure, (ax,) = make_axes()
    result = draw_one_panel(bench, ax, better_fit(bench), _TIMES, (7.5, 28.5))
    lower, upper = result.rebound_speeds
    return describe(
        "9",
        figure,
        lower=lower,
        upper=upper,
        end=1e3 * result.last_release[0],
        begin=1e3 * force_above(result, 1, 0.03)[0],
    )
