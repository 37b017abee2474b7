"""Balls joined by infinitely many collisions changed a heavy ball's velocity by round-off."""

import math

import pytest

import stackbounce as sb


def test_joined_with_a_heavy_ball():
    masses = [0.004254298, 0.010710843, 0.004948328, 4748.0783, 70.136967]
    drop = sb.Drop(
        [sb.Ball(mass) for mass in masses],
        [None] + [sb.Rigid(0.0)] * 4,
        [0.0, 0.121746412, 184.568918, 0.435116550],
        velocities=[1.0, 0.0, 0.0, 0.0, 0.0],
    )
    result = sb.simulate(drop)
    momentum = math.fsum(m * v for m, v in zip(masses, result.rebound_speeds, strict=True))
    assert result.status is sb.Status.COLLAPSED
    assert momentum == pytest.approx(masses[0], rel=1e-14, abs=0.0)
