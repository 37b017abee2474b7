"""Rigid balls: eqs 1 to 4, collision counts, against exact references."""

from random import Random

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from scipy.optimize import brentq

import stackbounce as sb
from batches import bits, in_lanes, rigid_pairs, swept
from drops import assert_collisions, exact, precise, rigid
from reference import rigid as reference
from stackbounce.engine import codes
from stackbounce.engine.memory import RIGID
from stackbounce.engine.work import LANE_EVENTS
from stackbounce.run.options import Options

PRECISION = 1e-11


@pytest.mark.parametrize(
    ("reach", "least", "known"), [(1.0, 0.7, 1.0), (3.0, 0.0, 0.7), (8.0, 0.0, 0.6)]
)
def test_many_pairs_have_the_bits_of_the_general_engine(reach, least, known):
    drops = rigid_pairs(5000, 1, reach, least)
    out = in_lanes("run_two_rigid", drops, LANE_EVENTS)
    general = swept(RIGID, drops, Options(np.inf, 1e-12, 1_000_000))
    done = out.status == codes.FINISHED
    assert done.mean() >= known
    assert (out.status[~done] == codes.ASK).all()
    for name in set(out._fields) - {"work"}:
        assert bits(getattr(out, name)[done]) == bits(getattr(general, name)[done])


@pytest.mark.parametrize("e", [1.0, 0.92, 0.9, 0.88, 0.8, 0.5])
@pytest.mark.parametrize("lower", [10.0, 4.23, 3.0, 2.63, 1.0])
def test_equations_1_and_2(lower, e):
    m1, m2 = lower, 1.0
    result = sb.simulate(rigid([m1, m2], e))
    event = result.events[1]
    assert event["contact"] == 1
    v1 = (e * m1 - (1 + e + e**2) * m2) / (m1 + m2)  # eq. 1
    v2 = (e * (2 + e) * m1 - m2) / (m1 + m2)  # eq. 2
    assert event["lower_velocity"] == pytest.approx(v1, abs=1e-15)
    assert event["upper_velocity"] == pytest.approx(v2, abs=1e-15)
    if v1 >= 0:
        assert result.rebound_ratios == pytest.approx([v1, v2], abs=1e-15)
        assert result.collisions.tolist() == [1, 1]


@pytest.mark.fast_cases(2)
@pytest.mark.parametrize(
    ("power", "total"), [(0, 3), (1, 31), (2, 314), (3, 3141), (4, 31415), (5, 314159)]
)
@pytest.mark.parametrize("gap", [0.0, 1.0])
def test_digits_of_pi(power, total, gap):
    """The lower ball at rest, the upper one coming down: Galperin's count."""
    drop = rigid([1.0, 100.0**power], gaps=[gap], velocities=[0.0, -1.0])
    assert sb.simulate(drop).collisions.sum() == total


@given(st.floats(1e-2, 1e5))
def test_elastic_counts_of_any_ratio(upper):
    angle = 0.5 * np.pi / np.arctan(upper**-0.5)
    assume(abs(2 * angle - round(2 * angle)) > 1e-6)  # at a tie rounding decides
    counts = sb.simulate(rigid([1.0, upper])).collisions.tolist()
    assert tuple(counts) == reference.elastic_counts(1.0, upper)


@pytest.mark.slow
def test_hundred_thousand_elastic_collisions():
    upper = 1.05e9
    result = sb.simulate(rigid([1.0, upper]))
    events = result.events
    assert len(events) > 100_000
    assert tuple(result.collisions) == reference.elastic_counts(1.0, upper)
    balls = events[events["contact"] == 1]
    fastest = [np.abs(balls[name]).max() for name in ("lower_velocity", "upper_velocity")]
    expected = reference.elastic_pair(1.0, upper, len(events))
    error = np.abs(result.rebound_speeds - [float(v) for v in expected])
    assert (error <= PRECISION * np.array(fastest)).all()
    assert abs(result.energy_retained - 1) <= PRECISION


