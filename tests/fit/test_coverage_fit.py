"""Errors, intervals and draws of fits cover the truth as often as they claim."""

import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parents[2]))
from benchmarks.coverage.fit import CASES
from benchmarks.coverage.shares import covered

SEEDS = 20
QUICK = [name for name in CASES if name.startswith(("two springs", "Hysteretic", "Rigid", "a dur"))]
"""The others are left to `python -m benchmarks.coverage`."""


@pytest.mark.parametrize("case", QUICK)
def test_the_truth_lies_within_one_standard_error_in_two_of_three(case):
    """All of a case together: 0.683, give or take 0.10 for one number of so few seeds, twice."""
    assert 0.48 <= covered(CASES[case], range(SEEDS)) <= 0.88
