import dataclasses
import math
import subprocess
import sys

import numpy as np
import pytest

from refusals import refusal
from stackbounce import errors
from stackbounce.model import LAWS, Ball, Drop, Hysteretic, Rigid, Spring, law_named
from stackbounce.model.catalogue import BALLS, PAIRS, catalogue_ball, stacked
from stackbounce.run.collision import separate

BALL = Ball(0.057)
SPRING = Spring(2500.0)


def two(**changes):
    parameters = {"balls": [BALL, BALL], "contacts": [SPRING, SPRING], "impact_speed": 1.0}
    return Drop(**(parameters | changes))


def test_a_ball_holds_floats():
    ball = Ball(np.float32(1), 2, "B1")
    assert (ball.mass, ball.diameter, ball.name) == (1.0, 2.0, "B1")
    assert type(ball.mass) is type(ball.diameter) is float
    with pytest.raises(dataclasses.FrozenInstanceError):
        ball.mass = 3.0
    assert hash(ball) == hash(Ball(1.0, 2.0, "B1"))


def test_names():
    assert refusal(errors.InvalidType, Ball, 1.0, name=3) == "name must be a string, got 3"
    assert refusal(errors.InvalidValue, Ball, 1.0, name=" ") == "name must not be empty, got ' '"
    got = refusal(errors.InvalidValue, Ball, 1.0, name="a\ud800")
    assert got == r"name must be text that UTF-8 can write, got 'a\ud800'"


@pytest.mark.parametrize("value", [-0.057, 0, 0.0, math.nan, math.inf, -math.inf])
@pytest.mark.parametrize("field", ["mass", "diameter"])
def test_a_ball_needs_positive_finite_numbers(field, value):
    words = {"mass": "kilograms", "diameter": "metres"}[field]
    got = refusal(errors.InvalidValue, Ball, **({"mass": 1.0} | {field: value}))
    assert got == f"{field} must be a positive number of {words}, got {value}"


@pytest.mark.parametrize("value", [0.00141, 1e-200])
def test_a_small_restitution_is_refused_with_the_least_that_is_not(value):
    got = refusal(errors.InvalidValue, Hysteretic, 1.0, restitution=value)
    assert got == (
        "restitution must be at least 0.00142 for exponent 1, so that unloading_exponent is at "
        f"most 1e+06, got {value}"
    )
    assert Hysteretic(1.0, restitution=0.00142).unloading_exponent < 1e6


def test_restitution_and_unloading_exponent_follow_from_each_other():
    law = Hysteretic(5.6e4, restitution=0.78)
    assert law.unloading_exponent == pytest.approx(2.28731, abs=1e-5)
    for p in (1.0, 1.5, 3.0):
        for e in (0.01, 0.5, 0.78, 1.0):
            law = Hysteretic(1.0, exponent=p, restitution=e)
            assert law.restitution == e
            assert law.unloading_exponent >= p
            assert e**2 == pytest.approx((p + 1) / (law.unloading_exponent + 1), rel=1e-14)
            back = Hysteretic(1.0, exponent=p, unloading_exponent=law.unloading_exponent)
            assert back.restitution == pytest.approx(e, rel=1e-14)


def test_a_hysteretic_law_needs_exactly_one_of_two():
    right = "restitution and unloading_exponent: exactly one of the two must be given, got "
    assert refusal(errors.InvalidValue, Hysteretic, 1.0) == right + "neither"
    got = refusal(errors.InvalidValue, Hysteretic, 1.0, restitution=0.6, unloading_exponent=7)
    assert got.startswith(right + "restitution=0.6 and unloading_exponent=7, which disagree")


@pytest.mark.parametrize(
    "law",
    [
        Hysteretic(1.0, restitution=0.5),
        Hysteretic(1.0, exponent=1.5, restitution=0.77),
        Hysteretic(1.0, exponent=1.3, unloading_exponent=5.1),
    ],
)
def test_the_rest_of_a_hysteretic_law_can_be_replaced(law):
    new = dataclasses.replace(law, stiffness=2.0)
    assert new.stiffness == 2.0
    assert (new.restitution, new.unloading_exponent) == (law.restitution, law.unloading_exponent)
    assert new.derived == law.derived
    for changes in ({"restitution": 0.6}, {"unloading_exponent": 8}, {"exponent": 2.0}):
        got = refusal(errors.InvalidValue, dataclasses.replace, law, **changes)
        assert got.endswith("which disagree: set the other to None")
    new = dataclasses.replace(law, restitution=0.6, unloading_exponent=None)
    assert new == Hysteretic(1.0, exponent=law.exponent, restitution=0.6)


