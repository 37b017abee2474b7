"""Errors, intervals and draws of fits cover the truth as often as they claim."""

import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parents[2]))
from benchmarks.coverage.fit import CASES
from benchmarks.coverage.shares import covered

SEEDS = 12


@pytest.mark.parametrize("case", CASES)
def test_the_truth_lies_within_one_standard_error_in_two_of_three(case):
    """All of a case together: 0.683, give or take two or three times 0.13 for so few seeds."""
    assert 0.40 <= covered(CASES[case], range(SEEDS)) <= 0.95
