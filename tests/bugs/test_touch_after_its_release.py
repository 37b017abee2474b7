"""A contact that opened and closed again in a row pressed from the start began before its end."""

import stackbounce as sb


def test_touch_after_its_release():
    contacts = [
        sb.HuntCrossley(0.21377870327408643, exponent=1.5, dissipation=6.778315737528866),
        sb.Spring(1.0),
        sb.Dashpot(1.0, 0.012259011407112688),
        sb.Hertz(4.749991695600879),
        sb.HuntCrossley(4.550308124366419, exponent=1.5, dissipation=4.72e-05),
        sb.Viscoelastic(1.5396590474006786, dissipative_time=7.032960482257893),
    ]
    masses = [478.8, 29.48, 0.01163, 0.0023636, 0.178, 856.2]
    drop = sb.Drop([sb.Ball(mass) for mass in masses], contacts, velocities=[-1.0] * 6)
    rows = sb.simulate(drop, rtol=1e-3, event_limit=300).intervals
    again = rows[rows["contact"] == 2]
    assert len(again) > 1
    assert (again["start"][1:] >= again["end"][:-1]).all()
