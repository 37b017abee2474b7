"""Drag in the fall and in the rise: against the equation of motion, many digits, and limits."""

import dataclasses
import math
from functools import partial

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from mpmath import mp, mpf
from scipy.integrate import solve_ivp

import stackbounce as sb
from refusals import refusal
from stackbounce import errors
from stackbounce.model import STANDARD_GRAVITY, drag

G = 9.80665
refused = partial(refusal, (errors.InvalidValue, errors.InvalidType))
BALL = sb.Ball(0.057, 0.066, "tennis")
AIR = sb.Air()
NOTHING = sb.Air(density=0.0)
K = 1.204 * 0.5 * math.pi * 0.066**2 / 8.0 / 0.057  # of the ball: g/k is its terminal speed squared

heights = st.floats(1e-3, 300.0)
speeds = st.floats(1e-3, 100.0)
densities = st.sampled_from([1e-300, 1e-30, 1e-15, 1e-6, 1e-3, 1.0, 30.0])


def moved(start, end=None, time=20.0):
    """Return time, position and speed at an event of the equation of motion, up-positive."""
    options = {"rtol": 1e-12, "atol": 1e-13, "method": "DOP853"}
    found = solve_ivp(
        lambda _, y: [y[1], -G - K * y[1] * abs(y[1])], (0.0, time), start, events=end, **options
    )
    return found.t[-1], found.y[0, -1], found.y[1, -1]


def crossing(of):
    """Return an event that ends the motion."""

    def event(_, y):
        return of(y)

    event.terminal, event.direction = True, -1
    return event


def rate(density):
    """Return k of the ball in air of a density, with the digits of the context."""
    area = mp.pi * mpf(BALL.diameter) ** 2 / 4
    return mpf(density) * mpf("0.5") * area / (2 * mpf(BALL.mass))


@pytest.mark.parametrize("speed", [0.5, 3.53, 5.8, 40.0])
def test_rises_and_flights_obey_the_equation_of_motion(speed):
    time, top, _ = moved([0.0, speed], crossing(lambda y: y[1]))
    flight = AIR.flight(BALL, speed)
    assert AIR.rise(BALL, speed) == flight.height == pytest.approx(top, rel=1e-10)
    assert flight.rise_time == pytest.approx(time, rel=1e-10)
    fall_time, _, landing = moved([top, 0.0], crossing(lambda y: y[0]))
    assert flight.fall_time == pytest.approx(fall_time, rel=1e-9)
    assert flight.landing_speed == pytest.approx(-landing, rel=1e-9)
    assert AIR.launch_speed(BALL, top) == pytest.approx(speed, rel=1e-10)


@given(height=heights, density=densities, up=speeds)
def test_a_small_drag_loses_no_digits(height, density, up):
    air = sb.Air(density=density)
    with mp.workdps(1000):
        k, h, v, g = rate(density), mpf(height), mpf(up), mpf(STANDARD_GRAVITY)
        speed = mp.sqrt(g / k * (1 - mp.exp(-2 * k * h)))
        time = mp.acosh(mp.exp(k * h)) / mp.sqrt(g * k)
        launch = mp.sqrt(g / k * (mp.exp(2 * k * h) - 1)) if k * h < 300 else None
        top = mp.log(1 + k * v * v / g) / (2 * k)
        rise = mp.atan(v * mp.sqrt(k / g)) / mp.sqrt(g * k)
        landing = v / mp.sqrt(1 + k * v * v / g)
    assert air.impact_speed(BALL, height) == pytest.approx(float(speed), rel=1e-14)
    assert air.fall_time(BALL, height) == pytest.approx(float(time), rel=1e-14)
    if launch is not None:
        assert air.launch_speed(BALL, height) == pytest.approx(float(launch), rel=1e-13)
    flight = air.flight(BALL, up)
    assert flight.height == pytest.approx(float(top), rel=1e-14)
    assert flight.rise_time == pytest.approx(float(rise), rel=1e-14)
    assert flight.landing_speed == pytest.approx(float(landing), rel=1e-14)


@given(height=heights)
def test_without_drag_all_is_as_in_free_fall(height):
    for air in (NOTHING, sb.Air(drag_coefficient=0.0)):
        speed = math.sqrt(2.0 * G * height)
        assert air.impact_speed(BALL, height) == speed == air.launch_speed(BALL, height)
        assert air.fall_time(BALL, height) == math.sqrt(2.0 * height / G)
        assert air.rise(BALL, speed) == speed * speed / (2.0 * G)
        flight = air.flight(BALL, speed)
        assert (flight.rise_time, flight.landing_speed) == (speed / G, speed)
        assert air.terminal_speed(BALL) == math.inf


