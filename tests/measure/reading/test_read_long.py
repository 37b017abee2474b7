"""Long files: the same numbers as of short ones, in less time and memory."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import stackbounce as sb
from stackbounce.measure.reading import numbers
from stackbounce.measure.reading.text import Text

CELLS = st.one_of(
    st.from_regex(r"[+-]?[0-9]{0,17}(\.[0-9]{0,17})?([eE][+-]?[0-9]{0,4})?", fullmatch=True),
    st.floats(allow_nan=False, allow_infinity=False, width=16).map(str),
    st.sampled_from(["", "-", "--", "1e400", "-0", "1e-22", "9007199254740993", "1.2.3", " 1"]),
)


def parsed(cells):
    """Return the numbers of a column of cells, or None where one of them is no plain number."""
    table = numbers.Table(np.empty((0, 1)), np.zeros(1, dtype=np.int64))
    text = Text("", "\t", ".", [], [], [], [], "")
    return numbers._parsed("\n".join(f"{cell}\t0" for cell in cells), text, [0], table)


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
