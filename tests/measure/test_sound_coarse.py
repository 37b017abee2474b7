"""Recordings of few bits, few samples, too loud or too quiet: the knocks are those that were."""

import numpy as np
import pytest

from stackbounce.measure.kinds.bounces.analysis import bounces
from stackbounce.measure.kinds.sound.analysis import knocks
from synthetic.falls import falls
from synthetic.sound import sound

FALL = falls(0.5, 0.8, bounces=9)
BEFORE = 0.5


def compared(data, rate):
    """Return errors of the times in s (found less true, and as claimed), and what bounces tells."""
    found = knocks(data)
    assert len(found.times) == len(FALL.touches), [one.why for one in found.dropped]
    assert not any(found.missed)
    true = FALL.touches - FALL.touches[0] + BEFORE
    off = np.array([one.nominal_value for one in found.times]) - true
    claimed = np.array([one.std_dev for one in found.times])
    assert np.abs(off).max() < 0.6e-3 + 1.0 / rate
    return off, claimed, bounces(found)


@pytest.mark.fast_cases(2)
@pytest.mark.parametrize(
    "options",
    [
        {"rate": 8000.0, "bits": 8},
        {"rate": 8000.0, "bits": 8, "noise": 0.0},
        {"rate": 8000.0, "bits": 8, "noise": 0.004},
        {"rate": 8000.0, "bits": 8, "noise": 0.01, "hum": 0.05},
        {"rate": 11025.0, "bits": 8, "echo": (0.05, 0.3)},
        {"rate": 44100.0, "bits": 8},
        {"rate": 44100.0, "bits": 8, "noise": 0.0},
        {"rate": 44100.0, "bits": 8, "noise": 0.0, "level": 0.1},
        {"rate": 44100.0, "bits": 8, "level": 8.0},
        {"rate": 48000.0, "level": 20.0},
        {"rate": 48000.0, "level": 0.005, "noise": 5e-5},
        {"rate": 48000.0, "level": 0.01, "noise": 0.0},
        {"rate": 192000.0, "bits": 24},
    ],
    ids=str,
)
def test_knocks_are_the_bounces_and_errors_are_sensible(options):
    rate = options["rate"]
    held, off_by = [], []
    for seed in range(4):
        off, claimed, told = compared(sound(FALL, seed=seed, before=BEFORE, **options), rate)
        assert (claimed < 0.15e-3 + 1.0 / rate).all()
        assert (claimed > 0.1 * min(1.0 / rate, 1.0 / 48e3)).all()
        assert abs(told.mean.nominal_value - 0.8) < 4.0 * told.mean.std_dev
        assert told.mean.std_dev < 5e-4
        off_by += list(np.abs(off - np.median(off)) / claimed)
        held += [abs(one.nominal_value - 0.8) < 2.0 * one.std_dev for one in told.restitutions]
    assert np.median(off_by) < 1.5
    assert np.mean(held) > 0.75


@pytest.mark.parametrize("seed", range(3))
def test_silence_and_a_noise_gate_make_no_knocks(seed):
    data = sound(FALL, seed=seed, before=BEFORE, rate=8000.0, bits=8, noise=0.0)
    compared(data - 1.0 / 128.0, 8000.0)
    data = sound(FALL, seed=seed, before=BEFORE, noise=0.003)
    loud = np.abs(data.sound) > 0.012
    compared(data.where(loud.rolling(time=960, min_periods=1).max() > 0, 0.0), 48e3)
    assert not knocks(data.where(data.time > 0.2, 0.0)).dropped  # a microphone that begins late


def test_uneven_bounces_leave_the_times_as_sure_as_they_are():
    random = np.random.default_rng(4)
    fall = falls(0.4, lambda _: 0.8 + 0.02 * float(random.standard_normal()), bounces=9)
    found = knocks(sound(fall, seed=4))
    assert max(time.std_dev for time in found.times) < 1e-4
    told = bounces(found)
    assert 0.008 < told.scatter < 0.05
    assert any("uneven floor" in note for note in told.notes)
    assert 0.003 < told.mean.std_dev < 0.03
    true = fall.restitutions[1 : 1 + len(told.restitutions)]
    off = [abs(one.nominal_value - kept) for one, kept in zip(told.restitutions, true, strict=True)]
    assert max(off) < 0.005
