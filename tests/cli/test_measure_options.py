"""`stackbounce measure`: a contact law, heights, points on the ball, the floor of a track."""

import shutil
from functools import partial
from pathlib import Path

import pytest

import stackbounce as sb
from stackbounce.errors import InvalidValue
from stackbounce.measure import analyse, heights, one_law
from stackbounce.measure.kinds.contact.kind import of_numbers
from stackbounce.measure.option_values import read_options
from stackbounce.measure.quantities import quantity_with_error
from stackbounce.measure.setup import Setup
from synthetic.falls import falls
from synthetic.track import track as tracked

LAB = Path(__file__).parents[2] / "docs" / "lab"
SPEED = (2.0 * 9.80665) ** 0.5  # m/s, after 1 m
HEIGHTS = "1.00, 0.64, 0.4096 m"


@pytest.fixture
def run(told, tmp_path):
    for name in ("tennis.wav", "tennis-force.csv"):
        shutil.copy(LAB / name, tmp_path)
    return partial(told, "measure")


def rows(found):
    return {row["name"]: (row["value"], row["error"]) for row in found}


@pytest.mark.parametrize(
    "law", ["Spring", "hertz", "dashpot", "viscoelastic", "hunt-crossley", "hysteretic"]
)
def test_the_law_that_is_saved_has_what_was_measured(run, law):
    files = ["tennis.wav", "tennis-force.csv", "--mass", "57g", "--height", "1m"]
    told = run(*files, "--law", law, "--save", "ball.toml")
    found = rows(told["law"])
    time, error = found["from contact time"]
    assert time == rows(told["files"][1]["found"])["contact time"][0]
    assert found["stiffness"][1] > error  # N/m, and seconds
    drop = sb.Drop.from_toml("ball.toml")
    contact = drop.contacts[0]
    assert type(contact).__name__ == found["law"][0]
    assert contact.stiffness == found["stiffness"][0]
    result = sb.simulate(drop)
    assert float(result.intervals["end"][0]) == pytest.approx(time, rel=1e-6)
    kept = found["from restitution"][0] if "from restitution" in found else 1.0
    assert float(result.rebound_ratios[0]) == pytest.approx(kept, abs=1e-6)


def test_numbers_alone_give_a_law_with_errors(run):
    contact = ["--contact-time", "5.0 ± 0.1 ms", "--restitution", "0.75+/-0.02"]
    told = run(*contact, "--mass", "(57.0±0.5) g", "--law", "hysteretic", "--save", "ball.toml")
    found = rows(told["law"])
    law = sb.calibrate(sb.Hysteretic, mass=0.057, contact_time=5e-3, restitution=0.75)
    assert found["stiffness"][0] == pytest.approx(law.stiffness)
    relative = found["stiffness"][1] / found["stiffness"][0]
    assert relative == pytest.approx(2 * 0.1 / 5.0, rel=0.1)  # the time's error counts twice
    assert sb.Drop.from_toml("ball.toml").contacts == (law,)
    assert rows(told["files"][0]["found"])["dynamic stiffness"][0] == pytest.approx(22503, rel=1e-4)


def test_an_exponent_with_the_law(run):
    given = ("--contact-time", "5ms", "--mass", "57g", "--speed", "2")
    told = run(*given, "--law", "power-law", "--exponent", "1.3")
    law = sb.calibrate(sb.PowerLaw, mass=0.057, contact_time=5e-3, impact_speed=2.0, exponent=1.3)
    assert rows(told["law"])["stiffness"][0] == pytest.approx(law.stiffness)


def test_what_is_known_counts_before_what_was_found(run):
    told = run("tennis.wav", "--restitution", "0.5", "--law", "rigid")
    assert rows(told["law"])["restitution"] == (0.5, 0.0)


@pytest.mark.parametrize("law", ["dashpot", "hunt-crossley"])
def test_a_track_tells_restitution_and_speed(law):
    track = analyse(tracked(falls(1.0, 0.8), noise=1e-4, seed=1))
    found = one_law(law, track, mass=0.06, contact_time=4e-3)
    assert sb.restitution(found.law, 0.06, SPEED) == pytest.approx(0.8, abs=3e-3)
    if law == "hunt-crossley":
        assert found.given["impact_speed"].nominal_value == pytest.approx(SPEED, abs=5e-3)


def test_heights_without_errors_give_a_law_all_the_same():
    assert one_law("rigid", [heights(1.0, 0.64)]).law == sb.Rigid(0.8)


def test_nothing_known_is_no_contact():
    assert of_numbers(Setup(contact_time=5e-3)).parts() == {}


@pytest.mark.parametrize(("mark", "point"), [(",", "."), (";", "."), (";", ",")])
def test_heights_typed_in(run, mark, point):
    given = HEIGHTS.replace(",", mark).replace(".", point)
    found = rows(run("--heights", given, "--height-error", "5mm")["files"][0]["found"])
    assert found["restitution"][0] == pytest.approx(0.8)
    assert found["drop height"] == (1.0, 0.005)
    each = run("--heights", "100 cm, 64 ± 0.5 cm, 409.6 mm", "--height-error", "5mm")
    for name, numbers in rows(each["files"][0]["found"]).items():
        assert numbers == pytest.approx(found[name])


