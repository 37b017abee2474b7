"""In a row pressed from the start, a contact that closed again began before its release."""

import stackbounce as sb


def test_touch_after_its_release():
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
