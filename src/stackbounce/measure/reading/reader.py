"""`read`: the file of any program -> a Dataset with the kind of measurement that it holds."""

import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from stackbounce.errors import FileError, InvalidValue, StackbounceError, shown
from stackbounce.measure.hints import Hint, Said, about, joined
from stackbounce.measure.quantities import Array
from stackbounce.measure.reading import wav, zipped
from stackbounce.measure.reading.clock import without_counts
from stackbounce.measure.reading.dataset import assemble, holds_of
from stackbounce.measure.reading.formats import layout_of
from stackbounce.measure.reading.layouts import Layout
from stackbounce.measure.reading.limits import content_of, refuse_others
from stackbounce.measure.reading.numbers import Table, rows_of
from stackbounce.measure.reading.options import ReadOptions, apply_options, of_run
from stackbounce.measure.reading.roles import Column
from stackbounce.measure.reading.text import decode, tabulate

if TYPE_CHECKING:
    import xarray as xr

__all__ = ["read", "read_content"]


def read(
    path: str | os.PathLike[str],
    *,
    holds: str | None = None,
    table: str | None = None,
    run: str | int | None = None,
    names: Mapping[str | int, str | int] | None = None,
    units: Mapping[str | int, str] | None = None,
    decimal: str | None = None,
) -> "xr.Dataset":
    r"""Return what a file of measurements holds, recognised by its content, in SI units.

    Tables of Tracker, phyphox (also its zip archives), Vernier, Logger Pro, PASCO Capstone,
    oscilloscopes of Rigol, Pico and Tektronix, any other table of numbers with names and units in
    its header, and WAV sound. Options are needed only where a file is not recognised correctly.

    Parameters
    ----------
    path : str or path-like
        The file; its name does not matter.
    holds : str, optional
        What it holds: ``"waveform"``, ``"sound"``, ``"track"``, ``"knocks"``, ``"bounces"``,
        ``"press curve"``, ``"acceleration"`` or ``"table"``.
    table : str, optional
        Which table of a zip archive, such as ``"Raw Data.csv"`` or ``"Raw Data"``.
    run : str or int, optional
        Which run of a table with several, by its name or counted from 1; by default the first.
    names : mapping, optional
        What columns are, by their names in the file or counted from 1, such as
        ``{1: "time", 2: "force"}``: ``"time"``, ``"force"``, ``"voltage"``, ``"compression"``,
        ``"x"``, ``"y"``, ``"sound"``, ``"knock_time"``, ``"acceleration_x"`` … or any other name.
        What can be measured may also stand first: ``{"time": 1, "y": "height"}``.
    units : mapping, optional
        Units of columns, by their names or counted from 1, such as ``{"x": "cm", "y": "cm"}``.
    decimal : str, optional
        The decimal mark, ``"."`` or ``","``.

    Returns
    -------
    xarray.Dataset
        A variable for each column, with attributes `units` (SI; empty where unknown) and
        `long_name` (as in the file). By what the Dataset `holds`:

        - waveform: `force` or `voltage` (time), further channels `force_2` …
        - sound: `sound` (time) of full scale 1, channels averaged; its attribute `rate` in Hz
        - acceleration: `acceleration_x`, `_y`, `_z`, `_absolute` (time), as far as they are there
        - track: `x`, `y` (time, track), NaN where a track has no point
        - knocks: `knock_time` (knock)
        - bounces: `knock_time` (knock), `height` and `energy` (bounce), by phyphox
        - press curve: `compression`, `force` (point)
        - table: whatever there is (row)

        Its attributes are `format`, the program; `why`, the evidence for it; `holds`; `doubt`, what
        is uncertain and which option settles it, or empty; `source`, the name of the file.

    Raises
    ------
    FileError
        If the file cannot be read or its kind is not recognised; if it is larger than 256 MiB
        (a zip archive: unpacked), or has more than 1000 columns or 67 million numbers.
    InvalidValue, InvalidType
        If an option makes no sense for this file.

    Notes
    -----
    Cells without a number are NaN, also those beyond an instrument's range (∞); rows without a
    time are left out. A truncated sound is read as far as it goes. `doubt` mentions both.

    Examples
    --------
    >>> import stackbounce as sb
    >>> path = getfixture("tmp_path") / "force.csv"
    >>> _ = path.write_text("Time (ms),Force (kN)\n0.0,0.0\n0.1,1.5\n0.2,0.1\n")
    >>> data = sb.read(path)
    >>> data.attrs["holds"], data.attrs["why"]
    ('waveform', 'a header names its columns: Time (ms), Force (kN)')
    >>> data.force.values
    array([   0., 1500.,  100.])
    """
    told = ReadOptions(holds, table, run, names, units, decimal)
    return _named(*content_of(path), told)


def read_content(name: str, content: bytes, **options: Any) -> "xr.Dataset":
    r"""Read the content of a file that is in memory; see `read`.

    Parameters
    ----------
    name : str
        What messages call it.
    content : bytes
        All of it.
    **options
        As of `read`.

    Returns
    -------
    xarray.Dataset

    Raises
    ------
    FileError
        If it is empty, or its kind is not recognised.
    InvalidValue, InvalidType
        If an option makes no sense for it.

    Examples
    --------
    >>> content = b"Time (s),Force (N)\n0,0\n1,2\n2,0\n"
    >>> read_content("force.csv", content).attrs["holds"]
    'waveform'
    """
    told = ReadOptions(**options)
    if not content:
        raise FileError(f"{name} is empty")
    return _named(name, bytearray(content), told)


