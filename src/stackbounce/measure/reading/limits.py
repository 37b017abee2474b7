"""Limits on what is read: no file too large, no table too wide, no file of another kind."""

from stackbounce.errors import FileError
from stackbounce.files import shipped_table

BYTES = 2**28
"""Bytes of a file, and of the tables in a zip archive together, at most."""

CELLS = 2**26
"""Numbers that a table or a sound may have, at most."""

COLUMNS = 1000
"""Columns of a table, at most."""

LINE = 2**20
"""Characters in a line, at most."""


def refuse_others(content: bytearray) -> None:
    """Raise `FileError` for known kinds of files that are neither a table nor a WAV sound."""
    begin = content[:64].removeprefix(b"\xef\xbb\xbf").lstrip()
    for where, what, kind, remedy in shipped_table(__package__, "others.toml")["kinds"]:
        if begin[where:].startswith(what.encode("latin-1")):
            raise FileError(f"it is {kind}, not a table or a WAV sound: {remedy}")
