"""Error bars of all analyses hold the truth as often as they claim."""

from collections.abc import Mapping
from typing import NamedTuple

import pytest
from benchmarks.coverage import accelerometer, heights, press, sound, stiffness, track, waveform
from benchmarks.coverage.shares import Trial, covered, shares

from coverage_cases import chosen
from measure.near import possible

TOLD = {name: trial for name, trial in waveform.CASES.items() if name in waveform.TOLD}
APART = {*TOLD, *waveform.HUMMING}
UNTOLD = {name: trial for name, trial in waveform.CASES.items() if name not in APART}
UGLY = [name for name in sound.CASES if name.startswith("ugly")]
POOLED = ("knock times", "flights", "restitutions")


class Analysis(NamedTuple):
    """Cases, those that each run of the tests counts, how often, and how many of them are fast."""

    cases: Mapping[str, Trial]
    few: tuple[str, ...]
    seeds: int
    fast: int = 0


ANALYSES = (
    Analysis(accelerometer.CASES, tuple(accelerometer.CASES), 300, fast=1),
    Analysis(stiffness.CASES, tuple(stiffness.CASES), 200, fast=1),
    Analysis(press.CASES, ("noise that remembers", "coarse digits"), 200),
    Analysis(track.CASES, ("track, 60 frames per second",), 400),  # of 200 one in fifty is outside
    Analysis(UNTOLD, ("hysteretic of restitution 0.9",), 160),
    Analysis(waveform.HUMMING, (), 150),
    Analysis(TOLD, ("told: dashpot",), 100),
)


def cases_of(analysis):
    for k, name in enumerate(chosen(analysis.cases, *analysis.few)):
        marks = [] if k < analysis.fast else [pytest.mark.slow]
        yield pytest.param(analysis.cases[name], analysis.seeds, marks=marks, id=name)


@pytest.mark.parametrize(
    ("trial", "seeds"), [case for analysis in ANALYSES for case in cases_of(analysis)]
)
def test_the_truth_lies_within_one_sigma_in_two_of_three(trial, seeds):
    for quantity, share in shares(trial, range(seeds)).items():
        assert 0.60 <= share.within_one <= 0.76, quantity
        assert share.within_two >= 0.90, quantity


@pytest.mark.slow
@pytest.mark.parametrize("trial", waveform.RINGING.values(), ids=waveform.RINGING)
def test_errors_by_a_sensor_that_rings_are_not_bold(trial):
    for quantity, share in shares(trial, range(60)).items():
        assert share.within_one >= 0.65, quantity
        assert share.within_two >= 0.93, quantity


@pytest.mark.parametrize("case", heights.CASES)
def test_heights_together(case):
    assert 0.60 <= covered(heights.CASES[case], range(1000)) <= 0.76


def can_be(share, count):
    """Return whether a share of independent trials can come from a true one of 60 to 76 %."""
    return possible(round(share * count), count, 0.60, 0.76)


@pytest.mark.slow
@pytest.mark.parametrize("case", chosen(sound.CASES, "ugly sound, all of it, 44.1 kHz"))
def test_sound(case):
    seeds = range(40 if case in UGLY else 400)
    for quantity, share in shares(sound.CASES[case], seeds).items():
        if case in UGLY and quantity not in POOLED:  # one a record
            assert can_be(share.within_one, len(seeds)), quantity
        else:
            assert 0.60 <= share.within_one <= 0.76, quantity
        assert share.within_two >= 0.87, quantity


@pytest.mark.slow
@pytest.mark.parametrize("case", chosen(sound.LIMITS, "sound, 8 bits at 8 kHz"))
def test_where_the_errors_of_a_sound_are_not_right_they_are_timid(case):
    for quantity, share in shares(sound.LIMITS[case], range(60)).items():
        assert share.within_one >= 0.60, quantity
        assert share.within_two >= 0.87, quantity


@pytest.mark.fast_cases(2)
@pytest.mark.parametrize("case", UGLY[::3])
def test_ugly_sound_in_a_few_recordings(case):
    # The nine knocks of a recording have about five independent errors.
    for quantity, share in shares(sound.CASES[case], range(4)).items():
        if quantity in POOLED:
            assert can_be(share.within_one, 5 * 4), quantity
