"""One ball that bounces on and on in air: against an integrator, and without air as `simulate`."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import stackbounce as sb
from measure.falls_in_air import falls_in_air
from stackbounce.errors import InvalidType, InvalidValue

G = 9.80665
BALL = sb.Ball(0.057, 0.066)
LIGHT = sb.Ball(0.0027, 0.040)
NOTHING = sb.Air(density=0.0)
LOSSY = [
    sb.Dashpot(22e3, 5.0),
    sb.HuntCrossley(5e5, 1.5, 0.1),
    sb.Viscoelastic(5e5, 1e-4),
    sb.Hysteretic(22e3, restitution=0.75),
]
OTHERS = [*LOSSY, sb.Spring(22e3), sb.Hertz(5e5), sb.StandardLinearSolid(22e3, 0.5, 1e-3)]
RIGID = [sb.Rigid(0.8), sb.RigidBySpeed(0.8, 3.0), sb.RigidLossBySpeed(0.8, 3.0)]


def drop(law, ball=BALL, **how):
    fallen = {} if {"impact_speed", "velocities"} & set(how) else {"height": 1.0}
    return sb.Drop([ball], [law], **(fallen | how))


def gravity_run(law, count):
    """Return the touches, the tops and the contacts of `simulate`'s own run with gravity."""
    result = sb.simulate(drop(law, gravity=G), until=8.0)
    events = result.events
    touches = events["time"][events["kind"] != "release"][:count]
    lasting = (result.intervals["end"] - result.intervals["start"])[:count]
    return touches, result.apexes[:count], lasting


@pytest.mark.parametrize("law", [*RIGID, *OTHERS])
def test_bounces_without_air_are_those_of_a_run_with_gravity(law):
    found = sb.bounces_in_air(drop(law, gravity=G), 6, NOTHING)
    touches, tops, lasting = gravity_run(law, 6)
    assert found["time"] == pytest.approx(touches, rel=1e-10)
    assert found["height"] == pytest.approx(tops["height"], rel=1e-10)
    assert found["apex_time"] == pytest.approx(tops["time"], rel=1e-10)
    assert found["contact_time"] == pytest.approx(lasting, rel=1e-9)


def test_the_end_of_a_run_with_gravity_is_the_last_bounce():
    """A dashpot that is too slow does not let go, and the ball lies still."""
    law = sb.Dashpot(22e3, 20.0)
    found = sb.bounces_in_air(drop(law, gravity=G), 10_000, NOTHING)
    run = sb.simulate(drop(law, gravity=G), until=60.0)
    assert run.status is sb.Status.SETTLED
    assert len(found) == len(run.intervals) > 3
    assert found["time"] == pytest.approx(run.intervals["start"], rel=1e-9)
    assert (found["height"][-1], found["contact_time"][-1]) == (0.0, math.inf)
    assert found["height"][-2] > 0.0


def test_a_spring_without_gravity_is_left_earlier_and_as_fast():
    law = sb.Spring(22e3)
    found, weighed = (sb.bounces_in_air(drop(law, gravity=g), 4, NOTHING) for g in (0.0, G))
    w, speed = math.sqrt(22e3 / 0.057), math.sqrt(2.0 * G)
    shorter = 2.0 * math.atan(G / (w * speed)) / w
    assert found["height"] == pytest.approx(weighed["height"], rel=1e-12)
    assert found["contact_time"] == pytest.approx(weighed["contact_time"] - shorter, rel=1e-10)
    assert found["time"] == pytest.approx(weighed["time"] - shorter * np.arange(4), rel=1e-12)


@pytest.mark.parametrize("law", [sb.Rigid(0.9), sb.HuntCrossley(3e5, 1.5, 0.1)])
def test_bounces_in_air_are_those_of_an_integration(law):
    """Flights step by step, and contacts as the law's closed forms or calibration tell them."""
    found = sb.bounces_in_air(drop(law, LIGHT), 6, sb.Air(drag_coefficient=0.45))
    fall = falls_in_air(
        1.0,
        lambda speed: sb.restitution(law, LIGHT.mass, speed),
        lasts=lambda speed: 0.0 if law.rigid else sb.contact_time(law, LIGHT.mass, speed),
        bounces=6,
    )
    assert found["time"] == pytest.approx(fall.touches - fall.touches[0], rel=1e-9, abs=1e-15)
    assert found["impact_speed"] == pytest.approx(fall.speeds, rel=1e-9)
    assert found["rebound_speed"] == pytest.approx(fall.rebounds, rel=1e-9)
    assert found["contact_time"] == pytest.approx(fall.releases - fall.touches, rel=1e-9)
    assert found["height"] == pytest.approx(fall.apexes, rel=1e-9)
    before, after = found["apex_time"][:-1], found["time"][1:]
    assert (found["time"][:-1] < before).all()
    assert (before < after).all()