@pytest.mark.parametrize("masses", [(1.0, 3.0), (0.1, 0.3), (0.05, 0.15), (7.0, 21.0), (1.1, 3.3)])
@pytest.mark.parametrize("gap", [0.0, 0.3])
def test_tie_at_the_end(masses, gap):
    """Both leave with the same speed: rounding makes no third ball-ball collision of it."""
    result = sb.simulate(rigid(masses, gaps=[gap]))
    assert result.collisions.tolist() == [3, 2]
    assert result.rebound_ratios == pytest.approx([1.0, 1.0], abs=PRECISION)
    assert result.status is sb.Status.FINISHED


@pytest.mark.parametrize("size", [2, 3, 4, 5, 6])
@pytest.mark.parametrize("unit", [1.0, 0.1, 0.057])
def test_cannon(size, unit):
    """Masses in ratios (n+2)/n, counted from the bottom: all the energy to the top ball."""
    masses = [unit]
    for n in range(size - 1, 0, -1):
        masses.insert(0, masses[0] * (n + 2) / n)
    result = sb.simulate(rigid(masses))
    assert result.collisions.tolist() == [1] * size
    assert result.rebound_ratios == pytest.approx([0.0] * (size - 1) + [size], abs=PRECISION)
    assert result.rebound_ratios[-1] ** 2 == pytest.approx(size**2, abs=1e-10)


@pytest.mark.parametrize(
    ("masses", "restitutions"),
    [
        ((1.0, 1.0), (0.0, 1.0)),
        ((3.0, 1.0), (0.0, 0.5)),
        ((1.0, 0.5), (0.5, 0.0)),
        ((4.0, 2.0, 0.5), (1.0, 0.0, 1.0)),
    ],
)
def test_restitution_zero(masses, restitutions):
    drop = rigid(masses, restitutions)
    expected = exact(drop)
    assert expected.finished
    assert_collisions(sb.simulate(drop), expected)


@pytest.mark.parametrize("e", [0.0, 0.3, 1.0])
def test_one_ball(e):
    result = sb.simulate(rigid([2.0], e))
    assert result.rebound_speeds.tolist() == [e]
    assert result.collisions.tolist() == [1]
    assert result.energy_retained == pytest.approx(e**2, abs=1e-15)
    (interval,) = result.intervals
    assert (interval["start"], interval["end"]) == (0.0, 0.0)
    assert interval["peak_force"] == np.inf
    assert interval["impulse"] == pytest.approx(2.0 * (1 + e), rel=1e-15)


def random_stacks(count):
    random = Random(11)
    for _ in range(count):
        size = random.choice([2, 2, 3, 3, 4, 5])
        elastic = random.random() < 0.4
        yield rigid(
            [10 ** random.uniform(-1, 1) for _ in range(size)],
            [1.0 if elastic else random.uniform(0.5, 1.0) for _ in range(size)],
            [random.choice([0.0, random.uniform(0, 2)]) for _ in range(size - 1)],
        )


@pytest.mark.fast_cases(3)
@pytest.mark.parametrize("drop", list(random_stacks(150)), ids=range(150))
def test_random_stacks(drop):
    expected = precise(drop, limit=1500)
    result = sb.simulate(drop)
    if expected.finished:
        assert result.status is sb.Status.FINISHED
        assert_collisions(result, expected)
    else:
        assert result.status is sb.Status.COLLAPSED
        assert (np.diff(result.rebound_speeds) >= -PRECISION).all()


def test_newtons_cradle_lowest_approaching_first():
    """Touching balls without a floor, two coming in: two go out."""
    drop = rigid([1.0] * 5, [None, 1.0, 1.0, 1.0, 1.0], velocities=[0.3, 0.3, 0.0, 0.0, 0.0])
    result = sb.simulate(drop)
    assert result.rebound_speeds.tolist() == [0.0, 0.0, 0.0, 0.3, 0.3]
    assert_collisions(result, exact(drop))


def test_ties_lowest_approaching_first():
    """Both neighbours of a ball at rest arrive at once: the lower contact collides first."""
    drop = rigid([1.0, 1.0, 2.0], [None, 0.5, 0.5], [1.0, 1.0], [1.0, 0.0, -1.0])
    result = sb.simulate(drop)
    assert result.events["contact"][:2].tolist() == [1, 2]
    assert result.events["time"][0] == result.events["time"][1] == 1.0
    assert_collisions(result, exact(drop))


