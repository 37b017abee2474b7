"""A reloaded contact with no loss, or almost none, took an unloading curve made of round-off."""

import pytest

import stackbounce as sb


def test_reloading_without_loss():
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


def test_reloading_too_slow_to_matter():
    """Far below the tolerance the loading curve's chord holds more than the curve."""
    contacts = [
        sb.Hysteretic(1.045e-08, exponent=2.0, unloading_exponent=9.328),
        sb.Spring(140.73455664736213),
        sb.Hertz(4.661040152669029e-07),
    ]
    balls = [sb.Ball(1.0 / 3.0), sb.Ball(1.0 / 3.0), sb.Ball(1.0)]
    drop = sb.Drop(balls, contacts, velocities=[1000.0, 0.0, 0.0])
    for rtol in (1e-5, 1e-7, 1e-9):
        result = sb.simulate(drop, rtol=rtol, event_limit=300)
        assert result.status is sb.Status.FINISHED
        assert result.energy_retained < 1.0
