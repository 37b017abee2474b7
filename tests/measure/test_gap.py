"""Gaps by two sensors, and from delays."""

import math

import pytest
from uncertainties import ufloat

import stackbounce as sb
from measure.near import near
from stackbounce.errors import InvalidType, InvalidValue
from stackbounce.measure import analyse, sensor_gap
from stackbounce.measure.kinds.waveform.analysis import waveform
from stackbounce.measure.kinds.waveform.gap import delay, gap_from_delay
from synthetic.waveform import waveform as record_of

SPEED = 1.98
BALLS = (sb.Ball(0.101), sb.Ball(0.0248))  # the paper's B1 and B2
LAWS = (sb.Hysteretic(5.6e4, restitution=0.78), sb.Spring(1.6e4))


def drop(gap, balls=BALLS, laws=LAWS, speed=SPEED):
    return sb.Drop(balls, laws, gaps=[gap], impact_speed=speed)


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
    record = record_of(
        sb.Drop(BALLS[:1], LAWS[:1], impact_speed=SPEED), rate=1e5, noise=0.4, seed=2
    )
    whole, nothing = waveform(record), waveform((record.time, 0.0 * record.time.values))
    with pytest.raises(InvalidValue, match="balls must show a contact"):
        delay(whole, nothing)
    with pytest.raises(InvalidValue, match="floor must begin before"):
        delay(waveform(record.isel(time=slice(300, None))), whole)
