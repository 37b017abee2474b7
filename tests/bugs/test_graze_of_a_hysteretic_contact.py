"""A hysteretic contact that turned back where it touched took an unloading curve from C = 0."""

import stackbounce as sb


def test_graze_of_a_hysteretic_contact():
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
