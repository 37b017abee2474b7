"""The picture of a result, drawn by the module that the result names."""

from importlib import import_module
from typing import TYPE_CHECKING, Any

from stackbounce.errors import InvalidType, shown

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["measured"]


def measured(data: Any, found: Any) -> "Figure":
    """Draw what an analysis found on what was measured.

    Parameters
    ----------
    data : xarray.Dataset
        What was measured, as `read` gives it.
    found : object
        What `stackbounce.measure.analyse`, or one of the analyses, found.

    Returns
    -------
    matplotlib.figure.Figure

    Raises
    ------
    InvalidType
        If `found` is nothing that has a picture.

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
