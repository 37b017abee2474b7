"""The plot of the result of any measurement analysis, drawn by the module that it names."""

from importlib import import_module
from typing import TYPE_CHECKING, Any

from stackbounce.errors import InvalidType, shown

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def measured(data: Any, found: Any) -> "Figure":
    """Draw the result of a measurement analysis together with the data.

    Parameters
    ----------
    data : xarray.Dataset
        The measured data, as from `read`.
    found : object
        The result of `stackbounce.measure.analyse`, or of one of the analyses.

    Returns
    -------
    matplotlib.figure.Figure

    Raises
    ------
    InvalidType
        If `found` is not the result of an analysis.

    Examples
    --------
    >>> from stackbounce.measure import bounces
    >>> figure = measured(None, bounces([0.0, 0.8, 1.44, 1.952]))
    """
    picture = getattr(found, "picture", None)
    if not isinstance(picture, str):
        raise InvalidType(f"found must be what an analysis returns, got {shown(found)}")
    figure: Figure = import_module(f"stackbounce.plots.measurements.{picture}").draw(data, found)
    return figure
