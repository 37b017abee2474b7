"""Force records as data: clocks, scales, polarity, and records that cannot be used."""

import numpy as np
import pytest
import xarray as xr

import stackbounce as sb
from drops import STACK
from measure.near import near
from refusals import refusal
from stackbounce.errors import InvalidType, InvalidValue
from stackbounce.fitting import FitProblem
from stackbounce.fitting.waveforms import read_waveform
from synthetic.waveform import waveform

ONE = sb.Drop([sb.Ball(0.150)], [sb.Spring(2500.0)], impact_speed=3.5)
VARY = {"contacts.0.stiffness": (1500.0, 4000.0)}
RECORD = waveform(ONE, rate=1e4, noise=0.5, seed=1, before=0.01).force
TIMES, FORCE = RECORD.time.values, RECORD.values


def fitted(record, drop=ONE, vary=VARY):
    return sb.fit(drop, {"force.0": record}, vary, starts=4)


def test_a_record_in_newtons_tells_stiffness_and_touch():
    found = fitted(RECORD)
    assert found.names == ["contacts.0.stiffness", "touch"]
    assert near(found["contacts.0.stiffness"], 2500.0)
    assert found["contacts.0.stiffness"].std_dev < 5.0
    assert found.units["touch"] == "s"
    assert found.degrees_of_freedom == len(TIMES) - 3  # stiffness, touch, baseline
    assert found.probability > 0.01
    assert found.residuals == []
    assert found.notes == ()
    (record,) = found.records
    assert record.times == pytest.approx(TIMES - found.best["touch"], abs=1e-12)
    before = record.times < 0.0
    assert np.ptp(record.fitted[before]) < 1e-9 < np.ptp(record.fitted[~before])


def test_residuals_are_those_of_a_spring_by_hand():
    objective = FitProblem(ONE, {"force.0": (TIMES, FORCE, 0.5)}, VARY).objective
    start, stiffness = 0.00995, 2450.0
    omega = np.sqrt(stiffness / 0.150)
    phase = omega * (TIMES - start)
    force = stiffness * 3.5 / omega * np.sin(phase) * ((phase > 0.0) & (phase < np.pi))
    wave = objective.measured[""].waveforms[0]
    off = wave.force - force
    trial = np.array([[stiffness, start]])
    assert objective.residuals(trial)[0] == pytest.approx((off.mean() - off) / 0.5, abs=1e-6)


@pytest.mark.fast_cases(1)
@pytest.mark.parametrize("shift", [0.1, 1234.567])
def test_the_clock_of_a_record_is_its_own(shift):
    found, plain = fitted((TIMES + shift, FORCE)), fitted((TIMES, FORCE))
    assert found.chi_squared == pytest.approx(plain.chi_squared, rel=1e-5)
    assert found.best["touch"] - shift == pytest.approx(plain.best["touch"], abs=1e-8)


def test_volts_have_a_scale_that_is_free():
    volts = (RECORD * 0.01).assign_attrs(units="V")
    found = fitted(volts)
    assert found.degrees_of_freedom == len(TIMES) - 4
    assert near(found["contacts.0.stiffness"], 2500.0)
    assert found["contacts.0.stiffness"].std_dev > fitted(RECORD)["contacts.0.stiffness"].std_dev
    assert fitted(-volts).best == pytest.approx(found.best, rel=1e-9)


def test_a_record_of_the_other_sign_in_newtons():
    assert fitted((TIMES, -FORCE)).best == pytest.approx(fitted((TIMES, FORCE)).best, rel=1e-9)


@pytest.mark.parametrize("bad", [np.nan, np.inf])
def test_samples_that_are_no_numbers_are_left_out(bad):
    force = FORCE.copy()
    force[[20, 200]] = bad
    found = fitted((TIMES, force))
    assert found.degrees_of_freedom == len(TIMES) - 2 - 3
    assert near(found["contacts.0.stiffness"], 2500.0)


