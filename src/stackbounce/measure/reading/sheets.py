"""Spreadsheets of Excel: .xlsx by openpyxl; each sheet is a table."""

import io
import re
import warnings
import zipfile
from collections.abc import Iterable, Iterator, Sequence

from stackbounce.errors import FileError, shown
from stackbounce.extras import need
from stackbounce.measure.reading.tables import Tables, as_text

_CELLS = 2**19
"""Cells of a spreadsheet, at most: some seconds."""

_BYTES = 2**26
"""Bytes of its parts, unpacked, at most."""

_COMMA = re.compile(r"\s*[+-]?[0-9]+,[0-9]+(?:[eE][+-]?[0-9]{1,4})?\s*")
_Rows = Iterable[Sequence[object]]


def from_xlsx(content: bytearray) -> Tables:
    """Return the sheets of an .xlsx file.

    Raises
    ------
    FileError
        If it is broken, has no numbers, or is too large.
    MissingExtra
        If openpyxl is not installed.
    """
    need("sheets", "an Excel file (.xlsx)")
    left = [_CELLS]
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
    return Tables(found, "", "it is a sheet of a spreadsheet", "spreadsheet", ".")


def _sheets(content: bytearray) -> Iterator[tuple[str, _Rows]]:
    import openpyxl

    with zipfile.ZipFile(io.BytesIO(content)) as archive:
        entries = archive.infolist()
        if sum(entry.file_size for entry in entries) > _BYTES:
            raise FileError(f"its parts would unpack to more than {_BYTES >> 20} MiB")
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
            raise FileError(f"it has more than {_CELLS} cells: save the sheet of interest as CSV")
        yield [_number(cell) for cell in row]


def _number(cell: object) -> object:
    """Return a number that was typed with a decimal comma, and stands as text, with a point."""
    if isinstance(cell, str) and _COMMA.fullmatch(cell):
        return cell.replace(",", ".")
    return cell
