import dataclasses
import math
import subprocess
import sys

import numpy as np
import pytest

from stackbounce import errors
from stackbounce.model import LAWS, Ball, Drop, Hysteretic, Rigid, Spring, law_named
from stackbounce.model.catalogue import BALLS, PAIRS, catalogue_ball, stack
from stackbounce.run.collision import separate

BALL = Ball(0.057)
SPRING = Spring(2500.0)


def two(**changes):
    parameters = {"balls": [BALL, BALL], "contacts": [SPRING, SPRING], "impact_speed": 1.0}
    return Drop(**(parameters | changes))


def message(error, make, *arguments, **parameters):
    with pytest.raises(error) as caught:
        make(*arguments, **parameters)
    assert "\n" not in str(caught.value)
    return str(caught.value)


# balls


def test_a_ball_holds_floats():
    ball = Ball(np.float32(1), 2, "B1")
    assert (ball.mass, ball.diameter, ball.name) == (1.0, 2.0, "B1")
    assert type(ball.mass) is type(ball.diameter) is float
    with pytest.raises(dataclasses.FrozenInstanceError):
        ball.mass = 3.0
    assert hash(ball) == hash(Ball(1.0, 2.0, "B1"))


@pytest.mark.parametrize("value", [-0.057, 0, 0.0, math.nan, math.inf, -math.inf])
@pytest.mark.parametrize("field", ["mass", "diameter"])
def test_a_ball_needs_positive_finite_numbers(field, value):
    words = {"mass": "kilograms", "diameter": "metres"}[field]
    got = message(errors.InvalidValue, Ball, **({"mass": 1.0} | {field: value}))
    assert got == f"{field} must be a positive number of {words}, got {value}"


@pytest.mark.parametrize("value", ["150 g", True, [1.0], 1j])
def test_a_mass_is_a_number(value):
    got = message(errors.InvalidType, Ball, mass=value)
    assert got == f"mass must be a positive number of kilograms, got {value!r}"


def test_a_mass_is_needed():
    assert message(errors.InvalidType, Ball, mass=None).endswith("got None")


def test_names():
    assert message(errors.InvalidType, Ball, 1.0, name=3) == "name must be a string, got 3"
    assert message(errors.InvalidValue, Ball, 1.0, name=" ") == "name must not be empty, got ' '"
    got = message(errors.InvalidValue, Ball, 1.0, name="a\ud800")
    assert got == r"name must be text that UTF-8 can write, got 'a\ud800'"


# laws


@pytest.mark.parametrize("value", [-0.1, 1.1, math.nan, math.inf])
def test_restitution_lies_from_0_to_1(value):
    got = message(errors.InvalidValue, Rigid, value)
    assert got == f"restitution must be a number from 0 to 1, got {value}"
    got = message(errors.InvalidValue, Hysteretic, 1.0, restitution=value)
    assert got == f"restitution must be a number above 0 and at most 1, got {value}"


def test_only_a_rigid_contact_may_keep_everything():
    assert Rigid(0).restitution == 0.0
    assert "above 0" in message(errors.InvalidValue, Hysteretic, 1.0, restitution=0)


@pytest.mark.parametrize("value", [0.00141, 1e-200])
def test_a_small_restitution_is_refused_with_the_least_that_is_not(value):
    got = message(errors.InvalidValue, Hysteretic, 1.0, restitution=value)
    assert got == (
        "restitution must be at least 0.00142 for exponent 1, so that unloading_exponent is at "
        f"most 1e+06, got {value}"
    )
    assert Hysteretic(1.0, restitution=0.00142).unloading_exponent < 1e6


