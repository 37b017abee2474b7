"""The compression at which a slow touch is noticed gave very heavy balls energy."""

import stackbounce as sb


def test_slow_touch_stores_no_energy():
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
