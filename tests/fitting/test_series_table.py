"""Tables of bounces as people type them: columns, errors, groups, and what is refused."""

import json
import tomllib
from pathlib import Path

import numpy as np
import pytest

from stackbounce.cli import main
from stackbounce.errors import InvalidValue
from stackbounce.fitting.series import fit_series, read_table
from stackbounce.fitting.series.series import make_series
from stackbounce.model.drop import STANDARD_GRAVITY

TABLES, REFUSED = (
    tomllib.loads(Path(__file__).with_name(f"{name}.toml").read_text("utf-8"))
    for name in ("tables", "refused")
)
HEIGHTS = Path(__file__).parents[2] / "docs" / "fit" / "heights.csv"


@pytest.fixture
def table(tmp_path):
    """Return a function that writes a table and reads it again."""

    def read(text, *errors, name="heights.csv"):
        (tmp_path / name).write_text(text, "utf-8")
        return read_table(tmp_path / name, errors)

    return read


def speeds(*heights):
    return pytest.approx(np.sqrt(2.0 * STANDARD_GRAVITY * np.array(heights)), rel=1e-12)


@pytest.mark.parametrize("text", TABLES["pairs"])
def test_two_columns_of_heights_in_many_forms(table, text):
    series = make_series(table(text).groups[""])
    order = np.argsort(-series.speeds)
    assert series.speeds[order] == speeds(1.0, 0.5)
    assert series.values[order] == pytest.approx([0.8, 0.66**0.5], rel=1e-12)


@pytest.mark.parametrize("text", TABLES["speeds"])
def test_speeds_and_restitutions(table, text):
    series = make_series(table(text).groups[""])
    assert series.speeds == pytest.approx([2.0, 3.0])
    assert series.values == pytest.approx([0.8, 0.75])
    assert not series.from_heights
    assert ("'drop height (cm)' is not used: 'e' is" in str(table(text).notes)) == ("drop" in text)


def test_bounces_in_turn_fall_from_where_the_one_before_rose_to(table):
    read = table("drop height,bounce 1,bounce 2\n100,64,41\n50,33,22\n")
    assert "taken as cm, by their size" in read.notes[0]
    series = make_series(read.groups[""])
    order = np.argsort(-series.speeds)
    assert series.speeds[order] == speeds(1.0, 0.64, 0.5, 0.33)
    assert (series.values[order] ** 2) == pytest.approx([0.64, 41 / 64, 0.66, 22 / 33], rel=1e-12)
    covariance = series.covariance()[np.ix_(order, order)]
    assert covariance[0, 1] < 0.0 == covariance[0, 2]  # neighbours share a height


def test_numbered_columns_of_equal_heights_are_readings(table):
    read = table("drop height (cm),rebound 1 (cm),rebound 2 (cm)\n100,64,66\n50,33,32\n25,17,\n")
    series = make_series(read.groups[""])
    assert series.values**2 == pytest.approx([17 / 25, 0.65, 0.65], rel=1e-9)
    scatter = (((64 - 66) ** 2 + (33 - 32) ** 2) / 2 / 2) ** 0.5 / 100  # m, pooled by hand
    slope = 0.5 / (series.values * [0.25, 0.5, 1.0])
    errors = np.sqrt(series.covariance().diagonal())
    assert errors == pytest.approx(slope * scatter / np.sqrt([1, 2, 2]), rel=1e-6)
    assert series.freedom() < 3.0
    assert "'rebound 1 (cm)', 'rebound 2 (cm)' are taken as repeated readings" in read.notes[0]


def test_means_and_deviations_of_the_readings_are_left_out(table):
    first, *others = (make_series(table(text).groups[""]) for text in TABLES["means"])
    for other in others:
        assert other.values == pytest.approx(first.values, rel=1e-12)
        assert other.covariance() == pytest.approx(first.covariance(), rel=1e-12)
    assert first.freedom() < 4.0


