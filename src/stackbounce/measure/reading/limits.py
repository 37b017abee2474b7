"""Limits on what is read: no file too large, no table too wide, no file of another kind."""

from stackbounce.errors import FileError

BYTES = 2**28
"""Bytes of a file, and of the tables in a zip archive together, at most."""

CELLS = 2**26
"""Numbers that a table or a sound may have, at most."""

COLUMNS = 1000
"""Columns of a table, at most."""

LINE = 2**20
"""Characters in a line, at most."""

# First bytes of other kinds of files: (offset, bytes, what it is, what to do).
_OTHERS = (
    (4, b"ftyp", "a video or a sound in MPEG-4", "track a video first, or save the sound as WAV"),
    (0, (b"ID3", b"\xff\xfb"), "an MP3 sound", "save it as WAV"),
    (0, b"OggS", "an Ogg sound", "save it as WAV"),
    (0, b"fLaC", "a FLAC sound", "save it as WAV"),
    (0, b"caff", "a Core Audio sound", "save it as WAV"),
    (0, b"FORM", "an AIFF sound", "save it as WAV"),
    (0, (b"\x89PNG", b"\xff\xd8\xff", b"GIF8"), "a picture", "export the numbers"),
    (0, b"%PDF", "a PDF document", "export the numbers as CSV"),
    (0, b"\x89HDF", "an HDF5 file", "export the numbers as CSV"),
    (0, b"MATLAB", "a MATLAB file", "export the numbers as CSV"),
    (0, b"\xd0\xcf\x11\xe0", "an old Excel file (.xls)", "save it as .xlsx or CSV"),
    (0, b"\x1f\x8b", "compressed by gzip", "unpack it"),
    (0, b"7z\xbc\xaf", "a 7z archive", "unpack it"),
    (0, b"Rar!", "a RAR archive", "unpack it"),
    (0, b"TDSm", "a TDMS file of LabVIEW", "export its channels as CSV"),
    (0, b"\x02P", "a C3D file of motion capture", "export its points as CSV"),
    (8, b"AVI ", "a video", "track it first"),
    (0, b"\x1a\x45\xdf\xa3", "a video or sound in Matroska", "track it, or save it as WAV"),
    (0, b"II*\0", "a picture or a video in TIFF", "track it first"),
    (0, b"SQLite format", "a database of SQLite", "export its table as CSV"),
    (0, b"<", "XML or HTML, such as a program's own project", "export its table as text or CSV"),
)


def refuse_others(content: bytearray) -> None:
    """Raise `FileError` for known kinds of files that are neither a table nor a WAV sound."""
    begin = content[:64].removeprefix(b"\xef\xbb\xbf").lstrip()
    for where, what, kind, remedy in _OTHERS:
        if begin[where:].startswith(what):
            raise FileError(f"it is {kind}, not a table or a WAV sound: {remedy}")
