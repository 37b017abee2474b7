"""Force records whose contact law is told: surer touches and releases, right ones for a dashpot."""

import numpy as np
import pytest

import stackbounce as sb
from stackbounce.errors import InvalidType, InvalidValue
from stackbounce.measure.kinds.waveform.analysis import waveform
from synthetic.waveform import waveform as record_of

STEEP = "more steeply than that of any spring"


def bounce(law, seed=1, rate=5e4, noise=2.0, **shape):
    """Return a record of 4 ms with 1 % noise, and when the contact in it began and ended."""
    made = sb.calibrate(law, mass=0.1, contact_time=4e-3, impact_speed=2.0, **shape)
    result = sb.simulate(sb.Drop([sb.Ball(0.1)], [made], impact_speed=2.0))
    record = record_of(result, rate=rate, noise=noise, seed=seed)
    touch = record.attrs["touch"]
    return record, touch, touch + float(result.intervals["end"][0])


def off(value, truth):
    return (value.nominal_value - truth) / value.std_dev


@pytest.mark.parametrize(
    ("law", "shape", "at_most"),
    [
        ("spring", {}, 0.6),
        ("hertz", {}, 0.6),
        ("power-law", {"exponent": 1.25}, 0.6),
        ("hysteretic", {"exponent": 1.5, "restitution": 0.75}, 0.8),
    ],
)
def test_a_told_law_narrows_the_touch(law, shape, at_most):
    record, touch, end = bounce(sb.model.laws.law_named(law), **shape)
    (free,) = waveform(record).contacts
    (told,) = waveform(record, law=law, exponent=shape.get("exponent")).contacts
    assert told.start.std_dev < at_most * free.start.std_dev
    assert abs(off(told.start, touch)) < 3.0
    assert abs(off(told.end, end)) < 3.0


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("restitution", [0.6, 0.7, 0.8])
def test_the_jump_of_a_dashpot_is_said_and_not_followed_down_too_early(restitution, seed):
    record, touch, end = bounce(sb.Dashpot, seed, restitution=restitution)
    unsaid, said = waveform(record), waveform(record, law=sb.Dashpot)
    assert any(STEEP in note for note in unsaid.notes)
    assert not any(STEEP in note for note in said.notes)
    (told,) = said.contacts
    assert off(unsaid.contacts[0].start, touch) < -1.0
    assert abs(told.start.nominal_value - touch) < 2e-5  # one sample
    assert abs(off(told.start, touch)) < 3.0
    assert abs(off(told.end, end)) < 3.0
    assert told.exponents[0].nominal_value == 0.0
    assert told.exponents[1].nominal_value == 1.0


@pytest.mark.parametrize("seed", range(4))
def test_a_viscoelastic_contact_begins_as_a_root_of_the_time(seed):
    record, touch, end = bounce(sb.Viscoelastic, seed, restitution=0.7)
    (told,) = waveform(record, law="viscoelastic").contacts
    assert abs(off(told.start, touch)) < 3.0
    assert abs(off(told.end, end)) < 3.0
    assert told.exponents[0].nominal_value == 0.5


def test_an_averaged_jump_is_as_unsure_as_its_samples_are_apart():
    record, touch, _ = bounce(sb.Dashpot, rate=2e5, noise=0.01, restitution=0.7)
    (told,) = waveform(record, law="dashpot").contacts
    assert told.start.std_dev >= 5e-6 / 12**0.5
    assert abs(off(told.start, touch)) < 3.0


def test_an_exponent_says_more_than_a_law_that_leaves_it_open():
    record, _, _ = bounce(sb.PowerLaw, exponent=1.25)
    told, open_ = (
        waveform(record, law=sb.PowerLaw, exponent=one).contacts[0].start for one in (1.25, None)
    )
    assert told.std_dev < 0.7 * open_.std_dev


