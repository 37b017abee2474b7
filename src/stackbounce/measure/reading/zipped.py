"""The tables of a zip archive, unpacked in memory up to a limit."""

import io
import zipfile
import zlib

from stackbounce.errors import FileError, shown
from stackbounce.measure.reading import arrays
from stackbounce.measure.reading.limits import BYTES
from stackbounce.measure.reading.tables import Tables

_MEMBERS = 1000  # of an archive, at most
_RATIO = 400  # of bytes to packed bytes; numbers as text come to about 10
_BROKEN = (zipfile.BadZipFile, zlib.error, EOFError, OSError, ValueError, RuntimeError)
_ENDINGS = (".csv", ".tsv", ".txt", ".dat", ".lvm", ".npy", ".trk")


def is_xlsx(content: bytearray) -> bool:
    """Return whether an archive is a spreadsheet of Excel."""
    return b"xl/workbook.xml" in content or b"xl/workbook.bin" in content


def members(content: bytearray) -> Tables:
    """Return the tables of an archive; the arrays of an .npz file are one table.

    Nothing is written to disk. Archives inside the archive are ignored.

    Raises
    ------
    FileError
        If the archive is broken, locked, a spreadsheet, without tables, or unpacks to too much.
    """
    if content.count(b"PK\x01\x02") > _MEMBERS:
        raise FileError(f"it is a zip archive of more than {_MEMBERS} files")
    try:
        with zipfile.ZipFile(io.BytesIO(content)) as archive:
            return _tables(archive)
    except FileError:
        raise
    except _BROKEN as error:
        raise FileError(f"it is a broken zip archive: {' '.join(str(error).split())}") from error


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
        name = shown(entry.filename)
        if entry.flag_bits & 1:
            raise FileError(f"its {name} is locked by a password: unpack it")
        if entry.compress_type not in (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED):
            raise FileError(f"its {name} is packed in an unusual way: unpack it")
        if entry.file_size > 2**20 and entry.file_size > _RATIO * max(entry.compress_size, 1):
            raise FileError(f"its {name} would unpack to more than {_RATIO} times its size")
        found[entry.filename] = _unzip(archive, entry, left)
        left -= len(found[entry.filename])
    if all(name.endswith(".npy") for name in names):
        return Tables(arrays.joined(found), "NumPy", "its arrays are those of an .npz file")
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
