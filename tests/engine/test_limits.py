"""Limits in which the models agree: stiff floors, wide gaps, restitution 1."""

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

import stackbounce as sb
from drops import rigid, springs

PRECISION = 1e-11


def overlapping(result):
    """Return whether two contacts were closed at one time."""
    rows = result.intervals
    return bool((rows["start"][1:] < np.maximum.accumulate(rows["end"])[:-1]).any())


@pytest.mark.parametrize("lower", [10.0, 3.0, 2.0, 1.0])
def test_stiff_floor_meets_separate_collisions(lower):
    """The remaining difference falls with the square root of the stiffness ratio."""
    separate = sb.simulate(rigid([lower, 1.0])).rebound_ratios
    errors = [
        np.abs(sb.simulate(springs([lower, 1.0], [ratio, 1.0])).rebound_ratios - separate).max()
        for ratio in (1e4, 1e6, 1e8, 1e10)
    ]
    orders = -np.diff(np.log10(errors)) / 2
    assert errors[-1] < 1e-4
    assert orders == pytest.approx(0.5, abs=0.05) or (orders > 0.45).all()


@given(
    masses=st.lists(st.floats(-1, 1).map(lambda x: 10**x), min_size=1, max_size=4),
    stiffness=st.floats(0.2, 5.0),
    gap=st.floats(3.0, 50.0),
)
@example(masses=[1.0, 1.000000002302585], stiffness=3.0, gap=10.0)  # a touch 2e9 times later
def test_disjoint_contacts_meet_rigid_collisions(masses, stiffness, gap):
    """Where no two springs are compressed at one time, each contact is a collision with e = 1."""
    gaps = [gap * (i + 1) ** 2 for i in range(len(masses) - 1)]
    soft = sb.simulate(springs(masses, [stiffness**i for i in range(len(masses))], gaps))
    if overlapping(soft):
        return
    hard = sb.simulate(rigid(masses, gaps=gaps))
    if soft.intervals["contact"].tolist() != hard.intervals["contact"].tolist():
        return  # contacts that last change who comes first
    assert soft.rebound_ratios == pytest.approx(hard.rebound_ratios, abs=PRECISION)
    assert soft.intervals["impulse"] == pytest.approx(hard.intervals["impulse"], rel=1e-9)


@pytest.mark.parametrize("gap", [20.0, 20.5, 33.0])
def test_tie_at_the_end_on_springs(gap):
    """m2/m1 = 3, wide gap: five contacts, then both leave with v1 = v2 = 1."""
    result = sb.simulate(springs([1.0, 3.0], [1.0, 1.0], [gap]))
    assert result.collisions.tolist() == [3, 2]
    assert result.rebound_ratios == pytest.approx([1.0, 1.0], abs=PRECISION)
    assert result.status is sb.Status.FINISHED


@pytest.mark.parametrize(("masses", "gap"), [((1.0, 1.0), 0.0), ((4.0, 1.0), 0.4), ((1.0, 6.0), 1)])
def test_hysteretic_meets_springs(masses, gap):
    """With restitution 1 they are springs; 1 - e away from it the difference is of first order."""
    balls = [sb.Ball(m) for m in masses]

    def ratios(e):
        laws = [sb.Hysteretic(k, restitution=e) for k in (1.0, 0.5)]
        return sb.simulate(sb.Drop(balls, laws, [gap], impact_speed=1.0)).rebound_ratios

    exact = sb.simulate(springs(masses, [1.0, 0.5], [gap])).rebound_ratios
    assert ratios(1.0) == pytest.approx(exact, abs=1e-12)
    errors = [np.abs(ratios(1 - step) - exact).max() for step in (1e-2, 1e-3, 1e-4, 1e-5)]
    assert -np.diff(np.log10(errors)) == pytest.approx(1.0, abs=0.05)


def test_light_upper_ball_does_not_disturb_the_lower_one():
    result = sb.simulate(springs([1.0, 1e-9], [1.0, 1.0]))
    assert result.rebound_ratios[0] == pytest.approx(1.0, abs=1e-8)
    assert result.intervals["end"].max() == pytest.approx(np.pi, abs=1e-3)
