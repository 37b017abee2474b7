"""Knocks as real ones are: their times agree with each other, and what is no bounce is refused."""

import re

import numpy as np
import pytest
from scipy.signal import fftconvolve
from uncertainties import ufloat

from stackbounce.measure import analyse
from stackbounce.measure.kinds.bounces.analysis import bounces
from stackbounce.measure.kinds.bounces.scatter import scatter_of
from stackbounce.measure.kinds.sound.alignment import aligned
from stackbounce.measure.kinds.sound.analysis import knocks
from stackbounce.measure.kinds.sound.consistency import misjudgement
from stackbounce.measure.kinds.sound.onset import onsets
from stackbounce.measure.statistics.ar_noise import whitened
from synthetic.falls import falls
from synthetic.sound import sound

RATE = 44100.0


def with_precursors(fall, seed):
    """Return knocks with a faint ringing before them, of other loudness and length each time."""
    random = np.random.default_rng(seed)
    data = sound(fall, rate=RATE, noise=5e-4, alike=0.7, uneven=0.2, room=0.4, seed=seed)
    values = data.sound.values.astype(float)
    for touch, speed in zip(fall.touches - fall.touches[0] + 0.5, fall.speeds, strict=True):
        since = np.arange(len(values)) / RATE - touch
        loud = speed / fall.speeds[0]
        rising = (since > -random.uniform(0.3e-3, 1.2e-3)) & (since < 0.0)
        ringing = np.exp(-np.maximum(since, 0.0) / 2e-3) * (since >= 0.0)
        faint = 0.01 * random.uniform(0.5, 2.0)
        values += loud * np.sin(6e4 * since) * (faint * rising + 0.3 * ringing)
    return values.astype(np.float32)


@pytest.mark.parametrize("seed", range(3))
def test_knocks_with_precursors_are_timed_alike(seed):
    fall = falls(0.05, 0.945, bounces=25)
    values = with_precursors(fall, seed)
    found = knocks(values, rate=RATE)
    times, errors = (np.array([getattr(one, part) for one in found.times]) for part in "ns")
    assert len(times) == 25
    first, claimed = onsets(whitened(values, 0.0), RATE, times, 0.0)
    off, picked = times - fall.touches, first - fall.touches
    assert np.std(picked) > 5.0 * np.median(claimed)  # what it was: picked inconsistently
    assert np.std(off) < 0.3 * np.std(picked)
    within = np.abs(off - np.average(off, weights=errors**-2)) < errors
    assert 0.4 < within.mean() < 0.95
    assert bounces(found).mean.nominal_value == pytest.approx(0.945, abs=1e-3)


def test_a_wrong_first_time_does_not_matter():
    fall = falls(0.3, 0.8, bounces=8)
    values = sound(fall, seed=1, alike=0.9).sound.values
    true = fall.touches - fall.touches[0] + 0.5
    wrong = true + 1e-3 * np.random.default_rng(1).uniform(-1.0, 1.0, 8)
    times, errors = aligned(values, 48000.0, wrong)
    assert np.std(times - true) < 0.05e-3
    again, _ = aligned(values, 48000.0, true)
    assert np.ptp((times - again)[1:] - (times - again)[:-1]) < 4.0 * errors.max()