def test_heights_in_a_table(run):
    Path("heights.csv").write_text("height (cm)\n100\n64\n40.96\n", encoding="utf-8")
    options = ["--height-error", "5mm", "--measured-to", "bottom,top", "--diameter", "65 mm"]
    table = run("heights.csv", *options)["files"][0]
    assert table["found"] == run("--heights", HEIGHTS, *options)["files"][0]["found"]
    assert rows(table["found"])["restitution of bounce 0"][0] == pytest.approx(0.575**0.5)


def test_the_drop_height_of_a_sound_may_be_the_top(run):
    options = ["--height", "1.066 m", "--measured-to", "top", "--diameter", "66mm"]
    of_top = rows(run("tennis.wav", *options)["files"][0]["found"])
    of_bottom = rows(run("tennis.wav", "--height", "1 m")["files"][0]["found"])
    assert of_top["restitution of bounce 0"] == pytest.approx(of_bottom["restitution of bounce 0"])


def test_one_bounce_again_and_again(run):
    told = run("--heights", "1, 0.63, 0.65, 0.64 m", "--repeated")["files"][0]
    found = rows(told["found"])
    assert "give --height-error" in told["notes"][0]
    assert (found["restitution"][0], found["restitution 2"][0]) == pytest.approx((0.8, 0.8))


def test_the_floor_of_a_track_of_the_centre_is_a_radius_below():
    law = sb.Spring(0.15 * (3.14159265 / 0.03) ** 2)
    drop = sb.Drop([sb.Ball(0.15, diameter=0.16)], [law], height=0.6, gravity=9.80665)
    data = tracked(sb.simulate(drop, until=0.6), frame_rate=240, noise=2e-4, seed=1)
    (found,) = analyse(data, floor=0.0, measured_to="centre", diameter=0.16)
    true = found.balls[0].drop_height
    assert abs(true.nominal_value - 0.6) < 3.0 * true.std_dev < 3e-3
    (same,) = analyse(data, floor=0.08)
    assert same.balls[0].drop_height.nominal_value == true.nominal_value


@pytest.mark.parametrize(("text", "value", "error"), [
    ("1.00 ± 0.01 m", 1.0, 0.01),
    ("100 cm +/- 5 mm", 1.0, 0.005),
    ("(1e2±1)cm", 1.0, 0.01),
    ("70 cm ± 2", 0.7, 0.02),
    ("70 cm ± 2 mm", 0.7, 0.002),
    ("(70 ± 2) cm", 0.7, 0.02),
    ("(70 cm ± 2)", 0.7, 0.02),
    ("70(2) cm", 0.7, 0.02),
    ("70.0(25) cm", 0.7, 0.025),
    ("70.0(0.5) cm", 0.7, 0.005),
    ("7.0(2)e1 cm", 0.7, 0.02),
    ("0.7 ± 0.02", 0.7, 0.02),
])  # fmt: skip
def test_numbers_with_errors(text, value, error):
    found = quantity_with_error(text, "m", "height")
    assert (found.nominal_value, found.std_dev) == (value, pytest.approx(error))


def test_a_unit_of_the_value_is_that_of_its_error():
    mass = quantity_with_error("57 g ± 5", "kg", "mass")
    share = quantity_with_error("75 % ± 2", "", "restitution")
    assert (mass.std_dev, share.std_dev) == (pytest.approx(0.005), pytest.approx(0.02))
    given = {"heights": "100 ± 1, 62(2), 39 cm ± 0.5"}
    heights = read_options(given, lambda one: one.name)["heights"]
    assert [one.nominal_value for one in heights] == pytest.approx([1.0, 0.62, 0.39])
    assert [one.std_dev for one in heights] == pytest.approx([0.01, 0.02, 0.005])


@pytest.mark.parametrize(
    ("name", "text"),
    [("mass", "-57 ± 1 g"), ("restitution", "1.2"), ("gravity", "0"), ("scale", "-1 mm")],
)
def test_numbers_out_of_range_are_refused_even_if_no_analysis_needs_them(name, text):
    with pytest.raises(InvalidValue, match=f"^--{name} must be a .*number"):
        read_options({"heights": "1, 0.6 m", name: text}, lambda one: one.on_command_line)


@pytest.mark.parametrize("text", ["1, nan m", "1 m, nan m", "1, 0.6, m"])
def test_a_height_that_is_no_number_is_named_as_it_was_typed(text):
    wrong = text.split(", ")[-1]
    with pytest.raises(InvalidValue, match=rf"heights \d must be a length .* got '{wrong}'"):
        read_options({"heights": text}, lambda one: one.name)


@pytest.mark.parametrize(
    "text",
    [
        *("70(2) cm ± 2", "70(2", "70(-2) cm", "70(2)(2) cm", "1 ± m", "± 1 m", "1 ± 2 s"),
        *("1 ± -1 m", "1 ± 1 ± 1 m", "1 ± 0.1) m", "(1 ± 0.1 m", "1) ± (0.1 m", "((1 ± 0.1)) m"),
    ],
)
def test_numbers_with_wrong_errors(text):
    with pytest.raises(sb.StackbounceError, match="height"):
        quantity_with_error(text, "m", "height")
