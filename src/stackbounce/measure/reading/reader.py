"""`read`: the file of any program -> a Dataset with the kind of measurement that it holds."""

import os
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from stackbounce.errors import FileError, StackbounceError, shown
from stackbounce.files import content_of
from stackbounce.library_types import Dataset
from stackbounce.measure.messages import Message, OptionHint, about_option
from stackbounce.measure.quantities import Array
from stackbounce.measure.reading import wav
from stackbounce.measure.reading.dataset import assemble, holds_of
from stackbounce.measure.reading.formats import layout_of
from stackbounce.measure.reading.layouts import NOT_NAMED, Layout, columns_of
from stackbounce.measure.reading.limits import BYTES, refuse_others
from stackbounce.measure.reading.numbers import Table, rows_of
from stackbounce.measure.reading.options import ReadOptions, apply_options, of_run, part_of
from stackbounce.measure.reading.roles import Column
from stackbounce.measure.reading.series import without_counts
from stackbounce.measure.reading.tables import Tables, chosen, from_project, tables_in
from stackbounce.measure.reading.text import decode, tabulate
from stackbounce.measure.reading.video import on_frames


def read(
    path: str | os.PathLike[str],
    *,
    holds: str | None = None,
    table: str | None = None,
    run: str | int | None = None,
    names: Mapping[str | int, str] | None = None,
    units: Mapping[str | int, str] | None = None,
    decimal: str | None = None,
    frame_rate: float | None = None,
    scale: float | None = None,
    start: float | str | None = None,
    stop: float | str | None = None,
) -> Dataset:
    r"""Return what a file of measurements holds, recognised by its content, in SI units.

    Tables of Tracker, ImageJ, TrackMate, phyphox, Sensor Logger, Vernier, Logger Pro, PASCO
    Capstone, LabVIEW, Audacity and oscilloscopes, also in zip archives and spreadsheets; any other
    table of numbers with names and units in its header; arrays of NumPy; and WAV sound. Options are
    needed only where a file is not recognised correctly.

    Parameters
    ----------
    path : str or path-like
        The file; its name does not matter.
    holds : str, optional
        What it holds: ``"waveform"``, ``"sound"``, ``"track"``, ``"knocks"``,
        ``"press curve"``, ``"acceleration"`` or ``"table"``.
    table : str, optional
        Which table of a zip archive, such as ``"Raw Data.csv"`` or ``"Raw Data"``, or sheet of a
        spreadsheet.
    run : str or int, optional
        Which run of a table with several, by its name or counted from 1; by default the first.
    names : mapping, optional
        What columns are, by their names in the file or counted from 1, such as
        ``{1: "time", 2: "force"}``: ``"time"``, ``"force"``, ``"voltage"``, ``"compression"``,
        ``"x"``, ``"y"``, ``"sound"``, ``"knock_time"``, ``"acceleration_x"`` … or any other name.
    units : mapping, optional
        Units of columns, by their names or counted from 1, such as ``{"x": "cm", "y": "cm"}``.
    decimal : str, optional
        The decimal mark, ``"."`` or ``","``.
    frame_rate : float, optional
        Frames per second of a video, where positions are told by frame and not by time.
    scale : float, optional
        Metres per pixel, where positions are in pixels.
    start, stop : float or str, optional
        Where the part begins and ends that is wanted: in s, or a text with a unit; frames, where
        the file counts frames; rows, where it counts neither.

    Returns
    -------
    xarray.Dataset
        A variable for each column, with attributes `units` (SI; empty where unknown) and
        `long_name` (as in the file). By what the Dataset `holds`:

        - waveform: `force` or `voltage` (time), further channels `force_2` …
        - sound: `sound` (time) of full scale 1, channels averaged; its attribute `rate` in Hz
        - acceleration: `acceleration_x`, `_y`, `_z`, `_absolute` (time), as far as they are there
        - track: `x`, `y` (time, track), NaN where a track has no point; in ``px`` and over frames
          where neither the file nor an option tells scale and frame rate
        - knocks: `knock_time` (knock)
        - bounces: `knock_time` (knock), by phyphox
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
    MissingExtra
        If the package is not installed that opens a spreadsheet or a program's own file.

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
    options = ReadOptions(holds, table, run, names, units, decimal, frame_rate, scale, start, stop)
    return _named(*content_of(path, BYTES), options)


def read_content(name: str, content: bytes, **options: Any) -> Dataset:
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
    checked = ReadOptions(**options)
    if not content:
        raise FileError(f"{name} is empty")
    return _named(name, bytearray(content), checked)


def _named(name: str, content: bytearray, options: ReadOptions) -> Dataset:
    try:
        data = part_of(_read(name, content, options), options.start, options.stop)
    except StackbounceError as error:
        raise type(error)(Message.of(error).of_file(name)) from error
    except MemoryError as error:
        raise FileError(f"{name} is too large for the memory of this machine") from error
    data.attrs["source"] = Path(name).name
    return data


def _read(name: str, content: bytearray, options: ReadOptions) -> Dataset:
    if wav.is_wav(content):
        data, why, doubts = wav.read_wav(content)
        if options.holds not in (None, "sound"):
            raise about_option("holds", f": the file is a sound, got {shown(options.holds)}")
        return _signed(data, "WAV", why, "sound", doubts)
    tables = tables_in(content)
    if tables is not None:
        return _from_tables(tables, options)
    if options.table is not None:
        raise about_option("table", ": there is one only, as it is no zip archive or spreadsheet")
    return _from_table(name, content, options)


def _from_tables(tables: Tables, options: ReadOptions) -> Dataset:
    """Read the first table that holds a known kind of measurement, or the one that is asked for."""
    names = sorted(tables.members, key=lambda member: member.count("/"))
    if options.table is not None:
        names = [chosen(tables, options.table)]
    options = replace(options, table=None, decimal=tables.decimal or options.decimal)
    read: dict[str, Dataset] = {}
    for name in names:
        try:
            content = bytearray(tables.members.pop(name))
            inner = from_project(content)  # one of Tracker in a zip archive
            own = _from_tables(inner, options) if inner else _from_table(name, content, options)
        except StackbounceError as error:
            if name == names[-1] and not read:
                raise type(error)(Message.of(error).of_file(name)) from error
            continue
        read[name] = own
        if own.attrs["holds"] != "table":
            break
    name, data = min(read.items(), key=lambda entry: entry[1].attrs["holds"] == "table")
    if tables.program and not data.attrs["format"].startswith(tables.program):
        data.attrs["format"] = tables.program
    data.attrs["why"] = "; ".join(filter(None, [tables.why, data.attrs["why"]]))
    others = [other for other in names if other != name]
    if others:
        hint = OptionHint({"table": others[0]})
        more = Message(f"{name} of it is read; ", hint, " reads another")
        data.attrs["doubt"] = Message("; ").join(filter(None, [data.attrs["doubt"], more]))
    return data


def _from_table(name: str, content: bytearray, options: ReadOptions) -> Dataset:
    layout, columns, table, doubts, runs = _table(name, content, options)
    _count(layout, columns, table)
    doubts += _flaws(table)
    columns, values = _numeric(columns, table)
    columns = without_counts(columns, values)
    holds = options.holds or layout.holds or holds_of(columns)
    data, more = assemble(holds, columns, values, None if runs else options.run)
    return _signed(data, layout.format, layout.why, holds, doubts + more)


def _table(
    name: str, content: bytearray, options: ReadOptions
) -> tuple[Layout, list[Column], Table, list[str], bool]:
    """Return the layout of a table, its columns, numbers and doubts, and whether it has runs.

    The text is freed on return, as it may be larger than all of these.
    """
    refuse_others(content)
    text = tabulate(decode(content), options.decimal, Path(name).name)
    layout, doubts = layout_of(text), list(text.doubts)
    if layout.end is not None:
        text = replace(text, content=text.content[: layout.end])
    if layout.bare and _told(layout, options):
        layout = replace(layout, columns=columns_of([], len(layout.columns)), doubts=(NOT_NAMED,))
    doubts += () if options.names else layout.doubts
    columns = apply_options(layout.columns, options)
    columns, runs = of_run(columns, options.run, doubts)
    places = [column.index for column in columns if column.index >= 0]
    table = rows_of(text, layout.first, places)
    if options.holds in (None, "track"):
        by_place = dict(zip(places, table.values.T, strict=True))
        columns, more = on_frames(columns, options.frame_rate, options.scale, by_place)
        doubts += more
    return layout, columns, table, doubts, runs


def _told(layout: Layout, options: ReadOptions) -> bool:
    """Return whether options say something else of columns than what they look like."""
    looks = holds_of(on_frames(layout.columns)[0])
    return bool(options.names) or options.holds not in (None, looks)


def _count(layout: Layout, columns: Sequence[Column], table: Table) -> None:
    """Put in the numbers of a column that counts rows, and the times of a clock."""
    at = next((k for k, column in enumerate(columns) if column.index < 0), None)
    if at is not None:
        rows = np.arange(len(table.values), dtype=np.float64)
        table.values = np.insert(table.values, at, rows, axis=1)
        table.strange = np.insert(table.strange, at, 0)
    if layout.clock:
        time = next((k for k, column in enumerate(columns) if column.role == "time"), None)
        if time is not None:
            table.values[:, time] = layout.clock[0] + layout.clock[1] * table.values[:, time]


def _signed(data: Dataset, form: str, why: str, holds: str, doubts: Sequence[str]) -> Dataset:
    doubt = Message("; ").join(dict.fromkeys(doubts))
    data.attrs = {"format": form, "why": why, "doubt": doubt, "holds": holds}
    return data


def _flaws(table: Table) -> list[str]:
    rows = len(table.values)
    strange = int(table.strange.sum()) if table.strange.max() <= rows / 2 else 0
    first, word = shown(table.first), shown(table.word)
    flaws = (
        (strange, f"cells are no numbers, the first {first}: taken as missing"),
        (table.words, f"lines among the numbers are words, first {word}: left out"),
        (table.beyond, "numbers are beyond any instrument's range: taken as missing"),
        (table.longer, "rows have more cells than the others"),
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