def test_a_record_of_amplitudes_is_no_sound_but_has_knocks():
    fall = falls(0.05, 0.93, bounces=20)
    values = sound(fall, rate=48000.0, alike=0.5, room=0.3, seed=2).sound.values
    rows = np.abs(values[: len(values) // 48 * 48]).reshape(-1, 48).mean(axis=1)
    told = bounces(knocks(rows, rate=1000.0))
    assert len(told.restitutions) >= 15
    assert told.mean.nominal_value == pytest.approx(0.93, abs=3e-3)
    off = [abs(one.nominal_value - 0.93) < 2.0 * one.std_dev for one in told.restitutions]
    assert np.mean(off) > 0.7


def test_errors_that_are_too_small_show_in_the_flights():
    fall = falls(0.3, 0.85, bounces=20)
    claimed = np.full(20, 1e-4)
    factors = []
    for seed in range(6):
        off = 1e-3 * np.random.default_rng(seed).standard_normal(20)
        factors.append(misjudgement(fall.touches + off, claimed, [0] * 19))
        assert misjudgement(fall.touches + 0.02 * off, claimed, [0] * 19) < 0.6
    assert 8.0 < np.mean(factors) < 13.0
    one = [0] * 19
    one[9] = 1  # flights that are not neighbours tell nothing
    later = fall.touches + off + np.where(np.arange(20) > 9, 0.1, 0.0)
    assert misjudgement(later, claimed, one) < 16.0


def tempo(times, seed):
    random = np.random.default_rng(seed)
    values = 1e-3 * random.standard_normal(round((times[-1] + 0.5) * RATE))
    since = np.arange(round(0.05 * RATE)) / RATE
    click = 0.5 * np.sin(2.0 * np.pi * 2500.0 * since) * np.exp(-since / 5e-3)
    for first in np.round(times * RATE).astype(int):
        values[first : first + len(click)] += random.uniform(0.9, 1.1) * click
    return values


@pytest.mark.parametrize("count", [3, 8])
@pytest.mark.parametrize("jitter", [0.0, 1.5e-3])
def test_a_metronome_is_refused(count, jitter):
    times = 0.2 + 0.5 * np.arange(count) + jitter * np.random.default_rng(3).standard_normal(count)
    heard = knocks(tempo(times, 1), rate=RATE)
    assert re.search(r"equal intervals of 0\.\d+ s, or nearly so, as of a metronome", heard.against)
    assert [time.nominal_value for time in heard.times] == pytest.approx(times, abs=1e-3)


def drum(seed):
    """Return one stroke: slow tones whose beats swell again."""
    random = np.random.default_rng(seed)
    since = np.arange(round(0.7 * RATE))[:, None] / RATE
    tones = np.sin(2.0 * np.pi * random.uniform(60, 900, 8) * since + random.uniform(0, 6, 8))
    stroke = (np.exp(-since / random.uniform(0.02, 0.3, 8)) * tones).sum(axis=1)
    values = np.concatenate([np.zeros(441), stroke * -np.expm1(-since[:, 0] / 1e-3)])
    return 0.8 * values / np.abs(values).max() + 1e-4 * random.standard_normal(len(values))


def clap(seed):
    """Return one clap of noise in a room with echoes."""
    random = np.random.default_rng(seed)
    since = np.arange(round(0.02 * RATE)) / RATE
    values = np.zeros(round(1.5 * RATE))
    values[13230 : 13230 + len(since)] = random.standard_normal(len(since)) * np.exp(-since / 2e-3)
    late = np.arange(round(1.2 * RATE)) / RATE
    room = 0.05 * random.standard_normal(len(late)) * np.exp(-11.5 * late)
    room[0] = 1.0
    for delay in random.uniform(5e-3, 90e-3, 25):
        room[round(delay * RATE)] += 0.6 * random.uniform(0.3, 1.0) * np.exp(-11.5 * delay)
    values = fftconvolve(values, room)[: len(values)]
    return 0.8 * values / np.abs(values).max() + 1e-3 * random.standard_normal(len(values))


@pytest.mark.parametrize("made", [drum, clap])
@pytest.mark.parametrize("seed", range(2, 6))
def test_one_stroke_and_one_clap_have_no_restitution(made, seed):
    heard = knocks(made(seed), rate=RATE)
    assert "one sound with echoes" in heard.against or len(heard.times) == 1
    assert "one sound with echoes, at 0.01" in heard.against or (made, seed) != (drum, 2)


def test_a_loud_sound_with_faint_ones_is_no_series():
    values = np.concatenate([drum(0)[:4410] * np.exp(-np.arange(4410) / 400.0), np.zeros(22050)])
    values += 1e-5 * np.random.default_rng(1).standard_normal(len(values))
    for k, late in enumerate([0.12, 0.2, 0.255]):
        first = round(late * RATE)
        values[first : first + 4410] += 0.02 * 0.7**k * values[441:4851]
    assert "one sound with echoes" in knocks(values, rate=RATE).against


def timed(count, jitter, floor, seed, claimed=1e-4):
    """Return times of bounces with errors, some of them timing and some of the floor."""
    random = np.random.default_rng(seed)
    fall = falls(0.3, lambda speed: 0.9 - 0.01 * speed + floor * random.normal(), bounces=count)
    times = fall.touches + jitter * random.standard_normal(count)
    return times if claimed is None else [ufloat(one, claimed) for one in times]


def about_scatter(told):
    (note,) = (note for note in told.notes if "from bounce to bounce" in note)
    return note


@pytest.mark.parametrize("seed", range(4))
def test_scatter_that_alternates_is_timing_and_other_the_floors(seed):
    told = bounces(timed(22, 1e-3, 0.0, seed))
    note = about_scatter(told)
    assert "alternates (lag-1 autocorrelation -0." in note
    assert ("timing" in note, "floor" in note) == (True, False)
    assert told.scatter == 0.0
    assert told.times[3].std_dev == pytest.approx(1e-3, rel=0.6)
    assert abs(told.mean.nominal_value - 0.89) < 0.01
    told = bounces(timed(22, 0.0, 0.01, seed))
    note = about_scatter(told)
    assert "an uneven floor or a spinning ball" in note
    assert "timing" not in note
    assert 0.004 < told.scatter < 0.02
    assert told.mean.std_dev > 1e-3


@pytest.mark.parametrize(
    ("series", "words"),
    [
        ((7, 0.0, 0.02, 1), "These bounces do not tell apart the timing and an uneven floor"),
        ((25, 1.5e-3, 0.0, 2, None), "alternates .* timing"),
        ((25, 0.0, 0.015, 2, None), "does not alternate"),
    ],
)
def test_few_bounces_and_times_without_errors(series, words):
    assert re.search(words, about_scatter(bounces(timed(*series))))


def test_single_restitutions_allow_for_timing_where_the_cause_is_unknown():
    true = falls(0.3, lambda speed: 0.9 - 0.01 * speed, bounces=8).restitutions[1:-1]
    off = []
    for seed in range(60):
        told = bounces(timed(8, 5e-4, 0.0, seed))
        if any("tell apart" in note for note in told.notes):
            off += [
                abs(kept.n - e) / kept.s for kept, e in zip(told.restitutions, true, strict=True)
            ]
    assert len(off) > 6 * 40
    assert 0.60 <= np.mean(np.array(off) < 1.0) <= 0.76
    assert np.mean(np.array(off) < 2.0) >= 0.93
    told = bounces(timed(7, 0.0, 0.02, 1))
    assert told.restitutions[-1].s > told.scatter > 0.01
    assert told.mean.s == pytest.approx(told.scatter / len(told.restitutions) ** 0.5, rel=0.3)


def test_knocks_have_the_errors_that_the_restitutions_tell():
    random = np.random.default_rng(1)
    data = sound(falls(0.3, lambda _: 0.85 + 0.02 * random.normal(), bounces=8), seed=1)
    told, heard = analyse(data)
    assert "tell apart" in about_scatter(told)
    assert heard.times == told.times
    assert heard.times[3].s > 10.0 * knocks(data).times[3].s


@pytest.mark.parametrize(("jitter", "floor", "cause"), [(1e-3, 0, "timing"), (0, 0.01, "floor")])
def test_the_cause_is_seldom_mistaken(jitter, floor, cause):
    causes = []
    for seed in range(40):
        flights = np.diff(timed(16, jitter, floor, 100 + seed))
        causes.append(scatter_of(list(4.9 * flights[:-1]), list(flights[1:] / flights[:-1])).cause)
    right = sum(found.startswith(cause) for found in causes)
    assert right >= 24
    assert len(causes) - right - causes.count("unknown") <= 2
