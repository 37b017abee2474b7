"""Chi squared around its minimum: against one parameter, and as a map over two."""

from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from stackbounce.plots.scales import Scale, label
from stackbounce.plots.style import COLORS

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import SubFigure

Array: TypeAlias = NDArray[np.float64]

_REACH = 4.0  # standard errors drawn on both sides
_WORTH = 9.0  # other minima are drawn if chi squared is less than this above the minimum
_FINE, _CELLS, _STEPS = 401, 81, 41  # values of a curve, of each side of a map, of a profile
_TOP = 10.0  # upper end of a profile's axis
_BANDS = (0.0, 1.0, 4.0, 9.0, 16.0, 25.0, 100.0)
_CURVE, _BEST, _OTHER, _KINK = COLORS[0], COLORS[1], "white", "#202020"


def draw_profile(axes: "Axes", fit: Any) -> None:
    """Draw chi squared against the only fitted parameter, its error, and the kinks.

    A kink is a value at which the number of contact intervals changes.
    """
    x = np.linspace(*_extent(fit, 0), _FINE)
    parameter = fit.objective.parameters[0]
    values = parameter.value(x)
    above = fit.objective.chi_squared(x[:, None]) - fit.chi_squared
    _draw_curve(axes, values, above)
    for kink in _kinks(fit, x[:, None]):
        where = kink[1:] != kink[:-1]
        for value in 0.5 * (values[1:] + values[:-1])[where]:
            axes.axvline(value, color=_KINK, linestyle=":", linewidth=1.0)
    best = fit[parameter.name]
    for at in (best.nominal_value - best.std_dev, best.nominal_value + best.std_dev):
        axes.axvline(at, color=_BEST, linewidth=0.8)
    for k, minimum in enumerate(fit.minima):
        more = minimum.chi_squared - fit.chi_squared
        look: Any = {"color": _BEST if k == 0 else _OTHER, "markeredgecolor": "black"}
        axes.plot(parameter.value(minimum.x), more, "o", zorder=4, clip_on=False, **look)
    axes.set_xlim(values[0], values[-1])
    axes.set_ylim(0.0, _TOP)
    label(axes, "x", parameter.name, _scale(fit, 0, values))
    axes.set_ylabel("chi squared above its minimum")


