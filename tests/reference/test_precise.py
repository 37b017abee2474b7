"""`precise` agrees with closed forms, with published values, with what is stored, and itself."""

import pytest
from mpmath import mp, mpf

from reference import data, precise

CLOSE = mpf(10) ** -34


def one_ball(law, **numbers):
    return precise.run([1], [{"law": law, "stiffness": 1, **numbers}], [], [-1])


@pytest.mark.parametrize("zeta", [0.01, 0.3, 0.9, 0.999999, 1, 1.000001, 1.5, 5])
def test_dashpot(zeta):
    """The force is zero when tan(omega t) = -2 zeta sqrt(1 - zeta**2) / (1 - 2 zeta**2)."""
    outcome = one_ball("Dashpot", damping=2 * mpf(zeta))
    with mp.workdps(60):
        z = mpf(zeta)
        r = mp.sqrt(abs(1 - z * z))
        if z < 1:
            time = mp.atan2(2 * z * r, 2 * z * z - 1) / r
        else:
            time = mp.log((z + r) / (z - r)) / r if r else mpf(2)
        assert abs(outcome.intervals[0].end - time) < CLOSE
        assert abs(outcome.velocities[0] - mp.exp(-z * time)) < CLOSE


@pytest.mark.fast_cases(2)
@pytest.mark.parametrize("exponent", [1, 1.5, 2.345])
@pytest.mark.parametrize("loss", [0.1, 1, 10])
def test_hunt_crossley(exponent, loss):
    """The closed form is d (1 + e) = ln[(1 + d) / (1 - d e)], d = chi v, whatever the exponent."""
    e = one_ball("HuntCrossley", exponent=exponent, dissipation=loss).velocities[0]
    with mp.workdps(60):
        d = mpf(loss)
        residual = d * (1 + e) - mp.log((1 + d) / (1 - d * e))
        slope = d - d / (1 - d * e)
        assert abs(residual / slope) < CLOSE


@pytest.mark.parametrize(
    ("scaled", "published"), [(0.09, 0.902852), (0.25, 0.760037), (0.64, 0.525371)]
)
def test_published_restitution_of_a_viscoelastic_ball(scaled, published):
    """v* = sqrt(1.5 A) at unit mass, stiffness and speed; `scaled` is its square."""
    outcome = one_ball("Viscoelastic", dissipative_time=mpf(str(scaled)) / 1.5)
    assert abs(outcome.velocities[0] - published) < 6e-7


@pytest.mark.parametrize("p", [0.5, 0.8, 1.5, 2, 3.7])
def test_power_law(p):
    """T = 2 sqrt(pi) Γ(1 + s) / Γ(1/2 + s) c_max / v with s = 1 / (p + 1)."""
    interval = one_ball("PowerLaw", exponent=p).intervals[0]
    with mp.workdps(60):
        s = 1 / (mpf(p) + 1)
        top = (1 / (2 * s)) ** s
        time = 2 * mp.sqrt(mp.pi) * mp.gamma(1 + s) / mp.gamma(mpf(1) / 2 + s) * top
        assert abs(interval.end - time) < CLOSE
        assert abs(interval.peak_compression - top) < CLOSE
        assert abs(interval.peak_force - top ** mpf(p)) < CLOSE
        assert abs(interval.impulse - 2) < CLOSE


@pytest.mark.parametrize(
    ("name", "indices"),
    [
        ("springs", range(0, 320, 32)),
        ("laws", (0, 9, 27)),
        *(
            pytest.param(name, indices, marks=pytest.mark.slow)
            for name, indices in [
                ("hysteretic", range(0, 42, 4)),
                ("laws", range(28, 148, 12)),
                ("gentle", (1, 8)),
            ]
        ),
    ],
)
def test_stored_values_come_out_again(name, indices):
    """Those of springs were found in normal modes instead."""
    rows = data.read(name)
    for row in [rows[index] for index in indices]:
        outcome = precise.run(**row["case"])
        assert [float(v) for v in outcome.velocities] == pytest.approx(
            row["rebound_speeds"], rel=1e-15, abs=1e-15
        )
        ours = sorted([i.contact, i.start, i.end] for i in outcome.intervals)
        theirs = sorted(row["intervals"])
        for a, b in zip(ours, theirs, strict=True):
            known = [float(x) for x in a if x is not None]
            expected = [x for x in b[:3] if x is not None]
            assert known == pytest.approx(expected, rel=1e-15, abs=1e-14 * row["end_time"])
