"""What balls do is a continuous function of gap, mass and speed, also where a count changes."""

import numpy as np
import pytest

import stackbounce as sb

MASSES = 0.0248, 0.101  # superballs B2 and, on it, B1: contacts reload several times
CONTACTS = {
    "Hysteretic": (sb.Hysteretic(3.6e4, restitution=0.78), sb.Hysteretic(2.2e4, restitution=0.9)),
    "Hysteretic, Hertz loading": (
        sb.Hysteretic(1e6, exponent=1.5, restitution=0.78),
        sb.Hysteretic(6e5, exponent=1.5, restitution=0.9),
    ),
    "Hysteretic, great loss": (
        sb.Hysteretic(3.6e4, restitution=0.3),
        sb.Hysteretic(2.2e4, restitution=0.2),
    ),
    "HollowBall": (sb.HollowBall(6e4, 1e-4, 0.3, 0.8), sb.HollowBall(4e4, 2e-4, 0.1, 0.95)),
    "Tabulated": (
        sb.Tabulated([0.0, 5e-4, 1e-3, 2e-3], [0.0, 9.0, 30.0, 80.0], [0.0, 4.0, 21.0, 80.0]),
        sb.Tabulated([0.0, 5e-4, 1e-3, 2e-3], [0.0, 15.0, 22.0, 50.0], restitution=0.85),
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
}
AXES = {
    "gaps.0": np.linspace(0.0, 8e-3, 10_000),
    "balls.1.mass": np.geomspace(0.005, 1.0, 10_000),
    "impact_speed": np.geomspace(0.1, 10.0, 10_000),
}
SUSPECTS = 10  # steps between neighbours that are looked at closely
FINEST = 1e-15  # of a value
JUMP = 1e-8


def outcomes(contacts, axis, values):
    """Return the rebound ratios at each value, and the number of collisions."""
    balls = [sb.Ball(mass) for mass in MASSES]
    found = sb.sweep(sb.Drop(balls, contacts, gaps=[2e-3], impact_speed=1.98), {axis: values})
    assert (found.status == sb.Status.FINISHED).all()
    return (
        found.rebound_ratio.transpose(..., "ball").values,
        found.collisions.transpose(..., "contact").values,
    )


def closed_in(contacts, axis, left, right, step):
    """Return the ends to which halving closes in on where ``step`` of the outcomes is largest."""
    while right - left > FINEST * right:
        inner = np.linspace(left, right, 9)
        if not (np.diff(inner) > 0.0).all():
            break
        j = int(np.argmax(step(*outcomes(contacts, axis, inner))))
        left, right = inner[j], inner[j + 1]
    return np.array([left, right])


def bends(ratios, _):
    return np.abs(np.diff(ratios, axis=0)).max(axis=1)


def changes(_, counts):
    return np.abs(np.diff(counts, axis=0)).max(axis=1)


def jumps(contacts, axis, values):
    """Return the jumps of the ratios where they bend most, and where a count changes."""
    ratios, counts = outcomes(contacts, axis, values)
    third = np.abs(np.diff(ratios, n=3, axis=0)).max(axis=1)
    places = [(k, k + 3, bends) for k in np.argsort(third)[-SUSPECTS:]]
    places += [(k, k + 1, changes) for k in np.flatnonzero(changes(ratios, counts))[:SUSPECTS]]
    ends = [closed_in(contacts, axis, values[i], values[j], step) for i, j, step in places]
    return [bends(*outcomes(contacts, axis, two))[0] for two in ends]


@pytest.mark.fast_cases(2)
@pytest.mark.parametrize("axis", AXES)
@pytest.mark.parametrize("law", CONTACTS)
def test_what_balls_do_is_continuous(law, axis):
    assert max(jumps(CONTACTS[law], axis, AXES[axis])) < JUMP
