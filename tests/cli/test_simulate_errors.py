"""``stackbounce simulate`` of numbers with errors."""

import json

import pytest

import stackbounce as sb
from stackbounce.cli.errors_given import split_errors

PAIR = ["simulate", "basketball", "tennis", "--height", "63 ± 1 cm", "--gap", "2mm"]


@pytest.fixture
def said(run):
    return lambda *arguments: run(*arguments)[1]


def test_tables_have_errors_and_say_how(said):
    out = said(*PAIR, "--error", "balls.1.mass=1g")
    rows = {line.split()[0]: line.split()[1:] for line in out.splitlines() if line.strip()}
    assert rows["tennis"][:2] == ["-3.515(28)", "6.413(53)"]
    assert "Errors by derivatives: 10000 drops within the errors follow them" in out
    assert "Measure height better: it makes 8" in out


def test_times_of_springs_that_do_not_change_have_no_error(said):
    out = said("simulate", "basketball", "tennis", "--height", "63 ± 1 cm")
    contacts = out[out.index("Contacts,") :].splitlines()
    (basketball,) = (line.split() for line in contacts if line.startswith("floor"))
    assert basketball[5:7] == ["30.58", "30.58"]
    assert "70.07(56)" in basketball


def test_json_has_the_errors_of_predict(said):
    plain = json.loads(said(*PAIR[:4], "63 cm", *PAIR[5:], "--json"))
    found = json.loads(said(*PAIR, "--json"))
    errors = found.pop("errors")
    assert found == plain
    assert errors["method"] == "derivatives"
    drop = sb.Drop.from_mapping(found["drop"])
    exact = sb.predict(drop, {"height": (0.63, 0.01)})["rebound_speeds.1"]
    assert errors["values"]["rebound_speeds.1"]["error"] == pytest.approx(exact.std_dev)


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
def test_apexes_have_errors_and_a_picture_bands(tmp_path, said):
    path = tmp_path / "bounce.svg"
    out = said(*PAIR, "--gravity", "9.81", "--until", "1s", "--plot", str(path))
    assert "Highest points, the first 3 of each ball" in out
    assert path.stat().st_size > 10_000


def test_a_number_that_the_drop_does_not_give_has_no_error(tmp_path, refused):
    path = tmp_path / "drop.toml"
    path.write_text(sb.Drop([sb.Ball(0.1)], [sb.Spring(1e4)], height=0.6).to_toml(), "utf-8")
    err = refused("simulate", str(path), "--error", "balls.0.diameter=1mm")
    assert err.endswith("balls.0.diameter needs balls.0.diameter, which the drop does not give\n")
