"""``stackbounce simulate`` of numbers with errors."""

import pytest

import stackbounce as sb
from stackbounce.cli.errors_given import split_errors

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
