"""Error bars of what is heard hold the truth as often as they claim."""

import pytest
from benchmarks.coverage.shares import shares
from benchmarks.coverage.sound import CASES

from coverage_cases import chosen

pytestmark = pytest.mark.slow

SEEDS = range(400)
FEW = chosen(
    CASES,
    "sound, noise and hum",
)


@pytest.mark.parametrize("case", FEW)
def test_the_truth_lies_within_one_sigma_in_two_of_three(case):
    for quantity, share in shares(CASES[case], SEEDS).items():
        assert 0.60 <= share.within_one <= 0.76, quantity
        assert share.within_two >= 0.87, quantity
