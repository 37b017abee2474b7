"""Files that hold tables in a packing of their own -> the tables, each as a program writes it.

A zip archive, a spreadsheet, and the XML of Tracker and Logger Pro are opened here; the tables
in them are then read like any other file, so that a program's layout is known in one place.
"""

from stackbounce.errors import FileError
from stackbounce.measure.reading import projects, sheets, zipped
from stackbounce.measure.reading.tables import Tables

__all__ = ["tables_in"]


def tables_in(content: bytearray) -> Tables | None:
    """Return the tables that a file holds, None where it is a table itself.

    Raises
    ------
    FileError
        If the file is broken, locked, or unpacks to too much.
    MissingExtra
        If the package is not installed that opens it.
    """
    if content.startswith((b"PK\x03\x04", b"PK\x05\x06")):
        return sheets.from_xlsx(content) if zipped.is_xlsx(content) else zipped.members(content)
    if content.startswith(b"\xd0\xcf\x11\xe0"):
        raise FileError("it is an old Excel file (.xls): save it as .xlsx or CSV")
    return projects.tables(content)
