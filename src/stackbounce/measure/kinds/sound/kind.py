"""Sound as a kind of measurement."""

from itertools import pairwise
from typing import TYPE_CHECKING, Any

from stackbounce.measure.kind import Kind
from stackbounce.model.drop import STANDARD_GRAVITY

if TYPE_CHECKING:
    import xarray as xr

    from stackbounce.measure.finding import Finding
    from stackbounce.measure.kinds.bounces.knocks import Knocks

__all__ = ["SOUND"]


def _analyse(
    data: "xr.Dataset",
    *,
    height: Any = None,
    measured_to: Any = "bottom",
    diameter: Any = None,
    gravity: float = STANDARD_GRAVITY,
) -> "tuple[Finding, ...]":
    from stackbounce.measure.kinds.bounces.analysis import bounces
    from stackbounce.measure.kinds.heights.analysis import fallen
    from stackbounce.measure.kinds.sound.analysis import knocks
    from stackbounce.measure.kinds.sound.few_bounces import few_bounces

    height = fallen(height, measured_to, diameter)
    heard = knocks(data)
    if _are_enough(heard, height):
        return bounces(heard, drop_height=height, gravity=gravity), heard
    return few_bounces(heard, gravity=gravity), heard


def _are_enough(heard: "Knocks", height: Any) -> bool:
    """Tell whether there are two flights in a row, of which the first may be the drop."""
    whole = [height is not None, *(not lost for lost in heard.missed)]
    return any(one and other for one, other in pairwise(whole))


SOUND = Kind(
    "sound",
    "restitution of each bounce, its fall with speed",
    _analyse,
    columns=(("time",), ("sound",)),
)
