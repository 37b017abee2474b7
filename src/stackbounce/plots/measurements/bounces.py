"""The plot of the restitution of each bounce against its impact speed."""

from typing import Any

import numpy as np

from stackbounce.library_types import Figure
from stackbounce.plots.style import COLORS, annotate, panels

_LINES = {"linear": "-", "power law": "--"}
_FIRST_NUMBERS = 6  # further ones would be written on each other


def draw(data: Any, found: Any, axes: Any = None) -> Figure:  # noqa: ARG001
    """Draw the restitution of each bounce against its impact speed, with the fitted laws e(v).

    Parameters
    ----------
    data : object
        Not used.
    found : Bounces
        The result of the analysis.
    axes : matplotlib.axes.Axes or sequence of them, optional
        Where to draw; by default in a new figure.

    Returns
    -------
    matplotlib.figure.Figure
        Not shown and not saved.
    """
    with panels((7.2, 4.4), axes) as (figure, (axes,)):
        speeds = np.array([getattr(speed, "nominal_value", speed) for speed in found.impact_speeds])
        kept = np.array([number.nominal_value for number in found.restitutions])
        errors = np.nan_to_num([number.std_dev for number in found.restitutions])
        grid = np.linspace(0.9 * speeds.min(), 1.04 * speeds.max(), 160)
        for k, law in enumerate(found.laws):
            line = [law.at(float(speed)) for speed in grid]
            middle = np.array([number.nominal_value for number in line])
            axes.plot(grid, middle, _LINES[law.form], color=COLORS[1 + k], label=_formula(law))
            if law.form == "linear":
                wide = np.array([number.std_dev for number in line])
                band: Any = {"color": COLORS[1], "alpha": 0.15, "linewidth": 0}
                axes.fill_between(grid, middle - wide, middle + wide, **band)
        mean = f"; mean {found.mean:.1uS}" if found.mean.std_dev > 0.0 else ""
        marks: Any = {"fmt": "o", "color": COLORS[0], "markersize": 6}
        bars: Any = {"yerr": errors, "capsize": 3, "elinewidth": 1.3}
        axes.errorbar(speeds, kept, label=f"each bounce{mean}", **marks, **bars)
        for k, number in enumerate(found.numbers[:_FIRST_NUMBERS]):
            annotate(axes, f"{number}", (speeds[k], kept[k]), COLORS[0], xytext=(7, 6))
        fastest = 1.08 * float(speeds.max())
        axes.set(xlabel="impact speed (m/s)", ylabel="restitution", xlim=(0.0, fastest))
        middle, half = 0.5 * (kept.max() + kept.min()), 0.5 * float(np.ptp(kept))
        reach = max(0.05, 1.6 * half + 1.2 * float(np.median(errors)))
        axes.set_ylim(middle - reach, middle + reach)
        axes.legend(loc="best", frameon=True, framealpha=0.9, edgecolor="none")
    return figure


def _formula(law: Any) -> str:
    if law.form == "linear":
        line = f"e = {law.coefficient.nominal_value:.3f} − {law.slope:.1uS} v/(m/s)"
        return line.replace("− -", "+ ")
    return f"e = {law.coefficient.nominal_value:.3f} (v/(m/s))$^{{{-law.slope:.1uS}}}$"
