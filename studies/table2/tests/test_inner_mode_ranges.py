"""What the study's page says of inner vibrations, recomputed."""

import pytest
from studies.table2 import inner_mode_ranges, inputs
from studies.table2.energy import bound_energy
from studies.table2.inner_mode import bounce_alone
from studies.table2.inner_mode_ranges import RANGES, find_modes, study_inner_modes


@pytest.fixture(scope="module")
def modes():
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(inner_mode_ranges, "_STEPS", 3)
        return study_inner_modes()


def test_every_pair_and_range_is_there(modes):
    assert [(one.pair, one.low, one.high) for one in modes.ranges] == [
        (pair, *ends) for pair in inputs.PAIRS for ends in RANGES
    ]
    for one in modes.ranges:
        assert one.least_excess <= one.most_excess
        assert 0.0 < one.most_left < 1.0


def test_only_a_slow_vibration_breaks_the_bound(modes):
    assert modes.slow > 0.2
    assert 0.0 < modes.fast < 0.006
    assert all(one.least_excess > -0.01 for one in modes.of_range(5.0))
    assert all(one.most_left < 0.011 for one in modes.of_range(5.0))
    assert max(one.most_excess for one in modes.of_range(3.0)) > 0.04


def test_modes_that_are_found_give_the_restitution():
    found = find_modes(inputs.PRINTED["B1"])
    assert len(found) == 5
    for ratio, share in found:
        assert bounce_alone(ratio, share) == pytest.approx(0.78, abs=1e-6)
    assert find_modes(0.3) == []


def test_a_vibration_that_explains_b1_can_exceed_the_bound_by_any_measured_amount(modes):
    """Energy alone does not exclude it; it exceeds the measured energy in some rows only."""
    for pair in ("B2_on_B1", "B3_on_B1"):
        bound = bound_energy(pair)
        measured = modes.measured[pair]
        assert measured == pytest.approx(bound.measured - bound.printed)
        found = [one.excess for one in modes.alone if one.pair == pair]
        assert min(found) < measured < max(found)
        lower, upper = inputs.read_ratios(pair)
        for one in modes.alone:
            if one.pair == pair:
                assert max(abs(one.first - lower), abs(one.second - upper)) > inputs.ERROR
    assert modes.beyond == 6
    assert modes.as_dict()["alone"][0]["excess"] == modes.alone[0].excess