def test_restitution_and_unloading_exponent_follow_from_each_other():
    assert Hysteretic(5.6e4, restitution=0.78).unloading_exponent == pytest.approx(
        2.28731, abs=1e-5
    )
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
    assert message(errors.InvalidValue, Hysteretic, 1.0) == right + "neither"
    got = message(errors.InvalidValue, Hysteretic, 1.0, restitution=0.6, unloading_exponent=7)
    assert got == (
        right + "restitution=0.6 and unloading_exponent=7, which disagree: set the other to None"
    )


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
        got = message(errors.InvalidValue, dataclasses.replace, law, **changes)
        assert got.endswith("which disagree: set the other to None")
    new = dataclasses.replace(law, restitution=0.6, unloading_exponent=None)
    assert new == Hysteretic(1.0, exponent=law.exponent, restitution=0.6)


@pytest.mark.parametrize("value", [0.5, -1.0, math.nan, math.inf])
def test_unloading_is_at_least_as_curved_as_loading(value):
    got = message(errors.InvalidValue, Hysteretic, 1.0, unloading_exponent=value)
    assert got == f"unloading_exponent must be a number from 1 to 1e+06, got {value}"


@pytest.mark.parametrize("value", [0.0, -1.0, 0.99, 1e308, math.nan, math.inf])
def test_exponent_is_at_least_1(value):
    got = message(errors.InvalidValue, Hysteretic, 1.0, exponent=value, restitution=0.5)
    assert got == f"exponent must be a number from 1 to 1e+06, got {value}"


def test_laws_by_name():
    assert law_named("Spring") is law_named("spring") is Spring
    got = message(errors.InvalidValue, law_named, "Sprung")
    assert got == (
        f"law must be a contact law, got 'Sprung'; did you mean Spring? Known: {', '.join(LAWS)}"
    )
    assert "got None; known: Rigid" in message(errors.InvalidValue, law_named, None)


# drops


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
        got = message(errors.InvalidValue, two, **(speed | given(value)))
        assert got == f"{right}, got {value}"


@pytest.mark.parametrize(("height", "gravity"), [(1e308, 0.0), (1e-200, 1e-200), (1e200, 1e200)])
def test_a_height_gives_a_speed(height, gravity):
    got = message(errors.InvalidValue, two, impact_speed=None, height=height, gravity=gravity)
    assert got == (
        "height must give an impact speed above 0 and finite at "
        f"{gravity or 9.80665} m/s**2, got {height}"
    )


@pytest.mark.parametrize(
    ("changes", "expected"),
    [
        ({"balls": []}, "balls must hold at least one ball, got none"),
        (
            {"contacts": [SPRING]},
            "contacts must hold one law per ball, the one below it (2), got 1",
        ),
        (
            {"gaps": [0.0, 0.0]},
            "gaps must hold one number per neighbouring pair of balls (1), got 2",
        ),
        (
            {"impact_speed": None, "velocities": [1.0]},
            "velocities must hold one number per ball (2), got 1",
        ),
        (
            {"impact_speed": None, "velocities": [0.0, 0.0]},
            "velocities must not all be 0, got 0 for every ball",
        ),
        (
            {"impact_speed": None},
            "impact_speed, height and velocities: exactly one of the three must be given, got none",
        ),
        (
            {"height": 1.0},
            (
                "impact_speed, height and velocities: exactly one of the three must be given, "
                "got impact_speed and height"
            ),
        ),
        (
            {"contacts": [Rigid(1.0), SPRING]},
            (
                "contacts must be all rigid or have none that is, got a mixture: "
                "contacts.0 is Rigid and contacts.1 is Spring"
            ),
        ),
        (
            {"contacts": [SPRING, None]},
            "contacts.1 must be a contact law, got None (for the floor only)",
        ),
    ],
)
def test_values_of_a_drop(changes, expected):
    assert message(errors.InvalidValue, two, **changes) == expected