def draw_map(figure: "SubFigure", fit: Any) -> None:
    """Draw chi squared over two parameters, and the profile of each beside the map."""
    grid: Any = {"width_ratios": (4, 1.2), "height_ratios": (1.2, 4)}
    (top, corner), (axes, right) = figure.subplots(2, 2, sharex="col", sharey="row", **grid)
    corner.set_axis_off()
    across, up = (np.linspace(*_extent(fit, k), _CELLS) for k in (0, 1))
    trials = np.stack([axis.ravel() for axis in np.meshgrid(across, up)], axis=1)
    above = (fit.objective.chi_squared(trials) - fit.chi_squared).reshape(_CELLS, _CELLS)
    x, y = (
        parameter.value(own)
        for parameter, own in zip(fit.objective.parameters, (across, up), strict=True)
    )
    _draw_bands(axes, x, y, np.maximum(above, 0.0))
    near = above < _BANDS[-1]
    for kink in _kinks(fit, trials[near.ravel()]):
        counts = np.full(near.shape, np.nan)
        counts[near] = kink
        _draw_kinks(axes, x, y, counts)
    _draw_minima(axes, fit)
    for k, (panel, values, turned) in enumerate(((top, x, False), (right, y, True))):
        chosen = values[:: (_CELLS - 1) // (_STEPS - 1)]
        rise = fit.profile(fit.names[k], chosen) - fit.chi_squared
        _draw_curve(panel, chosen, rise, turned=turned)
        getattr(panel, "set_xlim" if turned else "set_ylim")(0.0, _TOP)
    axes.set_xlim(x[0], x[-1])
    axes.set_ylim(y[0], y[-1])
    for k, (which, values) in enumerate((("x", x), ("y", y))):
        label(axes, which, fit.names[k], _scale(fit, k, values))
    top.set_ylabel("profile")
    right.set_xlabel("profile")


def _extent(fit: Any, k: int) -> tuple[float, float]:
    """Return the range of coordinates that is drawn: around the minima, within the bounds."""
    parameter = fit.objective.parameters[k]
    low, high = parameter.span
    slope = abs(parameter.slope(float(fit.x[k])))
    reach = _REACH * fit[parameter.name].std_dev / slope
    near = [
        minimum.x[k] for minimum in fit.minima if minimum.chi_squared < fit.chi_squared + _WORTH
    ]
    return max(low, min(near) - reach), min(high, max(near) + reach)


def _scale(fit: Any, k: int, values: Array) -> Scale:
    parameter = fit.objective.parameters[k]
    log = parameter.logarithmic and values[-1] > 3.0 * values[0]
    return Scale(values, log, [], parameter.unit)


def _kinks(fit: Any, trials: Array) -> list[NDArray[np.int64]]:
    """Return the number of contact intervals per trial, for each contact where it varies."""
    found = []
    for key in fit.objective.measured:
        counts = fit.objective.solve(key, trials)["collisions"]
        found += [count for count in counts.T if np.ptp(count) > 0]
    return found


def _draw_curve(axes: "Axes", values: Array, above: Array, *, turned: bool = False) -> None:
    """Draw a profile, with lines at one and two standard deviations; ``turned`` swaps the axes."""
    line, plot = (axes.axvline, (above, values)) if turned else (axes.axhline, (values, above))
    for rise, text in ((1.0, "1 σ"), (4.0, "2 σ")):
        line(rise, color="#404040", linestyle="--", linewidth=0.8)
        place = (rise, 0.98) if turned else (0.995, rise)
        transform = axes.get_xaxis_transform() if turned else axes.get_yaxis_transform()
        look: Any = {"ha": "right", "va": "top" if turned else "bottom", "fontsize": 8}
        axes.text(*place, text, transform=transform, rotation=90 if turned else 0, **look)
    axes.plot(*plot, color=_CURVE)


def _draw_bands(axes: "Axes", x: Array, y: Array, above: Array) -> None:
    """Draw chi squared as colors, with contours at one, two and three standard deviations.

    The extents of each contour along the axes are the standard deviations of the parameters.
    """
    from matplotlib import colormaps

    colors = colormaps["Blues_r"](np.linspace(0.15, 1.0, len(_BANDS)))
    axes.contourf(x, y, above, levels=_BANDS, colors=colors, extend="max")
    drawn = axes.contour(x, y, above, levels=_BANDS[1:4], colors="black", linewidths=0.9)
    axes.clabel(drawn, fmt=dict(zip(_BANDS[1:4], ("1 σ", "2 σ", "3 σ"), strict=True)), fontsize=8)
    axes.grid(visible=False)


def _draw_kinks(axes: "Axes", x: Array, y: Array, counts: Array) -> None:
    """Draw lines between regions with different counts; counts are nan far from the minimum."""
    own = np.unique(counts[np.isfinite(counts)])
    levels = (0.5 * (own[1:] + own[:-1])).tolist()
    look: Any = {"colors": _KINK, "linewidths": 0.9, "linestyles": ":"}
    axes.contour(x, y, counts, levels=levels, **look)


def _draw_minima(axes: "Axes", fit: Any) -> None:
    """Mark the best values with their errors, and the other minima."""
    first, second = (fit[name] for name in fit.names)
    bars = {"xerr": first.std_dev, "yerr": second.std_dev, "linewidth": 1.2}
    look: Any = {"fmt": "o", "color": _BEST, "markeredgecolor": "black", "zorder": 4}
    axes.errorbar(first.nominal_value, second.nominal_value, **bars, **look)
    for minimum in fit.minima[1:]:
        place = [p.value(x) for p, x in zip(fit.objective.parameters, minimum.x, strict=True)]
        axes.plot(*place, "s", color=_OTHER, markeredgecolor="black", markersize=6, zorder=3)
