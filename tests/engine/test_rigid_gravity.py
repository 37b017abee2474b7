"""Rigid balls under gravity: bounces, several balls, rest, apexes, no gain of energy."""

import functools
from random import Random

import numpy as np
import pytest

import stackbounce as sb
from drops import assert_collisions, fallen, rigid

PRECISION = 1e-11
G = 9.81
falling = functools.partial(rigid, gravity=1.0)


@pytest.mark.parametrize("compiled", [False, True])
@pytest.mark.parametrize("e", [1e-13, 0.3, 0.5, 0.9, 0.99])
def test_one_ball_bounces_to_rest(e, compiled):
    """All is over sqrt(2 h/g) (1 + e)/(1 - e) after the release, and apex k is h e^(2k)."""
    result = sb.simulate(falling([0.057], [e], height=1.3, gravity=G), until=1e4, compiled=compiled)
    assert result.status is sb.Status.SETTLED
    assert result.collisions.tolist() == [-1]
    assert result.rebound_speeds.tolist() == [0.0]
    fall = np.sqrt(2 * 1.3 / G)
    assert result.end_time == pytest.approx(fall * 2 * e / (1 - e), rel=1e-12)
    apexes = result.apexes
    expected = 1.3 * e ** (2.0 * np.arange(1, len(apexes) + 1))
    assert apexes["height"][expected > 1e-300] == pytest.approx(
        expected[expected > 1e-300], rel=1e-12
    )
    assert np.all(np.diff(apexes["time"]) > 0.0)
    assert len(apexes) == len(result.intervals)


def test_without_loss_a_ball_bounces_for_ever():
    result = sb.simulate(falling([1.0], [1.0]), until=1e4 + 1.0)
    assert result.status is sb.Status.TIME_REACHED
    assert result.collisions.tolist() == [5001]
    assert result.rebound_speeds == pytest.approx([0.0], abs=1e-15)
    assert result.apexes["height"] == pytest.approx(0.5, rel=1e-15)


@pytest.mark.parametrize(
    ("masses", "restitutions", "collisions"),
    [([1.0], [0.0], [1]), ([1.0, 20.0], [0.5, 0.5], [-1, -1])],
)
def test_what_loses_all_speed_rests_at_once(masses, restitutions, collisions):
    result = sb.simulate(falling(masses, restitutions), until=9.0)
    assert result.status is sb.Status.SETTLED
    assert (result.end_time, result.collisions.tolist()) == (0.0, collisions)
    assert len(result.apexes) == 0


def test_without_a_time_the_run_ends_once_none_approaches():
    result = sb.simulate(falling([1.0], [0.5]))
    assert result.status is sb.Status.FINISHED
    assert (result.end_time, result.collisions.tolist()) == (0.0, [1])
    assert result.rebound_speeds.tolist() == [0.5]
    assert result.apexes["height"].tolist() == [0.125]
    drop = falling([3.0, 1.0], 1.0)
    assert sb.simulate(drop).rebound_ratios == pytest.approx([0.0, 2.0], abs=1e-15)
    rising = sb.simulate(falling([1.0], [0.5], velocities=[1.0]))
    assert (rising.status, len(rising.intervals)) == (sb.Status.FINISHED, 0)


def test_without_a_time_speeds_are_those_of_the_last_collision():
    """On the way to it gravity has slowed the lower ball down and made the upper one faster."""
    result = sb.simulate(falling([30.0, 1.0], 1.0, [0.5]))
    assert result.end_time == pytest.approx(0.25, abs=1e-15)
    lower, upper = 0.75, -1.25
    expected = [lower - 2.0 * (lower - upper) / 31.0, upper + 60.0 * (lower - upper) / 31.0]
    assert result.rebound_speeds == pytest.approx(expected, abs=1e-15)


def test_one_ball_lies_while_the_other_flies_away():
    result = sb.simulate(falling([3.0, 1.0], [0.0, 0.5]))
    assert result.status is sb.Status.FINISHED
    assert result.rebound_speeds == pytest.approx([0.0, 0.125], abs=1e-15)


