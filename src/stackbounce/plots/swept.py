"""Pictures of a sweep: lines over one number, maps over two."""

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from stackbounce.errors import InvalidType, InvalidValue, nearest, shown
from stackbounce.plots.style import STYLE, color_of

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

__all__ = ["TITLES", "heatmap", "lines"]

TITLES = {
    "rebound_ratio": "rebound ratio",
    "collisions": "collisions",
    "energy_retained": "energy retained",
    "first_touch": "first touch (s)",
    "last_release": "last release (s)",
}
"""What can be drawn, and how it is called."""

_MOST_COUNTS = 12  # colors of a map of collisions
_INFINITE = (0.75, 0.75, 0.75, 1.0)
_LEVELS = 8  # contours


def lines(data: "xr.Dataset", show: str = "rebound_ratio") -> "Figure":
    """Draw a sweep over one number: a line for each ball, or for each contact.

    Parameters
    ----------
    data : xarray.Dataset
        From `sweep`, with one dimension.
    show : str, optional
        What to draw: ``rebound_ratio``, ``collisions``, ``energy_retained``, ``first_touch`` or
        ``last_release``.

    Returns
    -------
    matplotlib.figure.Figure
        Not shown and not saved.

    Raises
    ------
    InvalidValue
        If the sweep has not one dimension, or nothing of that name.
    InvalidType
        If `data` is no Dataset.

    Examples
    --------
    >>> import stackbounce as sb
    >>> from stackbounce import plots
    >>> drop = sb.Drop([sb.Ball(1.0)] * 2, [sb.Spring(1.0)] * 2, impact_speed=1.0)
    >>> figure = plots.lines(sb.sweep(drop, {"balls.0.mass": [1.0, 2.0, 5.0]}))
    >>> figure.axes[0].get_xlabel()
    'balls.0.mass (kg)'
    """
    (dim,) = _dimensions(data, show, 1)
    import matplotlib as mpl
    from matplotlib.figure import Figure

    with mpl.rc_context():
        mpl.rcParams.update(STYLE)
        figure = Figure(figsize=(6.4, 4.2))
        axes = figure.subplots()
        across, own = _axis(data, dim), data[show]
        part = next((name for name in ("ball", "contact") if name in own.dims), "")
        for k in range(own.sizes[part]) if part else [0]:
            one = own.isel({part: k}) if part else own
            style = "steps-mid" if show == "collisions" else "default"
            label = f"{part} {k}" if part else None
            axes.plot(across, one.values, color=color_of(k), label=label, drawstyle=style)
        if part:
            axes.legend(frameon=False)
        _label(axes, "x", data, dim)
        axes.set_ylabel(TITLES[show])
        axes.set_title(_unfinished(data), loc="left", fontsize=10)
    return figure


def heatmap(data: "xr.Dataset", show: str = "rebound_ratio", index: int = -1) -> "Figure":
    """Draw a sweep over two numbers as a map, with contours, or with a color for each count.

    Parameters
    ----------
    data : xarray.Dataset
        From `sweep`, with two dimensions; the first one goes up.
    show : str, optional
        As in `lines`.
    index : int, optional
        Which ball or contact; by default the uppermost.

    Returns
    -------
    matplotlib.figure.Figure
        Not shown and not saved.

    Raises
    ------
    InvalidValue
        If the sweep has not two dimensions, or nothing of that name, or no such ball or contact.
    InvalidType
        If `data` is no Dataset.

    Examples
    --------
    >>> import stackbounce as sb
    >>> from stackbounce import plots
    >>> drop = sb.Drop([sb.Ball(1.0)] * 2, [sb.Spring(1.0)] * 2, impact_speed=1.0)
    >>> over = {"balls.0.mass": [1.0, 2.0], "contacts.1.stiffness": [1.0, 3.0]}
    >>> plots.heatmap(sb.sweep(drop, over)).axes[0].get_xlabel()
    'contacts.1.stiffness (N/m)'
    """
    up, across = _dimensions(data, show, 2)
    import matplotlib as mpl
    from matplotlib.figure import Figure

    own = data[show]
    part = next((name for name in ("ball", "contact") if name in own.dims), "")
    if part:
        if not -own.sizes[part] <= index < own.sizes[part]:
            raise InvalidValue(
                f"index must name a {part} from 0 to {own.sizes[part] - 1}, got {index}"
            )
        own = own.isel({part: index})
    with mpl.rc_context():
        mpl.rcParams.update(STYLE | {"axes.grid": False})
        figure = Figure(figsize=(6.4, 4.8))
        axes = figure.subplots()
        x, y = _axis(data, across), _axis(data, up)
        if show == "collisions":
            _draw_counts(axes, x, y, own.values)
        else:
            _draw_levels(axes, x, y, own.values)
        _label(axes, "x", data, across)
        _label(axes, "y", data, up)
        which = f" of {part} {index % data.sizes[part]}" if part else ""
        title = TITLES[show] + which
        axes.set_title("\n".join(filter(None, (title, _unfinished(data)))), loc="left", fontsize=10)
    return figure


