"""A touch right after another was sought before its series in the root of time began."""

import numpy as np
import pytest

import stackbounce as sb


@pytest.mark.parametrize("compiled", [False, True])
def test_touch_no_earlier_than_its_series(compiled):
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