@pytest.mark.parametrize("size", [1, 2, 30, 1000])
def test_tall_stack_of_equal_elastic_balls(size):
    """Equal balls swap velocities: each passes each other and all the floor, which adds up."""
    result = sb.simulate(rigid([1.0] * size, gaps=[1.0] * (size - 1)))
    assert result.status is sb.Status.FINISHED
    assert result.collisions.tolist() == list(range(size, 0, -1))
    assert result.rebound_speeds.tolist() == [1.0] * size


# --- inelastic collapse: detected by theory, replaced by its limit; collisions counted below it


@pytest.mark.parametrize("gap", [0.0, 1.0])
@pytest.mark.parametrize(
    ("upper", "restitutions"),
    [(8.0, (0.5, 0.5)), (1.0, (0.0, 0.0)), (1.0, (0.0, 0.5)), (1.0, (0.5, 0.0))],
)
def test_collapse_exactly_at_the_threshold_and_where_a_restitution_is_zero(
    upper, restitutions, gap
):
    result = sb.simulate(rigid([1.0, upper], restitutions, gaps=[gap]))
    assert result.status is sb.Status.COLLAPSED
    assert result.rebound_speeds.tolist() == [0.0, 0.0]


@pytest.mark.parametrize("compiled", [None, False])
@pytest.mark.parametrize(
    ("restitution", "status"), [(0.17155, "COLLAPSED"), (0.1715729, "FINISHED")]
)
def test_rates_below_underflow(restitution, status, compiled):
    drop = rigid([1.0, 1.0], restitution, gaps=[0.3])
    assert sb.simulate(drop, compiled=compiled).status.name == status


def near_threshold(random):
    """Return a drop of two balls next to the threshold of collapse, and on which side it is."""
    mass = 10.0 ** random.uniform(-1.3, 0.7)
    threshold = brentq(lambda e: 4.0 * e / (1.0 - e) ** 2 - mass, 1e-9, 1.0 - 1e-9)
    offset = random.choice([-1.0, 1.0]) * 10.0 ** random.uniform(-8.0, -4.0)
    gap = random.choice([0.0, 0.3, random.uniform(0.0, 1.0)])
    return rigid([1.0, mass], threshold + offset, gaps=[gap]), offset < 0.0


@pytest.mark.fast_cases(1)
@pytest.mark.parametrize(("seed", "count"), [(1, 200), (2, 3_000)])
def test_next_to_the_threshold(seed, count):
    random = np.random.default_rng(seed)
    for _ in range(count):
        drop, collapses = near_threshold(random)
        assert sb.simulate(drop).status.name == ("COLLAPSED" if collapses else "FINISHED")


@pytest.mark.parametrize("gap", [0.0, 0.25])
def test_just_below_collapse_is_counted_to_the_end(gap):
    drop = rigid([1.0, 7.999], 0.5, gaps=[gap])
    result, expected = sb.simulate(drop), precise(drop)
    assert result.status is sb.Status.FINISHED
    assert result.collisions.tolist() == expected.counts() == [421, 421]
    assert 1e-129 < result.rebound_speeds[0] < result.rebound_speeds[1] < 1e-126
    assert result.rebound_speeds == pytest.approx([float(v) for v in expected.velocities], rel=1e-8)


@pytest.mark.parametrize(("upper", "floor", "balls"), [(7.9999, 1333, 1332), (7.99999, 4215, 4214)])
def test_just_below_collapse_beyond_the_range_of_floats(upper, floor, balls):
    """Speeds fall below the smallest float, long before the last collision."""
    drop = rigid([1.0, upper], 0.5)
    assert precise(drop).counts() == [floor, balls]
    result = sb.simulate(drop)
    assert result.status is sb.Status.FINISHED
    assert result.collisions.tolist() == [floor, balls]
    assert (np.diff(result.rebound_speeds) >= 0.0).all()


def test_collapse_of_two_balls_with_a_gap_ends_at_a_finite_time():
    drop = rigid([1.0, 20.0], 0.5, gaps=[0.3])
    result = sb.simulate(drop)
    assert result.status is sb.Status.COLLAPSED
    end = exact(drop, limit=300).collisions[-1].time
    assert result.end_time == pytest.approx(float(end), rel=1e-9)