def _draw_levels(axes: "Axes", x: Any, y: Any, values: NDArray[Any]) -> None:
    colors = axes.pcolormesh(x, y, values, cmap="viridis", shading="nearest", rasterized=True)
    assert axes.figure is not None
    axes.figure.colorbar(colors, ax=axes)
    if min(values.shape) > 1 and np.nanmin(values) < np.nanmax(values):
        lined = axes.contour(
            x, y, values, levels=_LEVELS, colors="white", linewidths=0.8, alpha=0.8
        )
        axes.clabel(lined, fontsize=8, fmt="%.3g")


def _draw_counts(axes: "Axes", x: Any, y: Any, values: NDArray[Any]) -> None:
    """Give each count a color of its own; high ones share the last, infinity is grey on top."""
    from matplotlib import colormaps
    from matplotlib.colors import BoundaryNorm, ListedColormap

    finite = values[values >= 0]
    low, high = (int(finite.min()), int(finite.max())) if finite.size else (0, 0)
    last = min(high, low + _MOST_COUNTS - 1)
    names = [f"{count}" for count in range(low, last + 1)]
    if high > last:
        names[-1] += " and more"
    colors = list(colormaps["viridis"](np.linspace(0.0, 1.0, len(names))))
    if finite.size < values.size:
        names.append("∞")
        colors.append(_INFINITE)
    drawn = np.where(values < 0, last + 1, np.minimum(values, last))
    norm = BoundaryNorm(low - 0.5 + np.arange(len(names) + 1), len(names))
    look: Any = {"cmap": ListedColormap(colors), "norm": norm, "shading": "nearest"}
    mesh = axes.pcolormesh(x, y, drawn, rasterized=True, **look)
    assert axes.figure is not None
    bar = axes.figure.colorbar(mesh, ax=axes, ticks=low + np.arange(len(names)))
    bar.ax.set_yticklabels(names)
    bar.ax.minorticks_off()


def _dimensions(data: Any, show: str, count: int) -> tuple[Any, ...]:
    """Return the dimensions of a sweep, of which there must be so many."""
    import xarray as xr

    if not isinstance(data, xr.Dataset) or "status" not in data:
        raise InvalidType(f"data must be a Dataset from sweep, got {shown(data)}")
    if show not in TITLES:
        raise InvalidValue(f"show must name a result, got {shown(show)}; {nearest(show, TITLES)}")
    dims = data["status"].dims
    if len(dims) != count:
        right = "one dimension" if count == 1 else "two dimensions"
        got = ", ".join(map(str, dims)) or "none"
        raise InvalidValue(f"data must have {right}, got {got}: choose with data.sel or data.isel")
    return dims


def _axis(data: "xr.Dataset", dim: Any) -> NDArray[Any]:
    return data[dim].values if dim in data.coords else np.arange(data.sizes[dim])


def _label(axes: "Axes", which: str, data: "xr.Dataset", dim: Any) -> None:
    """Name an axis and its unit; even ratios make it logarithmic."""
    unit = data[dim].attrs.get("units", "") if dim in data.coords else ""
    values = _axis(data, dim)
    getattr(axes, f"set_{which}label")(f"{dim} ({unit})" if unit else f"{dim}")
    if values.dtype.kind in "iuf" and len(values) > 2 and min(values[0], values[-1]) > 0.0:
        ratios = np.log(values[1:] / values[:-1])
        if np.ptp(ratios) < 1e-6 * np.abs(ratios).max():
            getattr(axes, f"set_{which}scale")("log")


def _unfinished(data: "xr.Dataset") -> str:
    """Return a line on the drops that could not be finished, if any."""
    from stackbounce.result import Status

    count = int(np.isin(data["status"].values, (Status.EVENT_LIMIT, Status.INVALID)).sum())
    return (
        f"{count} of {data['status'].size} drops could not be finished: see status" if count else ""
    )