@pytest.mark.parametrize("k", [1e-12, 1e-4, K, 0.126, 3.0])
@pytest.mark.parametrize("speed", [1e-3, 0.5, 3.0, 8.0])
def test_the_speed_of_a_flight_is_that_whose_flight_lasts_its_time(k, speed):
    time = drag.rise_time(k, speed, G) + drag.fall_time(k, drag.risen(k, speed, G), G)
    assert drag.flight_speed(k, time, G) == pytest.approx(speed, rel=1e-14)
    assert drag.landing_speed(k, speed, G) <= speed


def test_the_speed_of_a_flight_grows_with_its_time():
    times = np.geomspace(1e-9, 300.0, 3000)
    found = [drag.flight_speed(0.126, time, G) for time in times.tolist()]
    assert (np.diff(found) > 0.0).all()
    assert found[0] == pytest.approx(0.5 * G * 1e-9, rel=1e-14)
    assert drag.flight_speed(0.126, 0.0, G) == 0.0
    with pytest.raises(OverflowError):
        drag.flight_speed(0.126, 1e4, G)


def test_a_ball_that_is_too_fast_is_followed_nowhere():
    with pytest.raises(OverflowError):
        drag.flown(K, -1.01 * AIR.terminal_speed(BALL), 0.1, G)
    with pytest.raises(OverflowError):
        drag.flown(K, 1.0, -10.0, G)


@pytest.mark.parametrize("start", [3.0, 0.0, -2.0])
@pytest.mark.parametrize("time", [0.4, 1.3, -0.2])
def test_a_ball_is_followed_from_any_speed(start, time):
    way, speed = drag.flown(K, start, time, G)
    assert (way, speed) == pytest.approx(moved([0.0, start], time=time)[1:], rel=1e-9)
    assert drag.flown(K, speed, -time, G) == pytest.approx((-way, start), rel=1e-10, abs=1e-12)
    free = (start * time - 0.5 * G * time**2, start - G * time)
    assert drag.flown(0.0, start, time, G) == pytest.approx(free)


@given(height=heights, density=densities)
def test_the_height_of_a_fall_is_the_inverse_of_its_speed(height, density):
    k = sb.Air(density)._rate(BALL)
    speed = drag.fallen_speed(k, height, G)
    if k * speed * speed / G < 0.9:
        assert drag.fall_height(k, speed, G) == pytest.approx(height, rel=1e-13)
    terminal = math.sqrt(G / k) if k > 1e-300 else math.inf
    assert drag.fall_height(k, 1.001 * terminal, G) == math.inf


def test_the_drag_is_the_weight_at_the_terminal_speed():
    drag = 0.5 * 1.204 * 0.5 * math.pi * 0.033**2 * AIR.terminal_speed(BALL) ** 2
    assert drag == pytest.approx(0.057 * G, rel=1e-14)
    assert AIR.impact_speed(BALL, 1e5) == pytest.approx(AIR.terminal_speed(BALL), rel=1e-14)
    assert AIR.impact_speed(BALL, 0.5, gravity=1.62) < math.sqrt(2.0 * 1.62 * 0.5)


def stack(balls, gaps=None, height=0.7, **more):
    return sb.Drop(balls, [sb.Spring(1e4)] * len(balls), gaps, height=height, **more)


def alone(drop, i, time):
    """Return how far ball i falls alone in a time, and its speed then."""
    ball = drop.balls[i]
    k = 1.204 * 0.5 * math.pi * ball.diameter**2 / 8.0 / ball.mass
    return [-one for one in drag.flown(k, 0.0, time, G)]


def test_balls_with_more_drag_fall_behind():
    heavy, light = sb.Ball(0.1, 0.058), sb.Ball(0.0085, 0.026)
    drop = stack([heavy, light, sb.Ball(0.001, 0.03)], [0.0, 0.002])
    in_air = AIR.dropped(drop)
    time = AIR.fall_time(heavy, 0.7)
    ways = [alone(drop, i, time) for i in range(3)]
    assert ways[0][0] == pytest.approx(0.7, rel=1e-10)
    assert [-v for v in in_air.velocities] == pytest.approx([way[1] for way in ways], rel=1e-10)
    apart = [ways[0][0] - ways[1][0], 0.002 + ways[1][0] - ways[2][0]]
    assert in_air.gaps == pytest.approx(apart, rel=1e-8)
    assert (in_air.height, in_air.contacts, in_air.gravity) == (None, drop.contacts, 0.0)


def test_three_balls_press_on_each_other_as_one():
    """The middle one alone would fall behind; the heavy one above presses it down."""
    light, middle, heavy = sb.Ball(0.02, 0.1), sb.Ball(0.01, 0.1), sb.Ball(1.0, 0.1)
    in_air = AIR.dropped(stack([light, middle, heavy]))
    assert in_air.gaps == (0.0, 0.0)
    assert len(set(in_air.velocities)) == 1
    assert AIR.dropped(stack([light, middle])).gaps[0] > 0.0


