"""A touch 1e14 contact times later began with its position's round-off as stored energy."""

import pytest

import stackbounce as sb


@pytest.mark.parametrize("gap", [7.601865069378338, 7.601865069378339, 7.601865069378181])
def test_a_touch_long_after_a_tie(gap):
    balls, springs = [sb.Ball(1.0), sb.Ball(6.0)], [sb.Spring(1.0), sb.Spring(0.2)]
    result = sb.simulate(sb.Drop(balls, springs, [gap], impact_speed=1.0))
    assert result.rebound_ratios == pytest.approx([1.0, 1.0], abs=1e-11)
    assert result.energy_retained == pytest.approx(1.0, abs=1e-12)
