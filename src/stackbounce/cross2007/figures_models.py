"""Figures 2, 4, 5 and 6: both models of two balls, and the curves of them as arrays."""

from typing import Any

import numpy as np

from stackbounce.cross2007.bench import Bench
from stackbounce.cross2007.cases import AFTER_FIRST, AFTER_SECOND, STIFFNESS, pair_mass_ratios
from stackbounce.cross2007.drops import Array, after_meeting, rigid_pair, spring_pair
from stackbounce.cross2007.stacks import figure_5
from stackbounce.cross2007.style import BLACK, FLOOR, GREY, UPPER, Picture, describe, make_axes, tag
from stackbounce.library_types import Axes
from stackbounce.model.drop import Drop
from stackbounce.run.result import Result

_POINTS = 241


def after_collision(bench: Bench, ratios: Array, restitution: float, count: int) -> Array:
    """Return both velocities right after the balls' `count`-th separate collision, over v0.

    Parameters
    ----------
    bench : Bench
        Simulates the drops.
    ratios : ndarray
        (R,) mass ratios m1/m2.
    restitution : float
        Of both contacts.
    count : int
        1 for v1 and v2 (eqs 1 and 2), 2 for v3 and v4 (eqs 3 and 4).

    Returns
    -------
    ndarray
        (2, R), lower and upper ball; nan where they do not collide that often.
    """
    results = [bench.simulate(rigid_pair((ratio, 1.0), restitution)) for ratio in ratios.tolist()]
    pairs = np.array([after_meeting(result, count) for result in results]).T
    return _recorded(bench, "velocity_ratio", pairs, mass_ratio=ratios, restitution=[restitution])


def rebound_by_mass(bench: Bench, ratios: Array, stiffness_ratio: float) -> Array:
    """Return both rebound ratios of a drop on springs for mass ratios m1/m2, (2, R)."""
    drops = [spring_pair((ratio, 1.0), (stiffness_ratio, 1.0)) for ratio in ratios.tolist()]
    return _rebounds(bench, drops, mass_ratio=ratios, stiffness_ratio=[stiffness_ratio])


def rebound_by_stiffness(bench: Bench, mass_ratio: float, ratios: Array) -> Array:
    """Return both rebound ratios of a drop on springs for stiffness ratios k1/k2, (2, R)."""
    drops = [spring_pair((mass_ratio, 1.0), (ratio, 1.0)) for ratio in ratios.tolist()]
    return _rebounds(bench, drops, stiffness_ratio=ratios, mass_ratio=[mass_ratio])


def _rebounds(bench: Bench, drops: list[Drop], **places: Any) -> Array:
    """Return both rebound ratios of each drop, (2, R), and record them."""
    pairs = np.array([bench.simulate(drop).rebound_ratios for drop in drops]).T
    return _recorded(bench, "rebound_ratio", pairs, **places)


def _recorded(bench: Bench, name: str, pairs: Array, **places: Any) -> Array:
    """Record curves (2, R) over the first of two ratios, at one value of the second."""
    import xarray as xr

    over, along = places
    coords = {key: (key, values, {"units": "1"}) for key, values in places.items()}
    array = ((along, "ball", over), pairs[None], {"units": "1"})
    bench.curves.append(xr.Dataset({name: array}, {**coords, "ball": [0, 1]}))
    return pairs


def sample_forces(bench: Bench, drop: Drop, times: Array) -> tuple[Array, Result]:
    """Return the forces at floor and between the balls in N, (2, T), and the drop's result."""
    result = bench.simulate(drop)
    curves = result.sample(times).expand_dims("run")
    gap, floor = ("run", list(drop.gaps), {"units": "m"}), type(drop.contacts[0]).__name__
    bench.curves.append(curves.assign_coords(gap=gap, floor=("run", [floor])))
    return np.asarray(curves["force"].values[0]), result


