"""Fits from files: TOML with tables of its own, and tables of drops."""

import numpy as np
import pytest

import stackbounce as sb
from fitting.test_series_table import REFUSED
from refusals import refusal
from stackbounce.errors import FileError, InvalidType, InvalidValue, ScenarioError
from stackbounce.fitting import FitProblem, Range, read_drops, read_question

STACK = """
[[balls]]
mass = "150 g"
[[balls]]
mass = "57 g"
[[contacts]]
law = "Spring"
stiffness = "2.5 kN/m"
[[contacts]]
law = "Spring"
stiffness = "1 kN/m"
"""
ONE = """
gaps = ["2 mm"]
impact_speed = 3.53

[measured]
"rebound_ratios.1" = "1.70 ± 0.02"
first_touch.1 = "0.6 ± 0.1 ms"
collisions = [1, 1]

[vary]
contacts.1.stiffness = "0.7 kN/m : 2.5 kN/m"
"gaps.0" = {low = "0 mm", high = "5 mm", prior = "2 ± 1 mm"}
"""
BASE = sb.Drop(
    [sb.Ball(0.15), sb.Ball(0.057)], [sb.Spring(2500.0), sb.Spring(1000.0)], impact_speed=3.53
)


@pytest.fixture
def write(tmp_path):
    def write_file(text, name="fit.toml", encoding="utf-8"):
        path = tmp_path / name
        path.write_bytes(text.encode(encoding))
        return path

    return write_file


def record(path, unit="N"):
    """Write a force record of 10 ms."""
    times = np.arange(-2e-3, 8e-3, 1e-5)
    pulse = 157.02 * np.sin(np.clip(times * 622.0, 0.0, np.pi))  # 57 g from 1 m
    force = pulse + np.random.default_rng(1).normal(0.0, 0.5, len(times))
    rows = "".join(f"{t:.6f},{f:.4f}\n" for t, f in zip(times, force, strict=True))
    path.write_text(f"Time (s),Force ({unit})\n{rows}", encoding="ascii")


def test_a_scenario_with_three_more_tables(write):
    asked = read_question(write(ONE + STACK))
    assert isinstance(asked, FitProblem)
    (drop,) = asked.drops.values()
    assert (drop.gaps, drop.impact_speed, drop.balls) == ((0.002,), 3.53, BASE.balls)
    assert asked.data[""]["first_touch.1"] == "0.6 ± 0.1 ms"  # quotes around a name or none
    assert asked.vary == {
        "contacts.1.stiffness": "0.7 kN/m : 2.5 kN/m",
        "gaps.0": Range("0 mm", "5 mm", "2 ± 1 mm"),
    }
    found = asked.fit()
    assert found.best == sb.fit(asked.drops, asked.data, asked.vary, tie=asked.tie).best
    names = [one.name for one in found.residuals]
    assert names == ["rebound_ratios.1", "first_touch.1", "gaps.0 (known)"]


def test_a_scenario_alone_asks_nothing_yet(write):
    asked = read_question(write("height = '1 m'\n" + STACK))
    assert (asked.data, asked.vary, asked.tie) == ({}, {}, {})


def test_a_list_of_names_varies_around_the_drop(write):
    asked = read_question(write("vary = ['contacts.1.stiffness']\nheight = 1.0\n" + STACK))
    assert asked.vary == {"contacts.1.stiffness": None}


def test_several_drops_share_what_stands_above_them(write):
    text = (
        "height = 0.3\n"
        + STACK
        + "[vary]\ncontacts.1.stiffness = ''\n[tie]\ngaps.0 = '1e-3 + 0*contacts.1.stiffness'\n"
        "[[drops]]\nname = 'low'\nmeasured.rebound_ratios = ['', '1.70 ± 0.02']\n"
        "[[drops]]\nname = 'fast'\nimpact_speed = '5 m/s'\ngaps = [0.001]\n"
        "[drops.measured]\ncollisions.1 = 1\nrebound_ratios.1 = '1.72 ± 0.02'\n"
    )
    asked = read_question(write(text))
    assert asked.drops["low"] == sb.Drop(BASE.balls, BASE.contacts, height=0.3)
    assert asked.drops["fast"].impact_speed == 5.0
    assert asked.drops["fast"].height is None
    assert asked.vary == {"contacts.1.stiffness": None}
    found = asked.fit()
    assert [one.drop for one in found.residuals] == ["low", "fast"]
    assert found.drops["low"].gaps == (0.001,)


def test_a_force_record_beside_the_file(write, tmp_path):
    record(tmp_path / "scope.csv")
    text = (
        "height = 1.0\n[measured]\nforce.0 = {file='scope.csv', start='-1 ms', end='7 ms', "
        "error='0.5 N'}\n[vary]\ncontacts.0.stiffness='10 kN/m : 50 kN/m'\n"
        "[[balls]]\nmass = 0.057\n[[contacts]]\nlaw = 'Spring'\nstiffness = 2e4\n"
    )
    asked = read_question(write(text))
    force = asked.data[""]["force.0"]
    assert (float(force.time[0]), float(force.time[-1])) == pytest.approx((-1e-3, 7e-3))
    assert force.attrs["error"] == 0.5
    found = asked.fit()
    assert found["contacts.0.stiffness"].nominal_value == pytest.approx(0.057 * 622.0**2, rel=0.01)
    (one,) = found.records
    assert one.unit == "N"
    assert 0.9 < one.scatter < 1.2
    assert np.interp(0.0, one.times, one.fitted) == pytest.approx(0.0, abs=2.0)


