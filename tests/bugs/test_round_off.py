"""Bugs of round-off and of numbers out of range."""

import math

import numpy as np
import pytest

import stackbounce as sb
from stackbounce.errors import ScenarioError
from stackbounce.fitting import FitProblem


def test_joined_with_a_heavy_ball():
    """Balls joined by infinitely many collisions changed a heavy ball's velocity by round-off."""
    masses = [0.004254298, 0.010710843, 0.004948328, 4748.0783, 70.136967]
    drop = sb.Drop(
        [sb.Ball(mass) for mass in masses],
        [None] + [sb.Rigid(0.0)] * 4,
        [0.0, 0.121746412, 184.568918, 0.435116550],
        velocities=[1.0, 0.0, 0.0, 0.0, 0.0],
    )
    result = sb.simulate(drop)
    momentum = math.fsum(m * v for m, v in zip(masses, result.rebound_speeds, strict=True))
    assert result.status is sb.Status.COLLAPSED
    assert momentum == pytest.approx(masses[0], rel=1e-14, abs=0.0)


def test_second_impact_after_a_long_flight():
    """Late in a run, the round-off of time exceeded that of the solution, and events alternated."""
    drop = sb.Drop(
        balls=[sb.Ball(0.1), sb.Ball(0.002)],
        contacts=[sb.Spring(1e4), sb.Spring(1e4)],
        height=1.0,
        gravity=9.81,
    )
    result = sb.simulate(drop, until=3.0)
    assert result.status is sb.Status.TIME_REACHED
    assert result.collisions.tolist() == [4, 2]
    energy = result.sample([0.0, 1.5, 3.0]).energy.values
    assert abs(energy / energy[0] - 1.0).max() < 1e-12


def test_light_ball_under_a_great_weight():
    """A very large static compression under a heavy ball cost the first microns their digits."""
    mass, gravity = 7680.765321260328, 14978.377780237126
    drop = sb.Drop(
        [sb.Ball(1.566e-06), sb.Ball(mass)],
        [sb.Spring(493506.0), sb.Spring(2632.0)],
        velocities=[-3.53, -3.53],
        gravity=gravity,
    )
    result = sb.simulate(drop, until=0.0005)
    motion = result.sample(np.linspace(0.0, 0.0005, 400))
    height = mass * gravity * np.abs(motion.position.values).max()
    assert np.ptp(motion.energy.values) < 1e-14 * height + 1e-13 * motion.energy.values[0]


@pytest.mark.parametrize("gap", [1e-3, 1e-2])
def test_noise_after_a_cannon(gap):
    """Balls at rest kept speeds of round-off, and collided again after a million years."""
    balls = [sb.Ball(1e-3 * mass) for mass in (30.0, 10.0, 5.0, 3.0, 2.0)]
    drop = sb.Drop(balls, [sb.Hertz(1e9)] * 5, [gap] * 4, impact_speed=1.0)
    result = sb.simulate(drop)
    assert result.collisions.tolist() == [1] * 5
    assert result.rebound_ratios == pytest.approx([0.0, 0.0, 0.0, 0.0, 5.0], abs=1e-11)


def test_tiny_times_stay_in_range():
    """Power series in seconds overflowed for contacts of a nanosecond.

    The restitution depends on v*^2 = 1.5 A (k/m)^(2/5) v^(1/5) alone.
    """
    tiny = sb.Drop([sb.Ball(1e-9**2.5)], [sb.Viscoelastic(1.0, 1e-10)], impact_speed=1.0)
    plain = sb.Drop([sb.Ball(1.0)], [sb.Viscoelastic(1.0, 0.1)], impact_speed=1.0)
    expected = sb.simulate(plain).rebound_ratios
    assert sb.simulate(tiny).rebound_ratios == pytest.approx(expected, rel=1e-10)


def test_a_list_of_stiffnesses_is_refused():
    """A list in place of a stiffness in N/m**exponent ended in pint's TypeError, not in words."""
    contact = {"law": "HuntCrossley", "stiffness": [1.5, "2 mm"], "exponent": 1.0, "dissipation": 0}
    drop = {"balls": [{"mass": 1.0}], "contacts": [contact], "impact_speed": 1.0}
    with pytest.raises(ScenarioError, match=r"contacts.0.stiffness.1 must be a stiffness"):
        sb.Drop.from_mapping(drop)


def test_every_sample_of_a_record_has_a_force():
    """A record whose times are not exact in binary lost samples when its times were shifted."""
    drop = sb.Drop([sb.Ball(0.057)], [sb.Spring(2.2e4)], height=1.0)
    times = np.arange(0.0, 0.01068, 2e-5)
    force = 150.0 * np.sin(np.clip((times - 0.0027) * 620.0, 0.0, np.pi))
    noisy = force + np.random.default_rng(1).normal(0.0, 0.5, len(times))
    data = {"force.0": (times, noisy)}
    objective = FitProblem(drop, data, ["contacts.0.stiffness"]).objective
    starts = np.linspace(*objective.spans[1], 50)
    for start in starts:
        (forces,) = objective.forces("", np.array([objective.spans[0, 0], start]))
        assert forces.shape == objective.measured[""].waveforms[0].times.shape


@pytest.mark.parametrize("gap", [7.601865069378338, 7.601865069378339, 7.601865069378181])
def test_a_touch_long_after_a_tie(gap):
    """A touch 1e14 contact times later began with its position's round-off as stored energy."""
    balls, springs = [sb.Ball(1.0), sb.Ball(6.0)], [sb.Spring(1.0), sb.Spring(0.2)]
    result = sb.simulate(sb.Drop(balls, springs, [gap], impact_speed=1.0))
    assert result.rebound_ratios == pytest.approx([1.0, 1.0], abs=1e-11)
    assert result.energy_retained == pytest.approx(1.0, abs=1e-12)
