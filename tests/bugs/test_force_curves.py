"""Bugs of force curves: chords near the touch, steep curves, loading again."""

import numpy as np
import pytest

import stackbounce as sb


def test_chord_at_its_end():
    """A contact that opened as its chord's impulse was used up took the power law with c < 0."""
    contacts = [
        sb.Hysteretic(2.3867518529685054, unloading_exponent=14.113140652121512),
        sb.Hysteretic(13.752430358911065, exponent=2.0, unloading_exponent=3.1740939800303334),
    ]
    balls = [sb.Ball(0.04101783107005437), sb.Ball(5.559215021304943)]
    drop = sb.Drop(balls, contacts, [1.579252862619208e-07], velocities=[1.0, -1.0])
    result = sb.simulate(drop)
    assert result.status is sb.Status.FINISHED
    assert result.energy_retained < 1.0


def test_chord_of_nothing():
    """The chord of a very steep curve, far below its peak, had a stiffness of exactly zero."""
    contacts = [
        sb.Hysteretic(8.147878107134783, exponent=2.0, unloading_exponent=27.429428024480437),
        sb.Hysteretic(
            0.11140557151844332, exponent=1.9007806083872723, unloading_exponent=29.75781112989332
        ),
        sb.Hysteretic(
            0.010235149866636385, exponent=3.995126585705634, unloading_exponent=4.706292881908961
        ),
        sb.Hysteretic(1.099859658325481, unloading_exponent=75.87111295483587),
    ]
    drop = sb.Drop([sb.Ball(1.0)] * 4, contacts, velocities=[0.0, 0.0, 0.0, -1.0])
    for rtol in (1e-6, 1e-5, 1e-4):
        assert sb.simulate(drop, rtol=rtol).status is sb.Status.FINISHED


def test_graze_of_a_hysteretic_contact():
    """A hysteretic contact that turned back where it touched took an unloading curve from C = 0."""
    contacts = [
        sb.PowerLaw(26.50225539929258, 1.5),
        sb.HuntCrossley(0.0001504827645236029, 3.958067304097706, 36.46231193010815),
        sb.Hysteretic(2469.5500935628634, unloading_exponent=1.0327012734690175),
    ]
    masses = [3.4962897273085667, 0.24277295278900984, 1.0963014427598385]
    drop = sb.Drop(
        [sb.Ball(mass) for mass in masses],
        contacts,
        [1.5425199607375288, 0.0],
        velocities=[-1.0, -1.0, -1.0],
    )
    result = sb.simulate(drop, rtol=1e-6, event_limit=300)
    assert result.status is not sb.Status.INVALID
    assert result.energy_retained < 1.0


def test_faint_contact_just_past_its_end():
    """A damped contact with a compression just below 0 made a step back in time."""
    contacts = [
        sb.HuntCrossley(107265942332919.33, exponent=1.5, dissipation=159.20881242862802),
        sb.HuntCrossley(12110100.145309199, exponent=1.5, dissipation=0.059835390825705076),
    ]
    drop = sb.Drop([sb.Ball(1e-6 / 3.0)] * 2, contacts, velocities=[-1.0, -1.0])
    result = sb.simulate(drop, rtol=1e-14)
    assert result.status is sb.Status.FINISHED
    assert (result.intervals["end"] >= result.intervals["start"]).all()


@pytest.mark.parametrize("rtol", [1e-10, 1e-12, 1e-14])
def test_faint_contact_under_a_weight(rtol):
    """A chord that oscillated about a distant static state lost all digits near c = 0."""
    drop = sb.Drop([sb.Ball(1.0)], [sb.PowerLaw(1.0, 3.0)], impact_speed=1.0, gravity=0.1)
    assert sb.simulate(drop, rtol=rtol).rebound_ratios == pytest.approx([1.0], abs=10 * rtol)


def test_lossy_reloading_gains_nothing():
    """A lossy contact that came back onto its loading curve regained the energy it had lost."""
    lossy = sb.Hysteretic(2.039, exponent=1.5, unloading_exponent=6.651)
    balls = [sb.Ball(20.22), sb.Ball(16.06)]
    contacts = [lossy, sb.Dashpot(5.793, 2.855e-4)]
    drop = sb.Drop(balls, contacts, velocities=[-1.0, -1.0], gravity=1.0357)
    result = sb.simulate(drop, until=100.0)
    energy = result.sample(np.linspace(0.0, result.end_time, 2000)).energy.values
    assert np.diff(energy).max() <= 1e-9 * energy[0]


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
