"""The plot of a track: the points, the parabolas of the flights, and the residuals."""

from typing import Any

import numpy as np

from stackbounce.library_types import Axes, Figure
from stackbounce.plots.style import WIDTH, annotate, color_of, panels

_SAMPLES = 60  # of a parabola
_LINES = 2  # on which restitutions are written in turn


def draw(data: Any, found: Any, axes: Any = None) -> Figure:  # noqa: ARG001
    """Draw each ball's points and parabolas, its bounces, and the residuals.

    Parameters
    ----------
    data : object
        Not used: the result contains the points.
    found : Tracks
        The result of the analysis.
    axes : matplotlib.axes.Axes or sequence of them, optional
        Where to draw; by default in a new figure.

    Returns
    -------
    matplotlib.figure.Figure
        Not shown and not saved.
    """
    length, time = found.units
    many, small = (1e3, "mm") if length == "m" else (1.0, length)
    with panels((WIDTH, 5.8), axes, [3, 1]) as (figure, (above, below)):
        for k, ball in enumerate(found.balls):
            _draw_ball(above, ball, color_of(k), found)
            left = many * ball.fit.residuals
            below.plot(ball.fit.times, left, "o", color=color_of(k), markersize=2.6)
            sigma = many * ball.fit.sigma
            below.axhspan(-sigma, sigma, color=color_of(k), alpha=0.10, linewidth=0)
        below.axhline(0.0, color="#808080", linewidth=0.8)
        above.set_ylabel(f"height ({length})")
        below.set(xlabel=f"time ({time})", ylabel=f"residual ({small})")
        above.set_title(_summary(found), loc="left", fontsize=10)
        above.margins(y=0.16)
        above.legend(loc="best", frameon=True, framealpha=0.9, edgecolor="none")
    return figure


def _draw_ball(axes: Axes, ball: Any, color: str, found: Any) -> None:
    named = len(found.balls) > 1
    times, used = ball.fit.times, np.isfinite(ball.fit.residuals)
    label = _label(ball, named, found.units.speed)
    dots: Any = {"marker": "o", "linestyle": "", "color": color, "markersize": 3.4}
    hollow: Any = dots | {"markerfacecolor": "white", "markeredgewidth": 0.9}
    axes.plot(times[used], ball.heights[used], label=label, **dots)
    axes.plot(times[~used], ball.heights[~used], **hollow)
    met = [time.nominal_value for time in ball.impact_times]
    impacts = dict(zip(ball.bounces, met, strict=True))
    for j, (first, last) in enumerate(ball.fit.flights):
        start = impacts.get(j - 1, times[first])
        at = np.linspace(start, impacts.get(j, times[last - 1]), _SAMPLES)
        axes.plot(at, found.fitted(ball, j, at), color=color, linewidth=1.4)
    rows = zip(ball.impact_times, ball.levels, ball.restitutions, strict=True)
    for k, (time, level, kept) in enumerate(rows):
        place = (time.nominal_value, level.nominal_value)
        axes.plot(*place, "v", color=color, markersize=7, markeredgecolor="white")
        if not named:
            low = -14 - 11 * (k % _LINES)  # bounces follow ever faster
            annotate(axes, f"e = {kept:.1uS}", place, color, xytext=(0, low), ha="center")


def _label(ball: Any, named: bool, speed: str) -> str:
    if not named:
        return "tracked"
    return (
        f"{ball.name}: {ball.impact_speeds[0]:.1uS} {speed} down, "
        f"{ball.rebound_speeds[0]:.1uS} {speed} up"
    )


def _summary(found: Any) -> str:
    base = found.time_base
    words = f"gravity of the flights {base.gravity:.1uS} {found.units.speed}²"
    if base.agrees or not found.units.known:
        return words
    if base.frame_rate_factor:
        return f"{words}: is the frame rate wrong by a factor of {base.frame_rate_factor:.3g}?"
    return f"{words}: frame rate or scale are wrong"
