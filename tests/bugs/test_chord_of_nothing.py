"""The chord of a very steep curve, far below its peak, had a stiffness of exactly zero."""

import stackbounce as sb


def test_chord_of_nothing():
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
