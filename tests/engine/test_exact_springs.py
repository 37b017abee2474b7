"""Springs (eqs 5 and 6) against the thirty-digit reference and published values."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from mpmath import mp

import stackbounce as sb
from drops import compared, drop_of, springs
from reference import data
from reference import rigid as rigid_reference

PRECISION = 1e-11
ENERGY = 1e-12
ROWS = data.read("springs")


@pytest.mark.fast_cases(3)
@pytest.mark.parametrize("row", ROWS, ids=range(len(ROWS)))
def test_reference(row):
    result = sb.simulate(drop_of(row["case"]))
    assert result.status is sb.Status.FINISHED
    found, expected = compared(row, result, PRECISION)
    assert abs(result.energy_retained - 1) <= ENERGY
    unit = np.sqrt(result.drop.balls[0].mass / result.drop.contacts[0].stiffness)
    scale = np.abs(expected)
    scale[:, 1:3] = np.maximum(scale[:, 1:3], unit)
    assert (np.abs(found - expected) <= PRECISION * scale).all()
    assert result.end_time == found[:, 2].max()


@given(
    upper=st.floats(0.02, 1.0), stiffness=st.floats(0.01, 100.0), delay=st.floats(np.pi, 3 * np.pi)
)
def test_wide_gap_gives_separate_collisions(upper, stiffness, delay):
    """A gap of at least pi v sqrt(m1/k1) is wide where the upper ball is not the heavier one."""
    result = sb.simulate(springs([1.0, upper], [1.0, stiffness], [delay]))
    numbers = [[mp.mpf(x) for x in row] for row in ((1.0, upper), (1, 1), (0,), (-1, -1))]
    expected = rigid_reference.run(*numbers)
    assert result.rebound_ratios == pytest.approx(
        [float(v) for v in expected.velocities], abs=PRECISION
    )
    if upper not in (1.0, 1 / 3):  # where a ball stops or keeps up, a rounding error may count
        assert result.collisions.tolist() == expected.counts()


def test_motion_between_the_events():
    """Equal balls and springs start on the modes of eqs 5 and 6: golden-ratio frequencies."""
    result = sb.simulate(springs([1, 1], [1, 1]))
    times = np.linspace(0.0, result.intervals["end"].min(), 101)
    slow, fast = (np.sqrt(5) - 1) / 2, (np.sqrt(5) + 1) / 2
    sample = result.sample(times)
    lower = upper = 0.0
    for w in (slow, fast):
        shape = 2 - w**2  # of the upper ball where the lower one's is 1
        weight = (1 + shape) / (1 + shape**2) / w
        lower = lower - weight * np.sin(w * times)
        upper = upper - weight * shape * np.sin(w * times)
    assert sample.position.sel(ball=0).values == pytest.approx(lower, abs=1e-13)
    assert sample.position.sel(ball=1).values == pytest.approx(upper, abs=1e-13)
    assert sample.force.sel(contact=0).values == pytest.approx(-lower, abs=1e-13)
    assert sample.force.sel(contact=1).values == pytest.approx(lower - upper, abs=1e-13)


def test_gravity_one_ball():
    """With c'' = g - w**2 c a contact lasts 2 (pi - atan(v w / g)) / w, every flight 2 v / g."""
    gravity, speed, w = 9.8, 1.5, 100.0
    drop = sb.Drop([sb.Ball(2.0)], [sb.Spring(2.0 * w**2)], impact_speed=speed, gravity=gravity)
    contact = 2 * (np.pi - np.arctan(speed * w / gravity)) / w
    period = contact + 2 * speed / gravity
    result = sb.simulate(drop, until=4.5 * period)
    assert result.status is sb.Status.TIME_REACHED
    bounces = np.arange(5)
    assert result.intervals["start"] == pytest.approx(bounces * period, abs=PRECISION)
    assert result.intervals["end"][:4] == pytest.approx(bounces[:4] * period + contact, rel=1e-11)
    assert result.apexes["height"] == pytest.approx(speed**2 / (2 * gravity), rel=PRECISION)
    energy = result.sample(np.linspace(0.0, 4.5 * period, 400)).energy.values
    assert energy == pytest.approx(speed**2, rel=ENERGY)


def test_gravity_keeps_energy_of_two_balls():
    balls, contacts = [sb.Ball(1.0), sb.Ball(0.3)], [sb.Spring(1e4), sb.Spring(3e3)]
    drop = sb.Drop(balls, contacts, [0.01], impact_speed=1.0, gravity=9.8)
    result = sb.simulate(drop, until=3.0)
    assert result.collisions.sum() > 20
    energy = result.sample(np.linspace(0.0, 3.0, 1000)).energy.values
    assert energy == pytest.approx(energy[0], rel=ENERGY)
