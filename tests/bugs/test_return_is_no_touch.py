"""A ball that came back after a flight counted as touching since its last release."""

import numpy as np
import pytest

import stackbounce as sb


def test_bounces_of_one_ball_under_gravity():
    drop = sb.Drop([sb.Ball(1.0)], [sb.Spring(1e4)], height=1.0, gravity=9.81)
    result = sb.simulate(drop, until=5.0)
    starts, ends = result.intervals["start"], result.intervals["end"]
    assert len(starts) == 6
    assert np.diff(starts) == pytest.approx(starts[1], abs=1e-12)
    assert ends - starts == pytest.approx(ends[0], abs=1e-12)
    assert result.apexes["height"] == pytest.approx(1.0, abs=1e-12)