@given(
    floor=st.one_of(st.just(1.0), st.floats(0.05, 0.97)),
    balls=st.floats(0.05, 0.97),
    side=st.floats(-2.0, 6.0).map(lambda x: 10**x),
    gap=st.sampled_from([0.0, 0.125, 2.0]),
)
def test_collapse_is_decided_by_theory(floor, balls, side, gap):
    threshold = float(reference.collapse_threshold(floor, balls))
    assume(abs(side - 1) > 0.01)
    drop = rigid([1.0, threshold * side], [floor, balls], gaps=[gap])
    result = sb.simulate(drop)
    if side > 1:
        assert result.status is sb.Status.COLLAPSED
        assert result.collisions.tolist() == [-1, -1]
        assert result.rebound_speeds.tolist() == [0.0, 0.0]
        assert result.energy_retained == 0.0
    else:
        assert result.status is sb.Status.FINISHED
        assert result.collisions.tolist() == precise(drop).counts()


@pytest.mark.fast_cases(2)
@pytest.mark.parametrize(
    ("masses", "restitutions", "gaps"),
    [
        ((1.0, 1.0, 1.0), (0.1, 0.1, 0.1), (0.0, 0.0)),
        ((1.0, 2.0, 4.0), (0.5, 0.5, 0.5), (0.0, 0.0)),
        ((1.0, 2.0, 4.0), (0.3, 0.3, 0.3), (0.5, 0.5)),
        ((1.0, 2.0, 2.0), (0.2, 0.6, 0.3), (0.5, 0.0)),
        ((0.3, 5.0, 0.3), (0.2, 0.6, 0.3), (0.5, 0.5)),
    ],
)
def test_collapse_of_three_balls(masses, restitutions, gaps):
    drop = rigid(masses, restitutions, gaps)
    assert not exact(drop, limit=300).finished
    result = sb.simulate(drop, event_limit=100_000)
    assert result.status is sb.Status.COLLAPSED
    assert (result.rebound_speeds >= 0.0).all()
    assert (np.diff(result.rebound_speeds) >= 0.0).all()
    assert 0.0 <= result.energy_retained < 1.0


@pytest.mark.slow
def test_collapse_in_the_middle_of_three_balls_without_a_floor():
    """Equal balls, e < 7 - 4 sqrt(3) = 0.0718 (McNamara and Young 1992): they end up together."""
    drop = rigid([1.0] * 3, [None, 0.05, 0.05], [1.0, 1.0], [1.0, 0.25, -1.0])
    result = sb.simulate(drop)
    assert not exact(drop, limit=200).finished
    assert result.status is sb.Status.COLLAPSED
    assert result.collisions.tolist() == [0, -1, -1]
    assert result.rebound_speeds == pytest.approx([0.25 / 3] * 3, abs=PRECISION)


@pytest.mark.parametrize(
    ("masses", "restitutions"), [((6.0, 0.3, 1.5), (0.95, 0.1)), ((6.0, 0.25, 1.5), (0.9, 0.15))]
)
def test_collapse_on_the_way_up(masses, restitutions):
    """Speeds differ by less than their round-off long before the last collision."""
    drop = rigid(masses, [1.0, *restitutions], [0.0, 1.0])
    assert not exact(drop, limit=150).finished
    result = sb.simulate(drop)
    assert result.status is sb.Status.COLLAPSED
    assert result.collisions.tolist()[1:] == [-1, -1]
    assert np.ptp(result.rebound_speeds) <= PRECISION


def test_a_group_that_joins_again_and_again_comes_to_an_end():
    """Two balls stick (restitution 0) and are parted by the third, ever less, all in no time."""
    masses, laws = [0.167, 0.169, 0.74], [None, 0.232, 0.891]
    for first in (0.0, 0.1):
        drop = rigid([3.311, *masses], [None, first, *laws[1:]], velocities=[0.64, 0.5, 0.2, -1.0])
        result = sb.simulate(drop, event_limit=20_000)
        assert result.status is sb.Status.COLLAPSED
        assert np.ptp(result.rebound_speeds) <= PRECISION
