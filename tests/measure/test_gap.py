"""Gaps by one sensor on the floor, with and without the upper ball, and by two sensors."""

import math
import re

import pytest
from uncertainties import ufloat

import stackbounce as sb
from measure.near import near
from stackbounce.errors import InvalidType, InvalidValue
from stackbounce.measure import analyse, floor_gap, sensor_gap
from stackbounce.measure.kinds.waveform.analysis import waveform
from stackbounce.measure.kinds.waveform.gap.delay import delay, gap_from_delay
from stackbounce.plots import measured
from synthetic.waveform import waveform as record_of

SPEED = 1.98
BALLS = (sb.Ball(0.101), sb.Ball(0.0248))  # the paper's B1 and B2
LAWS = (sb.Hysteretic(5.6e4, restitution=0.78), sb.Spring(1.6e4))
VOLTS = {"sensitivity": 0.01, "bits": 12, "full_scale": 2.0, "noise": 0.004}


def drop(gap, balls=BALLS, laws=LAWS, speed=SPEED):
    return sb.Drop(balls, laws, gaps=[gap], impact_speed=speed)


def records(gap, balls=BALLS, laws=LAWS, noise=0.4, **how):
    """Return the records under both balls, and under the lower one alone."""
    alone = sb.Drop(balls[:1], laws[:1], impact_speed=SPEED)
    options = {"rate": 1e5, "noise": noise} | how
    both = record_of(drop(gap, balls, laws), seed=1, **options)
    return both, record_of(alone, seed=2, **options)


@pytest.mark.parametrize("gap", [1e-3, 1.5e-3, 2e-3])
def test_the_gap_that_went_in_comes_out(gap):
    found = floor_gap(*records(gap), mass=0.101)
    assert near(found.delay, float(sb.simulate(drop(gap)).first_touch[1]))
    assert near(found.gap, gap)
    assert found.gap.std_dev < 0.4 * gap
    assert found.gap_limits[0] < gap < found.gap_limits[1]
    assert found.gain == pytest.approx(1.0, abs=0.01)
    assert found.notes == ()
    assert found.parts() == {}


def test_volts_need_the_speed_or_the_height_of_the_fall():
    both, alone = records(1e-3, **VOLTS)
    for known in ({}, {"restitution": 0.78}):
        found = floor_gap(both, alone, impact_speed=SPEED, **known)
        assert near(found.gap, 1e-3)
    with pytest.raises(InvalidValue, match="impact_speed must be given for a record in V, got"):
        floor_gap(both, alone, mass=0.101)
    height = SPEED**2 / (2.0 * 1.6)
    *_, fallen = analyse(both, alone=alone, height=height, gravity=1.6)
    known = floor_gap(both, alone, impact_speed=SPEED).gap
    assert fallen.gap.nominal_value == pytest.approx(known.nominal_value, rel=1e-12)


def test_the_lower_balls_second_bounce_tells_its_restitution():
    both, alone = records(1e-3, **VOLTS)
    lower = sb.Drop(BALLS[:1], LAWS[:1], impact_speed=SPEED, gravity=9.80665)
    twice = record_of(sb.simulate(lower, until=0.4), rate=1e5, before=0.01, seed=2, **VOLTS)
    known, once = (floor_gap(both, one, impact_speed=SPEED) for one in (twice, alone))
    assert near(known.gap, 1e-3)
    assert known.gap.std_dev < once.gap.std_dev


def test_balls_that_touch_from_the_start_are_told():
    found = floor_gap(*records(0.0), mass=0.101)
    assert (found.gap, found.delay) == (None, None)
    assert found.gap_limits[0] == 0.0 < found.gap_limits[1] < 1e-3
    assert found.notes[-1].endswith("the gap may be 0")
    assert str(found.rows()[0].value).startswith("below 0.000")


