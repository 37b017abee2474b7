"""Force records: contacts, times, peaks, impulses, and records as bad as they come."""

import re
from itertools import pairwise

import numpy as np
import pytest
import xarray as xr
from uncertainties import ufloat

import stackbounce as sb
from measure.near import near
from refusals import refusal
from stackbounce.errors import InvalidType, InvalidValue
from stackbounce.measure.kinds.waveform.analysis import waveform
from stackbounce.measure.kinds.waveform.peaks import impulse_of
from stackbounce.measure.kinds.waveform.record import undrooped
from stackbounce.plots.measurements.waveform import draw
from synthetic.waveform import drooped
from synthetic.waveform import waveform as record_of
from work import calls_of, memory_of

ONE = sb.simulate(sb.Drop([sb.Ball(0.1)], [sb.Spring(6e4)], impact_speed=2.0))
TIME = float(ONE.intervals["end"][0])
PEAK = float(ONE.intervals["peak_force"][0])


def pulses(count, *, apart=0.02, rate=5e4, noise=0.5, tau=4e-3, height=100.0, seed=0):
    """Half sines, one after the other."""
    times = np.arange(0.0, apart * (count + 0.5), 1.0 / rate)
    phase = (times - 0.5 * apart) % apart
    inside = (times >= 0.5 * apart) & (phase <= tau)
    force = np.where(inside, height * np.sin(np.pi * phase / tau), 0.0)
    return times, force + np.random.default_rng(seed).normal(0.0, noise, len(times))


@pytest.mark.parametrize("sign", [1, -1])
@pytest.mark.parametrize("sensitivity", [None, 0.01])
def test_one_bounce(sign, sensitivity):
    gain = sensitivity or 1.0
    how = {"noise": 1.0 * gain, "offset": 20.0 * gain, "drift": 3.0 * gain}
    record = record_of(ONE, rate=1e5, sign=sign, sensitivity=sensitivity, **how)
    found = waveform(record, mass=0.1)
    (contact,) = found.contacts
    assert found.sign == sign
    assert found.unit == ("N" if sensitivity is None else "V")
    assert near(contact.time, TIME)
    assert contact.time.std_dev < 0.01 * TIME
    assert near(contact.start, record.attrs["touch"])
    assert near(contact.peak_force, gain * PEAK)
    assert near(contact.impulse, gain * 0.4)
    assert near(found.stiffness, 6e4)
    assert near(contact.rise + contact.fall, TIME)
    assert near(contact.exponents[0], 1.0)
    assert found.noise == pytest.approx(1.0 * gain, rel=0.15)
    assert not found.notes
    assert found.parts()["contact"] == {"law": "Spring", "stiffness": found.stiffness.nominal_value}


def test_rows_tell_all_with_units_and_parts_make_a_drop():
    found = waveform(record_of(ONE, rate=1e5, noise=1.0), mass=ufloat(0.1, 0.001), impact_speed=2.0)
    units = {row.name: row.unit for row in found.rows()}
    told = {"contact time": "s", "impulse": "N s", "dynamic stiffness": "N/m"}
    assert told.items() <= units.items()
    parts = found.parts()
    law = sb.Spring(parts["contact"]["stiffness"])
    drop = sb.Drop([sb.Ball(**parts["ball"])], [law], impact_speed=parts["impact_speed"])
    assert sb.simulate(drop).end_time == pytest.approx(TIME, rel=0.01)


def test_hertz_is_told_from_a_spring_by_how_it_begins():
    law = sb.calibrate(sb.Hertz, mass=0.1, contact_time=TIME, impact_speed=2.0)
    record = record_of(sb.Drop([sb.Ball(0.1)], [law], impact_speed=2.0), rate=1e5, noise=0.3)
    (contact,) = waveform(record).contacts
    (shifted,) = waveform(record.assign_coords(time=record.time - 1.0)).contacts
    assert shifted.time.nominal_value == pytest.approx(contact.time.nominal_value, rel=1e-6)
    assert near(contact.exponents[0], 1.5)
    assert contact.exponents[0].std_dev < 0.1
    assert near(contact.time, TIME)


