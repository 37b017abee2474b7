"""Curves of pieces, of hollow balls and tables: closed forms, another integration, limits."""

import math

import numpy as np
import pytest

import stackbounce as sb
from reference import pieces
from stackbounce.model.laws.tabulated import monotone_spline

CLOSE = 1e-9
TABLE = [0.0, 0.01, 0.03, 0.06, 0.1], [0.0, 0.5, 2.5, 4.0, 9.0], [0.0, 0.0, 0.7, 2.0, 9.0]


def one_ball(law, speed, mass=1.0):
    return sb.simulate(sb.Drop([sb.Ball(mass)], [law], impact_speed=speed))


def two_stages(law):
    """Return the reference of a hollow ball."""
    k, knee, ratio = law.stiffness, law.buckling_compression, law.stiffness_ratio

    def force(c):
        return k * c if c <= knee else k * (knee + ratio * (c - knee))

    return pieces.Contact(force, [knee], law.restitution**2)


def by_points(law):
    """Return the reference of a table, whose curves are the law's own splines."""
    loading = monotone_spline(law.compression, law.force)
    back = None
    if law.unloading is not None:
        x = [one / law.compression[-1] for one in law.compression]
        y = [one / law.force[-1] for one in law.unloading]
        unloading = monotone_spline(x, y)
        back = (lambda c: at(unloading, c)), [one[0] for one in unloading[1:-1]]
    share = law.engine_numbers()[2]
    return pieces.Contact(lambda c: at(loading, c), [one[0] for one in loading[1:]], share, back)


def at(spline, x):
    begin, a, b, s = next(one for one in reversed(spline) if one[0] <= x)
    return a + (x - begin) * (b + (x - begin) * s)


def reference_of(law):
    return two_stages(law) if isinstance(law, sb.HollowBall) else by_points(law)


@pytest.mark.parametrize("e", [0.05, 0.3, 0.75, 0.999, 1.0])
@pytest.mark.parametrize("ratio", [0.01, 0.3, 1.0])
@pytest.mark.parametrize("speed", [0.1, 1.0, 10.0])
def test_a_hollow_ball_returns_its_share(e, ratio, speed):
    result = one_ball(sb.HollowBall(100.0, 0.05, ratio, e), speed)
    assert result.status is sb.Status.FINISHED
    assert result.collisions.tolist() == [1]
    assert result.rebound_ratios[0] == pytest.approx(e, rel=1e-11)


@pytest.mark.parametrize("ratio", [0.01, 0.3, 0.9])
@pytest.mark.parametrize("speed", [0.6, 1.0, 10.0])
def test_a_hollow_ball_without_loss_in_closed_form(ratio, speed):
    """Twice: a sine to the knee, then one about the point where the soft line has no force."""
    knee, omega = 0.05, 10.0
    first = math.asin(knee * omega / speed) / omega
    left = math.sqrt(speed**2 - (knee * omega) ** 2)
    slow = omega * math.sqrt(ratio)
    ahead = math.atan(left * ratio / (slow * knee)) / slow
    result = one_ball(sb.HollowBall(100.0, knee, ratio, 1.0), speed)
    assert result.last_release[0] == pytest.approx(2.0 * (first + ahead), rel=1e-12)
    (interval,) = result.intervals
    force = math.sqrt((100.0 * knee) ** 2 + ratio * 100.0 * left**2)
    assert interval["peak_force"] == pytest.approx(force, rel=1e-12)
    assert interval["peak_time"] == pytest.approx(first + ahead, rel=1e-7)
    assert interval["impulse"] == pytest.approx(2.0 * speed, rel=1e-12)


@pytest.mark.parametrize("e", [0.2, 0.5, 0.9])
def test_a_ball_that_does_not_buckle_is_a_hysteretic_one(e):
    stack = [sb.Ball(1.0), sb.Ball(0.4)]
    both = [
        sb.simulate(sb.Drop(stack, [law, law], impact_speed=1.0))
        for law in (
            sb.HollowBall(100.0, 0.05, 1.0, e),
            sb.HollowBall(100.0, 50.0, 0.1, e),
            sb.Hysteretic(100.0, restitution=e),
        )
    ]
    for result in both[:2]:
        assert result.rebound_ratios == pytest.approx(both[2].rebound_ratios, abs=1e-10)
        assert result.last_release == pytest.approx(both[2].last_release, rel=1e-9)


