"""A force that grows like c^1000 grew beyond the last terms of a step's series."""

import pytest

import stackbounce as sb


def test_steep_curve_in_one_step():
    contacts = [
        sb.Hysteretic(0.1708730320590105, unloading_exponent=142.08141226878044),
        sb.Hysteretic(0.22249416497324995, exponent=1.5, unloading_exponent=1.7262365982009555),
        sb.Hertz(75.15568001174381),
    ]
    drop = sb.Drop(
        [sb.Ball(1.0), sb.Ball(4.0), sb.Ball(0.5)],
        contacts,
        [0.5685077972075273, 0.0],
        velocities=[0.1951582606299207, 0.0, -1.0],
    )
    rough, fine, finest = (sb.simulate(drop, rtol=rtol) for rtol in (1e-6, 1e-9, 1e-13))
    assert rough.rebound_speeds == pytest.approx(finest.rebound_speeds, abs=1e-6)
    assert fine.rebound_speeds == pytest.approx(finest.rebound_speeds, abs=1e-9)