def test_several_peaks_in_one_contact():
    balls, laws = [sb.Ball(0.0248), sb.Ball(0.101)], [sb.Spring(3.6e4), sb.Spring(1.6e4)]
    drop = sb.Drop(balls, laws, gaps=[0.001], impact_speed=2.0)
    found = waveform(record_of(drop, rate=1e5, noise=0.6), mass=0.1)
    (contact,) = found.contacts
    assert len(contact.peaks) == 3
    assert near(contact.time, 0.01067682)
    assert any("3 peaks" in note for note in found.notes)
    assert contact.peak_force.nominal_value == pytest.approx(115.16, rel=0.02)


def test_separate_collisions_are_separate_contacts():
    balls, laws = [sb.Ball(0.0085), sb.Ball(0.101)], [sb.Spring(2.3e4), sb.Spring(1.4e4)]
    result = sb.simulate(sb.Drop(balls, laws, gaps=[0.012], height=0.2))
    record = record_of(result, rate=5e4, noise=0.3, before=0.01, duration=0.04)
    contacts = waveform(record).contacts
    rows = result.intervals[(result.intervals["contact"] == 0) & (result.intervals["end"] < 0.02)]
    assert len(contacts) == len(rows) == 5
    for contact, row in zip(contacts, rows, strict=True):
        assert near(contact.start, record.attrs["touch"] + row["start"])
        assert near(contact.time, row["end"] - row["start"])
        assert near(contact.impulse, row["impulse"])


def test_a_table_counts_the_contacts_that_it_does_not_list():
    rows = {row.name: row.value for row in waveform(pulses(15, rate=1e4)).rows()}
    assert rows["contacts"] == 15
    assert rows["further contacts, not listed"] == 3
    assert "contact 12: touch" in rows
    assert "contact 13: touch" not in rows


@pytest.mark.slow
def test_a_hundred_bounces():
    _, ten = calls_of(waveform, pulses(10))
    found, hundred = calls_of(waveform, pulses(100))
    assert hundred < 10 * ten  # the work grows with the contacts, no faster
    assert len(found.contacts) == 100
    times = [one.time for one in found.contacts]
    inside = np.mean([near(one, 4e-3, 1.0) for one in times])
    assert 0.5 < inside < 0.9


@pytest.mark.slow
def test_a_million_samples_take_hardly_more_steps_than_few():
    data = pulses(3, rate=1.4e7, noise=5.0)
    assert len(data[0]) > 900_000
    _, few = calls_of(waveform, pulses(3, noise=5.0))
    _, many = calls_of(waveform, data)
    assert many < 1.5 * few
    found, held = memory_of(waveform, data)
    assert held < 20 * data[0].nbytes
    assert len(found.contacts) == 3
    assert all(near(one.time, 4e-3) and one.time.std_dev < 1e-5 for one in found.contacts)


@pytest.mark.parametrize("seed", range(20))
def test_pure_noise_has_no_contacts(seed):
    times = np.arange(20_000) * 1e-5
    found = waveform((times, np.random.default_rng(seed).normal(3.0, 1.0, len(times))))
    assert found.contacts == ()
    assert found.noise == pytest.approx(1.0, rel=0.05)
    assert any("no contact stands out" in note for note in found.notes)
    assert found.parts() == {}
    assert near(found.baseline, 3.0)


def test_a_constant_record_has_no_contacts():
    found = waveform((np.arange(100) * 1e-3, np.full(100, 2.5)))
    assert found.contacts == ()
    assert found.baseline.nominal_value == pytest.approx(2.5)
    assert draw(None, found).axes


@pytest.mark.parametrize(
    ("at", "change", "words"),
    [
        (slice(None, None, 7), np.nan, "blank"),
        ([100, 101], 50.0, "one or two samples"),
        (100, 300.0, "1 spike"),
        (560, 300.0, "1 spike"),
        (None, 0.0, "sorted"),
    ],
)
def test_what_is_odd_in_a_record_is_left_out_and_said(at, change, words):
    times, force = pulses(1)
    if at is None:
        order = np.random.default_rng(1).permutation(len(times))
        times, force = times[order], force[order]
    else:
        force[at] += change
    found = waveform((times, force))
    (contact,) = found.contacts
    assert near(contact.time, 4e-3)
    assert near(contact.peak_force, 100.0, 5.0)
    assert any(words in note for note in found.notes)


