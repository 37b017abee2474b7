"""Balls that do not stand exactly above each other, beside an integration in two dimensions."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import stackbounce as sb
from stackbounce.errors import InvalidType, InvalidValue

ENOUGH = {"rtol": 3e-12, "atol": 1e-16, "method": "DOP853"}


def stack(masses, radii, laws, gaps, speed):
    balls = [sb.Ball(m, diameter=2.0 * r) for m, r in zip(masses, radii, strict=True)]
    return sb.Drop(balls, laws, gaps=gaps, impact_speed=speed)


PAPER = stack([0.15, 0.057], [0.08, 0.033], [sb.Spring(2500.0), sb.Spring(1000.0)], [0.0], 3.53)
SUPERBALLS = stack(
    [0.101, 0.0248], [0.0281, 0.01785], [sb.Hertz(3e6), sb.Hertz(1.5e6)], [1e-3], 1.98
)
THREE = stack(
    [0.1, 0.05, 0.02], [0.03, 0.024, 0.018], [sb.HuntCrossley(1e6, 1.5, 0.2)] * 3, [0.0, 1e-3], 2.4
)


def push(law, c, rate):
    """Return a law's force in N."""
    if c <= 0.0:
        return 0.0
    match law:
        case sb.Spring(k):
            return k * c
        case sb.Dashpot(k, b):
            return max(0.0, k * c + b * rate)
        case sb.Hertz(k):
            return k * c**1.5
        case sb.PowerLaw(k, p):
            return k * c**p
        case sb.Viscoelastic(k, a):
            return max(0.0, k * (c**1.5 + 1.5 * a * math.sqrt(c) * rate))
        case sb.HuntCrossley(k, p, x):
            return max(0.0, k * c**p * (1.0 + x * rate))


def integrated(drop, moved, offset, lowered=0.0):
    """Return offsets, positions and both speeds, with the exact geometry of circles."""
    mass = np.array([ball.mass for ball in drop.balls])
    radius = np.array([0.5 * ball.diameter for ball in drop.balls])
    count = len(mass)
    x, y = np.zeros(count), np.zeros(count)
    x[moved] = offset
    y[0] = radius[0]
    for i in range(1, count):
        apart = radius[i - 1] + radius[i] + drop.gaps[i - 1]
        y[i] = y[i - 1] + apart
    y[moved] -= lowered

    def change(_, state):
        x, y, u, v = state.reshape(4, count)
        ax, ay = np.zeros(count), np.zeros(count)
        ay[0] = push(drop.contacts[0], radius[0] - y[0], -v[0]) / mass[0]
        for i in range(1, count):
            dx, dy = x[i] - x[i - 1], y[i] - y[i - 1]
            apart = math.hypot(dx, dy)
            nx, ny = dx / apart, dy / apart
            rate = -((u[i] - u[i - 1]) * nx + (v[i] - v[i - 1]) * ny)
            force = push(drop.contacts[i], radius[i - 1] + radius[i] - apart, rate)
            for ball, sign in ((i, 1.0), (i - 1, -1.0)):
                ax[ball] += sign * force * nx / mass[ball]
                ay[ball] += sign * force * ny / mass[ball]
        return np.concatenate([u, v, ax, ay])

    start = np.concatenate([x, y, np.zeros(count), np.full(count, -drop.reference_speed)])
    result = sb.simulate(drop, rtol=1e-12)
    for begin, end in zip(moments := kinks(result), moments[1:], strict=False):
        start = solve_ivp(change, (begin, end), start, **ENOUGH).y[:, -1]
    return start.reshape(4, count)


def kinks(result):
    """Return the times in s at which contacts open and close, and one after them."""
    times = [0.0, *result.intervals["start"], *result.intervals["end"], 1.1 * result.end_time]
    return np.unique([time for time in times if time >= 0.0])


@pytest.mark.parametrize(
    ("drop", "moved", "expected"),
    [
        (PAPER, 1, [-69.9173, 183.99291]),
        (PAPER.replace(gaps=[2e-3]), 1, [-70.66755, 185.96722]),
        (SUPERBALLS, 1, [-35.56887, 144.85709]),
        (THREE, 1, [-76.74298, 219.53777, -165.12956]),
        (THREE, 2, [1.2066, -62.86294, 151.12435]),
    ],
)
def test_speeds_per_offset_are_those_of_an_integration_in_two_dimensions(drop, moved, expected):
    # DOP853 at 3e-12 with an offset of 10 micrometres, by others
    found = sb.simulate(drop, rtol=1e-11).sideways()
    assert found.transfer.sel(moved=moved).values == pytest.approx(expected, rel=2e-6)


LAWS = [
    lambda k, _: sb.Spring(0.01 * k),
    lambda k, x: sb.Dashpot(0.01 * k, 8.0 * x),
    lambda k, _: sb.Hertz(k),
    lambda k, x: sb.PowerLaw(k, 1.2 + x),
    lambda k, x: sb.Viscoelastic(k, 1e-3 * x),
    lambda k, x: sb.HuntCrossley(k, 1.0 + x, x),
]


