"""Restitution from the times and heights of bounces."""

import math

import numpy as np
import pytest
import xarray as xr
from uncertainties import correlation_matrix, ufloat

import stackbounce as sb
from stackbounce.errors import InvalidType, InvalidValue
from stackbounce.measure import one_ball
from stackbounce.measure.kinds.bounces.analysis import bounces
from stackbounce.measure.kinds.bounces.knocks import missed_between
from stackbounce.measure.kinds.bounces.restitution_law import laws_of
from stackbounce.measure.kinds.heights.analysis import heights
from stackbounce.plots import measured
from synthetic.falls import falls

FALL = falls(1.0, lambda speed: 0.9 - 0.02 * speed, bounces=10)


def test_exact_times_give_what_went_in():
    found = bounces(FALL.touches, drop_height=1.0, time_error=1e-6)
    kept = [one.nominal_value for one in found.restitutions]
    assert kept == pytest.approx(FALL.restitutions[: len(kept)], abs=1e-5)
    assert found.numbers == tuple(range(9))
    assert found.laws[0].coefficient.nominal_value == pytest.approx(0.9, abs=1e-5)
    assert found.laws[0].slope.nominal_value == pytest.approx(0.02, abs=1e-5)
    assert found.laws[0].at(2.0).nominal_value == pytest.approx(0.86, abs=1e-5)
    assert found.laws[0].chi_squared < found.laws[1].chi_squared
    assert not found.inferred


def test_neighbours_share_a_flight():
    found = bounces([0.0, 1.0, 1.8, 2.44, 2.952], time_error=1e-3)
    assert correlation_matrix(found.restitutions)[0, 1] < -0.3
    law = found.laws[0]
    assert abs(correlation_matrix([law.coefficient, law.slope])[0, 1]) > 0.3


def test_a_drop_height_is_inferred_as_phyphox_does_and_marked():
    found = bounces(falls(0.8, 0.85, bounces=7).touches, time_error=1e-4)
    assert found.inferred
    assert found.drop_height.nominal_value == pytest.approx(0.8, rel=1e-6)
    assert any("inferred" in note for note in found.notes)


def test_without_errors_the_scatter_is_the_error():
    times = FALL.touches + np.random.default_rng(1).normal(0.0, 1e-3, len(FALL.touches))
    found = bounces(times)
    assert 0.3e-3 < found.times[0].std_dev < 3e-3
    assert any("scatter" in note for note in found.notes)
    exact = bounces([0.0, 1.0, 1.8])
    assert math.isnan(exact.restitutions[0].std_dev)
    assert exact.rows()


def test_contact_time_is_taken_off():
    law = sb.Dashpot(5e3, damping=2.0)
    fall = falls(0.5, law, mass=0.05, bounces=6)
    contact = float((fall.releases - fall.touches)[0])
    found = bounces(fall.touches, contact_time=contact, time_error=1e-6)
    assert found.mean.nominal_value == pytest.approx(sb.restitution(law, 0.05), abs=1e-6)
    with pytest.raises(InvalidValue, match="contact_time must be shorter"):
        bounces(fall.touches, contact_time=10.0)


def test_a_missing_bounce_is_seen_and_left_out():
    found = bounces(np.delete(FALL.touches, 4), time_error=1e-4)
    assert found.flights[3] is None
    assert found.numbers == (1, 2, 6, 7, 8)
    assert any("missing" in note for note in found.notes)
    assert found.restitutions[2].n == pytest.approx(FALL.restitutions[6], abs=1e-3)


def test_phyphox_times_with_nothing_at_the_end():
    data = xr.Dataset({"knock_time": ("knock", [0.5, 1.5, 2.3, 2.94, 0.0, math.nan])})
    assert len(bounces(data).times) == 4


def test_parts_make_a_drop():
    found = bounces(FALL.touches, drop_height=1.0)
    drop = one_ball([found.parts()], mass=0.05)
    assert drop.height == pytest.approx(1.0)
    assert sb.simulate(drop).rebound_ratios[0] == pytest.approx(found.mean.nominal_value)