def test_uneven_time_steps():
    random = np.random.default_rng(3)
    times = np.cumsum(random.uniform(0.5e-5, 1.5e-5, 2500))
    force = 100.0 * np.sin(np.pi * np.clip((times - 0.01) / 4e-3, 0.0, 1.0))
    found = waveform((times, force + random.normal(0.0, 0.5, len(times))))
    (contact,) = found.contacts
    assert near(contact.start, 0.01)
    assert near(contact.time, 4e-3)
    assert near(contact.impulse, 100.0 * 4e-3 * 2.0 / np.pi)
    assert any("uneven" in note for note in found.notes)


@pytest.mark.parametrize("bits", [None, 8])
def test_a_clipped_record_is_told(bits):
    found = waveform(record_of(ONE, rate=1e5, noise=0.5, full_scale=100.0, bits=bits))
    (contact,) = found.contacts
    assert contact.clipped
    assert any("clipped at" in note for note in found.notes)
    assert near(contact.time, TIME)
    assert {row.name: row.value for row in found.rows()}["peak force"].startswith("above")


@pytest.mark.parametrize("bits", [6, 8, 12])
def test_a_converter_s_steps_are_not_taken_for_clipping(bits):
    (contact,) = waveform(record_of(ONE, rate=1e5, bits=bits, full_scale=256.0)).contacts
    assert not contact.clipped
    assert len(contact.peaks) == 1
    assert contact.time.nominal_value == pytest.approx(TIME, rel=0.03)


@pytest.mark.parametrize("resonance", [(600.0, 0.01), (800.0, 0.03), (1100.0, 0.1)])
def test_the_ringing_of_a_sensor_is_taken_off(resonance):
    how = {"noise": 1.0, "before": 0.01, "bits": 12, "full_scale": 256.0, "seed": 3}
    record = record_of(ONE, rate=5e4, resonance=resonance, **how)
    found = waveform(record)
    (contact,) = found.contacts
    (note,) = [note for note in found.notes if "sensor rings" in note]
    assert float(re.search(r"at (\d+) Hz", note)[1]) == pytest.approx(resonance[0], rel=0.02)
    assert near(contact.start, record.attrs["touch"])
    assert near(contact.time, TIME)
    assert near(contact.peak_force, PEAK)
    assert near(contact.impulse, 0.4)
    assert contact.time.std_dev < 0.02 * TIME
    assert contact.peak_force.std_dev < 0.01 * PEAK


def test_small_contacts_after_a_large_one_are_no_ringing():
    times = np.arange(0.0, 0.012, 2e-5)
    humps = [(2e-3, 100.0), (3.5e-3, 30.0), (5e-3, 10.0)]
    phases = [np.pi * np.clip((times - at) / 1e-3, 0.0, 1.0) for at, _ in humps]
    force = sum(height * np.sin(phase) for phase, (_, height) in zip(phases, humps, strict=True))
    found = waveform((times, force + np.random.default_rng(1).normal(0.0, 0.3, len(times))))
    assert len(found.contacts) == 3
    assert not any("sensor rings" in note for note in found.notes)


def test_no_contact_begins_before_the_one_before_it_ends():
    times = np.arange(0.0, 0.03, 2e-5)
    at = np.clip(times - 0.01, 0.0, 8e-3)
    force = 100.0 * np.sin(np.pi * at / 4e-3) ** 2  # two humps that touch
    found = waveform((times, force + np.random.default_rng(1).normal(0.0, 0.5, len(times))))
    ends = [(one.start.n, one.end.n) for one in found.contacts]
    assert all(before[1] <= after[0] for before, after in pairwise(ends))