@pytest.mark.fast_cases(3)
@pytest.mark.parametrize(
    "seed", [*range(15), *(pytest.param(seed, marks=pytest.mark.release) for seed in range(15, 50))]
)
def test_random_stacks_of_all_laws(seed):
    random = np.random.default_rng(seed)
    count = 2 + seed % 3
    drop = stack(
        random.uniform(0.02, 0.3, count),
        random.uniform(0.015, 0.1, count),
        [LAWS[(seed + i) % 6](10.0 ** random.uniform(4, 6), random.random()) for i in range(count)],
        random.choice([0.0, 1e-3, 5e-3], count - 1),
        random.uniform(1.0, 4.0),
    )
    moved = int(random.integers(1, count))
    leaving = sb.simulate(drop, rtol=1e-11).sideways()
    assert leaving.attrs["error"] <= 1e-9
    found = leaving.transfer.values[:, moved]
    most = max(abs(found))
    small = 1e-4 / most  # what is left out is of second order
    speeds = integrated(drop, moved, small)[2] / small
    assert found == pytest.approx(speeds, abs=1e-5 * most)


@pytest.mark.parametrize(
    ("drop", "offset", "angle", "first", "loss"),  # as docs/straight.md has them
    [
        (PAPER, 5e-3, 8.27, 8.22, 0.033),
        (PAPER, 0.01, 16.47, 16.12, 0.126),
        (SUPERBALLS, 5e-3, 9.93, 9.80, 0.041),
    ],
)
def test_how_far_first_order_goes_and_what_the_height_loses(drop, offset, angle, first, loss):
    apart = 0.5 * (drop.balls[0].diameter + drop.balls[1].diameter) + drop.gaps[0]
    lowered = apart - math.sqrt(apart**2 - offset**2)  # for the gap to be that of the drop
    _, _, sideways, upward = integrated(drop, 1, offset, lowered)[:, 1]
    assert math.degrees(math.atan2(sideways, upward)) == pytest.approx(angle, abs=0.006)
    result = sb.simulate(drop)
    assert np.degrees(result.sideways({1: offset}).angle[1]) == pytest.approx(first, abs=0.006)
    assert 1.0 - (upward / result.rebound_speeds[1]) ** 2 == pytest.approx(loss, abs=6e-4)


@pytest.mark.parametrize("drop", [PAPER, SUPERBALLS, THREE])
def test_the_floor_pushes_straight_up(drop):
    mass = [ball.mass for ball in drop.balls]
    result = sb.simulate(drop)
    assert mass @ result.sideways().transfer.values == pytest.approx(0.0, abs=1e-9)
    together = dict.fromkeys(range(len(mass)), 1e-3)
    assert result.sideways(together).sideways_speed.values == pytest.approx(0.0, abs=1e-12)
    drifting = result.sideways(speeds=dict.fromkeys(range(len(mass)), 0.1))
    assert drifting.offset.values == pytest.approx(0.1 * result.end_time)


def test_stiff_springs_that_do_not_overlap_in_time_are_rigid():
    rigid = PAPER.replace(contacts=[sb.Rigid(1.0), sb.Rigid(1.0)], gaps=[5e-3])
    stiff = PAPER.replace(contacts=[sb.Spring(1e12), sb.Spring(1e12)], gaps=[5e-3])
    found = [sb.simulate(drop).sideways().transfer.values for drop in (rigid, stiff)]
    assert found[0] == pytest.approx(found[1], rel=1e-4)


@pytest.mark.parametrize("drop", [PAPER, THREE, PAPER.replace(contacts=[sb.Rigid(0.9)] * 2)])
def test_plain_python_gives_the_same_bits(drop, monkeypatch):
    result = sb.simulate(drop)
    found = result.sideways().transfer.values
    monkeypatch.setattr("stackbounce.engine.native.available", lambda: False)
    assert found.tobytes() == result.sideways().transfer.values.tobytes()


def test_a_tennis_ball_1_mm_off_the_middle():
    result = sb.simulate(PAPER)
    found = result.sideways({1: "1 mm"})
    assert np.degrees(found.angle.values[1]) == pytest.approx(1.655, abs=1e-3)
    top = result.rebound_speeds[1] / 9.80665
    assert found.offset_at_top[1] == found.offset[1] + top * found.sideways_speed[1]
    assert found.landing[1] == pytest.approx(float(found.offset[1]) + 2 * top * 0.18399, abs=3e-3)
    assert "remark" not in found.attrs
    assert "first order ends" in result.sideways({1: 0.01}).attrs["remark"]


@pytest.mark.parametrize(
    ("drop", "arguments", "error", "message"),
    [
        (sb.Drop([sb.Ball(1.0)], [sb.Spring(1.0)], impact_speed=1.0), (), InvalidValue, "diameter"),
        (PAPER, ({2: 1e-3},), InvalidValue, "a ball of offsets must be a whole number from 0 to 1"),
        (PAPER, ([1e-3],), InvalidType, "offsets must be a dict"),
        (PAPER, ({1: "1 kg"},), InvalidValue, r"offsets\[1\] must be a length"),
        (PAPER, ({}, {1: math.nan}), InvalidValue, r"speeds\[1\] must be a finite number of m/s"),
    ],
)
def test_what_is_wrong_is_said(drop, arguments, error, message):
    with pytest.raises(error, match=message):
        sb.simulate(drop).sideways(*arguments)