@pytest.mark.parametrize(
    ("times", "words"),
    [
        ([1.0, 2.0], "at least three"),
        ([0.0, 1.0, 1.0], "must ascend"),
        ([0.0, 9e-10, 16e-10], "in s, got intervals of at most 9e-10 s"),
        ([0.0, math.nan, 1.0], "finite"),
        ((1e-4 * np.arange(25)).astype(np.float32), "faster and faster, got 24 equal intervals"),
        (np.round(np.arange(90) / 30, 4), "faster and faster, got 89 equal intervals of 0.0333 s"),
        (np.arange(5000) ** 0.9, "bounces, at most 200, got 5000"),
    ],
)
def test_times_that_make_no_sense(times, words):
    with pytest.raises(InvalidValue, match=words):
        bounces(times)


@pytest.mark.parametrize("times", ["now", 3, [None, 1, 2], xr.Dataset({"a": 1})])
def test_what_are_no_times(times):
    with pytest.raises(InvalidType):
        bounces(times)


def test_a_throw_is_no_restitution():
    assert any("above 1" in note for note in bounces([0.0, 0.5, 1.2, 1.7], time_error=1e-3).notes)


def test_speeds_that_do_not_differ_tell_no_law():
    with pytest.raises(InvalidValue, match="impact speeds must differ"):
        laws_of([2.0] * 4, [ufloat(0.7, 0.01) for _ in range(4)])


def test_intervals_in_which_a_bounce_is_missing():
    steps = 0.7 ** np.arange(10)
    assert missed_between(steps) == [0] * 10
    joined = [*steps[:3], steps[3] + steps[4], *steps[5:]]
    assert missed_between(joined) == [0, 0, 0, 1, 0, 0, 0, 0, 0]


@pytest.mark.parametrize(
    ("place", "first", "later"),
    [
        ("bottom", 0.0, 0.0),
        ("centre", 0.05, 0.05),
        ("top", 0.1, 0.1),
        (("bottom", "top"), 0.0, 0.1),
    ],
)
def test_heights_wherever_they_were_read(place, first, later):
    read = 1.0 + first, [0.64 + later, 0.4096 + later]
    found = heights(*read, diameter=0.1, measured_to=place, height_error=0.005)
    assert [one.nominal_value for one in found.restitutions] == pytest.approx([0.8, 0.8])
    assert found.mean.nominal_value == pytest.approx(0.8)
    assert found.drop_height.nominal_value == pytest.approx(1.0)
    assert found.parts()["contact"] == {"law": "Rigid", "restitution": pytest.approx(0.8)}
    assert found.rows()[0].name == "restitution"


def test_heights_above_the_drop_are_a_stack_s():
    found = heights(0.5, 1.2, height_error=0.01)
    assert found.mean.nominal_value > 1.0
    assert "contact" not in found.parts()
    assert any("gained energy" in note for note in found.notes)


def test_heights_without_errors_say_so():
    found = heights(1.0, [0.6, 0.4])
    assert math.isnan(found.mean.std_dev)
    assert any("height_error" in note for note in found.notes)
    known = heights(ufloat(1.0, 0.01), ufloat(0.64, 0.01))
    assert known.mean.std_dev == pytest.approx(0.8 * 0.5 * math.hypot(0.01, 0.01 / 0.64))
    assert measured(None, known).axes[0].lines[0].get_ydata()[-1] == pytest.approx(0.64)


def test_repeated_heights_scatter():
    found = heights(ufloat(1.0, 1e-9), [0.64, 0.65, 0.63], repeated=True)
    assert found.mean.nominal_value == pytest.approx(0.8)
    assert len(found.restitutions) == 3
    assert found.mean.std_dev > 0.003


@pytest.mark.parametrize(
    ("read", "options", "error", "words"),
    [
        ((-1.0, 0.5), {}, InvalidValue, "drop_height must be"),
        ((1.0, [0.5, -0.1]), {}, InvalidValue, "the height of bounce 2"),
        ((1.0, []), {}, InvalidValue, "at least one"),
        ((1.0, "half"), {}, InvalidValue, "bounce 1 must be a length"),
        ((1.0, 0.5), {"measured_to": "top"}, InvalidValue, "diameter must be given"),
        ((1.0, 0.5), {"measured_to": "side"}, InvalidValue, "bottom, centre or top"),
        ((1.0, 0.5), {"measured_to": 3}, InvalidType, "bottom, centre or top"),
        (
            (1.0, 0.05),
            {"measured_to": "top", "diameter": 0.1},
            InvalidValue,
            "more than the height",
        ),
    ],
)
def test_heights_that_make_no_sense(read, options, error, words):
    with pytest.raises(error, match=words):
        heights(*read, **options)
