"""The plot of the result of any measurement analysis, drawn by the module that it names."""

from importlib import import_module
from typing import Any

from stackbounce.errors import InvalidType
from stackbounce.library_types import Figure
from stackbounce.plots.style import drawn_by, into_axes


@into_axes
def measured(data: Any, found: Any, *, axes: Any = None) -> Figure:
    """Draw the result of a measurement analysis together with the data.

    Parameters
    ----------
    data : xarray.Dataset
        The measured data, as from `read`.
    found : object
        The result of one analysis, or of `stackbounce.measure.analyse`, whose last one is drawn.
    axes : matplotlib.axes.Axes or sequence of them, optional
        Where to draw: as many as the picture has panels; by default in a new figure.

    Returns
    -------
    matplotlib.figure.Figure, or `axes` if given

    Raises
    ------
    InvalidType
        If `found` is not the result of an analysis.
    InvalidValue
        If `axes` are not as many as the picture has panels.

    Examples
    --------
    >>> from stackbounce.measure import bounces
    >>> figure = measured(None, bounces([0.0, 0.8, 1.44, 1.952]))
    """
    found = found[-1] if isinstance(found, tuple) and found else found
    if not isinstance(getattr(found, "picture", None), str):
        raise InvalidType(f"found must be what an analysis returns, got {drawn_by(found)}")
    module = import_module(f"stackbounce.plots.measurements.{found.picture}")
    figure: Figure = module.draw(data, found, axes)
    return figure
