"""The plot of a press curve (force against compression) and of the fits to it."""

from typing import TYPE_CHECKING, Any

import numpy as np

from stackbounce.plots.style import COLORS, file_of, two_panels

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_IN, _OUT, _LINE = COLORS[0], COLORS[1], "#606060"
_MANY = 1500  # points of a branch that are drawn, about


def draw(data: Any, found: Any) -> "Figure":
    """Draw a press curve with the fits of its branches, the hysteresis loop, and the residuals.

    Parameters
    ----------
    data : xarray.Dataset or None
        The measured data; the name of its file is in the title.
    found : Press
        The result of the analysis.

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
    with two_panels(6.0, [3.4, 1]) as (figure, above, below):
        _draw_record(above, found)
        _draw_branches(above, found)
        _draw_line(above, found)
        _draw_residuals(below, found)
        above.set_ylabel("force (N)")
        above.set_title(_title(data, found), loc="left", fontsize=10)
        above.legend(frameon=False, loc="upper left")
        below.set_ylabel("force − fit (N)")
        below.set_xlabel("compression from contact (mm)")
        above.set_ylim(*_limits(found))
    return figure


def _branches(found: Any) -> list[tuple[Any, str, str]]:
    pairs = ((found.loading, _IN, "in"), (found.unloading, _OUT, "out"))
    return [(curve, color, way) for curve, color, way in pairs if curve is not None]


def _limits(found: Any) -> tuple[float, float]:
    top = max(float(curve.force.max()) for curve, _, _ in _branches(found))
    low = min(float(curve.force.min()) for curve, _, _ in _branches(found))
    return min(-0.03 * top, 1.1 * low), 1.07 * top


def _draw_record(axes: "Axes", found: Any) -> None:
    """Draw the cycles that were not fitted, in grey."""
    if found.cycles < 2:
        return
    x, y = found.record
    some = slice(None, None, max(1, len(x) // (4 * _MANY)))
    axes.plot(1e3 * x[some], y[some], color="#c4c4c4", linewidth=0.8, label="other cycles")


def _draw_branches(axes: "Axes", found: Any) -> None:
    """Draw points and fits of both branches, and shade the hysteresis loop between the fits."""
    for curve, color, way in _branches(found):
        x, y = 1e3 * curve.compression, curve.force
        some = slice(None, None, max(1, len(x) // _MANY))
        size = float(np.clip(600.0 / len(x), 1.2, 4.0))
        axes.plot(x[some], y[some], ".", color=color, markersize=size, alpha=0.45)
        order = np.argsort(x)
        exponent = found.exponent if way == "in" else found.unloading_exponent
        name = f"{way}: force ∝ compression$^{{{exponent.nominal_value:.3g}}}$"
        axes.plot(x[order], curve.fit[order], color=color, label=name)
    if found.loading is not None and found.unloading is not None:
        _shade(axes, found)


def _shade(axes: "Axes", found: Any) -> None:
    c = np.linspace(0.0, float(found.peak_compression.nominal_value), 400)
    fits = []
    for curve, _, _ in _branches(found):
        order = np.argsort(curve.compression)
        fits.append(np.interp(c, curve.compression[order], curve.fit[order]))
    axes.fill_between(1e3 * c, fits[1], fits[0], color=_IN, alpha=0.10, linewidth=0)
    if found.loss is None or found.loss.nominal_value < 0.03:
        return
    gap = fits[0] - fits[1]
    at = int(gap.argmax())
    axes.annotate(
        f"{100.0 * found.loss.nominal_value:.0f} % of the work lost",
        xy=(1e3 * c[at], 0.5 * (fits[0][at] + fits[1][at])),
        xytext=(0.97, 0.10),
        textcoords="axes fraction",
        ha="right",
        color="#404040",
        arrowprops={"arrowstyle": "-", "color": "#808080", "linewidth": 0.8},
    )


def _draw_line(axes: "Axes", found: Any) -> None:
    """Draw the linear fit through the origin, whose slope is the linear stiffness."""
    if found.linear_stiffness is None:
        return
    end = float(found.peak_compression.nominal_value)
    k = float(found.linear_stiffness.nominal_value)
    look: Any = {"color": _LINE, "linewidth": 1.2, "label": f"straight line: {_kilo(k)}"}
    axes.plot([0.0, 1e3 * end], [0.0, k * end], "--", zorder=4, **look)


def _kilo(stiffness: float) -> str:
    """Return a stiffness as text in a unit with a suitable prefix.

    Examples
    --------
    >>> _kilo(7437.0)
    '7.44 kN/m'
    """
    if stiffness >= 1e6:
        return f"{1e-6 * stiffness:.3g} MN/m"
    return f"{1e-3 * stiffness:.3g} kN/m" if stiffness >= 1e3 else f"{stiffness:.3g} N/m"


def _draw_residuals(axes: "Axes", found: Any) -> None:
    for curve, color, _ in _branches(found):
        some = slice(None, None, max(1, len(curve.force) // _MANY))
        rest = curve.force - curve.fit
        axes.plot(1e3 * curve.compression[some], rest[some], ".", color=color, markersize=2.5)
    axes.axhline(0.0, color="#808080", linewidth=0.8)


def _title(data: Any, found: Any) -> str:
    """Return one line: the file, the exponent and the restitution."""
    source = file_of(data)
    words = [source] if source and source != "synthetic" else []
    for name in ("exponent", "restitution"):
        value = getattr(found, name)
        if value is not None:
            short = f"{value:.1uP}" if value.std_dev > 0.0 else f"{value.nominal_value:.3g}"
            words.append(f"{name} {short}")
    return ", ".join(words)
