"""Accelerations of what falls and bounces: flights, heights, restitutions, and the untold."""

import numpy as np
import pytest
import xarray as xr

import stackbounce as sb
from measure.near import near
from stackbounce.errors import InvalidType, InvalidValue
from stackbounce.measure import accelerometer, analyse, one_ball, one_law
from stackbounce.measure.finding import channels
from stackbounce.plots import measured
from synthetic.accelerometer import accelerometer as record_of
from synthetic.falls import falls

G = 9.80665


def fall(contact_time=0.012, height=0.8, bounces=4):
    law = sb.calibrate(sb.Dashpot, mass=0.2, contact_time=contact_time, restitution=0.6)
    return falls(height, law, mass=0.2, bounces=bounces)


@pytest.mark.parametrize(
    ("option", "value"),
    [
        ("rate", 100.0),
        ("rate", 1000.0),
        ("missing", 0.1),
        ("spin", 2.0),
        ("noise", 0.5),
        ("full_range", 40.0),
        ("before", 0.15),
    ],
)
def test_what_went_in_comes_out(option, value):
    found = accelerometer(record_of(fall(), seed=4, **{option: value}))
    assert near(found.drop_height, 0.8)
    assert near(found.mean, 0.6)
    assert len(found.restitutions) == 3
    assert all(near(kept, 0.6) for kept in found.restitutions)
    assert near(found.impact_speeds[0], (2.0 * G * 0.8) ** 0.5)
    assert near(found.apex_heights[0], 0.8 * 0.36)


def test_contact_times_only_where_the_sampling_allows():
    coarse, fine = (accelerometer(record_of(fall(), rate=rate)) for rate in (200.0, 1000.0))
    assert set(coarse.contact_times) == {None}
    assert any("it was sampled every 5 ms: contact times and peaks" in one for one in coarse.notes)
    assert all(near(time, 0.012) for time in fine.contact_times)
    assert not any("sampled" in note for note in fine.notes)


def test_a_range_that_ends_is_told():
    cut, whole = (
        accelerometer(record_of(fall(), rate=1000.0, full_range=limit)) for limit in (80.0, 4e3)
    )
    words = "the sensor's range ended in a pulse: peaks are higher than they look"
    assert (words in cut.notes, words in whole.notes) == (True, False)
    assert cut.peaks[0] < whole.peaks[0] == pytest.approx(np.pi / 2 * 1.6 * 3.96 / 0.012, rel=0.03)


def test_a_record_that_begins_in_flight_has_no_drop_height():
    record = record_of(fall(), seed=1)
    found = accelerometer(record.isel(time=record.time.values > 0.7))
    assert (found.fall, found.drop_height) == (None, None)
    assert len(found.restitutions) == 2
    assert near(found.mean, 0.6)
    assert any("no drop height" in note for note in found.notes)


def test_of_several_drops_the_longest_series_counts():
    one, other = record_of(fall(bounces=2), seed=1), record_of(fall(bounces=5), seed=2)
    size = np.concatenate([one.acceleration_absolute, np.full(200, G), other.acceleration_absolute])
    found = accelerometer((np.arange(len(size)) / 200.0, size))
    assert len(found.restitutions) == 4
    assert near(found.drop_height, 0.8)


def test_half_of_a_flight_is_near_zero():
    steps = [(50, 1.0), (10, 0.4), (10, 0.1), (2, 20.0), (8, 0.4), (8, 0.1), (2, 20.0), (50, 1.0)]
    size = np.concatenate([np.full(count, level * G) for count, level in steps])
    (kept,) = accelerometer((np.arange(len(size)) / 100.0, size)).restitutions
    assert kept.nominal_value == pytest.approx(0.5 * 0.16 / 0.2)  # half a flight over the fall


@pytest.mark.parametrize(
    ("data", "error", "words"),
    [
        ((np.arange(50.0), np.full(50, G)), InvalidValue, "the least acceleration is 9.81 m/s"),
        ((np.arange(50.0), np.zeros(50)), InvalidValue, "must hold a free fall and a bounce"),
        ((np.zeros(50), np.zeros(50)), InvalidValue, "8 samples or more at ascending times"),
        (([1.0], [2.0]), InvalidValue, "8 samples or more at ascending times, got 1"),
        ("fall", InvalidType, "must be a Dataset with time and acceleration, or arrays of numbers"),
        ((np.arange(3.0), None), InvalidValue, "time and acceleration of one length, got shapes"),
        (xr.Dataset({"acc": 1.0}), InvalidType, "must hold an acceleration over time, got acc"),
    ],
)
def test_bad_input(data, error, words):
    with pytest.raises(error, match=words):
        accelerometer(data)


def test_a_ball_and_its_law_are_those_that_fell():
    record = record_of(fall(), rate=1000.0, seed=1)
    found = accelerometer(record)
    law = one_law("dashpot", [found], mass=0.2).law
    true = sb.calibrate(sb.Dashpot, mass=0.2, contact_time=0.012, restitution=0.6)
    assert law.stiffness == pytest.approx(true.stiffness, rel=0.15)
    drop = one_ball([found.parts()], mass=0.2)
    assert drop.height == pytest.approx(0.8, rel=0.02)
    assert drop.contacts[0].restitution == pytest.approx(0.6, abs=0.02)
    rows = {row.name: row for row in found.rows()}
    assert rows["contact time of bounce 0"].value.n == pytest.approx(0.012, rel=0.1)
    assert rows["height of flight 0"].unit == "m"
    shown = [(curve.label, curve.unit) for curve in channels(record)]
    assert shown == [(name, "m/s^2") for name in record.data_vars]


def test_the_picture_tells_heights_and_restitutions():
    record = record_of(fall(), seed=1)
    (found,) = analyse(record)
    texts = measured(record, found).axes[0].texts
    words = [text.get_text() for text in texts]
    assert len(words) == 4 + 3
    assert words[0] == f"{100.0 * found.drop_height:.1uS} cm"
    assert words[4] == f"e = {found.restitutions[0]:.1uS}"
    in_time = [text.get_text()[:3] for text in sorted(texts, key=lambda text: text.xy[0])]
    assert [start == "e =" for start in in_time] == [False, True] * 3 + [False]
