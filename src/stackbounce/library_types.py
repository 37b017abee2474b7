"""Types of heavy libraries, for annotations: checkers of types import them, a run does not."""

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.axis import Axis
    from matplotlib.contour import ContourSet
    from matplotlib.figure import Figure, SubFigure
    from pandas import DataFrame
    from pint import UnitRegistry
    from rich.console import Console
    from uncertainties import UFloat
    from xarray import DataArray, Dataset
else:
    Axes = Axis = Console = ContourSet = DataArray = DataFrame = Dataset = Any
    Figure = SubFigure = UFloat = UnitRegistry = Any

__all__ = [
    "Axes", "Axis", "Console", "ContourSet", "DataArray", "DataFrame", "Dataset", "Figure",
    "SubFigure", "UFloat", "UnitRegistry",
]  # fmt: skip
