"""Bugs of force curves: chords near the touch, steep curves, loading again."""

import numpy as np
import pytest

import stackbounce as sb


@pytest.mark.parametrize("rtol", [1e-10, 1e-12, 1e-14])
def test_faint_contact_under_a_weight(rtol):
    """A chord that oscillated about a distant static state lost all digits near c = 0."""
    drop = sb.Drop([sb.Ball(1.0)], [sb.PowerLaw(1.0, 3.0)], impact_speed=1.0, gravity=0.1)
    assert sb.simulate(drop, rtol=rtol).rebound_ratios == pytest.approx([1.0], abs=10 * rtol)


def test_steep_curve_in_one_step():
    """A force that grows like c^1000 grew beyond the last terms of a step's series."""
    contacts = [
        sb.Hysteretic(0.1708730320590105, unloading_exponent=142.08141226878044),
        sb.Hysteretic(0.22249416497324995, exponent=1.5, unloading_exponent=1.7262365982009555),
        sb.Hertz(75.15568001174381),
    ]
    drop = sb.Drop(
        [sb.Ball(1.0), sb.Ball(4.0), sb.Ball(0.5)],
        contacts,
        [0.5685077972075273, 0.0],
        velocities=[0.1951582606299207, 0.0, -1.0],
    )
    rough, fine, finest = (sb.simulate(drop, rtol=rtol) for rtol in (1e-6, 1e-9, 1e-13))
    assert rough.rebound_speeds == pytest.approx(finest.rebound_speeds, abs=1e-6)
    assert fine.rebound_speeds == pytest.approx(finest.rebound_speeds, abs=1e-9)


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


def test_reloading_without_loss():
    """A reloaded contact with no loss took an unloading curve made of round-off."""
    contacts = [
        sb.Hysteretic(36.501, exponent=2.0, unloading_exponent=2.0),
        sb.Spring(26.91283690861319),
    ]
    drop = sb.Drop(
        [sb.Ball(0.22009918560764596), sb.Ball(15.623389984193086)],
        contacts,
        [0.6952327150037606],
        velocities=[-1.0, -1.0],
    )
    result = sb.simulate(drop)
    same = sb.simulate(
        sb.Drop(
            drop.balls,
            [sb.PowerLaw(36.501, 2.0), contacts[1]],
            drop.gaps,
            velocities=drop.velocities,
        )
    )
    assert result.status is sb.Status.FINISHED
    assert result.rebound_speeds == pytest.approx(same.rebound_speeds, abs=1e-10)
