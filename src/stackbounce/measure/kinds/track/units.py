"""The units of a track: those of SI, or pixels and frames where no scale or clock is known."""

from typing import Any, NamedTuple

from stackbounce.measure.kinds.track.time_base import TimeBase

__all__ = ["SI", "TrackUnits", "uncalibrated", "units_of"]


class TrackUnits(NamedTuple):
    """The units that a track's positions and times are in.

    Attributes
    ----------
    length : str
        ``"m"`` or ``"px"``.
    time : str
        ``"s"`` or ``"frame"``.

    Examples
    --------
    >>> TrackUnits("px").speed, TrackUnits("px").known
    ('px/s', False)
    """

    length: str = "m"
    time: str = "s"

    @property
    def known(self) -> bool:
        """Whether they are those of SI, so that gravity can check them."""
        return self == SI

    @property
    def speed(self) -> str:
        """The unit of speeds."""
        return f"{self.length}/{self.time}"


SI = TrackUnits()


def units_of(data: Any) -> TrackUnits:
    """Return the units of a Dataset, those of SI where it tells none."""
    axis = next((one for one in ("y", "x") if one in getattr(data, "data_vars", ())), None)
    if axis is None:
        return SI
    said = [
        data[name].attrs.get("units") if name in data.variables else "" for name in (axis, "time")
    ]
    return TrackUnits("px" if said[0] == "px" else "m", "frame" if said[1] == "frame" else "s")


def uncalibrated(base: TimeBase, units: TrackUnits, gravity: float) -> TimeBase:
    """Return what gravity says of a track whose scale or clock is not known, `gravity` in m/s²."""
    fall = f"The flights fall with {base.gravity:.2uS} {units.speed}^2"
    if units.time == "s":
        scale = gravity / base.gravity.nominal_value
        note = f"{fall}: if that is free fall, the scale is {scale:.3g} m for a pixel."
    else:
        note = f"{fall}: restitutions do not depend on frame rate and scale, heights and speeds do."
    return base._replace(frame_rate_factor=None, agrees=False, note=note)
