"""Broken, odd and hostile files: one clear line, or a doubt; never much memory or time."""

import math
import os
import tomllib
import tracemalloc
import zipfile
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import stackbounce as sb
from fuzz.mutate import minimal_cases, mutated
from measure import make_files as made
from measure.make_files import archive
from refusals import refusal
from stackbounce.errors import FileError, InvalidType, InvalidValue, StackbounceError
from stackbounce.measure.reading import limits, numbers, tables
from stackbounce.measure.reading.text import Text

MARKS = tomllib.loads(Path(__file__).with_name("marks.toml").read_text("utf-8"))["tables"]


def refused(read, content, message, error=FileError, **options):
    said = refusal(error, read, content, **options)
    assert message in said
    assert len(said) < 500


@pytest.mark.parametrize(
    ("path", "error", "message"),
    [
        ("missing", FileError, "^missing cannot be read: No such file or directory$"),
        (".", FileError, r"^\. is a folder: give one of its files$"),
        ("a\0b", FileError, r"^'a\\x00b' cannot be read: embedded null"),
        ("x" * 100_000, FileError, "cannot be read: "),
        (b"x", InvalidType, "^path must be a string or a path, got b'x'$"),
        (None, InvalidType, "^path must be a string or a path, got None$"),
    ],
)
def test_no_file(path, error, message):
    with pytest.raises(error, match=message):
        sb.read(path)


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no pipes here")
def test_a_pipe_or_a_device_is_not_waited_for(tmp_path):
    os.mkfifo(tmp_path / "pipe")
    for path in ("/dev/zero", tmp_path / "pipe"):
        with pytest.raises(FileError, match="is no ordinary file"):
            sb.read(path)


def test_too_large_a_file_is_not_read(tmp_path):
    path = tmp_path / "large"
    with path.open("wb") as file:
        file.truncate(limits.BYTES + 1)
    with pytest.raises(FileError, match="larger than 256 MiB"):
        sb.read(path)


@pytest.mark.parametrize(("content", "message"), [
    (b"", "is empty"),
    (b"\n\n\n", "no row of numbers"),
    (b"words and words\nand more", "no row of numbers in its first 2 lines; it begins with 'words"),
    (b"\xef\xbb\xbf", "no row of numbers"),
    (b"Time (s),Force (N)\n", "no row of numbers"),
    (b"#multi:\n,a,,\nt,x,y,\n", "no row of numbers"),
    (b"Vernier Format 2\n1\t2\n", "no row of numbers"),
    (b"Vernier Format 2\na\nb\n1\t2\n3\t4\n", "lacks the names"),
    (bytes(range(256)) * 8, "it is no text"),
    (b"\xff\xfe1", "a program's own bytes"),
    (b"\x02P" + bytes(range(256)), "a C3D file"),
    (b"TDSm\x0e\0\0\0", "a TDMS file"),
    (np.arange(2000, dtype="<i4").tobytes(), "a program's own bytes"),
    (np.random.default_rng(1).integers(0, 9, 2000).astype("<u2").tobytes(), "own bytes"),
    (b"<?xml version='1.0'?><tracker/>", "it is XML or HTML"),
    (b"\xef\xbb\xbf  <html>", "it is XML or HTML"),
    (b"\x89PNG\r\n\x1a\n" + bytes(100), "it is a picture"),
    (b"\0\0\0\x18ftypmp42" + bytes(100), "it is a video"),
    (b"ID3\x03" + bytes(100), "save it as WAV"),
    (b"%PDF-1.7", "it is a PDF"),
    (b"t,x\n0,1\n" + b"1," * 2000, "at most 1000 columns"),
    (b"1," * 600_000, "more than 1048576 characters"),
    (b"t,x\n0,1\n" + b"1" * 1_100_000, "more than 1048576 characters"),
    (b"t,x\n" + b"0,1\n" * 500 + b"1" * 5_000_000, "more than 1048576 characters"),
    (b"t,F\n0,0,0,1\n0,1,0,2\n0,2,0,3\n", "decimal comma between commas"),
    (archive({"inner.zip": archive({"a.csv": "1,2\n"})}), "without any table"),
    (archive({}), "without any table"),
    (archive({f"{k}.csv": "" for k in range(1001)}), "more than 1000 files"),
    (archive({"[Content_Types].xml": "", "a.csv": "1,2"}), "it is a spreadsheet"),
    (archive({"a.csv": "1,2\n" * 100})[:-30], "archive that cannot be unpacked"),
    (archive({"a.csv": "words"}), "a.csv: it has no row of numbers"),
    (archive({"a.csv": made.wav()}), "a.csv: it is no text"),
    (b"PK\x03\x04", "archive that cannot be unpacked"),
])  # fmt: skip
def test_refused(read, content, message):
    refused(read, content, message)


