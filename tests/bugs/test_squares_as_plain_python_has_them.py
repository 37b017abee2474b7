"""An integer power was a product in compiled code, but the library's power in plain Python."""

import stackbounce as sb


def test_squares_as_plain_python_has_them():
    contacts = [
        sb.PowerLaw(stiffness=5441.120604864837, exponent=1.5),
        sb.Hysteretic(
            stiffness=1320.239732465966, exponent=1.0, unloading_exponent=4.606666693466105
        ),
    ]
    drop = sb.Drop(
        [sb.Ball(1.919894650203452), sb.Ball(1.000310909634864)],
        contacts,
        [0.0011864930202191905],
        velocities=[-3.53, -3.53],
    )
    compiled = sb.simulate(drop, rtol=1e-6, compiled=True)
    plain = sb.simulate(drop, rtol=1e-6, compiled=False)
    assert compiled.rebound_speeds.tolist() == plain.rebound_speeds.tolist()
    assert compiled.intervals.tolist() == plain.intervals.tolist()
