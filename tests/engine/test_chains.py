"""Rows of equal balls, of which the first strikes the others: known results.

The page on towers shows how a cradle breaks up, and the solitary wave of a long chain.
"""

import functools
import math

import numpy as np
import pytest
from scipy.special import jn_zeros, jv

import stackbounce as sb
from reference import precise

LAWS = {"Spring": sb.Spring(1.0), "Hertz": sb.Hertz(1.0)}
finite = pytest.mark.parametrize("law", LAWS)


@functools.cache
def row(law, count, speed=1.0, gap=0.0):
    """Return the run of a row of balls of mass 1, the first of which has a speed."""
    contact = LAWS.get(law) or sb.Rigid(1.0)
    return sb.simulate(
        sb.Drop(
            [sb.Ball(1.0)] * count,
            [None] + [contact] * (count - 1),
            gaps=[gap] * (count - 1),
            velocities=[speed] + [0.0] * (count - 1),
        )
    )


@pytest.mark.slow
@finite
def test_cradle_against_thirty_digits(law):
    contact = {"law": law, "stiffness": 1}
    exact = precise.run([1] * 5, [None] + [contact] * 4, [0] * 4, [1, 0, 0, 0, 0])
    result = row(law, 5)
    assert result.collisions.tolist() == exact.counts(5) == [0, 1, 1, 1, 1]
    assert result.rebound_speeds == pytest.approx([float(v) for v in exact.velocities], abs=1e-11)
    ends = sorted(float(interval.end) for interval in exact.intervals)
    assert sorted(result.intervals["end"]) == pytest.approx(ends, rel=1e-10)


@pytest.mark.parametrize("gap", [0.0, 1.0])
@pytest.mark.parametrize("count", [2, 5, 50])
def test_rigid_cradle_hands_on_the_velocity(count, gap):
    result = row("Rigid", count, speed=0.3, gap=gap)
    assert result.rebound_speeds.tolist() == [0.0] * (count - 1) + [0.3]
    assert result.collisions.tolist() == [0] + [1] * (count - 1)


@finite
@pytest.mark.parametrize("count", [5, 30, 300, 1000])
def test_momentum_and_energy_are_kept(law, count):
    result = row(law, count)
    assert result.status is sb.Status.FINISHED
    assert result.collisions.tolist() == [0] + [1] * (count - 1)
    assert (result.intervals["start"] == 0.0).all()
    assert math.fsum(result.rebound_speeds) == pytest.approx(1.0, abs=1e-12)
    assert result.energy_retained == pytest.approx(1.0, abs=1e-11)


def test_spring_row_is_bessel_functions_until_it_breaks():
    """v_n = J_2n(2t) + J_2n+2(2t) in a long row, until its first contact opens at a zero of J_2.

    The force at contact n is the time integral of v_(n-1) - v_n, or 4n J_2n(2t) / (2t).
    """
    result, n = row("Spring", 40), np.arange(40)
    release = 0.5 * jn_zeros(2, 1)[0]
    assert result.intervals["end"].min() == pytest.approx(release, rel=1e-12)
    times = np.linspace(0.1, release, 9)
    found = result.sample(times)
    for j, t in enumerate(times):
        velocities = jv(2 * n, 2 * t) + jv(2 * n + 2, 2 * t)
        assert found.velocity.values[:, j] == pytest.approx(velocities, abs=1e-13)
        forces = 2 * n[1:] * jv(2 * n[1:], 2 * t) / t
        assert found.force.values[1:, j] == pytest.approx(forces, abs=1e-13)
