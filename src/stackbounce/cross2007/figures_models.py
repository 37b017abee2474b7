"""Figures 2, 4, 5 and 6: both models of two balls."""

from typing import TYPE_CHECKING

import numpy as np

from stackbounce.cross2007.bench import Bench
from stackbounce.cross2007.curves import (
    after_collision,
    rebound_by_mass,
    rebound_by_stiffness,
    sample_forces,
)
from stackbounce.cross2007.drops import Array, spring_pair
from stackbounce.cross2007.lines import AFTER_FIRST, AFTER_SECOND, STIFFNESS, pair_mass_ratios
from stackbounce.cross2007.style import (
    BLACK,
    FLOOR,
    GREY,
    UPPER,
    Feature,
    Picture,
    make_axes,
    tag,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_POINTS = 241


def draw_figure_2a(bench: Bench) -> Picture:
    """Draw the velocities after the first ball-ball collision against the mass ratio."""
    figure, (ax,) = make_axes()
    ratios = np.linspace(AFTER_FIRST.low, AFTER_FIRST.high, _POINTS)
    lossless = after_collision(bench, ratios, bench("models.lossless"), 1)
    lossy = after_collision(bench, ratios, bench("models.restitution"), 1)
    _two_curves(ax, ratios, lossless, "-")
    _two_curves(ax, ratios, lossy, "--")
    tag(ax, ratios, lossless[1], 5.0, r"$v_2/v_0$,  $e=1$", UPPER)
    tag(ax, ratios, lossy[1], 7.0, r"$v_2/v_0$,  $e=0.8$", UPPER, above=False)
    tag(ax, ratios, lossless[0], 7.0, r"$v_1/v_0$,  $e=1$", FLOOR)
    tag(ax, ratios, ratios * 0.0, 7.0, r"$v_1/v_0$,  $e=0.8$", FLOOR, above=False)
    ax.set(xlabel=r"$m_1/m_2$", ylabel=r"$v/v_0$", xlim=(0, 10), ylim=(-3, 3))
    return Picture(
        "2a",
        "After the first collision of the two balls",
        "Velocities v1 of the lower and v2 of the upper ball right after their first collision, "
        "separate collisions (eqs 1 and 2), e = 1 (solid) and 0.8 (dashed).",
        (
            "The mass ratio runs from 0 to 10: the text reads the figure at 10.",
            "Solid for e = 1 and dashed for 0.8; the caption does not say.",
        ),
        (Feature("v2/v0 at m1/m2 = 10, e = 1", "2.64", f"{lossless[1, -1]:.3f}"),),
        figure,
    )


def draw_figure_2b(bench: Bench) -> Picture:
    """Draw the velocities after the second ball-ball collision against the mass ratio."""
    figure, (ax,) = make_axes()
    most = 0.9999 * AFTER_SECOND.high  # where the second collision ends for e = 1
    ratios = np.linspace(AFTER_SECOND.low, most, _POINTS)
    lossless = after_collision(bench, ratios, bench("models.lossless"), 2)
    lossy = after_collision(bench, ratios, bench("models.restitution"), 2)
    _two_curves(ax, ratios, lossless, "-")
    _two_curves(ax, ratios, lossy, "--")
    tag(ax, ratios, lossless[1], 0.5, r"$v_4/v_0$,  $e=1$", UPPER)
    tag(ax, ratios, lossy[1], 0.5, r"$e=0.8$", UPPER, above=False)
    ax.text(0.285, -1.6, r"$v_3/v_0$,  $e=1$", color=FLOOR, va="top")
    ax.text(0.17, -1.7, r"$e=0.8$", color=FLOOR, ha="right", va="bottom")
    ax.set(xlabel=r"$m_1/m_2$", ylabel=r"$v/v_0$", xlim=(0, 1), ylim=(-5, 2))
    stop = float(np.interp(0.0, lossless[0], ratios))
    return Picture(
        "2b",
        "After the second collision of the two balls",
        "Velocities v3 of the lower and v4 of the upper ball right after their second collision "
        "(eqs 3 and 4), which takes place where m1 is at most about m2; e = 1 (solid), 0.8 "
        "(dashed).",
        ("The mass ratio runs from 0 to 1, where the second collision ends for e = 1.",),
        (Feature("m1/m2 at which the lower ball stops, e = 1", "0.52", f"{stop:.3f}"),),
        figure,
    )


def draw_figure_4a(bench: Bench) -> Picture:
    """Draw the rebound ratios on equal springs against the mass ratio."""
    return _rebound(bench, "4a", bench("models.stiffness_ratio"), 4.0)


def draw_figure_4b(bench: Bench) -> Picture:
    """Draw the rebound ratios on a stiff lower spring against the mass ratio."""
    return _rebound(bench, "4b", bench("fig5.floor_stiffness") / bench("fig5.ball_stiffness"), 7.0)


def draw_figure_5(bench: Bench) -> Picture:
    """Draw displacements and forces of two masses whose collisions are nearly separate."""
    figure, (motion, force) = make_axes(4.2, 2)
    masses = bench("fig5.lower_mass"), bench("fig5.upper_mass")
    stiffnesses = bench("fig5.floor_stiffness"), bench("fig5.ball_stiffness")
    drop = spring_pair(masses, stiffnesses, speed=bench("models.speed"))
    times = np.linspace(0.0, 0.040, 401)
    (floor, between), result = sample_forces(bench, drop, times)
    place = -1e3 * np.asarray(result.sample(times)["position"].values)
    ms = 1e3 * times
    motion.plot(ms, place[0], color=FLOOR)
    motion.plot(ms, place[1], color=UPPER)
    motion.axhline(0.0, color=GREY, lw=0.6, zorder=0)
    motion.text(12.2, -4.2, "lower mass, $x$", color=FLOOR, va="top", ha="center")
    motion.text(9.8, 7.5, "upper mass, $y$", color=UPPER, va="bottom", ha="center")
    motion.set(ylabel="displacement (mm)", ylim=(-11, 11))
    force.plot(ms, floor, color=FLOOR)
    force.plot(ms, between, color=UPPER)
    force.text(5.6, 160.0, "end stop", color=FLOOR)
    tag(force, ms, between, 14.4, "between the masses", UPPER)
    force.set(xlabel=r"$t$ (ms)", ylabel=r"force (N)", xlim=(0, 40), ylim=(0, 240))
    ends = result.intervals["end"] * 1e3
    starts = result.intervals["start"] * 1e3
    for moment in (5.0, 19.0, 29.0):
        for ax in (motion, force):
            ax.axvline(moment, color=GREY, lw=0.6, ls=":", zorder=0)
    return Picture(
        "5",
        "Two collisions with the end stop, one between the masses",
        "Masses of 0.4 and 0.2 kg on springs of 1e5 and 5e3 N/m. Above: displacement toward the "
        "end stop. Below: the forces. Dotted: the text's 5, 19 and 29 ms.",
        (
            "The impact speed is 1 m/s, as in the paper's simplest case.",
            "The quantities drawn: displacements x and y toward the end stop, and the forces.",
        ),
        (
            Feature("first end-stop contact ends", "5 ms", f"{ends[0]:.2f} ms"),
            Feature("contact of the masses ends", "19 ms", f"{ends[1]:.2f} ms"),
            Feature("second end-stop contact begins", "29 ms", f"{starts[2]:.2f} ms"),
        ),
        figure,
    )


def draw_figure_6(bench: Bench) -> Picture:
    """Draw the rebound ratios against the stiffness ratio for three mass ratios."""
    figure, (ax,) = make_axes(3.3, right=0.4)
    ratios = np.geomspace(STIFFNESS.low, STIFFNESS.high, _POINTS)
    colors = (BLACK, FLOOR, UPPER)
    for mass_ratio, color in zip(pair_mass_ratios(bench), colors, strict=True):
        lower, upper = rebound_by_stiffness(bench, mass_ratio, ratios)
        ax.semilogx(ratios, lower, "--", color=color)
        ax.semilogx(ratios, upper, "-", color=color)
        for curve in (lower, upper):
            ax.text(112, curve[-1], f"{mass_ratio:.3g}", color=color, va="center")
    ax.text(112, 2.9, r"$r_m$", va="center")
    ax.text(22, 2.62, "$e_2$", va="center")
    ax.text(22, 0.58, "$e_1$", va="center")
    ax.xaxis.set_major_formatter("{x:g}")
    ax.set(xlabel=r"$r_k=k_1/k_2$", ylabel=r"$v/v_0$", xlim=(0.1, 100), ylim=(0, 3))
    return Picture(
        "6",
        "Rebound against stiffness ratio",
        "Rebound ratios e1 of the lower (dashed) and e2 of the upper ball (solid) on springs, for "
        "three mass ratios r_m.",
        (
            "The mass ratios: 2.63, 4.23 and 12.3, section III's and IV's light balls on top.",
            "The axis of r_k: from 0.1 to 100, logarithmic.",
        ),
        (),
        figure,
    )


def _two_curves(ax: "Axes", xs: Array, pair: Array, style: str) -> None:
    ax.plot(xs, pair[0], style, color=FLOOR)
    ax.plot(xs, pair[1], style, color=UPPER)
    ax.axhline(0.0, color=GREY, lw=0.6, zorder=0)


def _rebound(bench: Bench, name: str, stiffness_ratio: float, at: float) -> Picture:
    figure, (ax,) = make_axes()
    ratios = AFTER_FIRST.high * np.linspace(0.045, 1.0, _POINTS) ** 2  # finer where the curves wind
    pair = rebound_by_mass(bench, ratios, stiffness_ratio)
    _two_curves(ax, ratios, pair, "-")
    tag(ax, ratios, pair[1], at, r"$v_2/v_0$", UPPER)
    tag(ax, ratios, pair[0], at, r"$v_1/v_0$", FLOOR, above=False)
    ax.set(xlabel=r"$m_1/m_2$", ylabel=r"$v/v_0$", xlim=(0, 10), ylim=(0, 3))
    ax.text(0.04, 0.93, rf"$k_1/k_2={stiffness_ratio:g}$", transform=ax.transAxes, va="top")
    return Picture(
        name,
        f"On springs, stiffness ratio {stiffness_ratio:g}",
        "Rebound ratios of two masses that stay in contact on springs (eqs 5 and 6), "
        f"k1/k2 = {stiffness_ratio:g}, after the last contact.",
        ("The mass ratio runs from 0 to 10, as in Fig. 2a.",),
        (),
        figure,
    )
