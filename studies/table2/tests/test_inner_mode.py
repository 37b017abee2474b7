"""Balls with an inner vibration: energy, limits, another method, and the bound on the energy."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from studies.table2 import inner_mode, inputs
from studies.table2.inner_mode import bounce_alone, collide_pair, compare_inner_modes

from stackbounce import errors


def test_nothing_is_lost():
    for found in compare_inner_modes(ratios=(1.3, 4.0), shares=(0.5, 0.8)):
        assert found.kept + found.left == pytest.approx(1.0, abs=1e-11)
        assert found.left > 0.0


@pytest.mark.parametrize("pair", list(inputs.PAIRS))
def test_a_fast_vibration_is_none(pair):
    near, nearer = (collide_pair(pair, ratio, 0.5) for ratio in (40.0, 160.0))
    for one, limit in ((near, 0.02), (nearer, 0.005)):
        assert one.first == pytest.approx(one.rigid_first, abs=limit)
        assert one.second == pytest.approx(one.rigid_second, abs=limit)
    assert nearer.left < near.left < 1e-4


def test_a_light_part_is_none():
    assert bounce_alone(2.0, 0.999) == pytest.approx(1.0, abs=2e-3)
    assert bounce_alone(2.0, 0.5) < 0.98


def by_steps(balls, contacts, gap, speed, until):
    """Integrate masses on springs, of which those of contacts only push."""
    mass = np.array([part for ball in balls for part in ball.masses])

    def slopes(_, state):
        q, v = np.split(state, 2)
        c = np.append(0.0, q[:-1]) - q
        force = np.zeros(len(q))
        force[::2] = np.maximum(0.0, contacts * c[::2])
        force[1::2] = [ball.inner_stiffness for ball in balls] * c[1::2]
        return np.concatenate([v, (force - np.append(force[1:], 0.0)) / mass])

    start = np.concatenate([np.repeat(gap * np.arange(len(balls)), 2), np.full(len(mass), -speed)])
    found = solve_ivp(
        slopes, (0.0, until), start, method="DOP853", rtol=1e-11, atol=1e-14, max_step=until / 1e3
    )
    velocity = found.y[len(mass) :, -1].reshape(-1, 2)
    return [
        float(np.dot(ball.masses, v)) / ball.mass for ball, v in zip(balls, velocity, strict=True)
    ]


@pytest.mark.parametrize(("ratio", "share"), [(1.5, 0.6), (4.0, 0.3)])
def test_pairs_by_another_method(ratio, share):
    found = collide_pair("B2_on_B1", ratio, share)
    solos = [inputs.read_solo(name) for name in inputs.PAIRS["B2_on_B1"]]
    balls = [inner_mode._ball(*solo, ratio, share) for solo in solos]
    lower, upper = (ball.stiffness for ball in balls)
    contacts = np.array([lower, lower * upper / (lower + upper)])
    gap = inner_mode._gap(inputs.MEASURED["B2_on_B1"][inputs.DELAY][0], solos[0].contact_time)
    speeds = by_steps(balls, contacts, gap, inner_mode._SPEED, 0.025)
    expected = [found.first * inner_mode._SPEED, found.second * inner_mode._SPEED]
    assert speeds == pytest.approx(expected, abs=1e-6)


def test_the_gap_gives_the_delay():
    time, delay = 4.3e-3, 2e-3
    rate, speed = math.pi / time, inner_mode._SPEED
    lower = -speed * math.sin(rate * delay) / rate
    assert inner_mode._gap(delay, time) - speed * delay == pytest.approx(lower, rel=1e-12)
    late = inner_mode._gap(7e-3, time)  # by then the lower ball has left the floor
    assert late == pytest.approx(speed * (7e-3 + 7e-3 - time))


def test_a_pair_can_retain_more_than_a_single_bounce_allows():
    """The bound takes a vibration for a loss; a second collision may take energy out of it."""
    found = compare_inner_modes(pairs=["B2_on_B1"], ratios=(3.0,), shares=(0.3,))
    (one,) = found
    assert one.alone < 0.97
    assert one.excess > 0.04
    assert collide_pair("B1_on_B2", 2.0, 0.7).excess < -0.2  # or less, by far


def test_a_tenfold_frequency_changes_little():
    for found in compare_inner_modes(ratios=(10.0,)):
        assert abs(found.excess) < 1e-3
        assert found.left < 1e-3


@pytest.mark.parametrize(
    ("ratio", "share", "words"),
    [(0.0, 0.5, "ratio must be a positive number"), (2.0, 1.0, "share must be a number from")],
)
def test_numbers_out_of_range_are_refused(ratio, share, words):
    with pytest.raises(errors.InvalidValue, match=words):
        bounce_alone(ratio, share)