@given(
    restitution=st.floats(0.1, 1.0),
    speed=st.floats(1e-3, 30.0),
    density=st.sampled_from([0.0, 1e-6, 1.2, 50.0]),
)
def test_air_takes_and_never_gives(restitution, speed, density):
    law, air = sb.Rigid(restitution), sb.Air(density)
    found = sb.bounces_in_air(drop(law, LIGHT, impact_speed=speed), 5, air)
    free = sb.bounces_in_air(drop(law, LIGHT, impact_speed=speed), 5, NOTHING)
    assert found["rebound_speed"] == pytest.approx(restitution * found["impact_speed"], rel=1e-14)
    for name in ("time", "impact_speed", "height", "apex_time"):
        assert (found[name] <= free[name] * (1.0 + 1e-12)).all()
    assert (found["impact_speed"][1:] <= found["rebound_speed"][:-1] * (1.0 + 1e-15)).all()


def test_a_drop_from_a_height_and_one_at_its_impact_speed_in_air_are_one():
    law = sb.HuntCrossley(3e5, 1.5, 0.1)
    high = drop(law, LIGHT, height=0.7)
    fast = drop(law, LIGHT, impact_speed=sb.Air().impact_speed(LIGHT, 0.7))
    thrown = drop(law, LIGHT, velocities=[-sb.Air().impact_speed(LIGHT, 0.7)])
    for other in (fast, thrown):
        assert sb.bounces_in_air(high, 3).tolist() == sb.bounces_in_air(other, 3).tolist()


def test_a_ball_that_stays_on_the_floor_has_no_further_bounce():
    for law in (sb.Rigid(0.0), sb.Dashpot(22e3, 500.0)):
        (found,) = sb.bounces_in_air(drop(law), 5)
        assert found["height"] == 0.0
        assert found["apex_time"] == found["contact_time"]


def test_a_scatter_is_drawn_anew_at_each_bounce():
    law = sb.RigidBySpeed(0.7, 1.0, 0.0, scatter=0.05, seed=4294967200.0)
    found = sb.bounces_in_air(drop(law, impact_speed=3.0), 200)
    kept = found["rebound_speed"] / found["impact_speed"]
    assert len(set(kept)) == 200
    assert kept.mean() == pytest.approx(0.7, abs=0.015)
    assert kept.std() == pytest.approx(0.05, rel=0.2)
    assert abs(np.corrcoef(kept[1:], kept[:-1])[0, 1]) < 0.2
    assert found.tolist() == sb.bounces_in_air(drop(law, impact_speed=3.0), 200).tolist()


@pytest.mark.parametrize(
    ("given", "error", "words"),
    [
        ((3, 1), InvalidType, "drop must be a Drop, got 3"),
        ((drop(RIGID[0]), 0), InvalidValue, "count must be"),
        ((drop(RIGID[0]), 1.5), InvalidType, "count must be"),
        ((drop(RIGID[0]), 1, 1.2), InvalidType, "air must be an Air, got 1.2"),
        ((drop(RIGID[0], velocities=[1.0]), 1), InvalidValue, "velocities.0 must be downward"),
        ((drop(None, impact_speed=1.0), 1), InvalidValue, "a floor that lets go, got none"),
        ((drop(sb.Bond(1e3), impact_speed=1.0), 1), InvalidValue, "that lets go, got a Bond"),
        ((drop(RIGID[0], sb.Ball(1.0)), 1), InvalidValue, "diameter must be given"),
        (
            (sb.Drop([BALL] * 2, [sb.Rigid(0.8)] * 2, impact_speed=1.0), 1),
            InvalidValue,
            "drop must be of one ball, got 2",
        ),
        (
            (drop(sb.Spring(1e300), impact_speed=1e-300), 1),
            InvalidValue,
            "drop must have impacts that can be computed, got INVALID",
        ),
    ],
)
def test_what_cannot_bounce_is_refused(given, error, words):
    with pytest.raises(error, match=words):
        sb.bounces_in_air(*given)
