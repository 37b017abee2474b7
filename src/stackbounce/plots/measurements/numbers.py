"""The plot of a result without a plot of its own: a table of its numbers with errors."""

from typing import Any

from stackbounce.library_types import Figure
from stackbounce.plots.style import file_of, panels
from stackbounce.shown import table_of

_MOST = 24  # rows that fit


def draw(data: Any, found: Any, axes: Any = None) -> Figure:
    """Draw the rows of a result as a table.

    Parameters
    ----------
    data : xarray.Dataset or None
        The measured data; the name of its file is written above the table.
    found : Finding
        The result of the analysis.
    axes : matplotlib.axes.Axes or sequence of them, optional
        Where to draw; by default in a new figure.

    Returns
    -------
    matplotlib.figure.Figure
        Not shown and not saved.
    """
    cells = table_of(found.table).rows[:_MOST]
    with panels((7.2, 1.0 + 0.28 * len(cells)), axes) as (figure, (axes,)):
        axes.axis("off")
        if cells:
            axes.table(cells, colLabels=["", "value", "unit"], loc="upper center", edges="open")
        axes.set_title(file_of(data), loc="left", fontsize=10)
    return figure
