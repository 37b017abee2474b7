"""Limits on what is read: no file too large, no table too wide, none broken or of another kind."""

import contextlib
from collections.abc import Iterator

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


@contextlib.contextmanager
def refusing(kinds: tuple[type[Exception], ...], words: str) -> Iterator[None]:
    """Raise `FileError` with some words for errors of a reader; ``{}`` is what the error says.

    Examples
    --------
    >>> with refusing((ValueError,), "it is broken ({})"):
    ...     float("one")
    Traceback (most recent call last):
        ...
    stackbounce.errors.FileError: it is broken (could not convert string to float: 'one')
    """
    try:
        yield
    except FileError:
        raise
    except kinds as error:
        raise FileError(words.format(" ".join(str(error).split())[:200])) from error


def refuse_others(content: bytearray) -> None:
    """Raise `FileError` for known kinds of files that are neither a table nor a WAV sound."""
    begin = content[:64].removeprefix(b"\xef\xbb\xbf").lstrip()
    for where, what, kind, remedy in shipped_table(__package__, "others.toml")["kinds"]:
        if begin[where:].startswith(what.encode("latin-1")):
            raise FileError(f"it is {kind}, not a table or a WAV sound: {remedy}")
