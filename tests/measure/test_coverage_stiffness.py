"""Error bars cover the truth as often as they claim."""

from collections import defaultdict

import pytest
from benchmarks.coverage.stiffness import CASES

SEEDS = 200


@pytest.mark.fast_cases(1)
@pytest.mark.parametrize("case", CASES)
def test_the_truth_lies_within_one_standard_error_in_two_of_three(case):
    hits = defaultdict(int)
    for seed in range(SEEDS):
        for name, found, truth in CASES[case](seed):
            hits[name] += abs(found.nominal_value - truth) <= found.std_dev
    shares = {name: count / SEEDS for name, count in hits.items()}
    assert all(0.60 <= share <= 0.76 for share in shares.values()), shares
