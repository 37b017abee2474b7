"""Plots of stacks: the outcome of one stack against its gaps, and the ranking of many."""

from typing import TYPE_CHECKING, Any

import numpy as np

from stackbounce.errors import InvalidValue
from stackbounce.plots.scales import show_in_handy_unit
from stackbounce.plots.style import color_of, styled_figure
from stackbounce.plots.sweep_curves import IN_A_ROW, check_source, draw_legend, name_of

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

__all__ = ["highest", "transition"]

_BARS = 12  # stacks that are drawn at most
_MARKS = ("o", "s", "^", "D", "v", "P", "X", "*")


def transition(data: "xr.Dataset") -> "Figure":
    """Draw the outcome of a stack for gaps from touching balls to separate collisions.

    Parameters
    ----------
    data : xarray.Dataset
        From `stackbounce.transition`.

    Returns
    -------
    matplotlib.figure.Figure
        Above, the rebound ratio of each ball against the gap, with thin lines for separate
        collisions; below, the collisions of each contact. The grey area is above the separation
        limit. Not shown and not saved.

    Raises
    ------
    InvalidType
        If `data` is no such Dataset.

    Examples
    --------
    >>> import stackbounce as sb
    >>> from stackbounce import plots
    >>> drop = sb.Drop([sb.Ball(1.0)] * 2, [sb.Spring(1.0)] * 2, impact_speed=1.0)
    >>> figure = plots.transition(sb.transition(drop))
    >>> [axes.get_ylabel() for axes in figure.axes]
    ['rebound ratio', 'collisions']
    """
    check_source(data, "textbook_ratio", "transition")
    with styled_figure(6.4, 5.2) as figure:
        above, below = figure.subplots(2, 1, sharex=True, height_ratios=[3, 1.6])
        gap = data["gap"].values
        for ball in data["ball"].values:
            look: Any = {"color": color_of(ball)}
            ratios = data["rebound_ratio"].sel(ball=ball)
            above.plot(gap, ratios, label=name_of(data, "ball", ball), **look)
            textbook = float(data["textbook_ratio"].sel(ball=ball))
            above.axhline(textbook, linewidth=0.9, linestyle=":", **look)
        _draw_collisions(below, data)
        limit = data.attrs["separate_from"]
        for axes in (above, below):
            if limit < gap[-1]:
                axes.axvspan(limit, gap[-1], color="#efefef", linewidth=0.0, zorder=-2.0)
            axes.set_xlim(0.0, gap[-1])
        above.set_ylabel("rebound ratio")
        draw_legend(above, data.sizes["ball"])
        unit, _ = show_in_handy_unit(below.xaxis, gap, "m")
        below.set_xlabel(f"gap ({unit})")
        figure.align_ylabels()
    return figure


def highest(data: "xr.Dataset") -> "Figure":
    """Draw the rebound height of the top ball for the best stacks, for each gap.

    Parameters
    ----------
    data : xarray.Dataset
        From `stackbounce.highest`.

    Returns
    -------
    matplotlib.figure.Figure
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
        most = len(_MARKS)
        raise InvalidValue(f"data must have at most {most} gaps, got {data.sizes['gap']}")
    best = data.isel(stack=slice(_BARS))
    rows = np.arange(best.sizes["stack"])
    with styled_figure(7.2, 1.4 + 0.32 * len(rows)) as figure:
        axes = figure.subplots()
        heights = best["height_ratio"].values
        axes.hlines(rows, heights.min(axis=1), heights.max(axis=1), color="#c8c8c8", linewidth=3.0)
        for k, gap in enumerate(best["gap"].values):
            look: Any = {"color": color_of(k), "marker": _MARKS[k], "linestyle": "none"}
            axes.plot(heights[:, k], rows, label=_gap_name(gap), markersize=6, **look)
        names = [" + ".join(map(str, stack)) for stack in best["balls"].values]
        axes.set_yticks(rows, names)
        axes.set_ylim(len(rows) - 0.5, -0.5)
        axes.set_xlim(left=0.0)
        axes.set_xlabel("height of the top ball over that of the drop")
        figure.legend(loc="outside upper left", ncols=IN_A_ROW, frameon=False, handlelength=1.6)
    return figure


def _draw_collisions(axes: "Axes", data: "xr.Dataset") -> None:
    """Draw the number of collisions of each contact as steps, with wider lines for lower contacts.

    Lines with equal counts therefore stay visible.
    """
    from matplotlib.ticker import MaxNLocator

    count = data.sizes["contact"]
    for contact in data["contact"].values:
        width = 1.5 + min(2.0, 6.0 / count) * (count - 1 - contact)
        counts = data["collisions"].sel(contact=contact)
        look: Any = {"color": color_of(contact), "linewidth": width}
        axes.plot(data["gap"].values, counts, drawstyle="steps-post", **look)
    most = int(data["collisions"].max())
    axes.set_ylim(-0.1 * most, 1.15 * most)
    axes.yaxis.set_major_locator(MaxNLocator(4, integer=True, min_n_ticks=1))
    axes.set_ylabel("collisions")


def _gap_name(gap: float) -> str:
    return "touching" if gap == 0.0 else f"gaps of {1e3 * gap:.4g} mm"
