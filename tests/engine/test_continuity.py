"""The energy retained is a continuous function of the gap, whatever the law."""

import numpy as np
import pytest

import stackbounce as sb

MASSES = (0.0248, 0.101)  # superballs B2 and, on it, B1: contacts reload several times
CONTACTS = {
    "lossy": (
        sb.Hysteretic(3.6e4, restitution=0.78, reloading="lossy"),
        sb.Hysteretic(2.2e4, restitution=0.9, reloading="lossy"),
    ),
    "lossy, Hertz loading": (
        sb.Hysteretic(1e6, exponent=1.5, restitution=0.78, reloading="lossy"),
        sb.Hysteretic(6e5, exponent=1.5, restitution=0.9, reloading="lossy"),
    ),
    "Spring": (sb.Spring(3.6e4), sb.Spring(2.2e4)),
    "Dashpot": (sb.Dashpot(3.6e4, 5.0), sb.Dashpot(2.2e4, 2.0)),
    "PowerLaw": (sb.PowerLaw(2e5, 1.3), sb.PowerLaw(1e5, 1.3)),
    "Hertz": (sb.Hertz(1e6), sb.Hertz(6e5)),
    "Viscoelastic": (sb.Viscoelastic(1e6, 1e-4), sb.Viscoelastic(6e5, 5e-5)),
    "HuntCrossley": (sb.HuntCrossley(1e6, 1.5, 0.2), sb.HuntCrossley(6e5, 1.5, 0.1)),
    "StandardLinearSolid": (
        sb.StandardLinearSolid(3e4, 0.6, 5e-4),
        sb.StandardLinearSolid(2e4, 0.4, 1e-3),
    ),
    "free": (
        sb.Hysteretic(3.6e4, restitution=0.78),
        sb.Hysteretic(2.2e4, restitution=0.9),
    ),
}
SUSPECTS = 10  # steps between neighbouring gaps that are looked at closely
FINEST = 1e-15  # m


def energies(contacts, gaps):
    """Return the energy retained, and the number of collisions, for each gap in m."""
    balls = [sb.Ball(mass) for mass in MASSES]
    drop = sb.Drop(balls, contacts, gaps=[0.0], impact_speed=1.98)
    found = sb.sweep(drop, {"gaps.0": gaps})
    return found.energy_retained.values, found.collisions.transpose(..., "contact").values


def largest_jump(contacts, count):
    """Return the largest jump of the energy retained between gaps of 0 to 8 mm.

    The steps that differ most from their neighbours are halved until a jump is all that is left.
    """
    gaps = np.linspace(0.0, 8e-3, count)
    energy, _ = energies(contacts, gaps)
    bends = np.abs(np.diff(energy, n=3))
    largest = 0.0
    for k in np.argsort(bends)[-SUSPECTS:]:
        left, right = gaps[k], gaps[k + 3]
        while right - left > FINEST:
            inner = np.linspace(left, right, 9)
            if not (np.diff(inner) > 0.0).all():
                break
            steps = np.abs(np.diff(energies(contacts, inner)[0]))
            j = int(np.argmax(steps))
            left, right = inner[j], inner[j + 1]
        (before, after), (one, other) = energies(contacts, np.array([left, right]))
        if (one == other).all():
            largest = max(largest, abs(after - before))
    return largest


@pytest.mark.fast_cases(2)
@pytest.mark.parametrize("law", CONTACTS)
def test_energy_is_continuous_in_the_gap(law):
    assert largest_jump(CONTACTS[law], 10_000) < 1e-9
