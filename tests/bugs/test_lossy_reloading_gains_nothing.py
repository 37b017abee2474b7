"""A lossy contact that came back onto its loading curve regained the energy it had lost."""

import numpy as np

import stackbounce as sb


def test_lossy_reloading_gains_nothing():
    lossy = sb.Hysteretic(2.039, exponent=1.5, unloading_exponent=6.651)
    balls = [sb.Ball(20.22), sb.Ball(16.06)]
    contacts = [lossy, sb.Dashpot(5.793, 2.855e-4)]
    drop = sb.Drop(balls, contacts, velocities=[-1.0, -1.0], gravity=1.0357)
    result = sb.simulate(drop, until=100.0)
    energy = result.sample(np.linspace(0.0, result.end_time, 2000)).energy.values
    assert np.diff(energy).max() <= 1e-9 * energy[0]
