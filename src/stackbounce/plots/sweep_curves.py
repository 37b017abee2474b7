"""Plots of sweeps, lines for one parameter that varies and maps for two, and of stacks."""

import math
import tomllib
from typing import Any

import numpy as np
from numpy.typing import NDArray

from stackbounce.errors import InvalidType, InvalidValue, one_of, shown
from stackbounce.library_types import Axes, DataArray, Dataset, Figure
from stackbounce.plots.maps import draw_counts, draw_levels
from stackbounce.plots.scales import is_flat, label, path_of, read_scale, show_in_handy_unit
from stackbounce.plots.style import COLORS, WIDTH, color_of, drawn_by, into_axes, panels

SHOWN = ("rebound_ratio", "collisions", "energy_retained", "first_touch", "last_release")
"""The variables that can be drawn."""

IN_A_ROW = 4
"""The largest number of entries in a horizontal legend."""

_STROKES = ("-", "--", ":", "-.")
_FEW = 25  # up to so many values are marked with dots
_BARS = 12  # stacks that are drawn at most
_MARKS = ("o", "s", "^", "D", "v", "P", "X", "*")


@into_axes
def lines(
    data: Dataset, show: str = "rebound_ratio", index: int | None = None, *, axes: Any = None
) -> Figure:
    """Draw a sweep of one parameter: a line for each ball or each contact.

    Parameters
    ----------
    data : xarray.Dataset
        From `sweep`, with one dimension.
    show : str, optional
        What to draw: ``rebound_ratio``, ``collisions``, ``energy_retained``, ``first_touch`` or
        ``last_release``.
    index : int, optional
        The only ball or contact to draw; by default all of them.
    axes : matplotlib.axes.Axes, optional
        Where to draw; by default in a new figure.

    Returns
    -------
    matplotlib.figure.Figure, or `axes` if given
        Not shown and not saved. Unfinished drops are left out; the title has their number.

    Raises
    ------
    InvalidValue
        If the sweep has not one dimension, or nothing of that name, or no such ball or contact.
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
    data, (dim,), part, own, unfinished = _prepared(data, show, 1)
    chosen = range(own.sizes[part]) if part else range(1)
    if part and index is not None:
        chosen = range(_index(own, part, index), _index(own, part, index) + 1)
    with panels((6.4, 4.0), axes) as (figure, (axes,)):
        scale = read_scale(data, dim)
        rows = [own.isel({part: k}).values if part else own.values for k in chosen]
        if show == "collisions":
            rows = _counts_on(axes, np.array(rows))
        for k, row in zip(chosen, rows, strict=True):
            name = name_of(data, part, k) if part else None
            axes.plot(scale.places, row, label=name, **_look(show, k, chosen, row))
        if part:
            draw_legend(axes, len(rows))
        label(axes, "x", path_of(data, dim), scale)
        _label_values(axes, show, own, np.array(rows))
        axes.set_title(unfinished, loc="left", fontsize=10, pad=26 if part else None)
    return figure


@into_axes
def heatmap(
    data: Dataset, show: str = "rebound_ratio", index: int = -1, *, axes: Any = None
) -> Figure:
    """Draw a sweep of two parameters as a map: contours, or discrete colors for counts.

    Parameters
    ----------
    data : xarray.Dataset
        From `sweep`, with two dimensions; the first one is the vertical axis.
    show : str, optional
        As in `lines`.
    index : int, optional
        Which ball or contact; by default the uppermost.
    axes : matplotlib.axes.Axes, optional
        Where to draw; by default in a new figure.

    Returns
    -------
    matplotlib.figure.Figure, or `axes` if given
        Not shown and not saved. Cells without a value are hatched: unfinished drops, whose number
        is in the title, and times of contacts that never close.

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
    data, (up, across), part, own, unfinished = _prepared(data, show, 2)
    title = show.replace("_", " ")
    if part:
        title += f" of {name_of(data, part, _index(own, part, index))}"
        own = own.isel({part: index})
    with panels((6.4, 4.8), axes) as (figure, (axes,)):
        axes.grid(visible=False)
        x, y = read_scale(data, across), read_scale(data, up)
        label(axes, "x", path_of(data, across), x)
        label(axes, "y", path_of(data, up), y)
        values = own.values.astype(float)
        if np.isnan(values).any():  # the background shows through where cells have no value
            axes.patch.set(facecolor="white", edgecolor="#b0b0b0", hatch="////", linewidth=0.0)
        if show == "collisions":
            draw_counts(axes, x, y, values)
        else:
            unit = draw_levels(axes, x, y, values, own.attrs.get("units", "1").removeprefix("1"))
            title += f" ({unit})" if unit else ""
        axes.set_title("\n".join(filter(None, (title, unfinished))), loc="left", fontsize=10)
    return figure