def test_trailing_zeros_are_not_read(table):
    rows = [f"{10 * k / 100:.4f},{round(6.4 * k) / 100:.4f}" for k in range(3, 9)]
    read = table("h0 (m),h1 (m)\n" + "\n".join(rows) + "\n")
    assert read.groups[""].rebound_height.assumed_error == pytest.approx(0.005)


def test_words_are_groups_and_remarks_are_not(table):
    rows = "golf,100,70,a\ngolf,50,36,b\nMax,100,53,c\n"  # a name, no maximum
    read = table("ball,drop height (cm),rebound (cm),remark\n" + rows)
    assert list(read.groups) == ["golf", "Max"]
    assert "The words of column 'remark' are not used: no groups." in read.notes
    masses = table("mass (g),h0 (cm),h1 (cm)\n57,50,32\n57,100,64\n46,50,40\n46,100,80\n")
    assert list(masses.groups) == ["57", "46"]
    alike = read_table(HEIGHTS, mass=0.058, diameter=0.066)
    assert "The mass and diameter are taken for all of" in str(alike.notes)


@pytest.mark.parametrize("text", TABLES["errors"])
def test_errors_stand_in_columns_cells_or_headings(table, text):
    series = make_series(table(text).groups[""])
    expected = 0.01 * 0.5 / (series.values * [0.5, 1.0])
    order = np.argsort(series.speeds)
    assert np.sqrt(series.covariance().diagonal())[order] == pytest.approx(
        np.sort(expected)[::-1], rel=1e-6
    )
    assert series.freedom() == np.inf
    assert not series.has_assumed_errors


def test_joined_cells_and_points_without_a_zero_before_them(table):
    read = table("ball,h0 (m),h1 (m)\na,1,.642\n,.5,.333\nb,1,.502\n,.5,.251\n")
    found = {(len(data.row), data.rebound_height.assumed_error) for data in read.groups.values()}
    assert (found, [*read.groups]) == ({(2, 0.0005)}, ["a", "b"])


def test_an_error_told_beside_the_table_and_half_a_digit_without(table):
    text = "drop height (cm),rebound (cm)\n100,64.5\n50,33\n"
    told = make_series(table(text, "5 mm", "drop height = 2 mm").groups[""])
    fall, rise = np.array([0.5, 1.0]), np.array([0.33, 0.645])
    variance = 0.25 * told.values**2 * ((0.005 / rise) ** 2 + (0.002 / fall) ** 2)
    assert told.covariance().diagonal() == pytest.approx(variance, rel=1e-6)
    read = table(text)
    series = make_series(read.groups[""])
    assert np.sqrt(series.assumed.diagonal()) == pytest.approx(
        0.0005 * 0.5 / series.values / [0.5, 1.0], rel=1e-6
    )
    assert "half of the step in which it was written, 0.5 mm" in read.notes[-1]
    read = table("v (m/s),e\n2,0.8012345678\n3,0.7512345678\n")  # computed, not read
    assert (
        "is 1 % of the largest, which has more digits than can be read, 0.00801" in read.notes[-1]
    )


def test_a_reading_far_from_the_others_is_named_and_kept(table):
    rows = [(100, 64.0), (100, 64.4), (100, 46.1), (100, 64.2), (50, 33.0), (50, 33.3), (50, 33.1)]
    read = table("drop height (cm),rebound (cm)\n" + "".join(f"{h},{r}\n" for h, r in rows))
    assert "Row 4 is far from the other readings of its height" in read.notes[-1]
    assert np.nanmean(read.groups[""].rebound_height.values[1]) == pytest.approx(0.59675)


@pytest.mark.parametrize(("text", "message"), REFUSED["tables"])
def test_what_is_wrong_is_said_with_row_and_column(table, text, message):
    with pytest.raises(InvalidValue) as refused:
        table(text)
    assert message in str(refused.value)
    assert str(refused.value).count("\n") == 0