def _named(name: str, content: bytearray, told: ReadOptions) -> "xr.Dataset":
    try:
        data = _read(content, told)
    except StackbounceError as error:
        raise about(name, error) from error
    except MemoryError as error:
        raise FileError(f"{name} is too large for the memory of this machine") from error
    data.attrs["source"] = Path(name).name
    return data


def _read(content: bytearray, told: ReadOptions) -> "xr.Dataset":
    if wav.is_wav(content):
        data, why, doubts = wav.read_wav(content)
        if told.holds not in (None, "sound"):
            holds = Hint({"holds": None})
            raise InvalidValue(Said(holds, f": the file is a sound, got {shown(told.holds)}"))
        return _signed(data, "WAV", why, "sound", doubts)
    if content.startswith((b"PK\x03\x04", b"PK\x05\x06")):
        return _from_zip(content, told)
    if told.table is not None:
        table = Hint({"table": None})
        raise InvalidValue(Said(table, ": there is one only, as it is no zip archive"))
    return _from_text(content, told)


def _from_zip(content: bytearray, told: ReadOptions) -> "xr.Dataset":
    members, by_phyphox = zipped.members(content)
    names = sorted(members, key=lambda one: (one.count("/"), one))
    if told.table is not None:
        names = [zipped.chosen(names, told.table)]
    read: list[tuple[str, xr.Dataset]] = []
    for name in names:
        try:
            read.append((name, _from_text(bytearray(members.pop(name)), told)))
        except StackbounceError as error:
            if name == names[-1] and not read:
                raise about(name, error) from error
            continue
        if read[-1][1].attrs["holds"] != "table":
            break
    name, data = next((one for one in read if one[1].attrs["holds"] != "table"), read[0])
    if by_phyphox and not data.attrs["format"].startswith("phyphox"):
        data.attrs["format"] = "phyphox"
        data.attrs["why"] = f"its meta/device.csv is phyphox's; {data.attrs['why']}"
    others = [one for one in names if one != name]
    if others:
        more = Said(f"{name} of it is read; ", Hint({"table": others[0]}), " reads another")
        data.attrs["doubt"] = joined("; ", filter(None, [data.attrs["doubt"], more]))
    return data


def _from_text(content: bytearray, told: ReadOptions) -> "xr.Dataset":
    layout, columns, table, doubts, runs = _table(content, told)
    if layout.clock:
        table.values[:, 0] = layout.clock[0] + layout.clock[1] * table.values[:, 0]
    doubts += _flaws(table)
    values = table.values
    if layout.holds != "bounces":
        columns, values = _numeric(columns, table)
        columns = without_counts(columns, values)
    holds = told.holds or layout.holds or holds_of(columns)
    if holds == "bounces" != layout.holds:
        whose = ": only phyphox's (in)elastic collision holds bounces"
        raise InvalidValue(Said(Hint({"holds": None}), whose))
    data, more = assemble(holds, columns, values, None if runs else told.run)
    return _signed(data, layout.format, layout.why, holds, doubts + more)


def _table(
    content: bytearray, told: ReadOptions
) -> tuple[Layout, list[Column], Table, list[str], bool]:
    """Return the layout of a text, its columns, numbers and doubts, and whether it has runs.

    The text is freed on return, as it may be larger than all of these.
    """
    refuse_others(content)
    text = tabulate(decode(content), told.decimal)
    layout = layout_of(text)
    columns = apply_options(layout.columns, told)
    doubts = [*text.doubts, *(() if told.names else layout.doubts)]
    columns, runs = of_run(columns, told.run, doubts)
    table = rows_of(text, layout.first, [one.index for one in columns])
    return layout, columns, table, doubts, runs


def _signed(
    data: "xr.Dataset", form: str, why: str, holds: str, doubts: Sequence[str]
) -> "xr.Dataset":
    doubt = joined("; ", dict.fromkeys(doubts))
    data.attrs = {"format": form, "why": why, "doubt": doubt, "holds": holds}
    return data


def _flaws(table: Table) -> list[str]:
    rows = len(table.values)
    strange = int(table.strange.sum()) if table.strange.max() <= rows / 2 else 0
    first, word = shown(table.first), shown(table.word)
    flaws = (
        (strange, f"cells are no numbers, the first {first}: taken as missing"),
        (table.words, f"lines among the numbers are words, first {word}: left out"),
        (table.infinite, "numbers are infinite, beyond the range: taken as missing"),
        (table.longer, "rows have more cells than the others"),
        (table.shorter, "rows have fewer cells than the others"),
    )
    return [f"{count} {words}" for count, words in flaws if count]


def _numeric(columns: Sequence[Column], table: Table) -> tuple[list[Column], Array]:
    """Return the columns that have numbers, and their numbers."""
    there = np.isfinite(table.values).any(axis=0) & (table.strange <= len(table.values) / 2)
    if not there.any():
        raise FileError("it has no column of numbers")
    kept = [k for k in range(len(columns)) if there[k]]
    values = table.values if len(kept) == len(columns) else table.values[:, kept]
    return [columns[k] for k in kept], values
