"""Maps: colors and contours for numbers, discrete colors for counts."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from stackbounce.library_types import Axes, ContourSet
from stackbounce.plots.scales import Scale, is_flat, show_in_handy_unit

_LEVELS = 7  # approximate number of contours
_LEAST = 5  # values in each direction that contours need
_BELOW = 0.05  # a smaller share of the other sign does not make a map signed
_MOST = 12  # up to so many counts each have a color of their own
_SINGLE = 8  # of more counts, the first so many have a color of their own
_INFINITE = (0.75, 0.75, 0.75, 1.0)


def draw_levels(axes: Axes, x: Scale, y: Scale, values: NDArray[Any], unit: str) -> str:
    """Draw numbers as colors with contours, and return the unit of the color bar.

    The colors go from dark to light, or from blue over white to red if the values change sign.
    """
    finite = values[np.isfinite(values)]
    low, high = (float(finite.min()), float(finite.max())) if finite.size else (0.0, 1.0)
    level = is_flat(values)
    span = max(-low, high)
    signed = not level and low < -_BELOW * span and high > _BELOW * span
    ends = (low - 1.0, low + 1.0) if level else (-span, span) if signed else (low, high)
    look: Any = {"cmap": "RdBu_r" if signed else "viridis", "rasterized": True}
    mesh = axes.pcolormesh(x.edges(), y.edges(), values, vmin=ends[0], vmax=ends[1], **look)
    assert axes.figure is not None
    bar = axes.figure.colorbar(mesh, ax=axes)
    unit, factor = show_in_handy_unit(bar.ax.yaxis, values, unit)
    if level:
        bar.set_ticks([low] if finite.size else [])
        bar.ax.minorticks_off()
    if signed:
        bar.ax.set_ylim(low, high)
    rising = all((np.diff(scale.places) > 0.0).all() for scale in (x, y))
    if min(values.shape) >= _LEAST and rising and not level:
        color = "#202020" if signed else "white"
        shape: Any = {"levels": _LEVELS, "colors": color, "linewidths": 0.7}
        drawn = axes.contour(x.places, y.places, values, **shape)
        bar.add_lines(drawn)
        _name_contours(axes, drawn, color, factor)
    return unit


def _name_contours(axes: Axes, drawn: ContourSet, color: str, factor: float) -> None:
    """Write the levels on their lines, without overlaps."""
    from matplotlib.figure import Figure
    from matplotlib.patheffects import withStroke

    if color == "white":
        drawn.set_path_effects([withStroke(linewidth=1.2, foreground="#404040")])
    look: Any = {"fontsize": 8, "fmt": lambda level: f"{level * factor:.3g}", "colors": "black"}
    assert isinstance(axes.figure, Figure)
    axes.figure.draw_without_rendering()  # computes the places of the labels
    kept: list[Any] = []
    for text in axes.clabel(drawn, inline=False, **look):
        box = text.get_window_extent()
        if any(box.padded(14.0).overlaps(other) for other in kept):
            text.remove()
            continue
        kept.append(box)
        text.set(clip_on=False, path_effects=[withStroke(linewidth=3.0, foreground="white")])


def group_counts(low: int, high: int) -> list[tuple[int, int]]:
    """Return the smallest and largest count of each color; high counts share a color.

    Examples
    --------
    >>> group_counts(1, 3)
    [(1, 1), (2, 2), (3, 3)]
    >>> group_counts(1, 40)[6:]
    [(7, 7), (8, 8), (9, 16), (17, 32), (33, 40)]
    """
    if high - low < _MOST:
        return [(count, count) for count in range(low, high + 1)]
    found = [(count, count) for count in range(low, low + _SINGLE)]
    while found[-1][1] < high:
        last = found[-1][1]
        found.append((last + 1, min(high, 2 * last)))
    return found


def draw_counts(axes: Axes, x: Scale, y: Scale, values: NDArray[Any]) -> None:
    """Draw counts in discrete colors, high counts in groups and infinity in grey."""
    from matplotlib import colormaps
    from matplotlib.colors import BoundaryNorm, ListedColormap

    finite = values[values >= 0]
    low, high = (int(finite.min()), int(finite.max())) if finite.size else (0, 0)
    parts = group_counts(low, high)
    names = [f"{first}" if first == last else f"{first}–{last}" for first, last in parts]
    shades = np.linspace(0.0, 1.0, len(parts)) if len(parts) > 1 else [0.5]
    colors = list(colormaps["viridis"](shades))
    drawn = np.searchsorted([last for _, last in parts], values).astype(float)
    drawn[np.isnan(values)] = np.nan
    if (values < 0).any():
        drawn[values < 0] = len(parts)
        names.append("∞")
        colors.append(_INFINITE)
    norm = BoundaryNorm(np.arange(len(names) + 1) - 0.5, len(names))
    look: Any = {"cmap": ListedColormap(colors), "norm": norm, "rasterized": True}
    mesh = axes.pcolormesh(x.edges(), y.edges(), drawn, **look)
    assert axes.figure is not None
    bar = axes.figure.colorbar(mesh, ax=axes, ticks=np.arange(len(names)))
    bar.ax.set_yticklabels(names)
    bar.ax.tick_params(which="both", length=0)
    bar.ax.minorticks_off()
