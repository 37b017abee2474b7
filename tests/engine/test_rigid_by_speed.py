"""Rigid collisions whose restitution depends on the speed, against many digits."""

from fractions import Fraction
from random import Random

import numpy as np
import pytest
from scipy import stats

import stackbounce as sb
from drops import assert_collisions, fallen, precise
from reference import restitution, rigid

G = 9.81


def random_law(random):
    """Return one of the three rigid laws."""
    e, speed = random.uniform(0.3, 1.0), 10.0 ** random.uniform(-2.0, 1.0)
    kind = random.choice([sb.Rigid, sb.RigidBySpeed, sb.RigidLossBySpeed])
    if kind is sb.Rigid:
        return kind(e)
    exponent, scatter = random.choice([0.1, 0.2, 0.25, 0.43, 1]), random.choice([0.0, 0.0, 0.1])
    return kind(e, speed, exponent, scatter=scatter, seed=random.randint(0, 9))


def random_drop(random, **more):
    """Return a stack of two to five balls, of which at most every third contact is a plain one."""
    size = random.randint(2, 5)
    laws = [random_law(random) for _ in range(size)]
    return sb.Drop(
        [sb.Ball(10.0 ** random.uniform(-1.0, 1.0)) for _ in range(size)],
        [None, *laws[1:]] if random.random() < 0.2 else laws,
        [random.choice([0.0, random.uniform(0.0, 0.1)]) for _ in range(size - 1)],
        velocities=[random.uniform(-3.0, 1.0) for _ in range(size)],
        **more,
    )


def test_random_stacks():
    random, compared = Random(5), 0
    for _ in range(120):
        drop = random_drop(random)
        result = sb.simulate(drop, event_limit=400)
        if result.status is not sb.Status.FINISHED or result.conditioning.max() > 1e2:
            continue  # plain contacts can collapse, and errors can grow beyond the digits compared
        expected = precise(drop)
        if expected.finished:
            assert_collisions(result, expected)
            compared += 1
    assert compared > 70


def test_random_stacks_under_gravity():
    random, compared = Random(6), 0
    while compared < 25:
        drop = random_drop(random, gravity=G)
        until = random.uniform(0.05, 0.4)
        result = sb.simulate(drop, until=until, event_limit=150)
        stopped = result.status is sb.Status.TIME_REACHED
        if not stopped or -1 in result.collisions or result.conditioning.max() > 1e2:
            continue
        expected, _ = fallen(drop, until)
        assert_collisions(result, expected)
        compared += len(expected.collisions) > 2


@pytest.mark.parametrize("masses", [(1.0, 0.5), (1.0, 3.0), (1.0, 5.0)])
def test_a_loss_in_proportion_to_the_speed_exactly(masses):
    """1 - e = v/4: all numbers are fractions."""
    law = sb.RigidLossBySpeed(0.5, speed=2.0, speed_exponent=1.0)
    drop = sb.Drop([sb.Ball(m) for m in masses], [law, law], impact_speed=1.5)
    fourth = [lambda v: max(Fraction(0), 1 - v / 4)] * 2
    start = [Fraction(v) for v in drop.start_velocities]
    expected = rigid.run([Fraction(m) for m in masses], fourth, [Fraction(0)], start, 12)
    assert expected.finished
    assert_collisions(sb.simulate(drop), expected)


def bounce(law, until=1e3, **more):
    """Return a ball that falls from 1 m and bounces."""
    return sb.simulate(sb.Drop([sb.Ball(0.6)], [law], height=1.0, gravity=G), until=until, **more)


@pytest.mark.parametrize("p", [0.05, 0.2, 0.43, 0.6])
def test_one_ball_comes_to_rest(p):
    """Its bounces last sum(2 u/g), u being u (1 - k u^p) next, between bounds by an integral.

    From a bounce at u on the sum of u is at most the integral of 1/(k u^p), u^(1-p)/((1-p) k), and
    at least (1 - k u^p)^p times that.
    """
    k = 0.2 / 3.0**p
    result = bounce(sb.RigidLossBySpeed(0.8, 3.0, p))
    assert result.status is sb.Status.SETTLED
    assert result.collisions.tolist() == [-1]
    assert result.rebound_speeds.tolist() == [0.0]
    u = (2.0 * G) ** 0.5
    speeds = [u := u * (1.0 - k * u**p) for _ in range(400_000)]
    rest = speeds[-1] ** (1.0 - p) / ((1.0 - p) * k)
    done = float(np.sum(speeds[:-1]))
    most = 2.0 / G * (done + rest)
    least = 2.0 / G * (done + rest * (1.0 - k * speeds[-1] ** p) ** p)
    assert most - least <= 1e-8 * most
    assert least * (1.0 - 1e-12) <= result.end_time <= most * (1.0 + 1e-12)
    lowest = result.apexes["height"][-1]
    assert 0.0 < lowest <= 1.1e-12  # of 1 m: what is left out is lower


