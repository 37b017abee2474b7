"""Plain Python raised where compiled code divides by zero, and runs ended as INVALID."""

import numpy as np
import pytest

import stackbounce as sb


@pytest.mark.parametrize("compiled", [False, True])
def test_restitution_zero(compiled):
    drop = sb.Drop([sb.Ball(1.0), sb.Ball(1.0)], [sb.Rigid(0.0), sb.Rigid(1.0)], impact_speed=1.0)
    result = sb.simulate(drop, compiled=compiled)
    assert result.status is sb.Status.FINISHED
    assert result.collisions.tolist() == [2, 1]
    assert result.rebound_speeds.tolist() == [0.0, 0.0]


@pytest.mark.parametrize("compiled", [False, True])
def test_gaps_that_vanish(compiled):
    balls = [sb.Ball(0.01), sb.Ball(0.04), sb.Ball(1.0)]
    laws = [sb.Rigid(1.0), sb.Rigid(0.452), sb.Rigid(1.0)]
    drop = sb.Drop(balls, laws, [1.0, 1.0], impact_speed=24.0)
    assert sb.simulate(drop, compiled=compiled).status is sb.Status.COLLAPSED


@pytest.mark.parametrize("compiled", [False, True])
@pytest.mark.parametrize(
    ("mass", "stiffness", "speed"), [(1e300, 1e-300, 1.0), (1e-300, 1.0, 1.0), (1.0, 1e308, 1.0)]
)
def test_numbers_out_of_range(mass, stiffness, speed, compiled):
    drop = sb.Drop([sb.Ball(mass)], [sb.Spring(stiffness)], impact_speed=speed)
    result = sb.simulate(drop, compiled=compiled)
    assert result.status is sb.Status.INVALID
    assert np.isnan(result.rebound_ratios).all()


@pytest.mark.parametrize("compiled", [False, True])
@pytest.mark.parametrize(("stiffness", "speed"), [(1.0, 1e-300), (1e80, 1e40)])
def test_a_very_slow_ball_and_a_very_fast_one(stiffness, speed, compiled):
    drop = sb.Drop([sb.Ball(1.0)], [sb.Spring(stiffness)], impact_speed=speed)
    assert sb.simulate(drop, compiled=compiled).rebound_ratios == pytest.approx([1.0], rel=1e-15)
