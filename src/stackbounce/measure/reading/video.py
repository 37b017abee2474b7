"""Positions by frame of a video: frames as times, pixels as lengths, one row for each frame."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from itertools import islice
from types import MappingProxyType
from typing import TypeAlias

import numpy as np

from stackbounce.measure.messages import Message, OptionHint
from stackbounce.measure.quantities import Array
from stackbounce.measure.reading.roles import FRAME, PIXEL, POINT, Column, column, heading

_Tracks: TypeAlias = tuple[list[Column], Array, list[str]]
"""Columns with their numbers, and what is unsure."""

_TRACKS = 12  # tracks below each other that are read, at most: the longest ones
_RATE, _SCALE = OptionHint({"frame_rate": None}), OptionHint({"scale": None})
_ROLES = {"", "x", "y", "track_id"}  # of columns beside which rows are frames
_LEAST = 5  # points of a track that is put together
_REACH = 0.05  # of the range of all points: how far from its path the next point of a track may be
_LOST = 5  # frames after which a track has no path any more
_STILL = 0.1  # of the range of the track that moves most: tracks that move less are specks


def on_frames(
    columns: Sequence[Column],
    frame_rate: float | None = None,
    scale: float | None = None,
    values: Mapping[int, Array] = MappingProxyType({}),
) -> tuple[list[Column], list[str]]:
    """Return columns in which frames are times, where there is no clock, and what is unsure.

    x and y without any count of frames are taken frame by frame; a single position only with a
    frame rate.

    Parameters
    ----------
    columns : sequence of Column
        As the header has them; without a position they stay as they are.
    frame_rate : float or None
        In 1/s; without it a frame is the unit of time.
    scale : float or None
        Metres per pixel; without it a pixel is the unit of length.
    values : mapping, optional
        The numbers of columns by their places in the file; with a frame rate, times without a unit
        that count by ones are frames.
    """
    roles = {column.role for column in columns}
    if not roles & {"x", "y"}:
        return list(columns), []
    found, doubts = list(columns), []
    video = frame_rate is not None or {"x", "y"} <= roles <= _ROLES
    if video and not roles & {"time", "frame"}:
        found.append(column(-1, heading("row"), "frame"))
        doubts.append("it does not count frames either, so that each row is one")
    return found, [*_timed(found, frame_rate, values), *doubts, *_scaled(found, scale)]


def _timed(found: list[Column], frame_rate: float | None, values: Mapping[int, Array]) -> list[str]:
    """Make frames times, where columns hold no others; return what is unsure."""
    at = next((k for k, member in enumerate(found) if member.role == "frame"), None)
    clock = next((k for k, member in enumerate(found) if member.role == "time"), None)
    if clock is not None and frame_rate is not None and _counts(found[clock], values):
        at, clock = clock, None
    if at is None or clock is not None:
        return [] if frame_rate is None else [Message(_RATE, " is not used, as the file has times")]
    said = replace(found[at].heading, unit=FRAME)
    factor, unit = (1.0, FRAME) if frame_rate is None else (1.0 / frame_rate, "s")
    found[at] = replace(found[at], heading=said, role="time", factor=factor, unit=unit)
    doubt = Message(
        "it has no times, so that a frame is the unit of time: ", _RATE, " tells frames per second"
    )
    return [doubt] if frame_rate is None else []


def _counts(column: Column, values: Mapping[int, Array]) -> bool:
    """Return whether the numbers of a column without a unit count by ones, perhaps with gaps."""
    numbers = values.get(column.index, np.empty(0))
    steps = np.diff(numbers[np.isfinite(numbers)])
    bare = not (column.unit or column.heading.unit)
    return bare and bool(steps.size and (steps % 1.0 == 0.0).all() and steps[steps > 0].min() == 1)


def _scaled(found: list[Column], scale: float | None) -> list[str]:
    """Make columns of positions those in m, or in pixels where no scale is known."""
    by_frame = any(column.role == "time" and column.heading.unit == FRAME for column in found)
    places = [k for k, member in enumerate(found) if member.role in ("x", "y")]
    bare = [k for k in places if not found[k].heading.unit and (by_frame or scale is not None)]
    pixels = [k for k in places if found[k].unit == PIXEL or k in bare]
    for k in pixels:
        factor, unit = (1.0, PIXEL) if scale is None else (scale, "m")
        found[k] = replace(found[k], factor=factor, unit=unit, doubt="")
    if pixels and scale is None:
        names = " and ".join(dict.fromkeys(found[k].role for k in pixels))
        verb = "are" if " and " in names else "is"
        return [Message(f"{names} {verb} taken as pixels: ", _SCALE, " tells metres per pixel")]
    if scale is not None and not pixels:
        return [Message(_SCALE, " is not used, as the positions have units")]
    return []


def rows_by_frame(columns: Sequence[Column], values: Array) -> _Tracks:
    """Return a table of tracks with one row for each time, and what is unsure.

    Tracks that stand below each other, told apart by a column of their numbers, are put side by
    side. Of several points in a frame that belong to no track, the one next to the point before is
    taken. Where several columns are told to be heights, each is a track.
    """
    columns = list(columns)
    told = {axis: [k for k, own in enumerate(columns) if own.named == axis] for axis in "xy"}
    if len(told["y"]) > 1:
        tracks = [columns[k].heading.name for k in told["y"]]
        if len({*tracks} - {""}) < len(tracks):
            tracks = [f"column {columns[k].index + 1}" for k in told["y"]]
        for k, track in (pair for own in told.values() for pair in zip(own, tracks, strict=False)):
            columns[k] = replace(columns[k], track=track)
    at = next((k for k, column in enumerate(columns) if column.role == "track_id"), None)
    time = next(k for k, column in enumerate(columns) if column.role == "time")
    if at is not None:
        return _side_by_side(columns, values, time, at)
    if any(column.track.startswith(POINT) for column in columns):
        return _linked(columns, values, time)
    if columns[time].heading.unit != FRAME or len({column.track for column in columns}) > 1:
        return list(columns), values, []
    places = [k for k, column in enumerate(columns) if column.role in ("x", "y")]
    kept = _nearest(values[:, time], values[:, places])
    many = len(values) - len(kept)
    doubt = f"{many} rows are further points in a frame: the one next to the point before is taken"
    return list(columns), values[kept], [doubt] * (many > 0)


def _side_by_side(columns: Sequence[Column], values: Array, time: int, at: int) -> _Tracks:
    import pandas as pd

    points = pd.DataFrame(values).dropna(subset=[time, at])
    lengths = points[at].value_counts()
    longest = points[points[at].isin(lengths.index[:_TRACKS])]
    places = [k for k, column in enumerate(columns) if column.role in ("x", "y")]
    single = longest.drop_duplicates([time, at], keep="last")
    table = single.pivot(index=time, columns=at, values=places)
    found = [replace(columns[k], track=f"track {track:g}") for k, track in table.columns]
    left = len(lengths) - _TRACKS
    doubts = [f"{left} shorter tracks are left out"] if left > 0 else []
    return [columns[time], *found], table.reset_index().to_numpy(np.float64), doubts


def _nearest(frames: Array, places: Array) -> list[int]:
    """Return one row of each run of equal frames, that next to the row kept before."""
    kept: list[int] = []
    for row, frame in enumerate(frames):
        if not kept or frame != frames[kept[-1]]:
            kept.append(row)
        elif kept[1:]:
            far = np.linalg.norm(places[[kept[-1], row]] - places[kept[-2]], axis=1)
            kept[-1] = row if far[1] < far[0] else kept[-1]
    return kept


def _linked(columns: Sequence[Column], values: Array, time: int) -> _Tracks:
    """Return tracks that are put together from points, each next to where it should be."""
    x, y = (
        {column.track: k for k, column in enumerate(columns) if column.role == axis}
        for axis in "xy"
    )
    axes = [[own[track] for track in x if track in y] for own in (x, y)]
    tracks = _together(values[:, time], np.stack([values[:, own] for own in axes], axis=-1))
    table = np.full((len(values), 1 + 2 * len(tracks)), np.nan)
    table[:, 0] = values[:, time]
    found = [columns[time]]
    for track in tracks:
        for axis, own in enumerate(axes):
            table[list(track), len(found)] = [place[axis] for place in track.values()]
            found.append(replace(columns[own[0]], track=f"track {(len(found) + 1) // 2}"))
    return found, table, []


def _together(times: Array, points: Array) -> list[dict[int, Array]]:
    """Return moving tracks as points by row, the longest first, of points (rows, any, x and y).

    In each row the longest track is the first to take the point next to its path.
    """
    known = np.asarray(np.isfinite(points).all(axis=2))
    reach = _REACH * float(np.ptp(points[known], axis=0).max()) if known.any() else 0.0
    tracks: list[dict[int, Array]] = []
    live: list[dict[int, Array]] = []
    for row, now in enumerate(times.tolist()):
        left = list(points[row][known[row]])
        live = [track for track in live if now - times[next(reversed(track))] <= _LOST]
        for track in sorted(live, key=len, reverse=True):
            off = [float(np.hypot(*(place - _expected(track, times, now)))) for place in left]
            if off and min(off) <= reach:
                track[row] = left.pop(off.index(min(off)))
        new = [{row: place} for place in left]
        tracks += new
        live += new
    found = [track for track in tracks if len(track) >= _LEAST]
    ranges = [float(np.ptp(list(track.values()), axis=0).max()) for track in found]
    widest = max(ranges, default=0.0)
    moving = [track for track, wide in zip(found, ranges, strict=True) if wide > _STILL * widest]
    return sorted(moving, key=len, reverse=True)[:_TRACKS]


def _expected(track: dict[int, Array], times: Array, now: float) -> Array:
    """Return where a track would go on to, by its last two points."""
    rows = list(islice(reversed(track), 2))
    last, before = rows[0], rows[-1]
    since = float(times[last] - times[before])
    if not since > 0.0:
        return track[last]
    ahead = float(now - times[last]) / since
    return np.asarray(track[last] + ahead * (track[last] - track[before]))