def test_a_table_of_a_straight_line_is_a_spring():
    table = sb.Tabulated([0.0, 0.1, 0.2, 0.5], [0.0, 10.0, 20.0, 50.0])
    result = one_ball(table, 3.0)  # to 0.3 m, over two knots
    spring = one_ball(sb.Spring(100.0), 3.0)
    assert result.rebound_ratios == pytest.approx(spring.rebound_ratios, rel=1e-14)
    assert result.last_release == pytest.approx(spring.last_release, rel=1e-13)


@pytest.mark.parametrize("speed", [0.05, 0.3, 0.8, 3.0])
@pytest.mark.parametrize("loss", ["none", "unloading", "restitution"])
def test_one_ball_on_a_table_against_quadrature(speed, loss):
    x, y, back = TABLE
    own = {"none": {}, "unloading": {"unloading": back}, "restitution": {"restitution": 0.6}}[loss]
    law = sb.Tabulated(x, y, **own)
    speeds, intervals = pieces.integrate([1.0], [reference_of(law)], [], [-speed])
    result = one_ball(law, speed)
    assert result.rebound_speeds == pytest.approx(speeds, abs=CLOSE * speed)
    assert result.last_release[0] == pytest.approx(intervals[0][0][1], rel=CLOSE)
    if loss == "restitution":
        assert result.rebound_ratios[0] == pytest.approx(0.6, rel=1e-11)
    assert law.restitution_at(1.0, speed) == pytest.approx(result.rebound_ratios[0], rel=1e-12)
    assert law.contact_time_at(1.0, speed) == pytest.approx(result.last_release[0], rel=1e-12)


def random_stack(seed):
    """Return a stack of two or three balls with gaps, on hollow balls and tables."""
    rng = np.random.default_rng(seed)
    count = int(rng.integers(2, 4))
    laws = []
    for _ in range(count):
        k = 10.0 ** rng.uniform(1.0, 3.0)
        if rng.random() < 0.5:
            knee = 10.0 ** rng.uniform(-2.5, -1.0)
            laws.append(sb.HollowBall(k, knee, rng.uniform(0.05, 1.0), rng.uniform(0.3, 1.0)))
            continue
        points = int(rng.integers(3, 6))
        x = np.concatenate([[0.0], np.cumsum(rng.uniform(0.2, 1.0, points))]) * 0.1
        y = np.concatenate([[0.0], np.cumsum(rng.uniform(0.1, 1.0, points))]) * 0.1 * k
        kind = rng.integers(3)
        back = y * np.linspace(rng.uniform(0.2, 0.9), 1.0, points + 1)
        own = [{}, {"unloading": back}, {"restitution": rng.uniform(0.3, 1.0)}][kind]
        laws.append(sb.Tabulated(x, y, **own))
    gaps = rng.choice([0.0, 0.01, 0.2], count - 1)
    return sb.Drop([sb.Ball(m) for m in rng.uniform(0.2, 2.0, count)], laws, gaps, impact_speed=1.0)


@pytest.mark.parametrize(
    "seed", [*range(8), *(pytest.param(seed, marks=pytest.mark.slow) for seed in range(8, 30))]
)
def test_stacks_against_another_integration(seed):
    drop = random_stack(seed)
    masses = [ball.mass for ball in drop.balls]
    contacts = [reference_of(law) for law in drop.contacts]
    speeds, intervals = pieces.integrate(masses, contacts, drop.gaps, drop.start_velocities)
    result = sb.simulate(drop)
    assert result.status is sb.Status.FINISHED
    assert result.collisions.tolist() == [len(one) for one in intervals]
    assert result.rebound_speeds == pytest.approx(speeds, abs=1e-8)
    for found, ends in zip(result.last_release, intervals, strict=True):
        assert not ends or found == pytest.approx(ends[-1][1], rel=1e-7)


SOFTENING = sb.Tabulated(
    [0.0, 1e-3, 2e-3, 3e-3], [0.0, 76.0, 96.0, 99.5], unloading=[0.0, 40.0, 90.0, 99.5]
)