def test_without_a_floor_all_fall_alike():
    drop = falling([1.0] * 3, [None, 0.5, 0.5], [0.1, 0.2], [1.0, 0.0, 0.0])
    still = falling([1.0] * 3, [None, 0.5, 0.5], [0.1, 0.2], [1.0, 0.0, 0.0], gravity=0.0)
    result, expected = sb.simulate(drop), sb.simulate(still)
    assert result.status is expected.status is sb.Status.FINISHED
    assert result.events["time"] == pytest.approx(expected.events["time"], rel=1e-14)
    fallen = expected.rebound_speeds - expected.end_time
    assert result.rebound_speeds == pytest.approx(fallen, abs=1e-14)
    later = sb.simulate(drop, until=5.0)
    assert later.status is sb.Status.TIME_REACHED
    assert later.rebound_speeds == pytest.approx(expected.rebound_speeds - 5.0, abs=1e-14)
    position = sb.simulate(still, until=5.0).sample([5.0]).position.values - 12.5
    assert later.sample([5.0]).position.values == pytest.approx(position, abs=1e-13)


def test_a_collapse_on_the_way_up_and_down_again():
    """A light ball between two heavy ones: all three fly on as one, up to a common apex."""
    drop = falling([6.0, 0.3, 1.5], [1.0, 0.95, 0.1])
    result = sb.simulate(drop)
    assert result.status is sb.Status.COLLAPSED
    assert np.ptp(result.rebound_speeds) <= PRECISION
    speed = result.rebound_speeds[0]
    assert result.apexes["ball"].tolist() == [0, 1, 2]
    assert result.apexes["height"] == pytest.approx(0.5 * speed**2, abs=1e-14)
    assert sb.simulate(drop, until=500.0).status is sb.Status.SETTLED


@pytest.mark.parametrize(
    ("masses", "restitutions", "gaps", "until"),
    [
        ((3.0, 1.0), 1.0, (0.0,), 39.5),
        ((1.0, 1.0), 1.0, (0.3,), 40.0),
        ((2.0, 1.0, 3.0), (0.9, 0.95, 0.8), (0.1, 0.0), 2.0),
        ((1.0, 0.3), (0.0, 0.9), (0.5,), 2.0),
        ((1.0, 0.3, 0.1), (0.0, 0.9, 0.9), (0.0, 0.2), 1.0),
    ],
)
def test_several_balls(masses, restitutions, gaps, until):
    drop = falling(masses, restitutions, gaps)
    result = sb.simulate(drop, until=until)
    expected, heights = fallen(drop, until)
    assert result.status is sb.Status.TIME_REACHED
    assert_collisions(result, expected, 1e-10)
    end = result.sample([until])
    heights = [float(height) for height in heights]
    assert end.position[:, 0].values == pytest.approx(heights, abs=1e-10)
    assert end.velocity[:, 0].values.tolist() == result.rebound_speeds.tolist()


def test_a_ball_dropped_on_others_at_rest():
    """Equal elastic balls pass the blow to the floor and back; below the striker nothing moves."""
    result = sb.simulate(falling([1.0] * 4, 1.0, [0.0, 0.0, 0.5], [0.0, 0.0, 0.0, -1.0]), until=2.0)
    assert result.events["contact"][:7].tolist() == [3, 2, 1, 0, 1, 2, 3]
    impact = np.sqrt(2.0) - 1.0
    assert result.intervals["start"][:7] == pytest.approx(impact, abs=1e-15)
    now = result.sample([impact / 2, 1.0])
    assert now.position[:3].values.tolist() == [[0.0] * 2] * 3
    assert now.velocity[3, 1] == pytest.approx(np.sqrt(2.0) - (1.0 - impact), abs=1e-14)


def random_lossy(count):
    random = Random(8)
    for _ in range(count):
        size = random.choice([2, 2, 3, 3, 4])
        choices = (0.0, 1.0, random.uniform(0.2, 0.9), random.uniform(0.2, 0.9))
        restitutions = [random.choice(choices) for _ in range(size)]
        restitutions[random.randrange(size)] = random.uniform(0.3, 0.8)
        yield falling(
            [10 ** random.uniform(-1, 1) for _ in range(size)],
            restitutions,
            [random.choice([0.0, random.uniform(0.0, 1.0)]) for _ in range(size - 1)],
        )


