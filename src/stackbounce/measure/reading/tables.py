"""The tables of one file, each as the bytes of a file of its own.

Archives are unpacked in memory up to a limit; openpyxl reads spreadsheets of Excel, .xlsx. The own
files of Tracker (.trk) and Logger Pro (.cmbl) are XML. XML with a document type is refused: without
one there are no entities, nor other files to read. Of arrays of NumPy nothing is unpickled.
"""

import io
import math
import re
import warnings
import zipfile
import zlib
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from tokenize import TokenError
from typing import NamedTuple
from xml.etree.ElementTree import Element, ParseError, fromstring

import numpy as np

from stackbounce.errors import FileError, nearest, shown
from stackbounce.extras import need
from stackbounce.library_types import DataFrame
from stackbounce.measure.messages import about_option
from stackbounce.measure.reading.limits import BYTES, CELLS, COLUMNS, refusing
from stackbounce.measure.reading.text import decode

_MEMBERS = 1000  # of an archive, at most
_RATIO = 400  # of bytes to packed bytes; numbers as text come to about 10
_BROKEN = (zipfile.BadZipFile, zlib.error, EOFError, OSError, ValueError, RuntimeError)
_NO_ARRAY = (ValueError, TypeError, LookupError, SyntaxError, EOFError, RecursionError, TokenError)
_NO_XML = (ParseError, ValueError, RecursionError)
_ENDINGS = (".csv", ".tsv", ".txt", ".dat", ".lvm", ".npy", ".trk")
_BOOK_CELLS = 2**19  # cells of a spreadsheet, at most: some seconds
_BOOK_BYTES = 2**26  # bytes of its parts, unpacked, at most
_COMMA = re.compile(r"\s*[+-]?[0-9]+,[0-9]+(?:[eE][+-]?[0-9]{1,4})?\s*")
_Rows = Iterable[Sequence[object]]
_XML = 2**25  # bytes of XML, at most: its tree takes some ten times as much memory
_TRACKER, _MASS = b"org.opensourcephysics.cabrillo.tracker", "tracker.PointMass"
_LOGGER_PRO = b"<DataSet"


@dataclass(frozen=True)
class Tables:
    """The tables of one file.

    Parameters
    ----------
    members : dict of str to bytes
        Each as the bytes of a table, by its name.
    program : str, optional
        Which program wrote the file, if that is known without its tables.
    why : str, optional
        By what it was recognised.
    decimal : str, optional
        The decimal mark of its tables, where that is known.
    """

    members: dict[str, bytes]
    program: str = ""
    why: str = ""
    decimal: str | None = None


def as_text(rows: Iterable[Sequence[object]]) -> bytes:
    r"""Return rows of cells as the bytes of a table, with tabs and decimal points.

    Examples
    --------
    >>> as_text([("t (s)", "y"), (0.5, None)])
    b't (s)\ty\n0.5\t\n'
    """
    cells = (("" if cell is None else " ".join(str(cell).split()) for cell in row) for row in rows)
    return "".join("\t".join(row) + "\n" for row in cells).encode()


def tables_in(content: bytearray) -> Tables | None:
    """Return the tables in a packing of its own, each as a program writes it; None if it is one."""
    if content.startswith((b"PK\x03\x04", b"PK\x05\x06")):
        return from_xlsx(content) if b"xl/workbook.xml" in content else from_zip(content)
    return from_project(content)


def chosen(tables: Tables, table: object) -> str:
    """Return the name of the table that is asked for, by its name or the last part of it.

    Raises
    ------
    InvalidValue
        If there is none of that name, or more than one.
    """
    word = str(table).casefold()
    found = []
    for name in tables.members:
        whole = name.casefold()
        last = whole.rpartition("/")[2]
        if word in (whole, last, last.rpartition(".")[0]):
            found.append(name)
    if len(found) != 1:
        near = nearest(table, tables.members)
        raise about_option("table", f" must be one in the file, got {shown(table)}; {near}")
    return found[0]


def from_zip(content: bytearray) -> Tables:
    """Return the tables of an archive; the arrays of an .npz file are one table.

    Nothing is written to disk. Archives inside the archive are ignored.

    Raises
    ------
    FileError
        If the archive is broken, locked, a spreadsheet, without tables, or unpacks to too much.
    """
    if content.count(b"PK\x01\x02") > _MEMBERS:
        raise FileError(f"it is a zip archive of more than {_MEMBERS} files")
    words = "it is a zip archive that cannot be unpacked: {}"
    with refusing(_BROKEN, words), zipfile.ZipFile(io.BytesIO(content)) as archive:
        return _tables(archive)