def test_a_bomb_does_not_go_off(read):
    bomb = archive({"Raw Data.csv": b"0,0\n" * 4_000_000})
    tracemalloc.start()
    refused(read, bomb, "would unpack to more than 400 times its size")
    assert tracemalloc.get_traced_memory()[1] < 2**22
    tracemalloc.stop()


def test_bombs_that_lie_of_their_size_or_are_many(read, monkeypatch):
    monkeypatch.setattr(tables, "BYTES", 2**20)
    content = bytearray(archive({"a.csv": b"0,0\n" * 300_000}))
    at = content.rindex(b"PK\x01\x02") + 24
    content[at : at + 4] = (2**21).to_bytes(4, "little")
    refused(read, bytes(content), "would unpack to more than")
    files = {f"{k}.csv": b"0,0\n" * 50_000 for k in range(10)}
    refused(read, archive(files), "its tables would unpack to more than 1 MiB")


def test_locked_and_damaged_archives(read):
    content = bytearray(archive({"a.csv": made.force_ms()}, zipfile.ZIP_STORED))
    content[100] ^= 1
    refused(read, bytes(content), "cannot be unpacked: Bad CRC-32")
    content[content.rindex(b"PK\x01\x02") + 8] |= 1
    refused(read, bytes(content), "is encrypted, password required")


def test_names_in_archives_are_names_only(read, tmp_path):
    data = read(archive({"../../evil.csv": made.force_ms(), "/abs.csv": made.press()}))
    assert "table=" in data.attrs["doubt"]
    assert {path.name for path in tmp_path.rglob("*")} == {"some file"}


def test_which_table_of_an_archive(read):
    names, cells = made.acceleration()
    content = made.phyphox_zip({
        "Aside.csv": (["a", "b"], [[1.0, 2.0], [3.0, 4.0]]), "Raw Data.csv": (names, cells)
    })  # fmt: skip
    assert read(content).attrs["holds"] == "acceleration"
    assert "table='Aside.csv'" in read(content).attrs["doubt"]
    for name in ("Aside.csv", "aside"):
        told = read(content, table=name)
        assert told.attrs["holds"] == "table"
        assert told.attrs["format"] == "phyphox"
        assert told.attrs["doubt"] == ""
    refused(read, content, "did you mean Aside.csv?", InvalidValue, table="Asides.csv")


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "latin-1", "cp1252"])
@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"])
def test_encodings(read, encoding, end):
    text = end.join(["Zeit (µs);Höhe (mm)", "0;1,5", "1;2,5", ""])
    data = read(text.encode(encoding))
    np.testing.assert_allclose(data.time, [0.0, 1e-6])
    np.testing.assert_allclose(data.y[:, 0], [0.0015, 0.0025])


@pytest.mark.parametrize(("text", "values", "doubtful"), MARKS)
def test_marks_in_numbers(read, text, values, doubtful):
    data = read(text, units={"t": "s", "F": "N"})
    np.testing.assert_allclose(data.force, values, rtol=1e-15)
    assert bool(data.attrs["doubt"]) == doubtful


@pytest.mark.parametrize(("decimal", "values"), [(",", [1.234, 2.345]), (".", [1234.0, 2345.0])])
def test_a_decimal_mark_that_is_told(read, decimal, values):
    data = read("t (s);F (N)\n0;1,234\n1;2,345\n", decimal=decimal)
    np.testing.assert_allclose(data.force, values)
    assert data.attrs["doubt"] == ""


def test_cells_that_are_no_numbers(read):
    text = "t (s),F (N)\n0,1\n1,NaN\n2,\n3,n/a\n4,-\n5,inf\n6,oops\n7,٣\n8,1_0\n9,0x1\n10,7\n"
    data = read(text)
    np.testing.assert_array_equal(np.isfinite(data.force), [1] + [0] * 9 + [1])
    assert "4 cells are no numbers, the first 'oops'" in data.attrs["doubt"]
    assert "1 numbers are beyond" in data.attrs["doubt"]


def test_words_and_rows_without_a_time_are_left_out(read):
    data = read("t (s),F (N),remark\n0,1,\n,5,\n1,2,\nend of run,,\n2,3,fine\n3,4,fine\n\n\n")
    assert list(data.data_vars) == ["force"]
    np.testing.assert_array_equal(data.force, [1, 2, 3, 4])
    doubt = read("t (s),F (N)\n0,1\n" + "words,words\n" * 300).attrs["doubt"]
    assert doubt == "300 lines among the numbers are words, first 'words,words': left out"


