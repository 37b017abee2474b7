"""A kind of measurement that one module adds is read, analysed, printed, served and drawn."""

import json
import sys
import types
from dataclasses import dataclass

import pytest
from page_build.data import options_json
from uncertainties import ufloat

import stackbounce as sb
from stackbounce import plots
from stackbounce.cli import main
from stackbounce.errors import InvalidType
from stackbounce.explorer.answers import records
from stackbounce.measure import analyse, heights, one_law
from stackbounce.measure.finding import Finding
from stackbounce.measure.kind import Kind
from stackbounce.measure.kinds import KINDS
from stackbounce.measure.quantities import Row


@dataclass(frozen=True)
class Swings(Finding):
    """How often a pendulum swings."""

    frequency: float
    gravity: float
    notes: tuple[str, ...] = ("Air is left out.",)

    def rows(self):
        return [Row("frequency", self.frequency, "Hz"), Row("gravity", self.gravity, "m/s^2")]

    def parts(self):
        return {"contact": {"law": "Rigid", "restitution": 0.5}}

    def law_arguments(self):
        return {"restitution": 0.5}


def test_a_result_shows_its_rows_with_errors_and_its_notes():
    found = heights(ufloat(1.0, 0.01), 0.64)
    first, second, *_ = repr(found).splitlines()[1:]
    assert first.split() == ["restitution", "0.8"]
    assert second.split() == ["drop", "height", "1.000(10)", "m"]
    assert "\nA height has no error" in repr(found)
    assert ">1.000(10)</td>" in found._repr_html_()
    assert "<p>A height has no error" in found._repr_html_()


HOW = {"options": ("gravity",), "columns": (("period",),), "dimension": "swing"}
PENDULUM = Kind("pendulum", "how often it swings", "pendulum.kind", **HOW)


@pytest.fixture
def path(tmp_path, monkeypatch):
    monkeypatch.setitem(KINDS, "pendulum", PENDULUM)
    module = types.SimpleNamespace(
        analyse=lambda data, setup: Swings(1.0 / float(data["period"].mean()), setup.gravity)
    )
    monkeypatch.setitem(sys.modules, PENDULUM.module, module)
    path = tmp_path / "swings.csv"
    path.write_text("period (s),angle\n2.0,1\n2.1,2\n1.9,3\n", encoding="utf-8")
    return path


def test_it_is_recognised_and_analysed(path):
    told, seen = sb.read(path, holds="pendulum"), sb.read(path)
    assert told.attrs["holds"] == seen.attrs["holds"] == "pendulum"
    assert told.period.dims == ("swing",)
    (found,) = analyse(told, gravity=9.8, mass=0.1)
    assert (found.frequency, found.gravity) == (pytest.approx(0.5), 9.8)
    assert one_law("rigid", [found]).law == sb.Rigid(0.5)


def test_it_is_printed_saved_and_drawn(path, capfd, tmp_path):
    arguments = ["measure", str(path), "--holds", "pendulum", "--gravity", "9.8"]
    assert main(arguments) == 0
    out = capfd.readouterr().out
    assert "frequency" in out
    assert "Air is left out." in out
    picture, ball = tmp_path / "swings.svg", tmp_path / "ball.toml"
    more = ["--plot", str(picture), "--save", str(ball), "--mass", "57g", "--json"]
    assert main([*arguments, *more]) == 0
    (told,) = json.loads(capfd.readouterr().out)["files"]
    assert told["holds"] == "pendulum"
    assert told["found"][0] == {"name": "frequency", "value": 0.5, "error": None, "unit": "Hz"}
    assert picture.read_bytes().startswith(b"<?xml")
    assert sb.Drop.from_toml(ball).contacts == (sb.Rigid(0.5),)


def test_it_is_in_the_page_s_answer_and_form(path):
    page = json.loads(records.measure_record(path.name, path.read_bytes(), {"gravity": "9.8"}))
    assert page["holds"] == "pendulum"
    assert [row["value"] for row in page["found"]] == [0.5, 9.8]
    assert (page["series"], page["zero"], page["measured"]) == ([], None, {})
    options = json.loads(options_json())["options"]
    (holds,) = [one for one in options if one["name"] == "holds"]
    assert "pendulum" in holds["choices"]


def test_what_no_analysis_returned_has_no_picture():
    with pytest.raises(InvalidType, match="found must be what an analysis returns, got 3"):
        plots.measured(None, 3)
