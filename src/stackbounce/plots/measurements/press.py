"""The plot of a press curve (force against compression) and of the fits to it."""

from typing import Any

import numpy as np

from stackbounce.library_types import Axes, Figure
from stackbounce.plots.style import COLORS, WIDTH, file_of, panels

_MANY = 1500  # points of a branch that are drawn, about


def draw(data: Any, found: Any, axes: Any = None) -> Figure:
    """Draw a press curve with the fits of its branches, the hysteresis loop, and the residuals.

    Parameters
    ----------
    data : xarray.Dataset or None
        The measured data; the name of its file is in the title.
    found : Press
        The result of the analysis.
    axes : matplotlib.axes.Axes or sequence of them, optional
        Where to draw; by default in a new figure.

    Returns
    -------
    matplotlib.figure.Figure
        Not shown and not saved.

    Examples
    --------
    >>> import numpy as np
    >>> import xarray as xr
    >>> from stackbounce.measure import press
    >>> c = 5e-3 * (1.0 - abs(np.linspace(-1.0, 1.0, 401)))  # m, in and out
    >>> force = 1e4 * c * np.where(np.arange(401) <= 200, 1.0, c / 5e-3)  # N
    >>> data = xr.Dataset({"force": ("point", force), "compression": ("point", c)})
    >>> [axes.get_ylabel() for axes in draw(data, press(data)).axes]
    ['force (N)', 'force − fit (N)']
    """
    branches = [(found.loading, found.exponent, COLORS[0], "in")]
    if found.unloading is not None:
        branches.append((found.unloading, found.unloading_exponent, COLORS[1], "out"))
    with panels((WIDTH, 6.0), axes, [3.4, 1]) as (figure, (above, below)):
        for curve, exponent, color, way in branches:
            x, y, fit = 1e3 * curve.compression, curve.force, curve.fit
            some = slice(None, None, max(1, len(x) // _MANY))
            size = float(np.clip(600.0 / len(x), 1.2, 4.0))
            above.plot(x[some], y[some], ".", color=color, markersize=size, alpha=0.45)
            order = np.argsort(x)
            name = f"{way}: force ∝ compression$^{{{exponent.nominal_value:.3g}}}$"
            above.plot(x[order], fit[order], color=color, label=name)
            below.plot(x[some], (y - fit)[some], ".", color=color, markersize=2.5)
        end = 1e3 * found.peak_compression.nominal_value
        k = 1e-3 * found.linear_stiffness.nominal_value
        line: Any = {"color": "#606060", "linewidth": 1.2, "label": f"straight line: {k:.3g} kN/m"}
        above.plot([0.0, end], [0.0, k * end], "--", zorder=4, **line)
        if found.unloading is not None:
            _shade(above, found, np.linspace(0.0, end, 400))
        below.axhline(0.0, color="#808080", linewidth=0.8)
        above.set_ylabel("force (N)")
        above.set_title(file_of(data), loc="left", fontsize=10)
        above.legend(frameon=False, loc="upper left")
        below.set(xlabel="compression from contact (mm)", ylabel="force − fit (N)")
        forces = np.concatenate([curve.force for curve, *_ in branches])
        top = float(forces.max())
        above.set_ylim(min(-0.03 * top, 1.1 * float(forces.min())), 1.07 * top)
    return figure


def _shade(axes: Axes, found: Any, at: Any) -> None:
    """Shade the hysteresis loop between the fits, and write down how much of the work is lost."""
    fits = []
    for curve in (found.loading, found.unloading):
        order = np.argsort(curve.compression)
        fits.append(np.interp(at, 1e3 * curve.compression[order], curve.fit[order]))
    axes.fill_between(at, fits[1], fits[0], color=COLORS[0], alpha=0.10, linewidth=0)
    look: Any = {"textcoords": "axes fraction", "ha": "right", "color": "#404040"}
    look["arrowprops"] = {"arrowstyle": "-", "color": "#808080", "linewidth": 0.8}
    widest = int((fits[0] - fits[1]).argmax())
    place = at[widest], 0.5 * (fits[0][widest] + fits[1][widest])
    said = f"{100.0 * found.loss.nominal_value:.0f} % of the work lost"
    axes.annotate(said, place, (0.97, 0.10), **look)