def test_ragged_rows(read):
    data = read("t (s),F (N)\n0,1\n1,2,9\n2\n3,4\n4,5\n")
    np.testing.assert_array_equal(data.force, [1, 2, np.nan, 4, 5])
    assert data.attrs["doubt"] == "1 rows have more cells than the others"


def test_names_that_come_twice_or_not_at_all(read):
    data = read("t (s),F (N),F (N),time,,a b,a-b\n" + "0,1,2,3,4,5,6\n1,1,2,3,4,5,6\n")
    names = ["force", "force_2", "time_2", "column_5", "a_b", "a_b_2"]
    assert list(data.data_vars) == names
    assert [int(data[name][0]) for name in names] == [1, 2, 3, 4, 5, 6]


def test_units_that_are_not_known(read):
    data = read("t (s),F (grunts)\n0,1\n1,2\n")
    assert data.force.attrs["units"] == ""
    assert "unit 'grunts' of 'F' is not known here" in data.attrs["doubt"]
    weight = read("t (s),Load (kg)\n0,1\n1,2\n")
    np.testing.assert_allclose(weight.force, [9.80665, 2 * 9.80665])
    assert "taken as a weight" in weight.attrs["doubt"]


def test_times_that_start_again_or_are_none(read):
    text = "t (s),F (N)\n" + "".join(f"{k % 10},{k}\n" for k in range(20))
    data = read(text)
    assert data.sizes == {"time": 10}
    assert "time starts again 1 times; run 1 of 2 is read" in data.attrs["doubt"]
    np.testing.assert_array_equal(read(text, run=2).force, range(10, 20))
    refused(read, text, "run must be one of the 2", InvalidValue, run=3)
    back = "t (s),F (N)\n" + "".join(f"{k * 7 % 13},{k}\n" for k in range(200))
    refused(read, back, "time runs backwards in", InvalidValue)


def test_gaps_and_repeats(read):
    times = [0.0, 0.1, 0.2, 0.2, 0.3, 0.4, 0.9, 1.0, 1.1, 1.2]
    data = read("t (s),F (N)\n" + "".join(f"{t},1\n" for t in times))
    assert "1 times are repeated" in data.attrs["doubt"]
    assert "1 gaps in time, the first after 0.4 s" in data.attrs["doubt"]
    uneven = read("t (s),F (N)\n" + "".join(f"{k**2 / 100},1\n" for k in range(10)))
    assert "gaps in time" not in uneven.attrs["doubt"]


def test_too_many_odd_lines(read, monkeypatch):
    monkeypatch.setattr("stackbounce.measure.reading.numbers._ODD", 100)
    refused(read, "t,F\n0,1\n" + "1,2_3\n" * 50, "too many of its lines are not just numbers")


def test_blank_cells_are_as_fast(read, monkeypatch):
    monkeypatch.setattr("stackbounce.measure.reading.numbers._ODD", 0)
    data = read("t (s),F (N),G,\n,,,\n0,1,,\n1,,3,\n,7,,\n2,,,")
    np.testing.assert_array_equal(data.time, [0, 1, 2])
    np.testing.assert_array_equal(data.force, [1, np.nan, np.nan])
    np.testing.assert_array_equal(data["g"], [np.nan, 3, np.nan])


def test_too_many_numbers(read, monkeypatch):
    monkeypatch.setattr("stackbounce.measure.reading.numbers.CELLS", 50)
    refused(read, made.force_ms(), "more than 50 numbers")
    monkeypatch.setattr("stackbounce.measure.reading.wav.CELLS", 50)
    refused(read, made.wav(), "more than 50 samples")


FILES = minimal_cases()


@pytest.mark.parametrize("holds", [None, "waveform", "track", "table"])
@pytest.mark.parametrize("name", sorted(made.MAKERS))
def test_only_our_own_errors_come_of_anything(read, name, holds):
    for seed in range(8):
        content = mutated(FILES[name], np.random.default_rng([seed, len(name)]))
        try:
            data = read(content, holds=holds)
        except StackbounceError as error:
            message = str(error)
            assert "\n" not in message
        else:
            assert data.attrs["holds"]
            assert max(data.sizes.values()) > 0
            numbers = [data[name] for name in data.variables if name != "track"]
            assert all(one.dtype == np.float64 and not np.isinf(one).any() for one in numbers)


