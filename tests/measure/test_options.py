"""Every option of a measurement is offered on every face, and means the same there."""

import inspect
import json
import re
from dataclasses import replace
from pathlib import Path

import pytest
from measure_options import row

import stackbounce as sb
from stackbounce.cli import main
from stackbounce.errors import InvalidType
from stackbounce.explorer.answers import records
from stackbounce.measure import analyse
from stackbounce.measure.kinds import KINDS, TYPED
from stackbounce.measure.option_values import read_options
from stackbounce.measure.options import OPTIONS, options_for, taken_by
from stackbounce.measure.setup import Setup

PAGE = Path(__file__).parents[2] / "docs" / "measure.md"
LAB = Path(__file__).parents[2] / "docs" / "lab"
GERMAN = "Zeit (s);Kraft (N)\n" + "".join(f"0,{k:03};{k % 7},250\n" for k in range(60))
ONLY_TYPED = {"heights"}  # the page takes files


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
    assert all(kind in out for kind in KINDS)


def test_the_page_offers_each():
    served = json.loads(records.list_options())
    assert [one["name"] for one in served["kinds"]] == list(KINDS)
    offered = {one["name"]: one for one in served["options"]}
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
    example = "Hertz" if option.name == "law" else "sound" if option.name == "holds" else ""
    example = example or ("," if option.name == "decimal" else option.example)
    told = read_options({option.name: example}, lambda one: one.on_command_line)
    assert set(told) == {option.name}
    assert str(told) == str(read_options({option.name: example}, lambda one: one.name))


def test_a_decimal_mark_is_told_on_every_face(tmp_path, capfd):
    path = tmp_path / "force.csv"
    path.write_text(GERMAN, encoding="utf-8")
    data = sb.read(path, decimal=",")
    assert data.force.values[1] == 1.25
    assert main(["measure", str(path), "--decimal", ",", "--json"]) == 0
    (told,) = json.loads(capfd.readouterr().out)["files"]
    page = json.loads(records.measure_record("force.csv", path.read_bytes(), {"decimal": ","}))
    assert told["found"] == page["found"]
    assert main(["measure", str(path), "--decimal", ";"]) == 2
    assert "decimal" in capfd.readouterr().err


def test_a_law_with_an_exponent_is_told_on_every_face(capfd):
    path = LAB / "tennis-force.csv"
    (found,) = analyse(sb.read(path), mass=0.057, law="PowerLaw", exponent=1.3)
    page = records.measure_record(
        path.name, path.read_bytes(), {"law": "PowerLaw", "exponent": "1.3"}
    )
    time = found.contacts[0].time.nominal_value
    assert {"contact time": time}.items() <= values(json.loads(page)["found"]).items()
    arguments = [str(path), "--mass", "57g", "--json", "--law", "power-law", "--exponent", "1.3"]
    assert main(["measure", *arguments]) == 2
    assert "needs what was not found: impact speed" in capfd.readouterr().err
    assert main(["measure", *arguments, "--speed", "4.4"]) == 0
    told = json.loads(capfd.readouterr().out)
    assert values(told["files"][0]["found"])["contact time"] == time


def test_the_record_of_the_lower_ball_alone_comes_with_the_page_too(capfd):
    path = LAB / "tennis-force.csv"
    file = (path.name, path.read_bytes())
    page = json.loads(records.measure_record(*file, {"speed": "4.4 m/s"}, alone=file))
    assert main(["measure", str(path), "--speed", "4.4", "--alone", str(path), "--json"]) == 0
    (told,) = json.loads(capfd.readouterr().out)["files"]
    assert page["found"] == told["found"]
    assert "gap between the balls" in values(page["found"])


def test_the_impact_speed_of_a_force_is_that_of_the_fall_of_the_lowest_point():
    setup = Setup(height=1.066, measured_to="top", diameter=0.066, gravity=9.8)
    assert setup.impact_speed == pytest.approx(19.6**0.5, rel=1e-12)
    assert replace(setup, speed=3.0).impact_speed == 3.0
    assert Setup().impact_speed is None


def values(found):
    return {one["name"]: one["value"] for one in found}


def test_an_option_that_is_not_there_or_another_function_s_is_refused():
    data = sb.read(LAB / "basketball-press.csv")
    with pytest.raises(TypeError, match="unexpected keyword argument 'holds'"):
        analyse(data, holds="table")
    with pytest.raises(InvalidType, match="repeated must be true or false, got 'yes'"):
        read_options({"repeated": "yes"}, lambda one: one.name)
    for alone in ("/etc/hostname", ["a", "b"], {}):  # a request cannot name a file of the server
        with pytest.raises(InvalidType, match="“Force under the lower ball alone” must be a file"):
            records.measure_record("a.csv", b"Time (s),Force (N)\n0,0\n", {"alone": alone})
