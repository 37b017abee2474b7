"""A damped contact with a compression just below 0 made a step back in time."""

import stackbounce as sb


def test_faint_contact_just_past_its_end():
    contacts = [
        sb.HuntCrossley(107265942332919.33, exponent=1.5, dissipation=159.20881242862802),
        sb.HuntCrossley(12110100.145309199, exponent=1.5, dissipation=0.059835390825705076),
    ]
    drop = sb.Drop([sb.Ball(1e-6 / 3.0)] * 2, contacts, velocities=[-1.0, -1.0])
    result = sb.simulate(drop, rtol=1e-14)
    assert result.status is sb.Status.FINISHED
    assert (result.intervals["end"] >= result.intervals["start"]).all()
