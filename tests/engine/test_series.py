"""Bounds of power series next to their values on a grid."""

import math

import numpy as np
import pytest
from kernel_build.jit import compile_kernel

from stackbounce.engine.series import evaluate, lower_bound

RNG = np.random.default_rng(4)
SERIES = [(RNG.normal(size=n + 1) * 0.7 ** np.arange(n + 1), n) for n in range(1, 25)]
SERIES += [(np.abs(a) * (-1.0) ** np.arange(n + 1), n) for a, n in SERIES]


@pytest.mark.parametrize("limit", [1e-3, 0.3, 1.0])
@pytest.mark.parametrize("low", [0, 1])
def test_a_series_is_never_below_its_bound(low, limit):
    for a, n in SERIES:
        bound = lower_bound(list(a), low, n, limit)
        least = min(evaluate(list(a[low:]), n - low, s) for s in np.linspace(0.0, limit, 101))
        assert bound <= least + 1e-12
        assert compile_kernel(lower_bound)(a, low, n, limit) == bound


def test_the_bound_is_sharp_for_a_parabola_that_falls():
    assert lower_bound([1.0, -0.5, -0.25], 0, 2, 1.0) == 0.25


@pytest.mark.parametrize("place", [0, 1, 2])
def test_a_lost_number_is_handed_on(place):
    a = np.array([1.0, 2.0, 3.0])
    a[place] = math.nan
    assert math.isnan(lower_bound(list(a), 0, 2, 0.5))
    assert math.isnan(compile_kernel(lower_bound)(a, 0, 2, 0.5))
