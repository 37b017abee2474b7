"""Error bars cover the truth as often as they claim: track."""

import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parents[2]))
from benchmarks.coverage.shares import covered
from benchmarks.coverage.track import CASES

SEEDS = range(200)


@pytest.mark.parametrize("name", CASES)
def test_one_sigma_covers_two_thirds(name):
    assert 0.60 <= covered(CASES[name], SEEDS) <= 0.76
