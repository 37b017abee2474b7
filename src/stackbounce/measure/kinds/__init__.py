"""The kinds of measurement, and a folder for each with its analysis and its result."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

from stackbounce.measure.kind import Kind

if TYPE_CHECKING:
    from stackbounce.measure.reading.roles import Column

__all__ = ["KINDS", "TYPED", "Kind", "kind_named"]

_IN_AIR = ("mass", "diameter", "drag_coefficient", "air_density")  # tell the drag of the air
_AXES = ("acceleration", "acceleration_absolute", "acceleration_z", "acceleration_y")


def _is_press_curve(columns: "Sequence[Column]") -> bool:
    """Return whether the columns have a force and a compression, or one length.

    Beside times, a length that is a position is none: that is a motion detector's.
    """
    roles = {column.role for column in columns}
    others = ("force", "x", "y") if "time" in roles else ("force",)
    lengths = [column for column in columns if column.unit == "m" and column.role not in others]
    return "force" in roles and ("compression" in roles or len(lengths) == 1)


_KNOCKS = Kind(
    "knocks",
    "restitution of each bounce, its fall with speed",
    f"{__name__}.bounces.analysis",
    options=("height", "measured_to", "contact_time", "gravity", *_IN_AIR),
    columns=(("knock_time",),),
    dimension="knock",
    longest_step=20.0,  # flights: 20 s are from a height of 500 m
)
_PRESS = Kind(
    "press curve",
    "static stiffness, exponent, loss",
    f"{__name__}.press.analysis",
    options=("tabulated",),
    columns=(("force",), ("compression",)),
    dimension="point",
    recognised=_is_press_curve,
)
_WAVEFORM = Kind(
    "waveform",
    "contacts, contact times, peaks, impulse, stiffness, gaps",
    f"{__name__}.waveform.kind",
    options=(
        *("mass", "contact_time", "law", "exponent", "height", "measured_to"),
        *("diameter", "speed", "time_constant", "gravity"),
    ),
    columns=(("time",), ("force", "voltage")),
)
_SOUND = Kind(
    "sound",
    "restitution of each bounce, its fall with speed",
    f"{__name__}.sound.kind",
    options=("height", "measured_to", "contact_time", "gravity", *_IN_AIR),
    columns=(("time",), ("sound",)),
    longest_step=2.5e-3,  # 400 samples per second: slower ones are no sound
)
_TRACK = Kind(
    "track",
    "drop height, speeds, restitution, rebound ratios, a check of clock and ruler",
    f"{__name__}.track.analysis",
    options=("floor", "measured_to", "gravity", *_IN_AIR),
    columns=(("time",), ("y", "x")),
    dimension="track",
    longest_step=2.0,  # a step of 1 may be a frame: gravity tells
)
_ACCELERATION = Kind(
    "acceleration",
    "drop height, restitution, contact times of fast sensors",
    f"{__name__}.acceleration.analysis",
    options=("gravity",),
    columns=(("time",), (*_AXES, "acceleration_x")),
)
_TABLE = Kind(
    "table",
    "restitution of each bounce, where its one column is heights",
    f"{__name__}.heights.kind",
    options=("heights", "height_error", "repeated", "measured_to", *_IN_AIR),
    dimension="row",
    starts_with=("heights",),
    typed="heights of bounces",
)
_CONTACT = Kind(
    "contact",
    "dynamic stiffness of a contact time",
    f"{__name__}.contact.kind",
    options=("contact_time", "restitution", "mass"),
    starts_with=("contact_time", "restitution"),
    typed="contact with the floor",
)

KINDS: dict[str, Kind] = {
    kind.name: kind for kind in (_KNOCKS, _PRESS, _WAVEFORM, _SOUND, _TRACK, _ACCELERATION, _TABLE)
}
"""What a file can hold; the first one that a file's columns fit is what it holds."""

TYPED: tuple[Kind, ...] = (_TABLE, _CONTACT)
"""What numbers without a file can tell."""


def kind_named(text: str) -> str | None:
    """Return the name of a kind of files, which may be typed in other ways; None for no kind.

    Examples
    --------
    >>> kind_named("press-curve"), kind_named("Press"), kind_named("sounds")
    ('press curve', 'press curve', None)
    """
    typed = " ".join(text.casefold().replace("-", " ").replace("_", " ").split())
    return next((name for name in KINDS if typed in (name, name.split()[0])), None)
