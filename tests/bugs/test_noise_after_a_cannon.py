"""Balls at rest kept speeds of round-off, and collided again after a million years."""

import pytest

import stackbounce as sb


@pytest.mark.parametrize("gap", [1e-3, 1e-2])
def test_noise_after_a_cannon(gap):
    balls = [sb.Ball(1e-3 * mass) for mass in (30.0, 10.0, 5.0, 3.0, 2.0)]
    drop = sb.Drop(balls, [sb.Hertz(1e9)] * 5, [gap] * 4, impact_speed=1.0)
    result = sb.simulate(drop)
    assert result.collisions.tolist() == [1] * 5
    assert result.rebound_ratios == pytest.approx([0.0, 0.0, 0.0, 0.0, 5.0], abs=1e-11)
