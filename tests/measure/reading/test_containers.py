"""Files with tables in them: spreadsheets, Tracker's and Logger Pro's own files, NumPy's arrays."""

import io
import sys
import zipfile

import numpy as np
import openpyxl
import pytest

from measure import make_files as made
from stackbounce.errors import FileError, InvalidValue, MissingExtra
from stackbounce.fitting.rows import rows_of
from stackbounce.measure.reading import tables

TIMES = 0.01 * np.arange(8)


def xlsx(tables):
    book = openpyxl.Workbook()
    book.remove(book.active)
    for name, rows in tables.items():
        sheet = book.create_sheet(name)
        for row in rows:
            sheet.append(row)
    content = io.BytesIO()
    book.save(content)
    return content.getvalue()


NAMES, COLUMNS = made.acceleration()
SHEETS = {
    "Metadata Device": [["property", "value"], ["version", "1.1.12"], ["build", 11156]],
    "Raw Data": [NAMES, *zip(*(column.tolist() for column in COLUMNS), strict=True)],
}


def test_phyphox_as_a_spreadsheet(read):
    data = read(xlsx(SHEETS))
    assert data.attrs["holds"] == "acceleration"
    assert "a sheet of a spreadsheet" in data.attrs["why"]
    assert "Raw Data of it is read" in data.attrs["doubt"]
    np.testing.assert_allclose(data.acceleration_y.values, COLUMNS[2])
    np.testing.assert_allclose(data.time.values, made.TIMES)


def test_the_sheet_of_raw_data_comes_before_others_like_it(read):
    smoothed = [NAMES, *([cell / 2 for cell in row] for row in SHEETS["Raw Data"][1:])]
    data = read(xlsx({"Smoothed": smoothed, "Raw data": SHEETS["Raw Data"]}))
    np.testing.assert_allclose(data.acceleration_y.values, COLUMNS[2])


def test_a_sheet_is_chosen_by_its_name(read):
    content = xlsx({f"Run {k}": [["t", "x", "y"], [0, 1, k], ["0,5", 2, 3]] for k in (1, 2)})
    data = read(content)
    assert data.y.values[0, 0] == 1.0
    assert data.time.values.tolist() == [0.0, 0.5]  # a number that is text with a decimal comma
    assert read(content, table="Run 2").y.values[0, 0] == 2.0
    with pytest.raises(InvalidValue, match="table must be one in the file, got 'Run 3'"):
        read(content, table="Run 3")
    book = xlsx({"Deckblatt": [["Klasse 7b", "2024"]], "Mai": [["h0", "h1"], [1, 0.64]]})
    name, rows = rows_of(("runs.xlsx", book))
    assert (name, rows[1]) == ("runs.xlsx, sheet 'Mai'", (2, ["1", "0.64"]))


def test_what_a_spreadsheet_cannot_be(read, monkeypatch):
    content = xlsx(SHEETS)
    for wrong, message in (
        (xlsx({"empty": []}), "spreadsheet without any cell"),
        (xlsx({"words": [["one", "two"], ["three", "four"]]}), "no row of numbers"),
        (content[:-40], r"cannot be read \(.*\): save it as CSV"),
        (
            b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1" + bytes(600),
            r"an old Excel file \(.xls\), .*: save it as",
        ),
    ):
        with pytest.raises(FileError, match=message):
            read(wrong)
    monkeypatch.setattr(tables, "_BOOK_CELLS", 50)
    with pytest.raises(FileError, match="more than 50 cells"):
        read(content)
    monkeypatch.setattr(tables, "_BOOK_BYTES", 1000)
    with pytest.raises(FileError, match="would unpack to more than"):
        read(content)


def test_a_bomb_of_entities_is_no_spreadsheet(read):
    bomb = b'<?xml version="1.0"?><!DOCTYPE a [<!ENTITY b "bbbb"><!ENTITY c "&b;&b;">]>'
    with zipfile.ZipFile(io.BytesIO(xlsx(SHEETS))) as old:
        packed = {name: old.read(name) for name in old.namelist()}
    packed["xl/workbook.xml"] = bomb + packed["xl/workbook.xml"]
    with pytest.raises(FileError, match=r"workbook\.xml' has a document type"):
        read(made.archive(packed))


