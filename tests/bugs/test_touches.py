"""Bugs of touches: their order, their moments and what they store."""

import numpy as np
import pytest

import stackbounce as sb


def test_slow_touch_stores_no_energy():
    """The compression at which a slow touch is noticed gave very heavy balls energy."""
    contacts = [
        sb.Hysteretic(3.764268470708638, unloading_exponent=2.0609534433666665),
        sb.Spring(1.3112434012732637),
        sb.PowerLaw(586.697294365442, 2.0),
    ]
    balls = [sb.Ball(9740.775433408135), sb.Ball(2179.866094979838), sb.Ball(0.00061856321212)]
    drop = sb.Drop(balls, contacts, [3.0586, 1.3397], velocities=[0.0, 0.0, -3.53])
    result = sb.simulate(drop, rtol=1e-3)
    assert result.status is sb.Status.FINISHED
    assert result.energy_retained < 1.0 + 1e-3


def test_touch_after_its_release():
    """In a row pressed from the start, a contact that closed again began before its release."""
    contacts = [
        sb.Spring(0.10750114962110865),
        sb.Hertz(0.9066058212129321),
        sb.Hertz(8.894798855166481),
        sb.Dashpot(7.314487662818641, damping=0.003476629928063712),
        sb.Spring(0.17527321123725637),
        sb.Spring(6.170570208276381),
    ]
    masses = [
        0.14157546541777685,
        0.007742366224901894,
        144.677843319286,
        0.0012457261529649503,
        0.007762609248202512,
        0.03797812914897937,
    ]
    drop = sb.Drop([sb.Ball(mass) for mass in masses], contacts, velocities=[-1.0] * 6)
    rows = sb.simulate(drop, rtol=1e-3, event_limit=60).intervals
    again = rows[rows["contact"] == 3]
    assert len(again) > 1
    assert (again["start"][1:] >= again["end"][:-1]).all()


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
