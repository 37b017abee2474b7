"""Error bars of what is found in tracks hold the truth as often as they claim."""

import pytest
from benchmarks.coverage.shares import shares
from benchmarks.coverage.track import CASES

from coverage_cases import chosen

pytestmark = pytest.mark.slow

SEEDS = range(400)  # of 200 chance alone would put one quantity in fifty outside
FEW = chosen(
    CASES,
    "track, 60 frames per second",
)


@pytest.mark.parametrize("case", FEW)
def test_the_truth_lies_within_one_sigma_in_two_of_three(case):
    for quantity, share in shares(CASES[case], SEEDS).items():
        assert 0.60 <= share.within_one <= 0.76, quantity
        assert share.within_two >= 0.90, quantity
