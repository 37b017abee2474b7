"""The own files of Tracker (.trk) and Logger Pro (.cmbl), both XML -> the tables in them.

XML with a document type is refused: without one there are no entities, nor other files to read.
"""

import math
from collections.abc import Iterator
from typing import NamedTuple
from xml.etree.ElementTree import Element, ParseError, fromstring

from stackbounce.errors import FileError
from stackbounce.measure.reading.tables import Tables, as_text
from stackbounce.measure.reading.text import decode

_BYTES = 2**25
"""Bytes of XML, at most: its tree takes some ten times as much memory."""

_TRACKER, _MASS = b"org.opensourcephysics.cabrillo.tracker", "tracker.PointMass"
_LOGGER_PRO = b"<DataSet"


class _Frame(NamedTuple):
    """Origin in pixels, angle in degrees, pixels per unit: the coordinates of a frame."""

    xorigin: float = 0.0
    yorigin: float = 0.0
    angle: float = 0.0
    xscale: float = 1.0
    yscale: float = 1.0

    def seen(self, x: float, y: float) -> tuple[float, float]:
        """Return where a pixel is in these coordinates, y upwards."""
        x, y, turn = x - self.xorigin, y - self.yorigin, math.radians(self.angle)
        return (
            (x * math.cos(turn) - y * math.sin(turn)) / self.xscale,
            -(x * math.sin(turn) + y * math.cos(turn)) / self.yscale,
        )


def tables(content: bytearray) -> Tables | None:
    """Return the tables in a file of Tracker or Logger Pro, None for any other file.

    Raises
    ------
    FileError
        If it is too large, broken, has a document type, or no table.
    """
    if not content[:64].removeprefix(b"\xef\xbb\xbf").lstrip().startswith(b"<"):
        return None
    begin = bytes(content[:2000])
    if _TRACKER in begin:
        return _tracker(_tree(content, "Tracker"))
    if b"<Document" in begin and _LOGGER_PRO in content:
        return _logger_pro(_tree(content, "Logger Pro"))
    return None


def _tree(content: bytearray, program: str) -> Element:
    if len(content) > _BYTES:
        raise FileError(
            f"it is a file of {program} larger than {_BYTES >> 20} MiB: export its table as text"
        )
    text = decode(content)
    if "<!DOCTYPE" in text:
        raise FileError(f"it is a file of {program} with a document type, which none has")
    try:
        return fromstring(text)
    except (ParseError, ValueError, RecursionError) as error:
        why = " ".join(str(error).split())[:200]
        raise FileError(
            f"it is a file of {program} that cannot be read ({why}): export its table as text"
        ) from error


def _tracker(tree: Element) -> Tables:
    """Return the positions of all point masses: from pixels by the clip's clock and axes."""
    clip, control = _first(tree, "media.core.VideoClip"), _first(tree, "ClipControl")
    start, begin = _number(clip, "startframe", 0.0), _number(clip, "starttime", 0.0)
    step = _number(control, "delta_t", math.nan)  # in ms, of one frame
    axes = {
        k: _Frame(*(_number(one, name, value) for name, value in _Frame()._asdict().items()))
        for k, one in _frames(_first(tree, "ImageCoordSystem"))
    } or {0: _Frame()}
    if not step > 0.0 or any(not abs(axis.xscale * axis.yscale) > 0.0 for axis in axes.values()):
        raise FileError("it is a file of Tracker without a clock or a scale: export its table")
    seen: dict[str, dict[int, tuple[float, float]]] = {}
    for mass in _objects(tree, _MASS):
        points = {
            k: axes[max((axis for axis in axes if axis <= k), default=min(axes))].seen(
                _number(one, "x", math.nan), _number(one, "y", math.nan)
            )
            for k, one in _frames(mass)
        }
        if points:
            name = (_text(mass, "name") or "mass").replace("\t", " ")
            seen[name if name not in seen else f"{name} {len(seen) + 1}"] = points
    if not seen:
        raise FileError("it is a file of Tracker without a track of a point mass")
    plain = all(axis.xscale == axis.yscale == 1.0 for axis in axes.values())
    unit = "px" if plain else _text(tree, "length_unit") or "m"
    rows: list[list[object]] = [
        ["#multi:"],
        ["", *(cell for name in seen for cell in (name, ""))],
        ["t (s)", *(f"{axis} ({unit})" for _ in seen for axis in "xy")],
    ]
    for k in sorted(set().union(*seen.values())):
        places = (cell for row in seen.values() for cell in row.get(k, (None, None)))
        rows.append([1e-3 * (begin + step * (k - start)), *places])
    why = "its XML is Tracker's; pixels are converted by its clock, axes and scale"
    return Tables({"tracks": as_text(rows)}, "Tracker", why, "file", ".")


def _logger_pro(tree: Element) -> Tables:
    """Return the data sets side by side, each column named with its run before it."""
    names: list[str] = []
    columns: list[list[str]] = []
    for k, member in enumerate(tree.iter("DataSet"), 1):
        run = "".join(c for c in member.findtext("DataSetName") or f"Run {k}" if c not in ":([")[
            :40
        ]
        for column in member.iter("DataColumn"):
            cells = (column.findtext("ColumnCells") or "").strip("\n").split("\n")
            if any(cell.strip() for cell in cells):
                name, unit = (
                    (column.findtext(key) or "").strip()
                    for key in ("DataObjectName", "ColumnUnits")
                )
                names.append(f"{run}: {name or 'column'}" + f" ({unit})" * bool(unit))
                columns.append(cells)
    if not columns:
        raise FileError("it is a file of Logger Pro without numbers: export its table as text")
    length = max(map(len, columns))
    padded = [column + [""] * (length - len(column)) for column in columns]
    why = "its XML is Logger Pro's"
    members = {"data": as_text([names, *zip(*padded, strict=True)])}
    return Tables(members, "Logger Pro", why, "file", ".")


def _objects(tree: Element, of: str) -> Iterator[Element]:
    return (node for node in tree.iter("object") if node.get("class", "").endswith(of))


def _first(tree: Element, of: str) -> Element | None:
    return next(_objects(tree, of), None)


def _property(one: Element | None, name: str) -> Element | None:
    return None if one is None else one.find(f"property[@name='{name}']")


def _text(one: Element | None, name: str) -> str:
    found = _property(one, name)
    return "" if found is None else " ".join((found.text or "").split())


def _number(one: Element | None, name: str, default: float) -> float:
    try:
        return float(_text(one, name) or default)
    except ValueError as error:
        raise FileError(f"it is a file of Tracker whose {name} is no number") from error


def _frames(one: Element | None) -> Iterator[tuple[int, Element]]:
    """Yield the objects in the array framedata of an object, with their places in it."""
    array = _property(one, "framedata")
    for each in () if array is None else array.findall("property"):
        place, inner = (each.get("name") or "").strip("[]"), each.find("object")
        if place.isdecimal() and len(place) < 9 and inner is not None:
            yield int(place), inner