def test_laws_by_name():
    assert law_named("Spring") is law_named("spring") is Spring
    got = refusal(errors.InvalidValue, law_named, "Sprung")
    assert got.startswith(
        "law must be a contact law, got 'Sprung'; did you mean Spring? Known: Rigid"
    )
    assert "got None; known: Rigid" in refusal(errors.InvalidValue, law_named, None)


def test_names_of_the_catalogue():
    assert catalogue_ball("BASKETBALL") is catalogue_ball("basketball")
    got = refusal(errors.InvalidValue, catalogue_ball, "tenis")
    assert got == (
        "ball must be one of the catalogue, got 'tenis'; did you mean tennis? "
        "Known: basketball, tennis, B1, B2, B3, big-basketball, football, handball, volleyball, "
        "tennis-ball, ping-pong-ball, golf-ball, superball, marble, steel-ball"
    )
    got = refusal(errors.InvalidValue, stacked, [])
    assert got == "balls must hold at least one name, got none"


def test_sequences_become_tuples_and_numbers_floats():
    drop = two(gaps=np.array([0.002]), impact_speed=3)
    assert drop.balls == (BALL, BALL)
    assert drop.contacts == (SPRING, SPRING)
    assert drop.gaps == (0.002,)
    assert type(drop.gaps[0]) is type(drop.impact_speed) is float
    assert hash(drop) == hash(two(gaps=(0.002,), impact_speed=3.0))
    assert two().gaps == (0.0,)
    assert Drop([BALL], [SPRING], impact_speed=1).gaps == ()


def test_ways_to_come_in():
    assert two(impact_speed=3.53).start_velocities == (-3.53, -3.53)
    drop = two(impact_speed=None, height=0.63)
    assert drop.reference_speed == pytest.approx(math.sqrt(2 * 9.80665 * 0.63), rel=1e-15)
    drop = two(impact_speed=None, height=2.0, gravity=1.0)
    assert drop.reference_speed == 2.0
    drop = two(impact_speed=None, velocities=[0, -2.0])
    assert drop.reference_speed == 2.0
    assert drop.start_velocities == (0.0, -2.0)


@pytest.mark.parametrize(
    ("given", "right", "values"),
    [
        (lambda v: {"impact_speed": v}, "impact_speed must be a positive number of m/s", (-1, 0)),
        (lambda v: {"height": v}, "height must be a positive number of metres", (-1, 0)),
        (lambda v: {"gaps": [v]}, "gaps.0 must be a number of metres, 0 or above", (-1,)),
        (lambda v: {"gravity": v}, "gravity must be a number of m/s**2, 0 or above", (-1,)),
        (lambda v: {"velocities": [0.0, v]}, "velocities.1 must be a finite number of m/s", ()),
    ],
)
def test_numbers_of_a_drop_have_ranges(given, right, values):
    for value in (*values, math.nan, math.inf):
        alone = {"height", "velocities"} & set(given(value))
        speed = {"impact_speed": None} if alone else {}
        got = refusal(errors.InvalidValue, two, **(speed | given(value)))
        assert got == f"{right}, got {value}"


@pytest.mark.parametrize(("height", "gravity"), [(1e308, 0.0), (1e-200, 1e-200), (1e200, 1e200)])
def test_a_height_gives_a_speed(height, gravity):
    got = refusal(errors.InvalidValue, two, impact_speed=None, height=height, gravity=gravity)
    near = f"finite at {gravity or 9.80665} m/s**2, got {height}"
    assert got == f"height must give an impact speed above 0 and {near}"


NONE = {"impact_speed": None}
ONE_OF_THREE = "impact_speed, height and velocities: exactly one of the three must be given, got"


@pytest.mark.parametrize(
    ("changes", "expected"),
    [
        ({"balls": []}, "balls must hold at least one ball, got none"),
        ({"contacts": [SPRING]}, "contacts must hold one law per ball, the one below it (2), got"),
        ({"gaps": [0.0, 0.0]}, "gaps must hold one number per neighbouring pair of balls (1), got"),
        ({**NONE, "velocities": [1.0]}, "velocities must hold one number per ball (2), got 1"),
        ({**NONE, "velocities": [0.0, 0.0]}, "velocities must not all be 0, got 0 for every ball"),
        (NONE, f"{ONE_OF_THREE} none"),
        ({"height": 1.0}, f"{ONE_OF_THREE} impact_speed and height"),
        ({"contacts": [Rigid(1.0), SPRING]}, "contacts must be all rigid or have none that is"),
        ({"contacts": [SPRING, None]}, "contacts.1 must be a contact law, got None (for the floor"),
    ],
)
def test_values_of_a_drop(changes, expected):
    assert refusal(errors.InvalidValue, two, **changes).startswith(expected)