@pytest.mark.parametrize("shape", ["square", "decay", "negative decay"])
@pytest.mark.parametrize("noise", [0.1, 0.5])
def test_a_square_wave_and_a_decay_are_no_contacts(shape, noise):
    times = np.arange(0.0, 0.1, 2e-5)
    wave = np.where((times % 0.02) > 0.012, 100.0, 0.0)
    fade = np.where(times > 0.02, 100.0 * np.exp(-(times - 0.02) / 8e-3), 0.0)
    values = {"square": wave, "decay": fade, "negative decay": -fade}[shape]
    found = waveform((times, values + np.random.default_rng(1).normal(0.0, noise, len(times))))
    assert not found.contacts
    assert any("no contacts of balls" in note for note in found.notes)


@pytest.mark.parametrize(("edge", "count"), [(0.05, 0), (0.5, 6)])
def test_equal_pulses_with_slow_edges_are_a_square_wave_unless_they_are_round(edge, count):
    times = np.arange(0.0, 0.12, 2e-5)
    phase = np.clip((times % 0.02 - 2e-3) / 4e-3, 0.0, 1.0)  # of a pulse every 20 ms
    force = np.clip(np.sin(np.pi * phase) / np.sin(np.pi * edge), 0.0, 1.0)
    found = waveform((times, 100.0 * force + np.random.default_rng(1).normal(0.0, 0.5, len(times))))
    assert len(found.contacts) == count
    assert any("no contacts of balls" in note for note in found.notes) == (count == 0)


@pytest.mark.parametrize("rate", [2e4, 5e4, 1e5])
def test_a_dashpot_that_loses_nearly_all_is_a_contact(rate):
    law = sb.calibrate(sb.Dashpot, mass=0.1, contact_time=TIME, impact_speed=2.0, restitution=0.1)
    drop = sb.Drop([sb.Ball(0.1)], [law], impact_speed=2.0)
    for seed in range(5):
        found = waveform(record_of(drop, rate=rate, noise=0.8, before=6e-3, seed=seed))
        assert len(found.contacts) == 1
        assert not any("no contacts of balls" in note for note in found.notes)


@pytest.mark.parametrize("law", [sb.Spring, sb.Dashpot, sb.Hysteretic])
@pytest.mark.parametrize("bits", [None, 8])
def test_a_contact_that_is_clipped_low_is_one(law, bits):
    shape = {"restitution": 0.9} if law is not sb.Spring else {}
    made = sb.calibrate(law, mass=0.1, contact_time=TIME, impact_speed=2.0, **shape)
    drop = sb.Drop([sb.Ball(0.1)], [made], impact_speed=2.0)
    record = record_of(drop, rate=5e4, noise=0.5, before=6e-3, full_scale=20.0, bits=bits)
    found = waveform(record)
    assert [contact.clipped for contact in found.contacts] == [True]
    assert found.contacts[0].time.nominal_value == pytest.approx(TIME, rel=0.03)


@pytest.mark.parametrize("mains", [50.0, 60.0])
def test_the_amplitude_of_hum_is_told(mains):
    record = record_of(ONE, rate=2e4, noise=0.5, hum=10.0, mains=mains, before=0.1)
    assert waveform(record).hum == pytest.approx(10.0, rel=0.05)


@pytest.mark.parametrize("before", [3e-3, 8e-3, 0.03, 0.1])
@pytest.mark.parametrize("mains", [50.0, 60.05])
def test_hum_is_taken_off_even_if_it_has_less_than_two_periods(before, mains):
    how = {"noise": 0.5, "hum": 8.0, "mains": mains, "before": before, "seed": 2}
    found = waveform(record_of(ONE, rate=5e4, **how))
    (contact,) = found.contacts
    assert any(f"hum of {mains:.0f} Hz" in note for note in found.notes)
    assert near(contact.time, TIME)
    assert near(contact.impulse, 0.4)
    assert near(contact.peak_force, PEAK)
    assert contact.impulse.std_dev < 0.003


@pytest.mark.parametrize("time_constant", [5e-3, 0.02, 0.1])
def test_a_droop_is_no_hum(time_constant):
    how = {"noise": 0.5, "time_constant": time_constant, "before": 5e-3}
    assert not waveform(record_of(ONE, rate=5e4, **how)).hum