@pytest.mark.parametrize("gap", [8e-3, 12e-3])
def test_a_ball_that_comes_too_late_is_told(gap):
    found = floor_gap(*records(gap, noise=2.0), mass=0.101)
    assert (found.gap, found.gap_limits) == (None, (0.0, math.inf))
    assert "no second ball is seen while the lower one is on the floor" in found.notes[-1]
    assert found.rows()[0].value == "unknown"


@pytest.mark.parametrize(("gap", "options"), [(1.5e-3, {"rate": 5e3}), (3e-3, {"noise": 1.5})])
def test_a_ball_that_is_seen_too_faintly_is_told(gap, options):
    found = floor_gap(*records(gap, **{"noise": 1.0} | options), mass=0.101)
    touch = float(sb.simulate(drop(gap)).first_touch[1])
    assert found.gap is None
    assert found.gap_limits[0] == 0.0 < gap < found.gap_limits[1] < 0.02
    assert touch < found.delay_limits[1]
    assert found.notes[-1].endswith("too faintly to tell when")


@pytest.mark.fast_cases(1)
@pytest.mark.parametrize("gap", [3e-3, 12e-3])
def test_a_light_ball_that_is_thrown_back_has_limits(gap):
    balls, laws = [sb.Ball(0.0085), sb.Ball(0.101)], [sb.Spring(2.3e4), sb.Spring(1.4e4)]
    found = floor_gap(*records(gap, balls, laws), mass=0.0085)
    touch = float(sb.simulate(drop(gap, balls, laws)).first_touch[1])
    assert found.gap is None
    assert found.gap_limits[0] < gap < found.gap_limits[1] < 0.1
    assert found.delay_limits[0] < touch < found.delay_limits[1]
    assert "only limits can be told" in found.notes[-1]
    assert " to " in str(found.rows()[0].value)


def test_drops_from_different_heights_are_told():
    both, _ = records(1e-3)
    lower = record_of(sb.Drop(BALLS[:1], LAWS[:1], impact_speed=0.9 * SPEED), rate=1e5, seed=2)
    found = floor_gap(both, lower, mass=0.101)
    assert any("were both drops from the same height?" in note for note in found.notes)


def test_a_record_without_a_bounce_is_refused():
    both, alone = records(1e-3)
    with pytest.raises(InvalidValue, match="alone must be the record of a bounce that it holds"):
        floor_gap(both, alone.isel(time=slice(0, 200)), mass=0.101)


def test_two_sensors():
    how = {"rate": 1e5, "noise": 0.5, "contacts": [0, 1], "seed": 1}
    record = record_of(drop(1e-3), **how)
    found, whole = analyse(record)
    assert near(found.delay, float(sb.simulate(drop(1e-3)).first_touch[1]))
    later = delay(waveform(record), waveform(record[["force_2"]]))
    assert later.nominal_value == found.delay.nominal_value
    assert found.gap is None
    assert found.notes[-1] == "the gap needs the impact speed too"
    assert len(whole.contacts) == 1
    of_spring = record_of(drop(1e-3, laws=(sb.Spring(5.6e4), LAWS[1])), **how)
    alone = sb.contact_time(sb.Spring(5.6e4), 0.101)
    assert near(sensor_gap(of_spring, impact_speed=SPEED, contact_time=alone).gap, 1e-3)
    told = {"height": 0.266, "measured_to": "top", "diameter": 0.066, "contact_time": 4e-3}
    fallen, _ = analyse(record, **told)
    known, _ = analyse(record, speed=(2.0 * 9.80665 * 0.20) ** 0.5, contact_time=4e-3)
    assert fallen.gap.nominal_value == pytest.approx(known.gap.nominal_value, rel=1e-12)
    with pytest.raises(InvalidValue, match="must have the floor's channel first, got force "):
        sensor_gap(record[["force_2", "force"]])
    with pytest.raises(InvalidValue, match="data must have two channels, got force"):
        sensor_gap(record[["force"]])
    record["force_2"] = 0.0 * record.force_2  # a channel of something else is left alone
    (whole,) = analyse(record)
    assert len(whole.contacts) == 1


