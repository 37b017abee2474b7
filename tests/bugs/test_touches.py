"""Bugs of touches: their moments, and what they store."""

import numpy as np
import pytest

import stackbounce as sb


@pytest.mark.parametrize("compiled", [False, True])
def test_touch_no_earlier_than_its_series(compiled):
    """A touch right after another was sought before its series in the root of time began."""
    drop = sb.Drop(
        [sb.Ball(0.10298869136359631), sb.Ball(0.5103668036097907)],
        [sb.Hertz(23.879508069101377), sb.Hertz(0.33076907380906506)],
        [3.933408239777231e-14],
        velocities=[-0.2413317459154288, -3.53],
    )
    result = sb.simulate(drop, rtol=1e-6, compiled=compiled)
    exact = sb.simulate(drop, compiled=compiled)
    assert result.status is exact.status is sb.Status.FINISHED
    assert result.collisions.tolist() == exact.collisions.tolist() == [1, 1]
    assert np.isfinite(result.intervals["start"]).all()
    assert result.rebound_speeds == pytest.approx(exact.rebound_speeds, abs=3.53e-6)


@pytest.mark.parametrize("gap", [7.601865069378338, 7.601865069378339, 7.601865069378181])
def test_a_touch_long_after_a_tie(gap):
    """A touch 1e14 contact times later began with its position's round-off as stored energy."""
    balls, springs = [sb.Ball(1.0), sb.Ball(6.0)], [sb.Spring(1.0), sb.Spring(0.2)]
    result = sb.simulate(sb.Drop(balls, springs, [gap], impact_speed=1.0))
    assert result.rebound_ratios == pytest.approx([1.0, 1.0], abs=1e-11)
    assert result.energy_retained == pytest.approx(1.0, abs=1e-12)
