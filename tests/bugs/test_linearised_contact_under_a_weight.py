"""A chord that oscillated about a distant static state lost all digits near c = 0."""

import pytest

import stackbounce as sb


@pytest.mark.parametrize("rtol", [1e-10, 1e-12, 1e-14])
def test_faint_contact_under_a_weight(rtol):
    drop = sb.Drop([sb.Ball(1.0)], [sb.PowerLaw(1.0, 3.0)], impact_speed=1.0, gravity=0.1)
    assert sb.simulate(drop, rtol=rtol).rebound_ratios == pytest.approx([1.0], abs=10 * rtol)
