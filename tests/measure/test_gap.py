"""Gaps from delays, and the paper's delays of 2 and 7 ms."""

import math

import pytest
from uncertainties import ufloat

import stackbounce as sb
from stackbounce.cross2007 import PAPER
from stackbounce.errors import InvalidValue
from stackbounce.measure import analyse
from stackbounce.measure.kinds.waveform.analysis import waveform
from stackbounce.measure.kinds.waveform.gap.delay import delay, gap_from_delay
from synthetic.waveform import waveform as record_of

SPEED = math.sqrt(2.0 * 9.80665 * 0.20)


def paper(key):
    return ufloat(PAPER[key].value, PAPER[key].spread)


def gap_at(delay_key, ball, **how):
    tau = paper(f"{ball}.contact_time")
    return gap_from_delay(paper(delay_key), SPEED, contact_time=tau, **how)


@pytest.mark.parametrize("gap", [1e-5, 1e-3, 5e-3, 0.1])
@pytest.mark.parametrize(
    "law", [sb.Spring(5.4e4), sb.Hysteretic(5.6e4, restitution=0.78), sb.Dashpot(5e4, 20.0)]
)
def test_a_gap_is_that_of_the_simulator(law, gap):
    balls = [sb.Ball(0.101), sb.Ball(0.0248)]
    drop = sb.Drop(balls, [law, sb.Spring(1.6e4)], gaps=[gap], impact_speed=2.0)
    touch = float(sb.simulate(drop).first_touch[1])
    found = gap_from_delay(touch, 2.0, mass=0.101, contact=law)
    assert found.nominal_value == pytest.approx(gap, rel=1e-5)


def test_a_spring_is_closed_form():
    tau = math.pi * math.sqrt(0.101 / 5.4e4)
    for t in (0.3 * tau, tau, 2.0 * tau):
        by_stiffness = gap_from_delay(t, 2.0, mass=0.101, stiffness=5.4e4).nominal_value
        by_time = gap_from_delay(t, 2.0, contact_time=tau).nominal_value
        by_run = gap_from_delay(t, 2.0, mass=0.101, contact=sb.Spring(5.4e4)).nominal_value
        assert by_stiffness == pytest.approx(by_time, rel=1e-12)
        assert by_stiffness == pytest.approx(by_run, rel=1e-9)


def test_a_rigid_contact_needs_no_mass():
    found = gap_from_delay(1e-3, 2.0, contact=sb.Rigid(0.5))
    assert found.nominal_value == pytest.approx(3e-3)


def test_errors_follow_from_what_was_given():
    delay, speed, tau = ufloat(2e-3, 1e-4), ufloat(2.0, 0.02), ufloat(4.3e-3, 1e-4)
    found = gap_from_delay(delay, speed, contact_time=tau)
    w = math.pi / 4.3e-3
    by_delay = 2.0 * (1.0 - math.cos(w * 2e-3)) * 1e-4
    by_speed = found.nominal_value * 0.01
    slope = 2.0 * (math.sin(w * 2e-3) / math.pi - 2e-3 / 4.3e-3 * math.cos(w * 2e-3))
    assert found.std_dev == pytest.approx(math.hypot(by_delay, by_speed, slope * 1e-4), rel=1e-3)


def test_two_channels_give_the_delay():
    balls, laws = [sb.Ball(0.101), sb.Ball(0.0248)], [sb.Spring(5.4e4), sb.Spring(1.6e4)]
    drop = sb.Drop(balls, laws, gaps=[1e-3], impact_speed=2.0)
    record = record_of(drop, rate=1e5, noise=0.5, contacts=[0, 1])
    later = delay(record[["force"]], waveform(record[["force_2"]]))
    truth = float(sb.simulate(drop).first_touch[1])
    assert abs(later.nominal_value - truth) < 4.0 * later.std_dev
    found = gap_from_delay(later, 2.0, mass=0.101, stiffness=5.4e4)
    assert abs(found.nominal_value - 1e-3) < 4.0 * found.std_dev
    assert found.std_dev < 1e-4
    record.attrs["holds"] = "waveform"
    told = {"height": 0.266, "measured_to": "top", "diameter": 0.066, "contact_time": 4e-3}
    fallen, _ = analyse(record, **told)
    known, _ = analyse(record, speed=SPEED, contact_time=4e-3)
    assert fallen.gap.nominal_value == pytest.approx(known.gap.nominal_value, rel=1e-12)


@pytest.mark.parametrize(
    ("lower", "gap", "printed", "errors"),
    [
        ("B1", 1.27e-3, "superballs.gap", (-1.0, 0.0)),  # B2 on B1: its millimetre
        ("B2", 2.87e-3, "superballs.gap", (-2.0, -1.0)),  # B1 on B2: three, not one
        ("B1", 1.27e-3, "B3_fit.gap", (1.0, 2.0)),  # B3 on B1: its fit of 2.4 mm
    ],
)
def test_the_paper_s_2_ms(lower, gap, printed, errors):
    found = gap_at("superballs.delay", lower)
    assert found.nominal_value == pytest.approx(gap, abs=0.02e-3)
    assert errors[0] < (PAPER[printed].value - found.nominal_value) / found.std_dev < errors[1]


def test_the_paper_s_7_ms_of_b1_on_b3_are_24_millimetres():
    for restitution, gap in ((1.0, 24.0e-3), (0.90, 22.9e-3)):
        found = gap_at("superballs.late_delay", "B3", restitution=restitution)
        assert found.nominal_value == pytest.approx(gap, rel=0.01)


def test_the_paper_s_7_ms_of_basketball_and_tennis_ball_are_its_2_mm_at_most():
    speed = math.sqrt(2.0 * 9.80665 * PAPER["fig8.drop_height"].value)
    floor = {"mass": paper("basketball.mass"), "stiffness": paper("fig9.floor_stiffness")}
    found = gap_from_delay(paper("stack.delay"), speed, **floor)
    assert found.nominal_value == pytest.approx(2.2e-3, abs=0.05e-3)
    assert abs(found.nominal_value - PAPER["stack.gap"].value) < found.std_dev


@pytest.mark.parametrize(
    ("how", "words"),
    [
        ({}, "exactly one of"),
        ({"contact_time": 1e-3, "stiffness": 1e4, "mass": 0.1}, "exactly one of"),
        ({"stiffness": 1e4}, "mass must be given"),
        ({"contact": sb.Spring(1e4)}, "mass must be given"),
        ({"contact_time": -1.0}, "contact_time must be"),
        ({"contact_time": 1e-3, "restitution": 1.5}, "restitution must be"),
    ],
)
def test_one_way_to_bounce_is_needed(how, words):
    with pytest.raises(InvalidValue, match=words):
        gap_from_delay(1e-3, 2.0, **how)


def test_channels_without_a_touch_are_named():
    drop = sb.Drop([sb.Ball(0.1)], [sb.Spring(6e4)], impact_speed=2.0)
    record = record_of(drop, rate=1e5, noise=1.0)
    times = record.time.values
    with pytest.raises(InvalidValue, match="balls must show a contact"):
        delay(record, (times, 0.0 * times))
    with pytest.raises(InvalidValue, match="floor must begin before"):
        delay(record.isel(time=slice(300, None)), record)
