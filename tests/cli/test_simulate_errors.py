"""``stackbounce simulate`` of numbers with errors."""

import math
from pathlib import Path

import pytest

import stackbounce as sb
from stackbounce.cli.errors_given import split_errors
from stackbounce.prediction import read_scenario

PAIR = ["simulate", "basketball", "tennis", "--height", "63 ± 1 cm", "--gap", "2mm"]


def test_tables_have_errors_and_say_how(printed):
    out = printed(*PAIR, "--error", "balls.1.mass=1g")
    rows = {line.split()[0]: line.split()[1:] for line in out.splitlines() if line.strip()}
    assert rows["tennis"][:2] == ["-3.515(28)", "6.413(53)"]
    assert "Errors by derivatives: 10000 drops within the errors follow them" in out
    assert "Measure height better: it makes 8" in out


def test_times_of_springs_that_do_not_change_have_no_error(printed):
    out = printed("simulate", "basketball", "tennis", "--height", "63 ± 1 cm")
    contacts = out[out.index("Contacts,") :].splitlines()
    (basketball,) = (line.split() for line in contacts if line.startswith("floor"))
    assert basketball[5:7] == ["30.58", "30.58"]
    assert "70.07(56)" in basketball


def test_json_has_the_errors_of_predict(told):
    plain = told(*PAIR[:4], "63 cm", *PAIR[5:])
    found = told(*PAIR)
    errors = found.pop("errors")
    assert found == plain
    assert errors["method"] == "derivatives"
    drop = sb.Drop.from_mapping(found["drop"])
    exact = sb.predict(drop, {"height": (0.63, 0.01)})["rebound_speeds.1"]
    assert errors["values"]["rebound_speeds.1"]["error"] == pytest.approx(exact.std_dev)


def test_an_error_of_a_balls_place(printed, told):
    asked = ("simulate", "basketball", "tennis", "--height", "63 cm", "--offset", "0 ± 1 mm")
    found = told(*asked)["errors"]
    assert found["numbers"] == {"offsets.1": {"value": 0.0, "error": 1e-3}}
    result = sb.simulate(sb.stack("basketball", "tennis", height="63 cm"))
    alone = float(result.sideways({1: 1e-3}).angle[1])
    assert found["values"]["angle.1"] == {"value": 0.0, "error": pytest.approx(alone)}
    out = printed(*asked)
    assert "How the balls leave if each above the lowest lies 0.0(1.0) mm off the middle" in out
    assert f"0.0({math.degrees(alone):.1f})" in out


def test_errors_stand_in_every_option():
    given = {
        "height": None,
        "speed": "3.5(1) m/s",
        "gravity": "9.81 +/- 0.01 m/s^2",
        "gap": ["1mm", "2 mm ± 0.1"],
        "contact": ["Spring stiffness='2.5 ± 0.1 kN/m'", "Spring stiffness=1kN/m"],
    }
    plain, written = split_errors(given)
    assert plain["contact"] == ["Spring 'stiffness=2.5 kN/m'", "Spring stiffness=1kN/m"]
    assert plain["gap"] == ["1mm", "2 mm"]
    assert written == {
        "impact_speed": "3.5(1) m/s",
        "gravity": "9.81 +/- 0.01 m/s^2",
        "gaps.1": "2 mm ± 0.1",
        "contacts.0.stiffness": "2.5±0.1 kN/m",
    }


@pytest.mark.slow
def test_apexes_have_errors_and_a_picture_bands(tmp_path, printed):
    path = tmp_path / "bounce.svg"
    out = printed(*PAIR, "--gravity", "9.81", "--until", "1s", "--plot", str(path))
    assert "Highest points, the first 3 of each ball" in out
    assert path.stat().st_size > 10_000


# --- scenario files whose numbers have errors
BALLS = [sb.Ball(0.15, name="a (1) ± b"), sb.Ball(0.057)]
DROP = sb.Drop(BALLS, [sb.Hertz(2e5), sb.Spring(1000.0)], gaps=[0.002], height=0.63)


@pytest.fixture(autouse=True)
def _files():
    Path("plain.toml").write_text(DROP.to_toml(), encoding="utf-8")
    text = DROP.to_toml()
    for old, new in (
        ("height = 0.63", 'height = "63 ± 1 cm"'),
        ("gaps = [0.002]", 'gaps = ["2.0(5) mm"]'),
        ("mass = 0.057", 'mass = "57 g ± 0.5 g"'),
        ("stiffness = 200000.0", 'stiffness = "200000 ± 10000"'),
    ):
        assert old in text
        text = text.replace(old, new)
    Path("drop.toml").write_text(text, encoding="utf-8")


def test_a_file_has_the_drop_and_its_errors():
    drop, errors = read_scenario("drop.toml")
    assert drop == DROP
    assert errors == {
        "height": "63 ± 1 cm",
        "gaps.0": "2.0(5) mm",
        "balls.1.mass": "57 g ± 0.5 g",
        "contacts.0.stiffness": "200000 ± 10000",
    }
    assert read_scenario("plain.toml") == (DROP, {})


def test_a_drop_has_no_errors():
    with pytest.raises(sb.errors.ScenarioError, match="height must be a length without an error"):
        sb.Drop.from_mapping(DROP.to_mapping() | {"height": "63 ± 1 cm"})


def test_an_option_takes_the_place_of_a_number_and_its_error(told):
    options = ("--speed", "3.5m/s", "--gap", "1 ± 0.1 mm")
    found = told("simulate", "drop.toml", *options)["errors"]["numbers"]
    assert found["balls.1.mass"] == {"value": 0.057, "error": 0.0005}
    assert list(found) == ["balls.1.mass", "contacts.0.stiffness", "gaps.0"]
    assert found["gaps.0"] == {"value": 0.001, "error": pytest.approx(1e-4)}
    assert "errors" not in told("simulate", "plain.toml")