def test_a_missing_reader_is_named(read, monkeypatch):
    content = xlsx(SHEETS)
    monkeypatch.setitem(sys.modules, "openpyxl", None)
    words = r"an Excel file \(.xlsx\) needs openpyxl: pip install 'stackbounce\[lab\]'"
    with pytest.raises(MissingExtra, match=words):
        read(content)


POINTS = {4: (150.0, 300.0), 5: (155.0, 310.0), 7: (165.0, 340.0)}


def prop(name, value, kind="double"):
    return f'<property name="{name}" type="{kind}">{value}</property>'


def inside(name, of, *parts):
    cls = f"org.opensourcephysics.{of}"
    return prop(name, f'<object class="{cls}">{"".join(parts)}</object>', "object")


def mass(name, points):
    frames = "".join(
        inside(f"[{k}]", "cabrillo.tracker.PointMass$FrameData", prop("x", x), prop("y", y))
        for k, (x, y) in points.items()
    )
    own = prop("name", name, "string") + prop("framedata", frames, "array")
    return inside("item", "cabrillo.tracker.PointMass", own)


def trk(*tracks, scale=200.0, angle=0.0, unit="m", before=""):
    axes = inside(
        "[0]", "media.core.ImageCoordSystem$FrameData",
        *map(prop, ("xorigin", "yorigin", "angle", "xscale", "yscale"),
             (100.0, 500.0, angle, scale, scale)),
    )  # fmt: skip
    parts = (
        inside("videoclip", "media.core.VideoClip", prop("startframe", 4, "int")),
        inside("clipcontrol", "media.core.StepperClipControl", prop("delta_t", 40.0)),
        inside("coords", "media.core.ImageCoordSystem", prop("framedata", axes, "array")),
        prop("length_unit", unit, "string"),
        prop("tracks", "".join(tracks), "collection"),
    )
    panel = "org.opensourcephysics.cabrillo.tracker.TrackerPanel"
    return f'<?xml version="1.0"?>{before}<object class="{panel}">{"".join(parts)}</object>'


def test_trackers_own_file(read):
    content = trk(mass("ball", POINTS))
    for data in (read(content), read(made.archive({"ball.trk": content}))):
        assert (data.attrs["format"], data.attrs["holds"]) == ("Tracker", "track")
        assert data.track.values.tolist() == ["ball"]
        np.testing.assert_allclose(data.time.values, [0.0, 0.04, 0.12])
        np.testing.assert_allclose(data.x.values[:, 0], [0.25, 0.275, 0.325])
        np.testing.assert_allclose(data.y.values[:, 0], [1.0, 0.95, 0.8])
    assert read(content).attrs["doubt"] == ""


def test_axes_that_are_turned(read):
    data = read(trk(mass("ball", {0: (100.0, 400.0), 1: (200.0, 500.0)}), angle=90.0, unit="cm"))
    np.testing.assert_allclose(data.x.values[:, 0], [0.005, 0.0], atol=1e-12)
    np.testing.assert_allclose(data.y.values[:, 0], [0.0, -0.005], atol=1e-12)


def test_two_masses_and_no_scale(read):
    data = read(trk(mass("low", POINTS), mass("high", {5: (1.0, 2.0)}), scale=1.0))
    assert data.track.values.tolist() == ["low", "high"]
    assert data.y.attrs["units"] == "px"
    np.testing.assert_array_equal(data.y.values[:, 1], [np.nan, 498.0, np.nan])


def cmbl(runs):
    sets = ""
    for name, columns in runs.items():
        cells = "".join(
            f"<DataColumn><DataObjectName>{title}</DataObjectName><ColumnUnits>{unit}</ColumnUnits>"
            f"<ColumnCells>\n{chr(10).join(map(str, numbers))}\n</ColumnCells></DataColumn>"
            for title, unit, numbers in columns
        )
        sets += f"<DataSet><DataSetName>{name}</DataSetName>{cells}</DataSet>"
    return f"<Document><Version>3.15</Version>{sets}</Document>"


