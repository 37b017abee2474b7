"""TrackMate: spots in the frames of a video, with the tracks that they belong to."""

from stackbounce.measure.reading.headings import heading
from stackbounce.measure.reading.layouts import Layout, first_row, layout
from stackbounce.measure.reading.roles import column
from stackbounce.measure.reading.text import Text

_ROLES = {
    "TRACK_ID": "track_id", "FRAME": "frame", "POSITION_X": "x", "POSITION_Y": "y",
    "POSITION_T": "time",
}  # fmt: skip


@layout
def trackmate(text: Text) -> Layout | None:
    """Recognise TrackMate's spots: ``POSITION_X`` … over longer names, short ones and units."""
    names = text.head[0]
    if not {"FRAME", "POSITION_X", "POSITION_Y"} <= set(names):
        return None
    first = first_row(text, 1, [names.index("POSITION_X"), names.index("POSITION_Y")])
    units = text.head[first - 1] if first > 1 else []
    columns = []
    for k, name in enumerate(names):
        unit = units[k].strip("() ") if k < len(units) else ""
        if name in _ROLES and not (name == "POSITION_T" and unit in ("", "frame", "frames")):
            columns.append(column(k, heading(name, unit), _ROLES[name]))
    why = "FRAME, POSITION_X, POSITION_Y are columns of TrackMate's spots"
    return Layout("TrackMate", why, tuple(columns), first)