def test_an_error_of_no_column_is_refused(table):
    with pytest.raises(InvalidValue, match="an error must name its column, got 'width'"):
        table(TABLES["pairs"][0], "width = 2 mm")


def test_a_fit_shows_itself_as_text_and_as_html(tmp_path):
    (tmp_path / "heights.csv").write_text(TABLES["pairs"][0])
    found = fit_series(tmp_path / "heights.csv", laws=["Rigid"], errors=["5 mm"])
    assert "heights.csv" in repr(found).splitlines()[0]
    assert "The drop heights are taken as exact" in repr(found)
    assert ">Rigid</th>" in found._repr_html_()
    row = found.table.loc[("heights.csv", "Rigid")]
    assert row["from"] < row["restitution"] < row["to"] < 0.82
    assert row["degrees"] == 1


def test_the_command_prints_draws_and_writes_a_page(tmp_path, capsys):
    path, plot, page = tmp_path / "heights.csv", tmp_path / "laws.svg", tmp_path / "page"
    rows = [(150, 79.1), (150, 78.3), (100, 54.0), (100, 53.2), (50, 27.6), (50, 27.4)]
    path.write_text("drop height (cm),rebound (cm)\n" + "".join(f"{h},{r}\n" for h, r in rows))
    assert main(["fit", str(path), "--compare", "--plot", str(plot), "--out", str(page)]) == 0
    told = capsys.readouterr().out
    assert "3 restitutions from 3.13 to 5.42 m/s" in told
    assert "The error of one rebound height is the scatter of repeated readings, 470 µm" not in told
    assert "with 3 degrees of freedom" in " ".join(told.split())
    assert plot.read_bytes().startswith(b"<?xml")
    assert "Viscoelastic" in (page / "index.html").read_text("utf-8")
    assert main(["fit", str(path), "--contact", "viscoelastic", "--json"]) == 0
    (series,) = json.loads(capsys.readouterr().out)["series"]
    assert [law["law"] for law in series["laws"]] == ["Viscoelastic"]


@pytest.mark.parametrize(
    ("rows", "message"),
    [
        ("100,64,0\n50,33,1\n", r"row 2: the error of 'rebound \(cm\)' must be above 0"),
        ("100,100,1\n50,50,1\n", "a restitution is 1 or more"),
        ("100,64,1\n", "it has one value only"),
        ("100,abc,1\n50,33,1\n75,50,1\n", r"row 2, rebound \(cm\) must be a length"),
    ],
)
def test_numbers_of_which_no_law_can_be_fitted(tmp_path, rows, message):
    path = tmp_path / "heights.csv"
    path.write_text("drop height (cm),rebound (cm),error\n" + rows)
    with pytest.raises(InvalidValue, match=message):
        fit_series(path)


def test_measure_and_fit_point_to_each_other(tmp_path, capsys):
    bounces, knocks = tmp_path / "heights.csv", tmp_path / "knocks.csv"
    bounces.write_text(TABLES["pairs"][0])
    knocks.write_text("knock time (s)\n0.0\n0.9\n1.62\n2.2\n")
    assert main(["measure", str(bounces)]) == 2
    assert f"stackbounce fit {bounces} fits it" in capsys.readouterr().err
    assert main(["fit", str(knocks)]) == 2
    assert f"stackbounce measure {knocks} analyses it" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ([str(HEIGHTS), "--vary", "gaps.0"], "--vary is of a drop; "),
        (["basketball", "--error", "5mm"], "--error is of a table of bounces"),
        (["dataset:golf", "--compare"], "name must be that of a dataset, got 'golf'"),
        (["dataset:golf-marble-heights", "--error", "1mm"], "has errors, mass and diameter of its"),
    ],
)
def test_options_that_do_not_belong_are_refused(arguments, message, capsys):
    assert main(["fit", *arguments]) == 2
    assert message in " ".join(capsys.readouterr().err.split())
