"""Error bars of what is read off force records hold the truth as often as they claim."""

import pytest
from benchmarks.coverage.shares import shares
from benchmarks.coverage.waveform import CASES, TOLD

from coverage_cases import chosen

pytestmark = pytest.mark.slow

SEEDS, FEWER = range(220), range(100)
FEW = chosen(
    CASES,
    "any law, 30 samples",
    "hysteretic of restitution 0.9",
    "told: dashpot",
    "told: viscoelastic",
    "told: exponent 2, 10 bits",
)


@pytest.mark.parametrize("case", FEW)
def test_the_truth_lies_within_one_sigma_in_two_of_three(case):
    for quantity, share in shares(CASES[case], FEWER if case in TOLD else SEEDS).items():
        assert 0.60 <= share.within_one <= 0.76, quantity
        assert share.within_two >= 0.90, quantity