@pytest.mark.fast_cases(4)
@pytest.mark.parametrize("drop", list(random_lossy(60)), ids=range(60))
def test_lossy_stacks_come_to_rest_and_gain_no_energy(drop):
    result = sb.simulate(drop, until=3000.0)
    assert result.status is sb.Status.SETTLED
    assert not result.rebound_speeds.any()
    assert result.energy_retained == 0.0
    sampled = result.sample(np.linspace(0.0, 1.01 * result.end_time + 0.01, 500))
    energy = sampled.energy.values
    assert np.diff(energy).max() <= 1e-14 * energy[0]
    assert energy[-1] == 0.0
    assert sampled.compression.values.max() <= 1e-13


@pytest.mark.parametrize(
    ("masses", "restitutions"), [((1.0, 1.0), (1.0, 0.5)), ((1.0, 1.0), (0.5, 1.0))]
)
def test_two_balls_whose_bounces_halve(masses, restitutions):
    """Both leave at v/2 together: 2 (1/2 + 1/4 + ...) v/g until they rest."""
    result = sb.simulate(falling(masses, restitutions), until=100.0)
    assert result.status is sb.Status.SETTLED
    assert result.end_time == pytest.approx(2.0, abs=1e-12)
    assert result.collisions.tolist() == [-1, -1]


def test_energy_is_kept_over_a_hundred_thousand_collisions():
    drop = falling([1.0, 0.7, 0.9], 1.0, [0.1, 0.3], velocities=[0.0, 0.0, -1.0])
    result = sb.simulate(drop, until=1e9, event_limit=100_000)
    assert result.status is sb.Status.EVENT_LIMIT
    assert len(result.intervals) == 100_000
    energy = result.sample(np.linspace(0.0, result.end_time, 1000)).energy.values
    assert np.abs(energy / energy[0] - 1.0).max() <= 1e-12


@pytest.mark.parametrize(
    ("speed", "gravity"),
    [(1e-200, 1.0), (1e200, 1.0), (1.0, 1e250), (1e-160, 1e-10), (1e150, 1e-100)],
)
def test_only_ratios_count(speed, gravity):
    """What happens does not depend on the units, however small or large the numbers get."""
    expected = sb.simulate(falling([1.0, 3.0, 2.0], 0.5), until=9.0)
    drop = falling([1.0, 3.0, 2.0], 0.5, gravity=gravity, impact_speed=speed)
    result = sb.simulate(drop, until=9.0 * speed / gravity)
    assert result.status is expected.status is sb.Status.SETTLED
    assert result.end_time == pytest.approx(expected.end_time * speed / gravity, rel=1e-12)
    counts = [len(run.intervals) for run in (result, expected)]
    assert counts[0] == pytest.approx(counts[1], rel=0.02)


def test_a_run_up_to_a_time_is_the_beginning_of_a_longer_one():
    drop = falling([1.0, 0.5, 2.0], [0.9, 0.8, 0.95], [0.1, 0.2])
    whole = sb.simulate(drop, until=4.0)
    for time in (0.05, 0.4, 1.7, 3.3):
        part, sampled = sb.simulate(drop, until=time), whole.sample([time])
        assert part.rebound_speeds.tolist() == sampled.velocity[:, 0].values.tolist()
        assert part.sample([time]).position.values.tolist() == sampled.position.values.tolist()
        assert part.end_time == time


def test_apexes_of_two_balls():
    result = sb.simulate(falling([3.0, 1.0], 1.0, gravity=G, height=0.5), until=1.5)
    apexes = result.apexes
    assert apexes["ball"][0] == 1
    assert apexes["height"][0] == pytest.approx(2.0, rel=1e-15)  # the upper one alone, at 2 v
    at = result.sample(apexes["time"])
    for index, apex in enumerate(apexes):
        assert at.position[apex["ball"], index] == pytest.approx(apex["height"], abs=1e-13)
        assert at.velocity[apex["ball"], index] == pytest.approx(0.0, abs=1e-13)