def test_logger_pros_own_file(read):
    one = [("Time", "s", [0, 0.1, 0.2]), ("Force", "N", [1, 2.5, 3]), ("", "", [3, 4, 5])]
    content = cmbl({"Run 1": one, "Latest": [("Time", "s", [0, 0.1]), ("Force", "N", [7, 8])]})
    data = read(content)
    assert (data.attrs["format"], data.attrs["holds"]) == ("Logger Pro", "waveform")
    assert data.force.values.tolist() == [1.0, 2.5, 3.0]
    assert data["column"].values.tolist() == [3.0, 4.0, 5.0]  # it has no name and no unit
    assert read(content, run="Latest").force.values.tolist() == [7, 8]


def npy(array):
    content = io.BytesIO()
    np.save(content, array)
    return content.getvalue()


def test_an_array_is_read_by_what_its_columns_look_like(read):
    volts = np.sin(np.arange(5000.0))
    wide = np.stack([1e-4 * np.arange(5000), volts])
    for array in (wide, wide.T, np.asfortranarray(wide.T)):
        data = read(npy(array))
        assert (data.attrs["format"], data.attrs["holds"]) == ("NumPy", "waveform")
        np.testing.assert_array_equal(data.voltage.values, volts)
    assert read(npy(volts)).attrs["holds"] == "table"


def test_records_and_archives_of_arrays_have_names(read):
    times, force = 0.01 * np.arange(20), np.arange(20.0)
    records = np.rec.fromarrays([times, force], names="time_ms,force_N")
    data = read(npy(records))
    np.testing.assert_allclose(data.time.values, times / 1000.0)
    packed = io.BytesIO()
    np.savez_compressed(packed, time=times, force=force.astype(np.int16))
    data = read(packed.getvalue())
    assert (data.attrs["format"], data.attrs["holds"]) == ("NumPy", "waveform")
    np.testing.assert_array_equal(data.force.values, force)


@pytest.mark.parametrize(("content", "message"), [
    (trk(), "without a track of a point mass"),
    (trk(mass("ball", POINTS), scale=0.0), "without a clock or a scale"),
    (trk(mass("ball", {1: ("one", 2)})), "whose x is no number"),
    (trk(mass("ball", POINTS))[:-9], "cannot be read"),
    (trk(mass("&b;", POINTS), before='<!DOCTYPE a [<!ENTITY b "c">]>'), "document type"),
    (trk(mass("&b;", POINTS), before='<!DOCTYPE a SYSTEM "file:///etc/hosts">'), "document type"),
    (trk(mass("ball", POINTS)) + " " * 2000, "a file of Tracker larger than"),
    ("<Document><a/></Document>", "it is XML or HTML"),
    ("<Document><DataSet></DataSet></Document>", "Logger Pro without numbers"),
    (npy(np.array([{"a": 1}], dtype=object)), "cannot be read .*allow_pickle"),
    (npy(np.array(["a", "b"])), "rows of plain numbers"),
    (npy(np.zeros((2, 3, 4))), "Must pass 2-d input"),
    (npy(np.zeros((0, 2))), "save one with rows of plain numbers"),
    (npy(np.zeros((9, 2)))[:-8], "cannot be read"),
    (npy(np.zeros((9, 2))).replace(b"(9, 2)", b"(9e9,)"), "cannot be read"),
    (npy(np.zeros((9, 2))).replace(b"(9, 2), }" + 10 * b" ", b"(99999999999, 2), }"), "cannot"),
    (b"\x93NUMPY\x09\x00", "cannot be read"),
    (npy(np.zeros((9, 2))).replace(b"(9, 2), }", b"(9, 2), ("), "cannot be read"),
    (npy(np.full((9, 2), np.nan)), "no row of numbers"),
])  # fmt: skip
def test_xml_and_arrays_that_are_refused(read, content, message, monkeypatch):
    monkeypatch.setattr("stackbounce.measure.reading.tables._XML", 4000)
    with pytest.raises(FileError, match=message):
        read(content)