@pytest.mark.parametrize(
    ("law", "last"),
    [
        (sb.RigidLossBySpeed(0.8, 3.0, 0.2), 1e-6),
        (sb.RigidLossBySpeed(0.8, 3.0, 0.43), 1e-6),
        (sb.Rigid(0.5), 1e-13),
    ],
)
def test_a_run_ends_amid_the_bounces(law, last):
    end = bounce(law).end_time
    for part in (0.5, 0.999, 1.0 - 1e-4, 1.0 - last):
        result = bounce(law, part * end)
        assert result.status is sb.Status.TIME_REACHED
        assert result.end_time == part * end
        assert result.rebound_speeds[0] != 0.0


def test_a_loss_that_vanishes_with_the_speed_never_ends():
    result = bounce(sb.RigidLossBySpeed(0.8, 3.0, 1.0), event_limit=10_000)
    assert result.status is sb.Status.EVENT_LIMIT
    assert result.collisions.tolist() == [10_000]
    assert bounce(sb.RigidLossBySpeed(0.8, 3.0, 1.0), 2.0).status is sb.Status.TIME_REACHED


def test_without_loss_below_a_speed_a_ball_bounces_for_ever():
    law = sb.RigidBySpeed(1.0, speed=0.5)  # it yields above 0.5 m/s
    result = bounce(law, 20.0)
    assert result.status is sb.Status.TIME_REACHED
    heights = result.apexes["height"]
    last = heights[-1]
    assert 0.0 < last <= 0.5**2 / (2.0 * G)
    assert heights[heights < 0.5**2 / (2.0 * G)] == pytest.approx(last, rel=1e-13)
    first = (0.5 / (2.0 * G) ** 0.5) ** 0.25
    assert heights[0] == pytest.approx(first**2, rel=1e-14)


def test_a_ball_above_one_that_comes_to_rest():
    """Ball 1 is far above; what is left out of ball 0's bounces does not reach it."""
    law = sb.RigidLossBySpeed(0.8, 3.0, 0.43)
    alone = bounce(law)
    balls = [sb.Ball(0.6), sb.Ball(0.06)]
    drop = sb.Drop(balls, [law, law], [200.0], velocities=[-((2.0 * G) ** 0.5), 0.0], gravity=G)
    result = sb.simulate(drop, until=alone.end_time + 0.01)
    assert result.status is sb.Status.TIME_REACHED
    assert result.collisions.tolist() == [-1, 0]
    assert len(result.intervals) == len(alone.intervals)
    assert result.rebound_speeds == pytest.approx([0.0, -G * result.end_time], rel=1e-13)


def test_two_balls_come_to_rest_together():
    law = sb.RigidLossBySpeed(0.8, 3.0, 0.2)
    drop = sb.Drop([sb.Ball(0.6), sb.Ball(0.06)], [law, law], height=1.0, gravity=G)
    result = sb.simulate(drop, until=60.0)
    assert result.status is sb.Status.SETTLED
    assert result.collisions.tolist() == [-1, -1]
    assert result.rebound_speeds.tolist() == [0.0, 0.0]
    last = result.events[-1]
    assert result.end_time - last["time"] <= 1e-11 * result.end_time
    assert abs(last["upper_velocity"]) <= 1e-11


@pytest.mark.parametrize("kind", [sb.RigidBySpeed, sb.RigidLossBySpeed])
def test_no_collapse_where_slow_collisions_lose_nothing(kind):
    """With e = 0.5 at all speeds this pair collides infinitely often (m2/m1 = 8)."""
    balls = [sb.Ball(1.0), sb.Ball(8.0)]
    law = kind(0.5, speed=1.0, speed_exponent=0.01)
    drop = sb.Drop(balls, [law, law], impact_speed=1.0)
    result, expected = sb.simulate(drop), precise(drop)
    assert result.status is sb.Status.FINISHED
    assert result.collisions.tolist() == expected.counts()
    assert_collisions(result, expected)


@pytest.mark.parametrize("compiled", [False, True])
@pytest.mark.parametrize(
    ("law", "upper"),
    [
        (sb.RigidLossBySpeed(0.5, speed=1.0, speed_exponent=1e-12), 9.0),
        (sb.RigidBySpeed(0.3, 1.0, 0.0, scatter=0.05), 20.0),
    ],
)
def test_rates_that_come_close_to_underflow_count_as_a_collapse(law, upper, compiled):
    drop = sb.Drop([sb.Ball(1.0), sb.Ball(upper)], [law, law], impact_speed=1.0)
    result = sb.simulate(drop, compiled=compiled)
    assert result.status is sb.Status.COLLAPSED
    assert result.collisions.tolist() == [-1, -1]
    assert result.rebound_speeds.tolist() == [0.0, 0.0]


@pytest.mark.parametrize("kind", [sb.RigidBySpeed, sb.RigidLossBySpeed])
def test_the_same_at_all_speeds_is_a_plain_rigid_contact(kind):
    random = Random(7)
    for _ in range(40):
        size = random.randint(1, 4)
        balls = [sb.Ball(10.0 ** random.uniform(-1.0, 1.0)) for _ in range(size)]
        given = {"height": 0.5, "gravity": random.choice([0.0, G])}
        e = [random.choice([0.5, 0.75, 0.875]) for _ in range(size)]
        one = sb.Drop(balls, [kind(x, 2.0, 0.0) for x in e], **given)
        other = sb.Drop(balls, [sb.Rigid(x) for x in e], **given)
        ours, plain = (sb.simulate(drop, until=0.7) for drop in (one, other))
        assert ours.log == plain.log
        assert ours.final_velocities == plain.final_velocities
        assert (ours.status, ours.infinite) == (plain.status, plain.infinite)


