"""Error bars of what is heard hold the truth as often as they claim."""

import pytest
from benchmarks.coverage.shares import shares
from benchmarks.coverage.sound import CASES
from scipy.stats import binom

from coverage_cases import chosen

UGLY = [name for name in CASES if name.startswith("ugly")]
SEEDS = {True: range(100), False: range(400)}  # of ugly recordings, and of others
POOLED = ("knock times", "flights", "restitutions")
FEW = chosen(
    CASES,
    "sound, noise and hum",
    "ugly sound, all of it, 44.1 kHz",
)


def possible(share, count):
    """Return whether a share can come from a true one of 60 to 76 %, by chance of one in a hundred.

    `count` is of independent trials.
    """
    hits = round(share * count)
    return binom.cdf(hits, count, 0.60) > 0.005 and binom.sf(hits - 1, count, 0.76) > 0.005


@pytest.mark.slow
@pytest.mark.parametrize("case", FEW)
def test_the_truth_lies_within_one_sigma_in_two_of_three(case):
    seeds = SEEDS[case in UGLY]
    for quantity, share in shares(CASES[case], seeds).items():
        if case in UGLY and quantity not in POOLED:  # one a record
            assert possible(share.within_one, len(seeds)), quantity
        else:
            assert 0.60 <= share.within_one <= 0.76, quantity
        assert share.within_two >= 0.87, quantity


@pytest.mark.parametrize("case", UGLY[::3])
def test_ugly_sound_in_a_few_recordings(case):
    # The nine knocks of a recording have about five independent errors.
    for quantity, share in shares(CASES[case], range(4)).items():
        if quantity in POOLED:
            assert possible(share.within_one, 5 * 4), quantity


def test_a_share_far_from_its_claim_is_seen():
    assert possible(0.68, 20)
    assert not possible(0.25, 20)
    assert not possible(0.55, 1000)
    assert not possible(0.80, 1000)
