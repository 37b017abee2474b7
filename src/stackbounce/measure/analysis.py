"""The right analysis for what a file holds."""

from itertools import pairwise
from typing import TYPE_CHECKING, Any

from stackbounce.errors import InvalidType, InvalidValue, shown
from stackbounce.measure.bounces import bounces
from stackbounce.measure.few import few_bounces
from stackbounce.measure.press import press
from stackbounce.measure.sound import Knocks, knocks
from stackbounce.measure.track import track
from stackbounce.measure.waveform import waveform
from stackbounce.model.drop import STANDARD_GRAVITY

if TYPE_CHECKING:
    import xarray as xr

__all__ = ["analyse"]


def analyse(
    data: "xr.Dataset",
    *,
    mass: float | None = None,
    height: float | None = None,
    speed: float | None = None,
    time_constant: float | None = None,
    gravity: float = STANDARD_GRAVITY,
) -> tuple[Any, ...]:
    r"""Return what is found in a measurement by the analysis, or analyses, that fit its kind.

    Parameters
    ----------
    data : xarray.Dataset
        As `read` gives it.
    mass : float, optional
        The ball's, in kg: makes a stiffness of a contact time.
    height : float, optional
        From where the ball fell, in m: gives the restitution of the first bounce.
    speed : float, optional
        Impact speed in m/s: calibrates the impulse of a force waveform.
    time_constant : float, optional
        Of a piezo sensor's droop, in s, which is then undone.
    gravity : float, optional
        In m/s**2.

    Returns
    -------
    tuple
        Of a sound `Bounces` (`FewBounces` where they are too few for a restitution) and `Knocks`;
        of knock times and of phyphox's bounces `Bounces`; of a track `Tracks`; of a force waveform
        `Waveform`; of a press curve `Press`.

    Raises
    ------
    InvalidType
        If `data` is none of `read`.
    InvalidValue
        If there is no analysis for what it holds, or nothing that it looks for is there.

    Examples
    --------
    >>> import stackbounce as sb
    >>> path = getfixture("tmp_path") / "knocks.csv"
    >>> text = '"Event time (s)","Interval (s)"\n0,0\n0.8,0.8\n1.44,0.64\n1.952,0.512\n'
    >>> _ = path.write_text(text)
    >>> (found,) = analyse(sb.read(path))
    >>> f"{found.mean.nominal_value:.3f}"
    '0.800'
    """
    holds = getattr(data, "attrs", {}).get("holds")
    if holds is None:
        raise InvalidType(f"data must be a Dataset from read, got {shown(data)}")
    if holds == "sound":
        heard = knocks(data)
        if _enough(heard, height):
            return bounces(heard, drop_height=height, gravity=gravity), heard
        return few_bounces(heard, gravity=gravity), heard
    if holds in ("knocks", "bounces"):
        return (bounces(data, drop_height=height, gravity=gravity),)
    if holds == "track":
        return (track(data, gravity=gravity),)
    if holds == "waveform":
        return (waveform(data, mass=mass, impact_speed=speed, time_constant=time_constant),)
    if holds == "press curve":
        return (press(data),)
    kinds = "sound, knocks, bounces, track, waveform, press curve"
    raise InvalidValue(f"there is no analysis of {holds}: tell what it holds, one of {kinds}")


def _enough(heard: Knocks, height: float | None) -> bool:
    """Tell whether there are two flights in a row, of which the first may be the drop."""
    whole = [height is not None, *(not lost for lost in heard.missed)]
    return any(one and other for one, other in pairwise(whole))