def test_few_samples_are_said_and_covered_by_the_error():
    found = waveform(record_of(ONE, rate=1100.0, noise=0.5, before=0.02))
    (contact,) = found.contacts
    assert contact.samples < 6
    assert any("sample faster" in note for note in found.notes)
    assert near(contact.time, TIME)


def test_a_record_that_begins_or_stops_within_a_contact():
    times, force = pulses(3)
    late, early = (waveform((times[part], force[part])) for part in (np.s_[550:], np.s_[:2580]))
    assert late.contacts[0].start is late.contacts[0].time is None
    assert any("begins within" in note for note in late.notes)
    assert early.contacts[-1].end is None
    assert any("stops within" in note for note in early.notes)
    assert near(early.contacts[0].time, 4e-3)
    for found in (late, early):
        draw(None, found)
        assert found.rows()


def test_further_channels_are_named():
    record = record_of(ONE, rate=1e5, noise=1.0, contacts=[0, 0])
    assert any("not Force_2 (N)" in note for note in waveform(record).notes)
    assert waveform(record[["force_2"]]).contacts


@pytest.mark.parametrize(
    ("data", "error"),
    [
        ("record.csv", InvalidType),
        (([1.0] * 20,), InvalidValue),
        (([1, 2, 3], [1, 2, 3]), InvalidValue),
        ((np.arange(20.0), np.full(20, np.nan)), InvalidValue),
        ((np.arange(20.0), np.arange(19.0)), InvalidValue),
        ((np.arange(9.0), ["a"] * 9), InvalidType),
        ((np.zeros(20), np.arange(20.0)), InvalidValue),
        (xr.Dataset({"sound": ("time", np.zeros(9))}, {"time": np.arange(9.0)}), InvalidValue),
    ],
)
def test_what_is_no_waveform_is_refused_in_one_line(data, error):
    assert refusal(error, waveform, data).startswith("data must")


@pytest.mark.parametrize("option", ["mass", "impact_speed", "time_constant"])
def test_options_are_checked(option):
    with pytest.raises(InvalidValue, match=option):
        waveform(pulses(1), **{option: -1.0})


def test_an_impulse_between_two_samples_is_zero():
    assert impulse_of(np.arange(5.0), np.ones(5), 0.0, 0.0, (7.0, 1.5)) == (0.0, 0.0)


def test_pictures_of_every_kind():
    axes = [draw(None, waveform(pulses(n, apart=0.5, rate=1e4))).axes for n in (1, 5)]
    assert [len(panels) for panels in axes] == [1, 2]
    record = record_of(ONE, rate=2e3, noise=0.5).assign_attrs(source="bounce.csv")
    assert "bounce.csv" in draw(record, waveform(record)).axes[0].get_title(loc="left")


@pytest.mark.parametrize("time_constant", [1e-4, 1e-2, 10.0])
def test_droop_and_its_inverse_undo_each_other(time_constant):
    random = np.random.default_rng(1)
    times = np.cumsum(random.uniform(0.5e-4, 2e-4, 1000))
    force = np.cumsum(random.normal(size=1000))
    back = undrooped(times, drooped(times, force, time_constant), time_constant)
    assert back == pytest.approx(force, abs=1e-8)


@pytest.mark.parametrize("time_constant", [4e-3, 2e-2, 0.5])
@pytest.mark.parametrize("offset", [0.0, -7.0])
def test_droop_is_put_back(time_constant, offset):
    how = {"noise": 0.5, "offset": offset, "time_constant": time_constant, "before": 0.01}
    (contact,) = waveform(record_of(ONE, rate=1e5, **how), time_constant=time_constant).contacts
    assert near(contact.time, TIME)
    assert abs(contact.impulse.nominal_value - 0.4) < max(4.0 * contact.impulse.std_dev, 1e-3)


def test_droop_that_is_not_put_back_is_said_with_its_time_constant():
    record = record_of(ONE, rate=1e5, noise=0.2, time_constant=0.04, before=0.01)
    (note,) = [one for one in waveform(record).notes if "droop" in one]
    assert float(re.search(r"about (0\.0\d+) s", note)[1]) == pytest.approx(0.04, abs=0.005)
    assert not any("droop" in one for one in waveform(record, time_constant=0.04).notes)