# --- long files: the same numbers as of short ones, in less time and memory
CELLS = st.one_of(
    st.from_regex(r"[+-]?[0-9]{0,17}(\.[0-9]{0,17})?([eE][+-]?[0-9]{0,4})?", fullmatch=True),
    st.floats(allow_nan=False, allow_infinity=False, width=16).map(str),
    st.sampled_from(["", "-", "--", "1e400", "-0", "1e-22", "9007199254740993", "1.2.3", " 1"]),
)


def parsed(cells):
    """Return the numbers of a column of cells, or None where one of them is no plain number."""
    text = Text("", "\t", ".", [], [], [], [], "")
    return numbers._parsed("\n".join(f"{cell}\t0" for cell in cells), text, [0])


@given(st.lists(CELLS, min_size=1, max_size=6))
def test_a_number_is_what_python_makes_of_it_or_none(cells):
    found = parsed(cells)
    if found is not None:
        wanted = [math.nan if cell in ("", "-", "--") else float(cell) for cell in cells]
        assert found[:, 0].tobytes() == np.array(wanted).tobytes()


NUMBERS = st.floats(allow_nan=False, allow_infinity=False) | st.decimals(-1000, 1000, places=6)


@given(st.lists(NUMBERS, min_size=2, max_size=40))
def test_plain_numbers_are_all_read_and_rounded_as_python_rounds_them(values):
    assert parsed([str(value) for value in values])[:, 0].tolist() == list(map(float, values))


@pytest.mark.parametrize(
    "cell", ["x", "1;2", "1.2.3", "True", "false", "0x10", "1_000", "1 000", "1e", "1\0", "1\xa02"]
)
def test_a_cell_that_is_no_plain_number_is_left_to_python(cell):
    assert parsed(["1", cell]) is None
    assert parsed([cell]) is None


LINES = {
    "plain": ("t (s),F (N)", [f"{k / 1000},{math.sin(k):.6f}" for k in range(400)]),
    "comma": (
        "t (s);F (N)",
        [f"{k / 1000};{math.sin(k):.6f}".replace(".", ",") for k in range(400)],
    ),
    "tab": ("t (s)\tF (N)", [f"{k}e-3\t{math.sin(k):.3e}" for k in range(400)]),
    "seventeen digits": ("t (s),F (N)", [f"{k / 1000!r},{math.sin(k)!r}" for k in range(400)]),
    "blanks": ("t (s) F (N)", [f"  {k / 1000:9.4f}  {math.sin(k):9.4f}" for k in range(400)]),
    "trailing delimiter": ("t (s),F (N),", [f"{k / 1000},{math.sin(k):.4f}," for k in range(400)]),
    "missing": ("t (s),F (N)", [f"{k / 1000},{'' if k % 7 == 3 else k}" for k in range(400)]),
    "words": ("t (s),F (N)", [f"{k / 1000},{'oops' if k == 333 else k}" for k in range(400)]),
    "quoted": ("t (s),F (N)", [f'"{k / 1000}","{k}"' for k in range(400)]),
    "thousands": ("t (s);F (N)", [f"{k};{k + 1000:,}.5" for k in range(400)]),
    "ragged": ("t (s),F (N)", [f"{k},{k}" + ",9" * (k == 350) for k in range(400)]),
    "no columns between": ("t (s),remark,F (N)", [f"{k},,{k / 8}" for k in range(400)]),
}


@pytest.mark.fast_cases(2)
@pytest.mark.parametrize("end", ["\n", "\r\n"])
@pytest.mark.parametrize("name", LINES)
def test_long_files_are_read_as_short_ones_are(tmp_path, monkeypatch, name, end):
    head, lines = LINES[name]
    path = tmp_path / "file.csv"
    path.write_bytes(end.join([head, *lines, ""]).encode())
    whole = sb.read(path)
    monkeypatch.setattr(numbers, "_CHUNK", 1000)  # so that it is long, and a chunk a few lines
    parts = sb.read(path)
    assert parts.attrs == whole.attrs
    assert list(parts.variables) == list(whole.variables)
    for variable in whole.variables:
        assert parts[variable].values.tobytes() == whole[variable].values.tobytes()


def test_a_first_row_with_a_remark_is_no_header(read):
    data = read(b"t (ms),F (N),comment\n0,1.5,start\n1,2.5,\n2,3.5,\n")
    assert (data.attrs["holds"], data.force.values.tolist()) == ("waveform", [1.5, 2.5, 3.5])
