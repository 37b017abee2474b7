"""Errors, intervals and draws of fits cover the truth as often as they claim."""

from functools import partial

import pytest
from benchmarks.coverage.fit import CASES
from benchmarks.coverage.shares import shares

from coverage_cases import chosen

pytestmark = pytest.mark.slow

FEW = chosen(CASES, "two springs with a gap")
"""All intervals and draws are left to `python -m benchmarks.coverage`."""


@pytest.mark.parametrize("case", FEW)
def test_the_truth_lies_within_one_standard_error_in_two_of_three(case):
    """Each number alone: 60 to 76 %, the spread of a share over so many seeds being 3 %."""
    for quantity, share in shares(partial(CASES[case], whole=False), range(200)).items():
        assert 0.60 <= share.within_one <= 0.76, quantity