def _tables(archive: zipfile.ZipFile) -> Tables:
    entries = archive.infolist()
    names = {entry.filename for entry in entries}
    if {"[Content_Types].xml", "META-INF/manifest.xml"} & names:
        raise FileError("it is a spreadsheet or document: save it as .xlsx or CSV")
    wanted = [
        entry for entry in sorted(entries, key=lambda entry: entry.filename)
        if entry.filename.casefold().endswith(_ENDINGS)
        and not entry.filename.startswith(("meta/", "__MACOSX/"))
    ]  # fmt: skip
    if not wanted:
        raise FileError(f"it is a zip archive without any table ({', '.join(_ENDINGS)})")
    found: dict[str, bytes] = {}
    left = BYTES
    for entry in wanted:
        if entry.file_size > 2**20 and entry.file_size > _RATIO * max(entry.compress_size, 1):
            much = f"more than {_RATIO} times its size"
            raise FileError(f"its {shown(entry.filename)} would unpack to {much}")
        found[entry.filename] = _unzip(archive, entry, left)
        left -= len(found[entry.filename])
    if all(name.endswith(".npy") for name in names):
        return from_arrays(found)
    if "meta/device.csv" in names:
        return Tables(found, "phyphox", "its meta/device.csv is phyphox's")
    return Tables(found)


def _unzip(archive: zipfile.ZipFile, entry: zipfile.ZipInfo, left: int) -> bytes:
    """Return the bytes of an entry, at most `left` of them, whatever size its header says."""
    with archive.open(entry) as file:
        content = file.read(left + 1)
    if len(content) > left:
        raise FileError(f"its tables would unpack to more than {BYTES >> 20} MiB")
    return content


def from_arrays(members: Mapping[str, bytes | bytearray]) -> Tables:
    """Return arrays of NumPy as tables; those that are columns of one length are one table.

    Raises
    ------
    FileError
        If one is cut off, empty, too large, no table, or holds no numbers.
    """
    import pandas as pd

    arrays = {name.removesuffix(".npy"): _array(content) for name, content in members.items()}
    columns = {name: array[0] for name, array in arrays.items() if list(array.columns) == [0]}
    if len(columns) == len(arrays) > 1 and len(set(map(len, columns.values()))) == 1:
        arrays = {"arrays": pd.DataFrame(columns)}
    texts = {
        name: array.to_csv(sep="\t", index=False, header=isinstance(array.columns[0], str)).encode()
        for name, array in arrays.items()
    }
    return Tables(texts, "NumPy", "it is an array of NumPy", ".")


def _array(content: bytes | bytearray) -> DataFrame:
    """Return the numbers of an array: its columns, or the fields of its records."""
    import pandas as pd

    with refusing((*_NO_ARRAY, MemoryError), "it is a NumPy array that cannot be read ({})"):
        array = np.load(io.BytesIO(content), allow_pickle=False)
        lying = array.ndim == 2 and array.shape[1] > COLUMNS >= array.shape[0]
        frame = pd.DataFrame(array.T if lying else array)
    if not 0 < frame.size <= CELLS or any(kind.kind not in "biuf" for kind in frame.dtypes):
        what = f"{array.dtype} and shape {array.shape}"
        raise FileError(f"it is a NumPy array of {what}: save one with rows of plain numbers")
    return frame.astype(np.float64).dropna(how="all")


def from_xlsx(content: bytearray) -> Tables:
    """Return the sheets of an .xlsx file.

    Raises
    ------
    FileError
        If it is broken, has no numbers, or is too large.
    MissingExtra
        If openpyxl is not installed.
    """
    need("an Excel file (.xlsx)", "openpyxl")
    left = [_BOOK_CELLS]
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of parts that hold no cells, such as styles
            found = {name: as_text(_bounded(rows, left)) for name, rows in _sheets(content)}
    except (FileError, MemoryError):
        raise
    except Exception as error:  # a broken file fails in too many ways to list them
        own = type(error).__module__ in ("builtins", "struct")  # of Python: no word for a user
        why = "it is damaged" if own else " ".join(str(error).split())[:200]
        raise FileError(
            f"it is a spreadsheet or document that cannot be read ({why}): save it as CSV"
        ) from error
    names = sorted(found, key=lambda name: name.casefold() != "raw data")  # phyphox's table
    found = {name: found[name] for name in names if found[name].strip()}
    if not found:
        raise FileError("it is a spreadsheet without any cell: save the one with numbers")
    return Tables(found, "", "it is a sheet of a spreadsheet", ".")


def _sheets(content: bytearray) -> Iterator[tuple[str, _Rows]]:
    import openpyxl

    with zipfile.ZipFile(io.BytesIO(content)) as archive:
        entries = archive.infolist()
        if sum(entry.file_size for entry in entries) > _BOOK_BYTES:
            raise FileError(f"its parts would unpack to more than {_BOOK_BYTES >> 20} MiB")
        for entry in entries:  # without a document type there are no entities; \0 is of UTF-16
            if b"<!DOCTYPE" in archive.read(entry).replace(b"\0", b""):
                raise FileError(f"its {shown(entry.filename)} has a document type, which none has")
    book = openpyxl.load_workbook(io.BytesIO(content), read_only=True, data_only=True)
    for sheet in book.worksheets:
        sheet.reset_dimensions()  # what the file says of its size may be wrong
        yield sheet.title, sheet.iter_rows(values_only=True)


