"""Every option of a measurement is offered on every face, and means the same there."""

import inspect
import json
import re
from dataclasses import replace
from pathlib import Path

import pytest
from measure_options import row, taken_by
from page_build.data import options_json

import stackbounce as sb
from stackbounce.cli import main
from stackbounce.errors import InvalidType
from stackbounce.explorer.answers import records
from stackbounce.measure import analyse
from stackbounce.measure.kinds import KINDS, TYPED
from stackbounce.measure.option_values import read_options
from stackbounce.measure.options import OPTIONS, options_for
from stackbounce.measure.setup import Setup

PAGE = Path(__file__).parents[2] / "docs" / "measure.md"
LAB = PAGE.parent / "lab"
FORCE = (LAB / "tennis-force.csv").read_text(encoding="utf-8")
GERMAN = "Zeit (s);Kraft (N)\n" + "".join(f"0,{k:03};{k % 7},250\n" for k in range(60))
ONLY_TYPED = {"heights", "restitution"}  # the page takes files


def test_python_takes_what_the_table_has():
    of_read = inspect.signature(sb.read).parameters
    assert set(of_read) - {"path"} == set(options_for("read"))
    of_analyse = inspect.signature(analyse).parameters
    assert list(of_analyse) == ["data", *options_for("analyse")]
    for name in options_for("analyse"):
        assert re.search(rf"^    (\w+, )*{name}(, \w+)* : ", analyse.__doc__, re.MULTILINE)


def test_each_option_is_taken_and_none_is_taken_that_is_not_in_the_table():
    names = {one.name for one in OPTIONS}
    for kind in (*KINDS.values(), *TYPED):
        assert set(kind.options) <= names
        assert kind.says
    assert all(taken_by(one) for one in OPTIONS if one.to != "read")


def test_the_command_line_offers_each(capfd, monkeypatch):
    monkeypatch.setenv("COLUMNS", "200")
    assert main(["measure", "--help"]) == 0
    out = capfd.readouterr().out
    offered = set(re.findall(r"--[a-z-]+", out))
    assert {one.on_command_line for one in OPTIONS} <= offered
    assert offered - {one.on_command_line for one in OPTIONS} == {
        "--name", "--save", "--plot", "--overwrite", "--json", "--help"
    }  # fmt: skip
    valued = [option for option in OPTIONS if option.form != "flag"]
    assert all(re.search(f"{known.on_command_line} +{known.value_name} ", out) for known in valued)
    assert all(kind in out for kind in KINDS)


def test_the_page_offers_each():
    offered = {one["name"]: one for one in json.loads(options_json())["options"]}
    assert set(offered) == {one.name for one in OPTIONS} - ONLY_TYPED
    assert offered["law"]["choices"] == list(sb.model.LAWS)
    assert all(one["label"] and one["says"] for one in offered.values())


def test_the_documentation_has_each():
    """The page has a directive that writes a row of each."""
    assert "```{measure-options}\n```\n" in PAGE.read_text(encoding="utf-8")
    for option in OPTIONS:
        written = row(option)
        assert written.count("|") == 5
        told = f"{option.label}. {option.says}"
        assert f"| `{option.on_command_line}` | `{option.name}` | {told} |" in written


@pytest.mark.parametrize("option", [one for one in OPTIONS if one.form not in ("flag", "file")])
def test_an_example_is_understood_on_the_command_line_and_by_the_page(option):
    chosen = {"law": "Hertz", "holds": "sound", "decimal": ","}
    example = {option.name: chosen.get(option.name, option.example)}
    told = read_options(example, lambda one: one.on_command_line)
    assert set(told) == {option.name}
    assert str(told) == str(read_options(example, lambda one: one.name))


FACES = {
    "decimal mark": (GERMAN, {"decimal": ","}),
    "law": (FORCE, {"law": "PowerLaw", "exponent": "1.3", "mass": "57 g", "speed": "4.4 m/s"}),
    "columns": ("a,b\n0,1\n0.5,0.7\n0.9,0.6\n1.22,0.5\n", {"names": "1=knock_time"}),
    "air": (
        "t\n0\n0.5\n0.9\n1.22\n",
        {
            "holds": "knocks",
            "height": "0.5 m",
            "mass": "2.7 g",
            "diameter": "40 mm",
            "drag_coefficient": "0.45 ± 0.05",
            "air_density": "1.3 kg/m^3",
        },
    ),
}


@pytest.mark.parametrize(("content", "typed"), FACES.values(), ids=FACES)
def test_an_option_means_the_same_on_every_face(content, typed, tmp_path, capfd):
    path = tmp_path / "file.csv"
    path.write_text(content, encoding="utf-8")
    on_command_line = {one.name: one.on_command_line for one in OPTIONS}
    arguments = [part for name, text in typed.items() for part in (on_command_line[name], text)]
    assert main(["measure", str(path), *arguments, "--json"]) == 0
    (told,) = json.loads(capfd.readouterr().out)["files"]
    page = json.loads(records.measure_record(path.name, path.read_bytes(), typed))
    assert (page["found"], page["notes"]) == (told["found"], told["notes"])
    options = read_options(typed, lambda one: one.name)
    of_read = {name: options.pop(name) for name in typed if name in options_for("read")}
    python = [row for one in analyse(sb.read(path, **of_read), **options) for row in one.rows()]
    numbers = [getattr(row.value, "nominal_value", row.value) for row in python]
    assert numbers == [row["value"] for row in told["found"]]
    if typed.get("decimal"):
        assert main(["measure", str(path), "--decimal", ";"]) == 2
        assert "decimal" in capfd.readouterr().err


def test_a_law_needs_what_it_is_calibrated_with(capfd):
    arguments = [str(LAB / "tennis-force.csv"), "--mass", "57g", "--law", "power-law"]
    assert main(["measure", *arguments, "--exponent", "1.3"]) == 2
    assert "needs what was not found: impact speed" in capfd.readouterr().err


def test_the_impact_speed_of_a_force_is_that_of_the_fall_of_the_lowest_point():
    setup = Setup(height=1.066, measured_to="top", diameter=0.066, gravity=9.8)
    assert setup.impact_speed == pytest.approx(19.6**0.5, rel=1e-12)
    assert replace(setup, speed=3.0).impact_speed == 3.0
    assert Setup().impact_speed is None


def test_an_option_that_is_not_there_or_another_function_s_is_refused():
    data = sb.read(LAB / "basketball-press.csv")
    with pytest.raises(TypeError, match="unexpected keyword argument 'holds'"):
        analyse(data, holds="table")
    with pytest.raises(InvalidType, match="repeated must be true or false, got 'yes'"):
        read_options({"repeated": "yes"}, lambda one: one.name)


def test_a_column_is_named_by_its_number_or_its_heading():
    typed = read_options({"names": "2=force, CH1=time"}, lambda option: option.name)
    assert typed == {"names": {2: "force", "CH1": "time"}}
