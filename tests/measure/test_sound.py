"""Knocks in recordings, ordinary and bad ones."""

import math

import numpy as np
import pytest
import xarray as xr

from stackbounce.errors import InvalidType, InvalidValue
from stackbounce.measure.kinds.bounces.analysis import bounces
from stackbounce.measure.kinds.sound.analysis import knocks
from stackbounce.measure.kinds.sound.loudness import Rises
from stackbounce.measure.kinds.sound.sequence import find_chain
from stackbounce.plots.measurements.bounces import draw as draw_bounces
from stackbounce.plots.measurements.sound import draw as draw_sound
from synthetic.falls import falls
from synthetic.sound import sound
from work import calls_of, memory_of

FALL = falls(0.5, 0.8, bounces=10)


def as_true(found, fall, before=0.5):
    """Return whether each bounce was found, and nothing else."""
    seen = [one.nominal_value for one in found.times]
    return seen == pytest.approx(fall.touches - fall.touches[0] + before, abs=1.5e-3, rel=0.0)


@pytest.mark.parametrize(("error", "series"), [(1e-3, (0, 1)), (1e-2, (0, 1, 2))])
def test_a_flight_is_longer_than_the_one_before_by_its_error_only(error, series):
    times = np.array([0.0, 0.5, 1.03])
    rises = Rises(times, np.full(3, error), np.array([3.0, 2.0, 1.0]), np.full(3, 9.0))
    assert find_chain(rises).indices == series


@pytest.mark.fast_cases(6)
@pytest.mark.parametrize(
    "options",
    [
        {},
        {"noise": 0.01},
        {"hum": 0.1},
        {"echo": (0.09, 0.5)},
        {"echo": (0.2, 0.5)},
        {"double": (0.003, 0.8)},
        {"attack": 0.5e-3},
    ],
    ids=str,
)
@pytest.mark.parametrize("seed", [1, 2])
def test_each_bounce_is_found_and_nothing_else(options, seed):
    assert as_true(knocks(sound(FALL, seed=seed, **options)), FALL)


def test_speech_before_the_series_is_left_out():
    found = knocks(sound(FALL, speech=0.1, before=2.0, seed=1))
    assert as_true(found, FALL, 2.0)
    assert found.against == ""
    assert any(one.time < 2.0 for one in found.dropped)


def test_echoes_and_clipping_are_told():
    assert any("clipped" in note for note in knocks(sound(FALL, level=3.0, seed=1)).notes)
    found = knocks(sound(FALL, echo=(0.05, 0.4), seed=1))
    assert any("echo 50.0 ms later" in note for note in found.notes)
    assert sum(one.why == "echo" for one in found.dropped) >= 5


def test_fast_bounces_at_the_end():
    fall = falls(0.1, 0.8, bounces=13)
    assert np.diff(fall.touches)[-1] < 0.021
    assert as_true(knocks(sound(fall, seed=2)), fall)


def test_a_missed_bounce_is_told():
    quiet = sound(FALL, seed=3)
    start = FALL.touches[4] - FALL.touches[0] + 0.5
    lost = (quiet.time > start - 0.01) & (quiet.time < start + 0.1)
    found = knocks(quiet.where(~lost, 0.0))
    assert found.missed[3] == 1
    assert any("missing" in note for note in found.notes)
    kept = bounces(found)
    assert kept.flights[3] is None
    assert kept.mean.nominal_value == pytest.approx(0.8, abs=1e-3)


def test_a_second_drop_is_told_and_can_be_chosen():
    one = sound(FALL, seed=1).sound.values
    both = np.concatenate([one, 0.9 * one])
    found = knocks(both, rate=48000.0)
    assert len(found.times) == 10
    assert any("another series" in note for note in found.notes)
    times = np.arange(len(one), len(both)) / 48000.0
    later = knocks(xr.Dataset({"sound": ("time", both[len(one) :])}, {"time": times}))
    assert len(later.times) == 10
    assert later.times[0].nominal_value > 3.0


def test_pure_noise_has_no_knocks():
    for seed in range(5):
        noise = np.random.default_rng(seed).normal(0.0, 0.1, 96000)
        with pytest.raises(InvalidValue, match="must hold a knock"):
            knocks(noise, rate=48000.0)


@pytest.mark.parametrize(
    ("data", "options", "error", "words"),
    [
        (np.full(1000, math.nan), {"rate": 8000.0}, InvalidValue, "silence"),
        (np.ones(3), {"rate": 8000.0}, InvalidValue, "must hold a knock"),
        (np.ones(0), {"rate": 8000.0}, InvalidValue, "silence"),
        (np.ones((2, 99)), {"rate": 8000.0}, InvalidValue, "data must hold sound"),
        (np.ones(1000), {}, InvalidValue, "rate must be given"),
        (np.ones(1000), {"rate": -1.0}, InvalidValue, "rate must be"),
        (np.ones(1000), {"rate": 399.0}, InvalidValue, "400 samples per second or more"),
        ("a.wav", {"rate": 1.0}, InvalidType, "data must be"),
    ],
)
def test_what_is_no_recording(data, options, error, words):
    with pytest.raises(error, match=words):
        knocks(data, **options)


@pytest.mark.slow
def test_two_minutes_take_hardly_more_steps_than_seconds():
    noise = np.random.default_rng(1).normal(0.0, 0.002, 120 * 48000).astype(np.float32)
    short = sound(FALL, seed=1).sound.values
    noise[1_000_000 : 1_000_000 + len(short)] += short
    _, few = calls_of(knocks, short, rate=48000.0)
    found, held = memory_of(knocks, noise, rate=48000.0)
    assert len(found.times) == 10
    assert held < 6 * noise.nbytes
    _, many = calls_of(knocks, noise, rate=48000.0)
    assert many < 1.5 * few


def test_pictures():
    data = sound(falls(0.5, 0.8, bounces=6), echo=(0.05, 0.4), seed=1)
    found = knocks(data)
    figure = draw_sound(data, found)
    assert [axes.get_ylabel() for axes in figure.axes] == ["sound (full scale 1)", "flight (ms)"]
    labels = [text.get_text() for text in figure.axes[0].get_legend().get_texts()]
    assert labels[0] == "6 knocks"
    assert "left out" in labels[1]
    figure = draw_bounces(found, bounces(found))
    assert figure.axes[0].get_xlabel() == "impact speed (m/s)"
    assert draw_bounces(None, bounces([0.0, 1.0, 1.8]))