def _bounded(rows: _Rows, left: list[int]) -> Iterator[list[object]]:
    """Yield rows as long as there are not too many cells in them."""
    for row in rows:
        left[0] -= len(row) + 1
        if left[0] < 0:
            raise FileError(
                f"it has more than {_BOOK_CELLS} cells: save the sheet of interest as CSV"
            )
        yield [_number(cell) for cell in row]


def _number(cell: object) -> object:
    """Return a number that was typed with a decimal comma, and stands as text, with a point."""
    if isinstance(cell, str) and _COMMA.fullmatch(cell):
        return cell.replace(",", ".")
    return cell


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


def from_project(content: bytearray) -> Tables | None:
    """Return the tables in a file of Tracker, Logger Pro or NumPy, None for any other file.

    Raises
    ------
    FileError
        If it is too large, broken, has a document type, or no table.
    """
    if content.startswith(np.lib.format.MAGIC_PREFIX):
        return from_arrays({"array": content})
    if not content[:64].removeprefix(b"\xef\xbb\xbf").lstrip().startswith(b"<"):
        return None
    begin = bytes(content[:2000])
    if _TRACKER in begin:
        return _tracker(_tree(content, "Tracker"))
    if b"<Document" in begin and _LOGGER_PRO in content:
        return _logger_pro(_tree(content, "Logger Pro"))
    return None


def _tree(content: bytearray, program: str) -> Element:
    its, instead = f"it is a file of {program}", "export its table as text"
    if len(content) > _XML:
        raise FileError(f"{its} larger than {_XML >> 20} MiB: {instead}")
    text = decode(content)
    if "<!DOCTYPE" in text:
        raise FileError(f"{its} with a document type, which none has")
    with refusing(_NO_XML, f"{its} that cannot be read ({{}}): {instead}"):
        return fromstring(text)


def _tracker(tree: Element) -> Tables:
    """Return the positions of all point masses: from pixels by the clip's clock and axes."""
    clip, control = _first(tree, "media.core.VideoClip"), _first(tree, "ClipControl")
    start, begin = _float_of(clip, "startframe", 0.0), _float_of(clip, "starttime", 0.0)
    step = _float_of(control, "delta_t", math.nan)  # in ms, of one frame
    axes = {
        k: _Frame(*(_float_of(one, name, value) for name, value in _Frame()._asdict().items()))
        for k, one in _frames(_first(tree, "ImageCoordSystem"))
    } or {0: _Frame()}
    if not step > 0.0 or any(not abs(axis.xscale * axis.yscale) > 0.0 for axis in axes.values()):
        raise FileError("it is a file of Tracker without a clock or a scale: export its table")
    seen: dict[str, dict[int, tuple[float, float]]] = {}
    for mass in _objects(tree, _MASS):
        points = {
            k: axes[max((axis for axis in axes if axis <= k), default=min(axes))].seen(
                _float_of(one, "x", math.nan), _float_of(one, "y", math.nan)
            )
            for k, one in _frames(mass)
        }
        if points:
            name = _text(mass, "name") or "mass"
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
    return Tables({"tracks": as_text(rows)}, "Tracker", why, ".")


def _logger_pro(tree: Element) -> Tables:
    """Return the data sets side by side, each column named with its run before it."""
    names: list[str] = []
    columns: list[list[str]] = []
    for k, member in enumerate(tree.iter("DataSet"), 1):
        said = member.findtext("DataSetName") or f"Run {k}"
        run = "".join(c for c in said if c not in ":([")[:40]
        for column in member.iter("DataColumn"):
            cells = (column.findtext("ColumnCells") or "").strip("\n").split("\n")
            if any(cell.strip() for cell in cells):
                name = (column.findtext("DataObjectName") or "").strip()
                unit = (column.findtext("ColumnUnits") or "").strip()
                names.append(f"{run}: {name or 'column'}" + f" ({unit})" * bool(unit))
                columns.append(cells)
    if not columns:
        raise FileError("it is a file of Logger Pro without numbers: export its table as text")
    length = max(map(len, columns))
    padded = [column + [""] * (length - len(column)) for column in columns]
    why = "its XML is Logger Pro's"
    return Tables({"data": as_text([names, *zip(*padded, strict=True)])}, "Logger Pro", why, ".")


def _objects(tree: Element, of: str) -> Iterator[Element]:
    return (node for node in tree.iter("object") if node.get("class", "").endswith(of))


def _first(tree: Element, of: str) -> Element | None:
    return next(_objects(tree, of), None)


def _text(one: Element | None, name: str) -> str:
    text = "" if one is None else one.findtext(f"property[@name='{name}']", "")
    return " ".join(text.split())


def _float_of(one: Element | None, name: str, default: float) -> float:
    try:
        return float(_text(one, name) or default)
    except ValueError as error:
        raise FileError(f"it is a file of Tracker whose {name} is no number") from error


def _frames(one: Element | None) -> Iterator[tuple[int, Element]]:
    """Yield the objects in the array framedata of an object, with their places in it."""
    array = None if one is None else one.find("property[@name='framedata']")
    for each in () if array is None else array.findall("property"):
        place, inner = (each.get("name") or "").strip("[]"), each.find("object")
        if place.isdecimal() and len(place) < 9 and inner is not None:
            yield int(place), inner