def test_a_ball_with_less_drag_stays_on_the_one_below():
    """As one body with the drag of both; a third one, with more drag, falls behind."""
    balls = [sb.Ball(0.150, 0.160), sb.Ball(0.057, 0.066), sb.Ball(0.001, 0.03)]
    in_air = AIR.dropped(stack(balls))
    drags = [0.5 * 1.204 * 0.5 * math.pi * ball.diameter**2 / 4.0 for ball in balls]
    k = (drags[0] + drags[1]) / (balls[0].mass + balls[1].mass)
    together = math.sqrt(G / k * -math.expm1(-2.0 * k * 0.7))
    assert [-v for v in in_air.velocities[:2]] == pytest.approx([together] * 2, rel=1e-14)
    assert in_air.gaps[0] == 0.0
    assert in_air.gaps[1] > 1e-3
    assert -in_air.velocities[2] < together


def test_a_ball_may_come_nearer_and_not_meet():
    balls = [sb.Ball(0.150, 0.160), sb.Ball(0.057, 0.066)]
    wide = AIR.dropped(stack(balls, [0.05]))
    assert 0.04 < wide.gaps[0] < 0.05
    assert -wide.velocities[1] > -wide.velocities[0]
    near = refused(AIR.dropped, stack(balls, [0.002]))
    assert near.startswith("gaps.0 must be 0, or so large that ball 1 ")


@given(height=heights)
def test_a_drop_without_drag_is_the_drop(height):
    drop = stack([BALL, sb.Ball(1.0, 0.1), sb.Ball(0.01, 0.2)], [0.0, 0.001], height=height)
    for gravity in (0.0, 3.7):
        here = dataclasses.replace(drop, gravity=gravity)
        in_air = NOTHING.dropped(here)
        assert in_air.velocities == here.start_velocities
        assert in_air.gaps == here.gaps


def test_heights_of_balls_that_move_down_have_a_minus_sign():
    down, up = AIR.rebound_heights(stack([BALL, BALL]), [-2.0, 3.0])
    assert (down, up) == (-AIR.rise(BALL, 2.0), AIR.rise(BALL, 3.0))


def test_each_ball_may_have_a_coefficient():
    air = sb.Air(drag_coefficient={"tennis": 0.6, "smooth": 0.4})
    other = dataclasses.replace(BALL, name="smooth")
    assert air.impact_speed(BALL, 2.0) == sb.Air(drag_coefficient=0.6).impact_speed(BALL, 2.0)
    assert air.impact_speed(other, 2.0) == sb.Air(drag_coefficient=0.4).impact_speed(BALL, 2.0)


def test_what_is_wrong_is_told():
    assert refused(sb.Air, density=-1).startswith("density must be a number of kg/m**3, 0 or above")
    assert refused(sb.Air, drag_coefficient={"a": "x"}).startswith("drag_coefficient.a must be")
    assert refused(AIR.impact_speed, sb.Ball(1.0), 1.0).startswith(
        "ball.diameter must be given for"
    )
    assert refused(AIR.rise, 3, 1.0) == "ball must be a Ball, got 3"
    assert refused(AIR.rise, BALL, -1.0).startswith("speed must be a number of m/s, 0 or above")
    assert refused(AIR.fall_time, BALL, 0.0).startswith("height must be a positive number of m")
    assert refused(AIR.rise, BALL, 1.0, gravity=0.0).startswith("gravity must be a positive")
    named = sb.Air(drag_coefficient={"tennis": 0.6})
    assert refused(named.rise, sb.Ball(1.0, 0.1, "b"), 1.0) == (
        "ball.name must be one of those in drag_coefficient (tennis), got 'b'"
    )
    thrown = sb.Drop([BALL], [sb.Spring(1.0)], impact_speed=1.0)
    assert refused(AIR.dropped, thrown).startswith("drop must have a height from which it falls")
    assert refused(AIR.dropped, 3) == "drop must be a Drop, got 3"
    assert refused(AIR.rebound_heights, thrown, [1.0, 2.0]).startswith("speeds must hold one num")
    assert refused(AIR.rebound_heights, thrown, [math.nan]).startswith("speeds.0 must be a")
    assert refused(AIR.dropped, stack([BALL, sb.Ball(1.0)])).startswith("balls.1.diameter must")
    launched = refused(sb.Air(density=1e3).launch_speed, sb.Ball(1e-3, 0.1), 10.0)
    assert launched.startswith("height must be one that a ball can")
    flown = refused(AIR.flight, sb.Ball(1.0, 0.1), 1e200)
    assert flown.startswith("speed must give a flight in the range")
    assert "names of balls as keys, got 1" in refused(sb.Air, drag_coefficient={1: 0.5})


def test_parts_of_one_body_do_not_part_in_the_fall():
    laws = [sb.Spring(1.0), sb.Bond(1.0)]
    drop = sb.Drop([sb.Ball(1.0, 0.1), sb.Ball(1e-3, 0.2)], laws, height=1.0)
    with pytest.raises(errors.InvalidValue, match=r"contacts\.1 must not be a Bond"):
        sb.Air().dropped(drop)
