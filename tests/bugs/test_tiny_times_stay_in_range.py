"""Power series in seconds overflowed for contacts of a nanosecond."""

import pytest

import stackbounce as sb


def test_tiny_times_stay_in_range():
    """The restitution depends on v*^2 = 1.5 A (k/m)^(2/5) v^(1/5) alone."""
    tiny = sb.Drop([sb.Ball(1e-9**2.5)], [sb.Viscoelastic(1.0, 1e-10)], impact_speed=1.0)
    plain = sb.Drop([sb.Ball(1.0)], [sb.Viscoelastic(1.0, 0.1)], impact_speed=1.0)
    expected = sb.simulate(plain).rebound_ratios
    assert sb.simulate(tiny).rebound_ratios == pytest.approx(expected, rel=1e-10)
