"""Error bars hold the truth as often as they claim: an accelerometer that bounced."""

import pytest
from benchmarks.coverage.accelerometer import CASES
from benchmarks.coverage.shares import shares

SEEDS = range(300)


@pytest.mark.fast_cases(1)
@pytest.mark.parametrize("case", CASES)
def test_the_truth_lies_within_one_sigma_in_two_of_three(case):
    for quantity, share in shares(CASES[case], SEEDS).items():
        assert 0.60 <= share.within_one <= 0.76, quantity
        assert share.within_two >= 0.90, quantity