def draw_figure_2a(bench: Bench) -> Picture:
    """Draw the velocities after the first ball-ball collision against the mass ratio."""
    figure, (ax,) = make_axes()
    ratios = np.linspace(AFTER_FIRST.low, AFTER_FIRST.high, _POINTS)
    lossless, lossy = _draw_separate(bench, ax, ratios, 1)
    tag(ax, ratios, lossless[1], 5.0, r"$v_2/v_0$,  $e=1$", UPPER)
    tag(ax, ratios, lossy[1], 7.0, r"$v_2/v_0$,  $e=0.8$", UPPER, above=False)
    tag(ax, ratios, lossless[0], 7.0, r"$v_1/v_0$,  $e=1$", FLOOR)
    tag(ax, ratios, ratios * 0.0, 7.0, r"$v_1/v_0$,  $e=0.8$", FLOOR, above=False)
    ax.set(xlim=(0, 10), ylim=(-3, 3))
    return describe("2a", figure, upper=lossless[1, -1])


def draw_figure_2b(bench: Bench) -> Picture:
    """Draw the velocities after the second ball-ball collision against the mass ratio."""
    figure, (ax,) = make_axes()
    most = 0.9999 * AFTER_SECOND.high  # where the second collision ends for e = 1
    ratios = np.linspace(AFTER_SECOND.low, most, _POINTS)
    lossless, lossy = _draw_separate(bench, ax, ratios, 2)
    tag(ax, ratios, lossless[1], 0.5, r"$v_4/v_0$,  $e=1$", UPPER)
    tag(ax, ratios, lossy[1], 0.5, r"$e=0.8$", UPPER, above=False)
    ax.text(0.285, -1.6, r"$v_3/v_0$,  $e=1$", color=FLOOR, va="top")
    ax.text(0.17, -1.7, r"$e=0.8$", color=FLOOR, ha="right", va="bottom")
    ax.set(xlim=(0, 1), ylim=(-5, 2))
    return describe("2b", figure, stop=np.interp(0.0, lossless[0], ratios))


def draw_figure_4a(bench: Bench) -> Picture:
    """Draw the rebound ratios on equal springs against the mass ratio."""
    return _rebound(bench, "4a", bench("models.stiffness_ratio"), 4.0)


def draw_figure_4b(bench: Bench) -> Picture:
    """Draw the rebound ratios on a stiff lower spring against the mass ratio."""
    return _rebound(bench, "4b", bench("fig5.floor_stiffness") / bench("fig5.ball_stiffness"), 7.0)


def draw_figure_5(bench: Bench) -> Picture:
    """Draw displacements and forces of two masses whose collisions are nearly separate."""
    figure, (motion, force) = make_axes(4.2, 2)
    times = np.linspace(0.0, 0.040, 401)
    (floor, between), result = sample_forces(bench, figure_5(bench), times)
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
    return describe("5", figure, first=ends[0], between=ends[1], second=starts[2])


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
    return describe("6", figure, upper=bench.curves[-1]["rebound_ratio"].values[0, 1, -1])


def _draw_separate(bench: Bench, ax: Axes, ratios: Array, count: int) -> tuple[Array, Array]:
    """Draw and return the velocities after the balls' `count`-th collision, for both e."""
    lossless = after_collision(bench, ratios, bench("models.lossless"), count)
    lossy = after_collision(bench, ratios, bench("models.restitution"), count)
    _two_curves(ax, ratios, lossless, "-")
    _two_curves(ax, ratios, lossy, "--")
    return lossless, lossy


def _two_curves(ax: Axes, ratios: Array, pair: Array, style: str) -> None:
    ax.plot(ratios, pair[0], style, color=FLOOR)
    ax.plot(ratios, pair[1], style, color=UPPER)
    ax.axhline(0.0, color=GREY, lw=0.6, zorder=0)
    ax.set(xlabel=r"$m_1/m_2$", ylabel=r"$v/v_0$")


def _rebound(bench: Bench, name: str, stiffness_ratio: float, at: float) -> Picture:
    figure, (ax,) = make_axes()
    ratios = AFTER_FIRST.high * np.linspace(0.045, 1.0, _POINTS) ** 2  # finer where the curves wind
    pair = rebound_by_mass(bench, ratios, stiffness_ratio)
    _two_curves(ax, ratios, pair, "-")
    tag(ax, ratios, pair[1], at, r"$v_2/v_0$", UPPER)
    tag(ax, ratios, pair[0], at, r"$v_1/v_0$", FLOOR, above=False)
    ax.set(xlim=(0, 10), ylim=(0, 3))
    ax.text(0.04, 0.93, rf"$k_1/k_2={stiffness_ratio:g}$", transform=ax.transAxes, va="top")
    return describe(name, figure, ratio=stiffness_ratio, upper=pair[1, -1])