def test_two_records_of_one_drop_have_one_clock():
    record = waveform(STACK, rate=1e4, noise=0.5, seed=2, before=0.01, contacts=[0, 1])
    vary = {**VARY, "contacts.1.stiffness": (700.0, 1500.0)}
    data = {"force.0": record.force, "force.1": record.force_2[1::3]}
    found = sb.fit(STACK, data, vary, starts=4)
    assert near(found["contacts.0.stiffness"], 2500.0)
    assert near(found["contacts.1.stiffness"], 1000.0)
    assert found.names[-1] == "touch"
    assert found.probability > 0.01
    later = (record.time.values + 5.0, record.force_2.values)
    found = sb.fit(STACK, {"force.0": record.force, "force.1": later}, VARY, starts=4)
    assert found.notes[0].startswith("the model does not describe the data")


def test_two_drops_have_a_clock_each():
    other = waveform(ONE, rate=1e4, noise=0.5, seed=3, before=0.02).force
    data = {"a": {"force.0": RECORD}, "b": {"force.0": other}}
    found = sb.fit({"a": ONE, "b": ONE}, data, VARY, starts=4)
    assert found.names == ["contacts.0.stiffness", "a.touch", "b.touch"]
    assert found.best["a.touch"] == pytest.approx(0.01, abs=2e-4)
    assert found.best["b.touch"] == pytest.approx(0.02, abs=2e-4)
    assert near(found["contacts.0.stiffness"], 2500.0)


def test_a_clock_is_no_name_for_something_else():
    with pytest.raises(InvalidValue, match=r"^touch is the time of first touch in a force record"):
        sb.fit(ONE, {"force.0": RECORD}, {"touch": (0.1, 1.0)}, tie={"gravity": "touch"})


BEFORE = TIMES < 0.005
QUIET = np.random.default_rng(1).normal(0.0, 0.5, len(TIMES))


@pytest.mark.parametrize(
    ("value", "kind", "message"),
    [
        ((TIMES, QUIET), InvalidValue, "must begin before a contact and hold it: 4"),
        ((TIMES[150:], FORCE[150:]), InvalidValue, "must begin before a contact and hold it"),
        ((TIMES, np.where(BEFORE, 0.0, 1.0)), InvalidValue, "must begin before a contact"),
        ((TIMES, FORCE * np.nan), InvalidValue, "must"),
        ((TIMES[1:], FORCE), InvalidValue, "must hold time and force of one length"),
        (([], []), InvalidValue, "must hold at least 8 samples"),
        (None, InvalidType, "must be a DataArray over time, or times, forces and their error"),
        ((np.r_[TIMES, TIMES + 0.2], np.r_[FORCE, FORCE]), InvalidValue, "got 2 contacts"),
        ((TIMES, FORCE, 0.5, 1.0), InvalidType, "must be a DataArray over time"),
        ((TIMES, FORCE, 0.0), InvalidValue, "'s error must be a positive number, got 0"),
        ((TIMES, FORCE, np.nan), InvalidValue, "'s error must be a positive number, got nan"),
        (
            xr.DataArray(np.ones((3, 3)), dims=("time", "x")),
            InvalidValue,
            "force over the time alone",
        ),
    ],
)
def test_records_that_cannot_be_used(value, kind, message):
    said = refusal(kind, fitted, value)
    assert said.startswith("force.0")
    assert message in said


@pytest.mark.parametrize(
    ("name", "message"),
    [("force.1", r"^force\.1 must end in the number of a contact"), ("force", r"force\.0(\?|$)")],
)
def test_a_contact_that_is_not_there(name, message):
    with pytest.raises(InvalidValue, match=message):
        sb.fit(ONE, {name: RECORD}, VARY)


@pytest.mark.parametrize("late", [0.0, 10.0])
def test_the_touch_is_sought_within_a_tenth_of_the_contact(late):
    drop = sb.Drop([sb.Ball(1.0)], [sb.Spring(1.0)], height=1.0)
    times = np.arange(-2.0, 6.0, 0.01)
    force = 4.43 * np.sin(np.clip(times, 0.0, np.pi))
    noisy = force + np.random.default_rng(1).normal(0.0, 0.01, len(times))
    record = read_waveform(drop, "force.0", (times + late, noisy), "force.0")
    assert record.begins == pytest.approx((late - 0.1 * np.pi, late + 0.1 * np.pi), abs=0.05)