@pytest.mark.parametrize(
    ("gap", "title"),
    [
        (0.0, r"gap between the balls: below 0\.00036 m"),
        (1.5e-3, r"the balls touch 1\.9\(1\) ms after the floor: a gap of 1\.1\(2\) mm"),
    ],
)
def test_the_picture(gap, title):
    both, alone = records(gap)
    found = floor_gap(both, alone, mass=0.101)
    figure = measured(both, found)
    assert [axes.get_ylabel() for axes in figure.axes] == ["force (N)", "difference"]
    assert re.fullmatch(title, figure.axes[0].get_title(loc="left"))
    (value,) = (row.value for row in found.rows() if row.name == "gap between the balls")
    assert value is found.gap or str(value).startswith("below")


# --- gaps from delays
@pytest.mark.parametrize("gap", [1e-5, 1e-3, 5e-3, 0.1])
@pytest.mark.parametrize(
    "law", [sb.Spring(5.4e4), sb.Hysteretic(5.6e4, restitution=0.78), sb.Dashpot(5e4, 20.0)]
)
def test_a_gap_is_that_of_the_simulator(law, gap):
    touch = float(sb.simulate(drop(gap, laws=(law, LAWS[1]), speed=2.0)).first_touch[1])
    found = gap_from_delay(touch, 2.0, mass=0.101, contact=law)
    assert found.nominal_value == pytest.approx(gap, rel=1e-5)


def test_a_spring_is_closed_form():
    tau = math.pi * math.sqrt(0.101 / 5.4e4)
    for t in (0.3 * tau, tau, 2.0 * tau):
        by_time = gap_from_delay(t, 2.0, contact_time=tau).nominal_value
        by_run = gap_from_delay(t, 2.0, mass=0.101, contact=sb.Spring(5.4e4)).nominal_value
        assert by_time == pytest.approx(by_run, rel=1e-9)


def test_a_rigid_contact_is_left_at_once():
    found = gap_from_delay(1e-3, 2.0, mass=0.1, contact=sb.Rigid(0.5))
    assert found.nominal_value == pytest.approx(3e-3)


def test_errors_follow_from_what_was_given():
    delay, speed, tau = ufloat(2e-3, 1e-4), ufloat(2.0, 0.02), ufloat(4.3e-3, 1e-4)
    found = gap_from_delay(delay, speed, contact_time=tau)
    w = math.pi / 4.3e-3
    by_delay = 2.0 * (1.0 - math.cos(w * 2e-3)) * 1e-4
    by_speed = found.nominal_value * 0.01
    slope = 2.0 * (math.sin(w * 2e-3) / math.pi - 2e-3 / 4.3e-3 * math.cos(w * 2e-3))
    assert found.std_dev == pytest.approx(math.hypot(by_delay, by_speed, slope * 1e-4), rel=1e-3)


@pytest.mark.parametrize(
    ("how", "words"),
    [
        ({}, "one of contact_time and contact must be given, got none"),
        ({"contact_time": 1e-3, "contact": sb.Spring(1e4), "mass": 0.1}, "given, got both"),
        ({"contact": sb.Spring(1e4)}, "mass must be"),
        ({"contact_time": -1.0}, "contact_time must be"),
    ],
)
def test_one_way_to_bounce_is_needed(how, words):
    with pytest.raises((InvalidType, InvalidValue), match=words):
        gap_from_delay(1e-3, 2.0, **how)


def test_channels_without_a_touch_are_named():
    _, record = records(1e-3)
    whole, nothing = waveform(record), waveform((record.time, 0.0 * record.time))
    with pytest.raises(InvalidValue, match="balls must show a contact"):
        delay(whole, nothing)
    with pytest.raises(InvalidValue, match="floor must begin before"):
        delay(waveform(record.isel(time=slice(300, None))), whole)
