"""The figure of a dataset: its points, and the best curve of each law."""

from typing import TYPE_CHECKING

import numpy as np

from stackbounce.fitting.validation.comparison import Comparison
from stackbounce.plots.style import COLORS, styled_figure

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_POINTS = 40  # of a curve
_STYLES = ("-", "--", "-.", ":")


def draw(comparison: Comparison) -> "Figure":
    """Return the figure of a dataset."""
    with styled_figure(6.4, 4.2) as figure:
        draw_on(figure.subplots(), comparison)
        return figure


def draw_on(axes: "Axes", comparison: Comparison) -> None:
    """Draw the points of a dataset with their errors, and the best curve of each law."""
    series = comparison.series
    speeds = np.linspace(series.speeds.min(), series.speeds.max(), _POINTS)
    places = list(comparison.curves)  # a law has its colour, whichever is the best
    for outcome in comparison.outcomes:
        i = places.index(outcome.laws[0])
        curve = comparison.curves[outcome.laws[0]].at(outcome.value, speeds)
        style = _STYLES[i % len(_STYLES)]
        label = f"{outcome.short_name}: p = {outcome.p:.2g}"
        axes.plot(speeds, curve, style, color=COLORS[i % len(COLORS)], label=label)
    errors = np.sqrt(series.covariance().diagonal())
    axes.errorbar(series.speeds, series.values, errors, fmt="o", color="black", ms=4, lw=1.0)
    axes.margins(0.04)  # whatever the style: no point lies on the frame
    axes.set_xlabel("impact speed (m/s)")
    axes.set_ylabel("restitution")
    axes.legend(fontsize=8, loc="best")
