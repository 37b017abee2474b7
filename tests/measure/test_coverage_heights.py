"""Error bars cover the truth as often as they claim: heights."""

import pytest
from benchmarks.coverage.heights import CASES
from benchmarks.coverage.shares import covered

SEEDS = range(1000)


@pytest.mark.parametrize("name", CASES)
def test_one_sigma_covers_two_thirds(name):
    assert 0.60 <= covered(CASES[name], SEEDS) <= 0.76