def _look(show: str, k: int, chosen: range, row: NDArray[Any]) -> dict[str, Any]:
    """Return the style of a line.

    If there are more lines than colors, the dash pattern changes. Lines of counts have different
    widths, so that equal counts do not hide each other.
    """
    stroke = _STROKES[k // len(COLORS) % len(_STROKES)]
    look: dict[str, Any] = {"color": color_of(k), "linestyle": stroke}
    above = chosen.stop - 1 - k
    if show == "collisions":  # equal counts would hide each other
        look |= {"drawstyle": "steps-mid", "linewidth": 1.5 + min(2.0, 6.0 / chosen.stop) * above}
    elif len(row) <= _FEW:
        look |= {"marker": "o", "markersize": 4}
    return look


def draw_legend(axes: Axes, count: int) -> None:
    """Put the legend outside of the axes: above or, with many names, to the right."""
    look: Any = {"frameon": False, "handlelength": 1.6, "borderpad": 0.0}
    if count <= IN_A_ROW:
        look |= {"loc": "lower left", "bbox_to_anchor": (0.0, 1.02), "ncols": count}
    else:
        look |= {"loc": "upper left", "bbox_to_anchor": (1.02, 1.0)}
    axes.legend(**look)


def _label_values(axes: Axes, show: str, own: DataArray, rows: NDArray[Any]) -> None:
    """Label the vertical axis; widen its range if the values differ by round-off only."""
    unit = own.attrs.get("units", "1").removeprefix("1")
    if show != "collisions":
        unit, _ = show_in_handy_unit(axes.yaxis, rows, unit)
        if is_flat(rows):
            middle = float(np.nanmean(rows)) if np.isfinite(rows).any() else 0.0
            wide = 0.5 * abs(middle) or 1.0
            axes.set_ylim(middle - wide, middle + wide)
    axes.set_ylabel(show.replace("_", " ") + (f" ({unit})" if unit else ""))


def _counts_on(axes: Axes, rows: NDArray[Any]) -> list[NDArray[Any]]:
    """Return the heights at which counts are drawn, and set the ticks of the axis.

    Infinite counts (-1) are drawn at a tick ∞ above all others.
    """
    from matplotlib.ticker import MaxNLocator

    finite = rows[rows >= 0]
    low, high = (int(finite.min()), int(finite.max())) if finite.size else (0, 0)
    places = MaxNLocator(6, integer=True, min_n_ticks=1).tick_values(low, max(high, low + 1))
    ticks = [float(place) for place in places if low - 1 < place < high + 1]
    names = [f"{tick:.0f}" for tick in ticks]
    top = high + max(1.0, 0.12 * (high - low))
    if (rows < 0).any():
        ticks, names = [*ticks, top], [*names, "∞"]
    axes.set_yticks(ticks, names)
    axes.set_ylim(low - 0.06 * (top - low) - 0.1, top + 0.06 * (top - low))
    return list(np.where(rows < 0, top, rows))


def check_source(data: Any, name: str, source: str) -> None:
    """Raise `InvalidType` unless data are a Dataset with the variable `name`, as from `source`."""
    import xarray as xr

    if not isinstance(data, xr.Dataset) or name not in data:
        got = f"one without {name}" if isinstance(data, xr.Dataset) else drawn_by(data)
        raise InvalidType(f"data must be a Dataset from {source}, got {got}")


def _prepared(
    data: Any, show: str, count: int
) -> tuple[Dataset, tuple[Any, ...], str, DataArray, str]:
    """Return what is to be drawn of a sweep, and raise if it has not `count` dimensions.

    That is: the sweep sorted by its numeric dimensions; these dimensions; the dimension of the
    result besides them, "ball", "contact" or ""; the result, with nan for unfinished drops; and a
    note with the number of these, or "".
    """
    from stackbounce.run.result import Status

    check_source(data, "status", "sweep")
    one_of(show, SHOWN, f"show must name a result, got {shown(show)}")
    dims = data["status"].dims
    if len(dims) != count:
        right = "one dimension" if count == 1 else "two dimensions"
        got = ", ".join(map(str, dims)) or "none"
        plots = {1: "lines", 2: "highest" if "height_ratio" in data else "heatmap"}
        choose = f"choose with data.sel or data.isel, or see plots.{plots.get(len(dims), 'lines')}"
        raise InvalidValue(f"data must have {right}, got {got}: {choose}")
    numeric = [dim for dim in dims if dim in data.coords and data[dim].dtype.kind in "iuf"]
    data = data.sortby(numeric)
    wrong = data["status"].isin([int(Status.EVENT_LIMIT), int(Status.INVALID)])
    own, unfinished, note = data[show], int(wrong.sum()), ""
    if unfinished:
        own = own.where(~wrong, drop=False).assign_attrs(own.attrs)
        note = f"{unfinished} of {wrong.size} drops could not be finished: see status"
    part = next((name for name in ("ball", "contact") if name in own.dims), "")
    return data, dims, part, own, note


def _index(own: DataArray, part: str, index: int) -> int:
    size = own.sizes[part]
    if not -size <= index < size:
        raise InvalidValue(f"index must name a {part} from 0 to {size - 1}, got {index}")
    return index % size


def name_of(data: Dataset, part: str, index: int) -> str:
    """Return a label for a ball or a contact, with the ball's name if it has one."""
    balls = tomllib.loads(data.attrs.get("drop", "")).get("balls", [])
    own = balls[index].get("name", "") if part == "ball" and index < len(balls) else ""
    return f"{part} {index}" + (f" ({own})" if own else "")


@into_axes
def highest(data: Dataset, *, axes: Any = None) -> Figure:
    """Draw the rebound height of the top ball for the best stacks, for each gap.

    Parameters
    ----------
    data : xarray.Dataset
        From `stackbounce.highest`.
    axes : matplotlib.axes.Axes, optional
        Where to draw; by default in a new figure.

    Returns
    -------
    matplotlib.figure.Figure, or `axes` if given
        The first stacks in order, at most 12, the best one above; a mark for each gap. Not shown
        and not saved.

    Raises
    ------
    InvalidType
        If `data` is no such Dataset.
    InvalidValue
        If it has more gaps than there are marks.

    Examples
    --------
    >>> import stackbounce as sb
    >>> from stackbounce import plots
    >>> figure = plots.highest(sb.highest(["B1", "B2", "B3"], 2))
    >>> figure.axes[0].get_xlabel()
    'height of the top ball over that of the drop'
    """
    check_source(data, "height_ratio", "highest")
    if data.sizes["gap"] > len(_MARKS):
        raise InvalidValue(f"data must have at most {len(_MARKS)} gaps, got {data.sizes['gap']}")
    best = data.isel(stack=slice(_BARS))
    rows = np.arange(best.sizes["stack"])
    with panels((WIDTH, 1.4 + 0.32 * len(rows)), axes) as (figure, (axes,)):
        heights = best["height_ratio"].values
        axes.hlines(rows, heights.min(axis=1), heights.max(axis=1), color="#c8c8c8", linewidth=3.0)
        for k, gap in enumerate(best["gap"].values):
            look: Any = {"color": color_of(k), "marker": _MARKS[k], "linestyle": "none"}
            axes.plot(heights[:, k], rows, label=_gap_name(gap), markersize=6, **look)
        axes.set_yticks(rows, best["stack"].values.tolist())
        axes.set_ylim(len(rows) - 0.5, -0.5)
        axes.set_xlim(0.0, 1.05 * float(np.nanmax(heights, initial=0.1)))
        axes.set_xlabel("height of the top ball over that of the drop")
        draw_legend(axes, data.sizes["gap"])
    return figure


def _gap_name(gap: float) -> str:
    if math.isnan(gap):
        return "with its own gaps"
    return "touching" if gap == 0.0 else f"gaps of {1e3 * gap:.4g} mm"
