"""The axes of the plots of sweeps: positions, cell edges, units and ticks."""

import re
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from stackbounce.library_types import Axes, Axis, Dataset
from stackbounce.units import handy

_ROUND_OFF = 1e-9  # relative; smaller differences are none


class Scale(NamedTuple):
    """The positions of a dimension's values on an axis.

    Parameters
    ----------
    places : ndarray
        (n,) ascending; the values, or 0, 1, … if there are none or they are not numbers.
    log : bool
        Whether the values are logarithmically spaced.
    unit : str
        SI, or empty.

    Examples
    --------
    >>> Scale(np.array([1.0, 10.0, 100.0]), True, "kg").edges().round(2)
    array([  0.32,   3.16,  31.62, 316.23])
    """

    places: NDArray[Any]
    log: bool
    unit: str

    def edges(self) -> NDArray[np.float64]:
        """Return the edges of the cells around the places, (n + 1,)."""
        places = np.log(self.places) if self.log else self.places.astype(float)
        if len(places) == 1:
            wide = 0.05 * abs(places[0]) or 0.5
            return np.array([places[0] - wide, places[0] + wide])
        middle = 0.5 * (places[1:] + places[:-1])
        ends = 2.0 * places[[0, -1]] - middle[[0, -1]]
        edges: NDArray[np.float64] = np.concatenate([ends[:1], middle, ends[1:]])
        return np.exp(edges) if self.log else edges


def read_scale(data: Dataset, dim: Any) -> Scale:
    """Return the scale of a dimension, by which `data` must be sorted."""
    size = data.sizes[dim]
    if dim not in data.coords or data[dim].dtype.kind not in "iuf":
        return Scale(np.arange(size), False, "")
    values = data[dim].values
    log = False
    if size > 2 and values[0] > 0.0:
        ratios = np.diff(np.log(values))
        log = bool(ratios.min() > 0.0 and np.ptp(ratios) < 1e-6 * ratios.max())
    return Scale(values, log, data[dim].attrs.get("units", ""))


def path_of(data: Dataset, dim: Any) -> str:
    """Return the path of the number that varies along a dimension, or the dimension's name."""
    return str(data[dim].attrs.get("path", dim))


def label(axes: Axes, which: str, name: str, scale: Scale) -> None:
    """Label an axis with name and unit, and set its ticks; the data stay in SI units."""
    axis: Axis = getattr(axes, f"{which}axis")
    if scale.log:
        getattr(axes, f"set_{which}scale")("log")
    unit, _ = show_in_handy_unit(axis, scale.places, scale.unit, scale.log)
    raised = re.sub(r"\*\*(-?[\d.]+)", r"$^{\1}$", unit)
    axis.set_label_text(f"{name} ({raised})" if unit else name)


def show_in_handy_unit(
    axis: Axis, values: NDArray[Any], unit: str, log: bool = False
) -> tuple[str, float]:
    """Label the ticks of an axis in a suitably prefixed unit; return the unit and its factor."""
    from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

    finite = np.abs(values[np.isfinite(values)])
    most, least = (finite.max(), finite.min()) if finite.size else (0.0, 0.0)
    name, factor = handy(float(most), unit)
    if log:
        if most < 300.0 * least:
            axis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
        axis.set_minor_formatter(NullFormatter())
        if least * factor < 1e-3 or most * factor >= 1e5:  # powers of ten, of the unit itself
            return unit, 1.0
    if log or factor != 1.0:
        axis.set_major_formatter(FuncFormatter(lambda x, _: f"{x * factor:.6g}".replace("-", "−")))
    return name, factor


def is_flat(values: NDArray[Any]) -> bool:
    """Return whether all finite values are equal within round-off.

    Examples
    --------
    >>> is_flat(np.array([1.0, 1.0 + 1e-14, np.nan])), is_flat(np.array([0.0, 1e-5]))
    (True, False)
    """
    finite = values[np.isfinite(values)]
    return not finite.size or bool(np.ptp(finite) <= _ROUND_OFF * np.abs(finite).max())
