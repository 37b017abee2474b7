"""`precise` agrees with closed forms, with published values, with the other references, itself."""

import itertools
import json

import pytest
from mpmath import mp, mpf

from reference import make_data, make_gentle, make_laws, precise, springs, taylor

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


@pytest.mark.fast_cases(2)
@pytest.mark.parametrize(
    ("law", "numbers", "published"),
    [
        ("Dashpot", {"damping": mpf("0.2")}, 0.744079),
        ("Dashpot", {"damping": mpf("0.6")}, 0.450975),
        ("HuntCrossley", {"exponent": 1.5, "dissipation": mpf("0.1")}, 0.937476),
        ("HuntCrossley", {"exponent": 1.5, "dissipation": mpf("0.3")}, 0.832870),
        ("HuntCrossley", {"exponent": 1.5, "dissipation": 1}, 0.593624),
        ("Viscoelastic", {"dissipative_time": mpf("0.09") / 1.5}, 0.902852),
        ("Viscoelastic", {"dissipative_time": mpf("0.25") / 1.5}, 0.760037),
        ("Viscoelastic", {"dissipative_time": mpf("0.64") / 1.5}, 0.525371),
    ],
)
def test_published_restitution(law, numbers, published):
    """v* = sqrt(1.5 A) at unit mass, stiffness and speed."""
    assert abs(one_ball(law, **numbers).velocities[0] - published) < 6e-7


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


SLOW = pytest.param("hysteretic", marks=pytest.mark.slow)


@pytest.mark.parametrize("name", ["springs", SLOW])
def test_other_references(name):
    rows = make_data.read(name)
    for row in rows[:: len(rows) // 10]:
        outcome = precise.run(**make_data.with_names(row["case"]))
        assert [float(v) for v in outcome.velocities] == pytest.approx(
            row["rebound_speeds"], rel=1e-15, abs=1e-15
        )
        ours = sorted([i.contact, float(i.start), float(i.end)] for i in outcome.intervals)
        theirs = sorted(i[:3] for i in row["intervals"])
        for a, b in zip(ours, theirs, strict=True):
            assert a == pytest.approx(b, rel=1e-15, abs=1e-14 * row["end_time"])


def test_springs_leaves_tall_stacks_to_precise():
    """The ninth of touching balls moves as t**17 at first, beyond the orders that it looks at."""
    with pytest.raises(ValueError, match="there are 9 balls"):
        springs.run([1] * 9, [1] * 9, [0] * 8, [-1] * 9)


MIXED = {
    "masses": [1, 0.3, 0.8],
    "contacts": [
        {"law": "Viscoelastic", "stiffness": 1, "dissipative_time": 0.3},
        {"law": "HuntCrossley", "stiffness": 2, "exponent": 1.3, "dissipation": 0.5},
        {"law": "Hysteretic", "stiffness": 0.7, "exponent": 1.5, "restitution": 0.6},
    ],
    "gaps": [0, 0.2],
    "velocities": [-1, -1, -1],
}


@pytest.mark.slow
def test_steps_and_neglected_forces_do_not_matter(monkeypatch):
    one = precise.run(**MIXED)
    monkeypatch.setattr(taylor, "TERMS", 70)
    monkeypatch.setattr(taylor, "PRECISION", -140)
    monkeypatch.setattr(taylor, "CONVERGED", -20)
    monkeypatch.setattr(precise, "NEGLECTED", mpf(10) ** -42)
    monkeypatch.setattr(precise, "LEAST", mpf(10) ** -43)
    other = precise.run(**MIXED)
    for a, b in zip(one.velocities, other.velocities, strict=True):
        assert abs(a - b) < CLOSE
    for a, b in zip(one.intervals, other.intervals, strict=True):
        assert a.contact == b.contact
        for name in ("start", "end", "peak_force", "peak_compression", "impulse"):
            assert abs(getattr(a, name) - getattr(b, name)) < CLOSE


@pytest.mark.slow
def test_momentum_and_impulses():
    floor = precise.run(**MIXED)
    free = precise.run(
        **{**MIXED, "contacts": [None, *MIXED["contacts"][1:]], "velocities": [1, 0, -1]}
    )
    with mp.workdps(60):
        m = [mpf(x) for x in MIXED["masses"]]
        pushed = sum(i.impulse for i in floor.intervals if i.contact == 0)
        after = sum(a * v for a, v in zip(m, floor.velocities, strict=True))
        assert abs(after + sum(m) - pushed) < CLOSE
        after = sum(a * v for a, v in zip(m, free.velocities, strict=True))
        assert abs(after - (m[0] - m[2])) < CLOSE


def test_data_file_is_what_the_script_writes():
    stored = make_data.read("laws")
    assert [row["case"] for row in stored[:28]] == list(make_laws.one_ball())
    for index in (0, 9, 27):
        row = stored[index]
        assert row == json.loads(
            make_data.row(row["case"], make_laws.solve(row["case"]), make_laws.DIGITS)
        )


@pytest.mark.slow
def test_data_file_of_gentle_contacts_is_what_the_script_writes():
    stored = make_data.read("gentle")
    assert [row["case"] for row in stored[:2]] == list(itertools.islice(make_gentle.pairs(), 2))
    solved = make_laws.solve(stored[1]["case"])
    assert stored[1] == json.loads(make_data.row(stored[1]["case"], solved, make_laws.DIGITS))
