"""The plot of an accelerometer's record: its flights, and the restitution of each bounce."""

from typing import Any

import numpy as np

from stackbounce.library_types import Figure
from stackbounce.plots.style import COLORS, annotate, panels

# Of the series' duration, shown on each side; of the duration that is shown, as wide as a text.
_BESIDE, _WORD = 0.15, 0.09


def draw(data: Any, found: Any, axes: Any = None) -> Figure:  # noqa: ARG001
    """Draw the magnitude of the acceleration, its flights shaded, with their restitutions.

    Parameters
    ----------
    data : object
        Not used: the result contains the record.
    found : Accelerometer
        The result of the analysis.
    axes : matplotlib.axes.Axes or sequence of them, optional
        Where to draw; by default in a new figure.

    Returns
    -------
    matplotlib.figure.Figure
        Not shown and not saved. Below 20 m/s² the scale is linear, above logarithmic.
    """
    with panels((7.2, 4.4), axes) as (figure, (axes,)):
        start, end = found.spans[0][0], found.spans[-1][1]
        beside = _BESIDE * (end - start)
        seen = (found.times > start - beside) & (found.times < end + beside)
        times, values = found.times[seen], found.values[seen]
        axes.plot(times, values, color="#4d4d4d", linewidth=0.9, marker=".", markersize=2.5)
        # Texts stand in the middle of a flight or a bounce, at a share of the picture's height, and
        # upright if a flight is short.
        upright = np.diff(found.spans).min() < _WORD * (times[-1] - times[0])
        at: Any = {"xycoords": axes.get_xaxis_transform(), "ha": "center", "va": "top"}
        at["rotation"], level, above = ("vertical", 0.96, 20.0) if upright else (None, 0.86, 8.0)
        box = {"facecolor": "white", "alpha": 0.8, "edgecolor": "none", "pad": 0.5}
        fallen = [] if found.fall is None else [found.drop_height]
        heights = zip(found.spans, [*fallen, *found.apex_heights], strict=True)
        for k, ((first, last), height) in enumerate(heights):
            color = COLORS[int(k < len(fallen))]
            axes.axvspan(first, last, color=color, alpha=0.13, linewidth=0)
            annotate(axes, f"{100.0 * height:.1uS} cm", (0.5 * (first + last), 0.96), color, **at)
        for k, kept in enumerate(found.restitutions):
            place = 0.5 * (found.spans[k][1] + found.spans[k + 1][0])
            annotate(axes, f"e = {kept:.1uS}", (place, level), "black", bbox=box, **at)
        axes.set_yscale("symlog", linthresh=20.0, linscale=1.2)
        top = float(values.max())
        ticks = [tick for tick in (0, 9.8, 20, 50, 100, 200, 500, 1000) if tick < 3.0 * top]
        axes.set_yticks(ticks, [f"{tick:g}" for tick in ticks])
        axes.minorticks_off()
        axes.set_ylim(-1.0, above * np.maximum(top, 20.0))
        axes.set(xlabel="time (s)", ylabel="magnitude of the acceleration (m/s²)")
    return figure