@pytest.mark.parametrize(
    ("changes", "expected"),
    [
        ({"balls": "AB"}, "balls must be a list, got 'AB'"),
        ({"balls": [BALL, 0.057]}, "balls.1 must be a Ball, got 0.057"),
        ({"contacts": None}, "contacts must be a list, got None"),
        ({"contacts": [None, 2.0]}, f"contacts.1 must be a contact law ({', '.join(LAWS)}), got"),
        ({"gaps": 0.002}, "gaps must be a list, got 0.002"),
        ({"gaps": "2 mm"}, "gaps must be a list, got '2 mm'"),
        ({"impact_speed": [3.0]}, "impact_speed must be a positive number of m/s, got [3.0]"),
        ({"gravity": True}, "gravity must be a number of m/s**2, 0 or above, got True"),
    ],
)
def test_types_of_a_drop(changes, expected):
    assert refusal(errors.InvalidType, two, **changes).startswith(expected)


def test_separate_collisions_keep_everything_else():
    contacts = [Hysteretic(1.0, restitution=0.78), SPRING]
    drop = two(contacts=contacts, gaps=[0.001], impact_speed=None, height=1.0)
    rigid = separate(drop)
    assert rigid == dataclasses.replace(drop, contacts=[Rigid(0.78), Rigid(1.0)])
    assert separate(rigid) == rigid
    assert separate(two(contacts=[None, SPRING])).contacts == (None, Rigid(1.0))
    assert refusal(errors.InvalidType, separate, 3) == "drop must be a Drop, got 3"


def test_separate_collisions_know_no_gravity():
    drop = two(impact_speed=None, height=2.0, gravity=1.0)
    rigid = separate(drop)
    assert rigid.gravity == 0.0
    assert rigid.start_velocities == drop.start_velocities == (-2.0, -2.0)
    drop = two(impact_speed=None, velocities=[0.0, -1.0], gravity=1.0)
    assert separate(drop).start_velocities == (0.0, -1.0)


def test_the_catalogue_gives_a_source_for_each_figure():
    other = {"ball", "name", "sources", "kinds", "lossy"}
    for entry in BALLS:
        plain = dataclasses.asdict(entry.ball) | dataclasses.asdict(entry)
        given = {key for key, value in plain.items() if value is not None}
        assert set(dict(entry.sources)) == given - other
        assert all(source.startswith("Cross 2007, ") for _, source in entry.sources)


def test_the_catalogue_holds_the_papers_balls():
    figures = {
        entry.ball.name: (entry.ball.mass, entry.ball.diameter, entry.stiffness) for entry in BALLS
    }
    assert figures == {
        "basketball": (0.150, 0.160, 2500.0),
        "tennis": (0.057, 0.066, 22500.0),
        "B1": (0.101, 0.058, 54000.0),
        "B2": (0.0248, 0.038, 36000.0),
        "B3": (0.0085, 0.026, 23000.0),
    }
    assert catalogue_ball("basketball").restitution == pytest.approx(math.sqrt(0.42 / 0.71))
    assert catalogue_ball("tennis").restitution == pytest.approx(math.sqrt(0.40 / 0.71))


@pytest.mark.parametrize("name", ["tennis", "B1", "B2", "B3"])
def test_dynamic_stiffness_agrees_with_the_contact_time(name):
    entry = catalogue_ball(name)
    expected = math.pi**2 * entry.ball.mass / entry.contact_time**2
    assert entry.stiffness == pytest.approx(expected, rel=0.02)


def test_a_fitted_pair_has_its_own_floor_gap_and_spring():
    for pair in PAIRS:
        chosen = stacked([pair.lower, pair.upper])
        assert chosen.contacts == (Spring(pair.floor_stiffness), Spring(pair.stiffness))
        assert chosen.gaps == (pair.gap,)
        assert chosen.contact_sources == (pair.source, pair.source)


def test_a_pair_the_other_way_round_has_its_spring_and_others_have_theirs_in_series():
    chosen = stacked(["B2", "B1"])
    assert chosen.contacts == (Spring(3.6e4), Spring(1.6e4))
    assert chosen.gaps == (0.0,)
    chosen = stacked(["B1", "B1", "tennis"])
    assert chosen.contacts[:2] == (Spring(5.4e4), Spring(2.7e4))
    assert chosen.contacts[2].stiffness == pytest.approx(1 / (1 / 5.4e4 + 1 / 2.25e4))
    assert chosen.contact_sources[1:] == ("B1 and B1 in series", "B1 and tennis in series")
    assert chosen.gap_sources == ("no gap given", "no gap given")


def test_the_model_needs_no_heavy_library():
    code = (
        "import sys\n"
        "import stackbounce.model.catalogue, stackbounce.model.toml\n"
        "heavy = {'pint', 'scipy', 'xarray', 'matplotlib', 'numba', 'pydantic', 'rich', 'typer'}\n"
        "print(sorted(heavy & set(sys.modules)))"
    )
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert run.stdout.strip() == "[]"