@pytest.mark.parametrize("speed", [1e-3, 0.1, 0.5, 1.0, 2.0, 3.0, 30.0])
@pytest.mark.parametrize(
    "law",
    [SOFTENING, sb.Tabulated([0.0, 1e-3, 2e-3], [0.0, 100.0, 101.0], unloading=[0.0, 99.0, 101.0])],
)
def test_a_table_never_returns_more_than_it_took(law, speed):
    """Where its unloading curve would lie above its loading curve, it returns the same share."""
    result = one_ball(law, speed, 0.05)
    assert result.status is sb.Status.FINISHED
    assert result.rebound_ratios[0] <= 1.0
    energy = result.sample(np.linspace(0.0, result.end_time, 300)).energy.values
    assert energy.max() <= energy[0] * (1.0 + 1e-10)


@pytest.mark.parametrize("width", [1.5e-3, 1e-2, 0.1])
def test_a_steep_table_without_loss_keeps_its_energy(width):
    law = sb.Tabulated([0.0, 1e-3, 1e-3 * (1.0 + width), 1.5e-3], [0.0, 30.0, 70.0, 71.0])
    result = one_ball(law, 1.2, 0.05)
    energy = result.sample(np.linspace(0.0, result.end_time, 500)).energy.values
    assert energy == pytest.approx(np.full(500, energy[0]), rel=1e-10)


def test_plain_python_gives_the_same_bits():
    for seed in range(6):
        drop = random_stack(seed)
        one, two = (sb.simulate(drop, compiled=compiled) for compiled in (None, False))
        assert one.rebound_speeds.tolist() == two.rebound_speeds.tolist()
        assert one.log == two.log


def test_a_sweep_has_the_same_numbers():
    """Over a hollow ball's constants, and over a mass beside a table."""
    hollow = sb.HollowBall(100.0, 0.05, 0.3, 0.8)
    table = sb.Tabulated(*TABLE[:2], unloading=TABLE[2])
    drop = sb.Drop([sb.Ball(1.0), sb.Ball(0.3)], [table, hollow], impact_speed=1.0)
    axes = {"contacts.1.restitution": [0.5, 0.8], "balls.1.mass": [0.2, 0.3]}
    swept = sb.sweep(drop, axes)
    result = sb.simulate(drop)
    assert swept.rebound_ratio.values[1, 1].tolist() == result.rebound_ratios.tolist()
    assert len(np.unique(swept.rebound_ratio.values)) == 8


@pytest.mark.parametrize(
    "law",
    [
        sb.HollowBall(1e4, 1e-3, 0.3, 0.7),
        sb.HollowBall(1e4, 1e-3, 0.3, 1.0),
        sb.Tabulated([0.0, 1e-3, 1e-2], [0.0, 10.0, 60.0], unloading=[0.0, 4.0, 60.0]),
    ],
)
def test_energy_is_kept_or_lost_but_never_made(law):
    drop = sb.Drop([sb.Ball(0.3), sb.Ball(0.1)], [law, law], impact_speed=2.0, gaps=[1e-3])
    result = sb.simulate(drop)
    sampled = result.sample(np.linspace(0.0, 1.2 * np.nanmax(result.last_release), 400))
    whole = sampled.energy.values
    start = 0.5 * 0.4 * 4.0
    falls = np.diff(whole) / start
    assert falls.max() < 1e-10
    lossless = getattr(law, "restitution", None) == 1.0
    assert (whole[-1] == pytest.approx(start, rel=1e-11)) == lossless


@pytest.mark.parametrize("restitution", [0.6, 1.0])
def test_a_ball_comes_to_rest_or_is_stopped(restitution):
    law = sb.HollowBall(1e4, 1e-3, 0.3, restitution)
    drop = sb.Drop([sb.Ball(0.1)], [law], height=0.05, gravity=9.81)
    result = sb.simulate(drop, until=20.0)
    if restitution < 1.0:
        assert result.status in (sb.Status.SETTLED, sb.Status.TIME_REACHED)
        assert abs(result.rebound_speeds[0]) < 1e-3
    else:
        assert result.status is sb.Status.TIME_REACHED
        assert result.energy_retained <= 1.0 + 1e-9
