"""Bugs of force curves: chords near the touch, steep curves, loading again."""

import numpy as np
import pytest

import stackbounce as sb


@pytest.mark.parametrize("rtol", [1e-10, 1e-12, 1e-14])
def test_faint_contact_under_a_weight(rtol):
    """A chord that oscillated about a distant static state lost all digits near c = 0."""
    drop = sb.Drop([sb.Ball(1.0)], [sb.PowerLaw(1.0, 3.0)], impact_speed=1.0, gravity=0.1)
    assert sb.simulate(drop, rtol=rtol).rebound_ratios == pytest.approx([1.0], abs=10 * rtol)


def test_steep_curve_without_a_force():
    """A lossy contact that turned on a steep curve without a force had forces of nan."""
    x = (0.0, 7.782028918825447e-06, 8.258240129118271e-06)
    force = (0.0, 0.02601113649956332, 0.026290450529335183)
    laws = [
        sb.Tabulated(x, force, unloading=(0.0, 0.013061570526707682, force[2])),
        sb.Hysteretic(23559.248428320974, restitution=0.05),
        sb.Bond(24902.980888266327, damping=0.0170163037599283),
        sb.HuntCrossley(3817924.3498970917, 1.5, dissipation=0.15546519049400043),
    ]
    mass = (0.10519654480600871, 0.16402630726019218, 0.03657033188038414, 0.31313266447978316)
    drop = sb.Drop(
        [sb.Ball(one) for one in mass],
        laws,
        gaps=[1.1126457695723777e-06, 0.0, 0.0],
        impact_speed=0.03128275786851308,
    )
    result = sb.simulate(drop)
    assert result.status is sb.Status.FINISHED
    motion = result.sample(np.linspace(0.0, result.end_time, 20))
    assert np.isfinite(motion.force.values).all()
    assert np.isfinite(motion.energy.values).all()
