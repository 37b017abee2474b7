"""The chord that replaces c^p near 0 was too long where soft neighbours press slowly."""

import pytest

import stackbounce as sb
from reference import precise

pytestmark = pytest.mark.slow

MASSES = [1.0] * 5
GAPS = [1.8153721755463523, 0.0, 0.0, 1.214885533625822]
VELOCITIES = [1.0, 0.0, 0.0, 0.0, 0.0]
CONTACTS = [
    {"law": "HuntCrossley", "stiffness": 0.4456, "exponent": 2.0, "dissipation": 3.094},
    {"law": "PowerLaw", "stiffness": 0.2637, "exponent": 1.5},
    {"law": "Hertz", "stiffness": 33631.0},
    {"law": "Spring", "stiffness": 1.593},
    {"law": "Hysteretic", "stiffness": 0.03104, "exponent": 1.0, "unloading_exponent": 1.0},
]


def test_slow_push_among_stiff_contacts():
    reference = precise.run(MASSES, CONTACTS, GAPS, VELOCITIES)
    speeds = [float(v) for v in reference.velocities]
    contacts = [
        getattr(sb, law["law"])(**{k: v for k, v in law.items() if k != "law"}) for law in CONTACTS
    ]
    drop = sb.Drop([sb.Ball(mass) for mass in MASSES], contacts, GAPS, velocities=VELOCITIES)
    for rtol in (1e-6, 1e-9, 1e-12):
        result = sb.simulate(drop, rtol=rtol)
        assert result.collisions.tolist() == reference.counts(5)
        assert result.rebound_speeds == pytest.approx(speeds, rel=0.0, abs=50.0 * rtol)
