"""The plot of bounce heights, with those of a constant restitution."""

from typing import Any

import numpy as np

from stackbounce.library_types import Figure
from stackbounce.plots.style import COLORS, annotate, panels
from stackbounce.run.quantities import Array


def draw(data: Any, found: Any, axes: Any = None) -> Figure:  # noqa: ARG001
    """Draw the measured heights of the ball's lowest point, and those at the mean restitution.

    Parameters
    ----------
    data : object
        Not used.
    found : Heights
        The result of the analysis.
    axes : matplotlib.axes.Axes or sequence of them, optional
        Where to draw; by default in a new figure.

    Returns
    -------
    matplotlib.figure.Figure
        Not shown and not saved.

    Examples
    --------
    >>> from stackbounce.measure import heights
    >>> draw(None, heights(1.0, [0.64, 0.41], height_error=0.005)).axes[0].get_ylabel()
    'height of the lowest point (m)'
    """
    with panels((7.2, 4.2), axes) as (figure, (axes,)):
        rows = [found.drop_height, *found.bounce_heights]
        at = np.arange(len(rows))
        values = np.array([height.nominal_value for height in rows])
        kept, start = found.mean.nominal_value, rows[0].nominal_value
        wide = np.linspace(at[0], at[-1], 160)
        mean = _with_error(found.mean)
        if found.repeated:
            expected = np.full(len(wide), _curve(found, start, kept, np.ones(1))[0])
            label = f"mean restitution {mean}"
        else:
            expected = _curve(found, start, kept, wide)
            label = f"restitution {mean} at each bounce"
        axes.plot(wide, expected, color=COLORS[1], label=label)
        errors = np.nan_to_num([height.std_dev for height in rows])
        axes.errorbar(at, values, yerr=errors, fmt="o", color=COLORS[0], capsize=3, label="read")
        for k, restitution in enumerate(found.restitutions, start=1):
            annotate(axes, "e = " + _with_error(restitution), (at[k], values[k]), COLORS[0])
        after = "bounce" if found.repeated else "after bounce"
        axes.set_xticks(at, ["drop", *(f"{after} {k}" for k in at[:-1])])
        axes.set_ylim(0.0, 1.12 * float(values.max()))
        axes.set(xlim=(-0.3, at[-1] + 0.6), ylabel="height of the lowest point (m)")
        axes.legend(frameon=False, loc="upper right")
    return figure


def _with_error(value: Any) -> str:
    """Return a restitution with the error of its last digit, or with three decimals if unknown."""
    return f"{value:.1uS}" if value.std_dev > 0.0 else f"{value.nominal_value:.3f}"


def _curve(found: Any, start: float, kept: float, bounces: Array) -> Any:
    """Return the heights at one restitution after some bounces."""
    if found.drag is None:
        return start * kept ** (2.0 * bounces)
    return np.array([found.drag.height_after(start, kept, bounce) for bounce in bounces.tolist()])