# --- restitutions that scatter from collision to collision: the draws, and how runs end
SEEDS = np.arange(4000.0)


def granite(seed=0.0, scatter=0.06):
    """Return the contact of granite spheres: 0.83 ± 0.06 at all speeds (Durda et al., 2011)."""
    return sb.RigidBySpeed(0.83, speed=1.0, speed_exponent=0.0, scatter=scatter, seed=seed)


def drawn(result):
    """Return the restitution of each collision on the floor, from the speeds of one ball."""
    after = result.events["upper_velocity"]
    return after / np.concatenate([[result.drop.reference_speed], after[:-1]])


@pytest.mark.parametrize("seed", [0.0, 1.0, 7.25, 4294967295.0])
def test_each_draw_is_that_of_the_reference(seed):
    law = granite(seed, scatter=0.02)
    expected = [float(0.83 + 0.02 * restitution.normal(seed, 0, hit)) for hit in range(50)]
    assert max(expected) < 1.0
    assert drawn(bounce(law, event_limit=50)) == pytest.approx(expected, abs=1e-14)


def test_scatter_is_normal():
    found = sb.sweep(
        sb.Drop([sb.Ball(1.0)], [granite(scatter=0.03)], impact_speed=2.0),
        {"contacts.0.seed": SEEDS},
    ).rebound_ratio.values[:, 0]
    assert stats.kstest((found - 0.83) / 0.03, "norm").pvalue > 1e-3
    later = drawn(bounce(granite(5.0, scatter=0.03), event_limit=100))
    assert stats.kstest((later - 0.83) / 0.03, "norm").pvalue > 1e-3


def test_e_is_kept_from_0_to_1():
    law = sb.RigidBySpeed(0.9, speed=1.0, speed_exponent=0.0, scatter=1.0)
    found = sb.sweep(
        sb.Drop([sb.Ball(1.0)], [law], impact_speed=2.0), {"contacts.0.seed": SEEDS}
    ).rebound_ratio.values[:, 0]
    assert (found.min(), found.max()) == (0.0, 1.0)
    z = stats.norm
    assert np.mean(found == 0.0) == pytest.approx(z.cdf(-0.9), abs=0.03)
    assert np.mean(found == 1.0) == pytest.approx(z.sf(0.1), abs=0.03)


def stack(seed=0.0):
    """Return three balls under gravity whose contacts scatter."""
    law = sb.RigidLossBySpeed(0.8, 3.0, 0.2, scatter=0.05, seed=seed)
    balls = [sb.Ball(0.6), sb.Ball(0.06), sb.Ball(0.02)]
    return sb.Drop(balls, [law] * 3, [0.0, 0.001], height=0.5)


def test_the_same_in_plain_python_again_in_parts_and_in_a_sweep():
    seeds = [0.0, 3.0, 0.5, 1e9]
    number = ("run", seeds)
    swept = sb.sweep(stack(), {f"contacts.{i}.seed": number for i in range(3)})
    for row, seed in enumerate(seeds):
        one, other = (sb.simulate(stack(seed), compiled=way) for way in (False, True))
        assert one.log == other.log
        assert swept.rebound_ratio[row].values.tolist() == one.rebound_ratios.tolist()
        middle = 0.5 * one.end_time
        later = one.sample([middle, one.end_time + 1.0]).velocity.values[:, 1]
        assert later.tolist() == one.rebound_speeds.tolist()
        assert list(sb.simulate(stack(seed), until=middle).events) == [
            event for event in one.events if event["time"] <= middle
        ]


def test_a_drop_of_a_sweep_does_not_depend_on_the_others():
    """A grid that several threads work on, whole and in pieces."""
    mass = np.linspace(0.01, 0.1, 90)
    vary = {"balls.1.mass": mass, "contacts.0.seed": np.arange(100.0)}
    whole = sb.sweep(stack(), vary).rebound_ratio.values
    for rows in (slice(0, 1), slice(37, 39), slice(89, 90)):
        part = sb.sweep(stack(), vary | {"balls.1.mass": mass[rows]}).rebound_ratio.values
        assert part.tolist() == whole[rows].tolist()


def test_one_ball_that_scatters_comes_to_rest():
    """On average each bounce is 0.83 times as long; far below, 0.4 times the scatter is lost."""
    for law in (granite(1.0), sb.RigidLossBySpeed(0.83, 1.0, 0.5, scatter=0.06, seed=2.0)):
        result = bounce(law)
        assert result.status is sb.Status.SETTLED
        assert result.collisions.tolist() == [-1]
        flights = 2.0 / 9.81 * result.events["upper_velocity"]
        assert result.end_time == pytest.approx(flights.sum(), rel=1e-11)
