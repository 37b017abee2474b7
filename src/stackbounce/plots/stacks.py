"""The plot of the ranking of stacks."""

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from stackbounce.errors import InvalidValue
from stackbounce.plots.style import color_of, styled_figure
from stackbounce.plots.sweep_curves import IN_A_ROW, check_source

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

_BARS = 12  # stacks that are drawn at most
_MARKS = ("o", "s", "^", "D", "v", "P", "X", "*")


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
        axes.set_yticks(rows, best["stack"].values.tolist())
        axes.set_ylim(len(rows) - 0.5, -0.5)
        axes.set_xlim(0.0, 1.05 * float(np.nanmax(heights, initial=0.1)))
        axes.set_xlabel("height of the top ball over that of the drop")
        figure.legend(loc="outside upper left", ncols=IN_A_ROW, frameon=False, handlelength=1.6)
    return figure


def _gap_name(gap: float) -> str:
    if math.isnan(gap):
        return "with its own gaps"
    return "touching" if gap == 0.0 else f"gaps of {1e3 * gap:.4g} mm"