@pytest.mark.parametrize(("old", "new", "expected"), REFUSED["files"])
def test_what_is_wrong_in_a_file_is_one_line_with_its_name(write, old, new, expected):
    path = write((ONE + STACK).replace(old, new))
    message = refusal(ScenarioError, read_question, path)
    assert message.startswith(f"{path}")
    assert expected in message


@pytest.mark.parametrize(("drops", "expected"), REFUSED["drops"])
def test_what_is_wrong_in_several_drops(write, drops, expected):
    message = refusal(ScenarioError, read_question, write(STACK + drops))
    assert "fit.toml: " in message
    assert expected in message


def test_a_record_without_a_force_is_refused(write):
    write("name,x (m)\n1,2\n3,4\n", "table.csv")
    with pytest.raises(ScenarioError, match=r"table\.csv holds no force over time, but a table"):
        read_question(write(ONE.replace("[measured]", "[measured]\nforce.0='table.csv'") + STACK))
    with pytest.raises(FileError, match=r"none\.csv cannot be read: No such file"):
        read_question(write(ONE.replace("[measured]", "[measured]\nforce.0='none.csv'") + STACK))
    with pytest.raises(InvalidType, match="path must be a string or a path"):
        read_question(3)


HEAD = "name,height (cm),gaps.0 (mm),rebound_ratios.1\n"


@pytest.mark.parametrize(
    "text",
    [
        f"{HEAD}a,30,,1.61 ± 0.02\nb,63.5,2,1.55+/-0.03\n",
        "name;height (cm);gaps.0 (mm);rebound_ratios.1\na;30;;1,61 ± 0,02\nb;63,5;2;1,55 ± 0,03\n",
        f'{HEAD}a,30,n/a,"1,61 ± 0,02"\nb,"63,5",2,"1,55 ± 0,03"\n',
        (
            "name\theight / m\tgaps.0\trebound_ratios.1\terror of rebound_ratios.1\n"
            "a\t0.3\t\t1.61\t0.02\n\n\nb\t635 mm\t2 mm\t1.55\t.03\n"
        ),
        (
            "error of rebound_ratios.1 (%);rebound_ratios.1;gaps.0 [mm];height, cm;name;\r\n"
            "2;161 %;;30;a;\r\n3;155 %;2;63.5;b;\r\n"
        ),
    ],
    ids=["commas", "semicolons", "quoted", "tabs", "in any order"],
)
@pytest.mark.parametrize("encoding", ["utf-8-sig", "utf-16", "latin-1"])
def test_a_table_as_spreadsheets_write_it(write, text, encoding):
    drops, data = read_drops(BASE, write(text, "drops.csv", encoding))
    assert [drop.height for drop in drops.values()] == pytest.approx([0.3, 0.635])
    assert [drop.gaps for drop in drops.values()] == [(0.0,), (0.002,)]
    assert all(drop.impact_speed is None for drop in drops.values())
    assert {name: one["rebound_ratios.1"] for name, one in data.items()} == {
        "a": pytest.approx((1.61, 0.02)),
        "b": pytest.approx((1.55, 0.03)),
    }


def test_an_error_beside_a_number_has_its_unit_in_every_row(write):
    text = "rebound_heights.1 (cm),error of rebound_heights.1\n172,3\n165,4\n"
    _, data = read_drops(BASE, write(text, "drops.csv"))
    found = [one["rebound_heights.1"] for one in data.values()]
    assert found == [pytest.approx((1.72, 0.03)), pytest.approx((1.65, 0.04))]


def test_a_table_has_counts_heights_and_forces(write, tmp_path):
    record(tmp_path / "scope.csv", "V")
    text = "collisions.0,rebound_heights.1 (cm),force.0,impact_speed\n1,172 ± 3 cm,,\n,,scope.csv,2"
    drops, data = read_drops(BASE, write(text, "drops.csv"))
    assert list(drops) == ["drop_1", "drop_2"]
    assert drops["drop_1"] == BASE
    assert drops["drop_2"].impact_speed == 2.0
    assert data["drop_1"] == {"collisions.0": 1, "rebound_heights.1": pytest.approx((1.72, 0.03))}
    assert data["drop_2"]["force.0"].attrs["units"] == "V"


@pytest.mark.parametrize(("text", "expected"), REFUSED["rows"])
def test_what_is_wrong_in_a_table_is_one_line_with_row_and_column(write, text, expected):
    path = write(text, "drops.csv")
    message = refusal((InvalidValue, FileError), read_drops, BASE, path)
    assert expected in message
    assert "table.xyz" in text or message.startswith(f"{path}: ")


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("height,collisions.0\n" + "1,1\n" * 1001, "more than 1000 columns or 1000 drops"),
        ("height" + "," * 2000 + "\n", "more than 1000 columns or 1000 drops"),
        ("h" * (2**20 + 2), "row 1 has more than 1048576 characters"),
        ("\x89PNG\r\n", "it is a picture, not a table"),
        ("", "is empty"),
    ],
    ids=["rows", "columns", "line", "picture", "nothing"],
)
def test_a_table_that_is_none_is_refused(write, text, expected):
    with pytest.raises(FileError, match=expected):
        read_drops(BASE, write(text, "drops.csv", "latin-1"))