def test_an_unloading_exponent_says_how_the_contact_ends():
    record, _, end = bounce(sb.Hysteretic, exponent=1.5, restitution=0.75)
    (told,) = waveform(record, law=sb.Hysteretic(1.0, exponent=1.5, restitution=0.75)).contacts
    (open_,) = waveform(record, law=sb.Hysteretic, exponent=1.5).contacts
    assert told.end.std_dev < 0.5 * open_.end.std_dev
    assert abs(off(told.end, end)) < 3.0


@pytest.mark.parametrize(
    "laws", [(sb.Hertz, "Hertz", sb.Hertz(1e6)), (None, "rigid", sb.Rigid, sb.Rigid(0.8))], ids=str
)
def test_class_name_and_law_say_the_same_and_a_rigid_one_nothing(laws):
    record, _, _ = bounce(sb.Hertz)
    starts = [waveform(record, law=law).contacts[0].start for law in laws]
    assert len({(start.nominal_value, start.std_dev) for start in starts}) == 1


@pytest.mark.parametrize(
    ("law", "exponent", "error", "words"),
    [
        ("hert", None, InvalidValue, "Hertz"),
        (2.0, None, InvalidType, "law must be a contact law, its class or its name, got 2.0"),
        (dict, None, InvalidType, "law must be a contact law, its class or its name, got"),
        (None, 1.5, InvalidValue, "exponent goes with a law that has one to choose, got law None"),
        ("spring", 2.0, InvalidValue, "exponent goes with a law that has one to choose, got law"),
        ("power-law", 0.5, InvalidValue, "exponent must be a number .*got 0.5"),
        ("power-law", float("nan"), InvalidValue, "exponent must be .*got nan"),
        ("power-law", "steep", InvalidType, "exponent must be .*got 'steep'"),
        (sb.PowerLaw(1e6, 1.3), 1.5, InvalidValue, "exponent must be that of the law, 1.3, got 1"),
    ],
)
def test_what_makes_no_sense_is_refused(law, exponent, error, words):
    record, _, _ = bounce(sb.Spring)
    with pytest.raises(error, match=words):
        waveform(record, law=law, exponent=exponent)


@pytest.mark.parametrize("exponent", [1.0, 8.0, 100.0])
@pytest.mark.parametrize(
    "law", [sb.PowerLaw, sb.HuntCrossley, sb.Hysteretic, sb.Hysteretic(1.0, restitution=0.05)]
)
def test_any_exponent_of_a_law_and_a_very_soft_release_give_numbers(law, exponent):
    record, _, _ = bounce(sb.Hertz)
    exponent = getattr(law, "exponent", exponent) if isinstance(law, sb.Hysteretic) else exponent
    (contact,) = waveform(record, law=law, exponent=exponent).contacts
    for moment in (contact.start, contact.end):
        assert np.isfinite([moment.nominal_value, moment.std_dev]).all()
    assert contact.exponents[0].nominal_value == pytest.approx(exponent)


def test_a_wrong_law_shows_in_the_misfit():
    record, _, _ = bounce(sb.Spring)
    (right,) = waveform(record, law="spring").contacts
    (wrong,) = waveform(record, law="power-law", exponent=3.0).contacts
    assert right.flanks[0].misfit == 1.0
    assert wrong.start.std_dev > right.start.std_dev


@pytest.mark.parametrize("seed", range(6))
@pytest.mark.parametrize(
    ("law", "shape"),
    [
        (sb.Spring, {}),
        (sb.PowerLaw, {"exponent": 2.0}),
        (sb.HuntCrossley, {"exponent": 1.0, "restitution": 0.7}),
        (sb.Hysteretic, {"exponent": 1.0, "restitution": 0.75}),
    ],
)
def test_nothing_is_said_of_a_force_that_begins_as_a_power(law, shape, seed):
    record, _, _ = bounce(law, seed, **shape)
    assert not any(STEEP in note for note in waveform(record).notes)
