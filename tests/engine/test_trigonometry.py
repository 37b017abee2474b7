"""Cosine and sine without branches, compared with the standard library's."""

import math

import numpy as np
import pytest

from stackbounce.engine.trigonometry import cosine, half_turns, nudge_mode, sinc

ROUNDING = 5e-16  # of numbers up to 1, with the standard library's own


def test_polynomials_begin_as_taylor_series():
    assert cosine(0.0) == sinc(0.0) == 1.0
    for x in (1e-9, 1e-7, 1e-3):
        assert cosine(x * x) == pytest.approx(math.cos(x), rel=2.3e-16, abs=0.0)
        assert x * sinc(x * x) == pytest.approx(math.sin(x), rel=2.3e-16, abs=0.0)


def test_half_turns():
    for x in np.linspace(-70.0, 70.0, 2001).tolist():
        sign, angle = half_turns(x)
        assert abs(angle) <= 0.5 * math.pi * (1.0 + 1e-15)
        assert abs(sign * cosine(angle * angle) - math.cos(x)) <= ROUNDING
        assert abs(sign * (angle * sinc(angle * angle)) - math.sin(x)) <= ROUNDING


@pytest.mark.parametrize("omega", [0.0, 0.3, 1.0, 16.0])
def test_nudged(omega):
    for angle in np.linspace(-0.01, 0.01, 201).tolist():
        d = angle / max(omega, 1.0)
        y, z = nudge_mode(omega, d, 0.6, -0.8)
        travel = math.sin(omega * d) / omega if omega else d
        assert abs(y - (0.6 * math.cos(omega * d) - 0.8 * travel)) <= ROUNDING
        rate = -0.8 * math.cos(omega * d) - 0.6 * omega * math.sin(omega * d)
        assert abs(z - rate) <= ROUNDING * max(omega, 1.0)