@pytest.mark.parametrize(
    ("changes", "expected"),
    [
        (
            {"balls": BALL},
            (
                "balls must be a list, "
                "got Ball(mass=0.057, diameter=None, name=None, young_modulus=..."
            ),
        ),
        ({"balls": "AB"}, "balls must be a list, got 'AB'"),
        ({"balls": [BALL, 0.057]}, "balls.1 must be a Ball, got 0.057"),
        ({"contacts": None}, "contacts must be a list, got None"),
        (
            {"contacts": [SPRING, 2500.0]},
            f"contacts.1 must be a contact law ({', '.join(LAWS)}), got 2500.0",
        ),
        ({"gaps": 0.002}, "gaps must be a list, got 0.002"),
        ({"gaps": {0.002}}, "gaps must be a list, got {0.002}"),
        ({"gaps": ["2 mm"]}, "gaps.0 must be a number of metres, 0 or above, got '2 mm'"),
        ({"impact_speed": "3 m/s"}, "impact_speed must be a positive number of m/s, got '3 m/s'"),
        ({"gravity": None}, "gravity must be a number of m/s**2, 0 or above, got None"),
        ({"gravity": True}, "gravity must be a number of m/s**2, 0 or above, got True"),
    ],
)
def test_types_of_a_drop(changes, expected):
    assert message(errors.InvalidType, two, **changes) == expected


def test_rigid_drops():
    assert two(contacts=[Rigid(1), Rigid(0.5)]).rigid
    assert two(contacts=[None, Rigid(0.5)]).rigid
    assert not two().rigid
    assert not two(contacts=[None, SPRING]).rigid


# what follows from a drop


def test_separate_collisions_keep_everything_else():
    drop = two(
        contacts=[Hysteretic(1.0, restitution=0.78), SPRING],
        gaps=[0.001],
        impact_speed=None,
        height=1.0,
    )
    assert separate(drop) == dataclasses.replace(drop, contacts=[Rigid(0.78), Rigid(1.0)])
    no_floor = two(contacts=[None, SPRING])
    assert separate(no_floor).contacts == (None, Rigid(1.0))
    rigid = separate(drop)
    assert separate(rigid) == rigid


def test_only_a_drop_has_separate_collisions():
    assert message(errors.InvalidType, separate, 3) == "drop must be a Drop, got 3"


def test_separate_collisions_know_no_gravity():
    drop = two(impact_speed=None, height=2.0, gravity=1.0)
    rigid = separate(drop)
    assert rigid.gravity == 0.0
    assert rigid.start_velocities == drop.start_velocities == (-2.0, -2.0)
    drop = two(impact_speed=None, velocities=[0.0, -1.0], gravity=1.0)
    assert separate(drop).start_velocities == (0.0, -1.0)


# the catalogue


def test_the_catalogue_gives_a_source_for_each_figure():
    for entry in BALLS:
        plain = dataclasses.asdict(entry.ball) | dataclasses.asdict(entry)
        given = {
            key
            for key, value in plain.items()
            if value is not None and key not in ("ball", "name", "sources", "kinds", "lossy")
        }
        assert set(dict(entry.sources)) == given
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


def test_names_of_the_catalogue():
    assert catalogue_ball("BASKETBALL") is catalogue_ball("basketball")
    got = message(errors.InvalidValue, catalogue_ball, "tenis")
    assert got == (
        "ball must be one of the catalogue, got 'tenis'; did you mean tennis? "
        "Known: basketball, tennis, B1, B2, B3, big-basketball, football, handball, volleyball, "
        "tennis-ball, ping-pong-ball, golf-ball, superball, marble, steel-ball"
    )
    assert message(errors.InvalidValue, stack, []) == "balls must hold at least one name, got none"


def test_a_fitted_pair_has_its_own_floor_gap_and_spring():
    for pair in PAIRS:
        chosen = stack([pair.lower, pair.upper])
        assert chosen.contacts == (Spring(pair.floor_stiffness), Spring(pair.stiffness))
        assert chosen.gaps == (pair.gap,)
        assert chosen.contact_sources == (pair.source, pair.source)


def test_a_pair_the_other_way_round_has_its_spring_only():
    chosen = stack(["B2", "B1"])
    assert chosen.contacts == (Spring(3.6e4), Spring(1.6e4))
    assert chosen.gaps == (0.0,)


def test_other_neighbours_have_their_springs_in_series():
    chosen = stack(["B1", "B1", "tennis"])
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
