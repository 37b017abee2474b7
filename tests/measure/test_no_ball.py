"""Sounds that no ball made have times but no restitution; bounces of a ball have one."""

import numpy as np
import pytest
from scipy.signal import butter, sosfilt

from stackbounce.errors import InvalidValue
from stackbounce.measure import analyse
from stackbounce.measure.kinds.bounces.analysis import bounces
from stackbounce.measure.kinds.bounces.knocks import Knocks
from stackbounce.measure.kinds.sound.analysis import knocks
from synthetic.falls import falls
from synthetic.sound import sound

RATE = 44_100


def noise(random, seconds):
    return 1e-3 * random.standard_normal(round(seconds * RATE))


def add(values, time, sound):
    first = round(time * RATE)
    part = values[first : first + len(sound)]
    part += sound[: len(part)]


def click(random, loud, decay=4e-3, band=(400.0, 6000.0)):
    """Return a burst of noise in a band."""
    since = np.arange(round(10.0 * decay * RATE)) / RATE
    burst = sosfilt(
        butter(2, band, "bandpass", fs=RATE, output="sos"), random.standard_normal(len(since))
    )
    return loud * np.exp(-since / decay) * burst


def clicks(random):
    """Return clicks at random times, of random loudness, as those of a keyboard."""
    count = random.integers(5, 40)
    values = noise(random, 0.2 * count + 1.0)
    for time in 0.3 + 0.2 * count * random.random(count):
        add(values, time, click(random, random.lognormal(-1.0, 0.7)))
    return values


def steps(random):
    """Return steps: heel and toe, nearly in time, alternately louder."""
    values = noise(random, 8.0)
    time = 0.4
    for k in range(random.integers(6, 12)):
        for late, share in ((0.0, 1.0), (random.normal(0.09, 0.01), 0.4)):
            loud = share * (0.5 + 0.15 * (k % 2)) * random.lognormal(0.0, 0.2)
            add(values, time + late, click(random, loud, 15e-3, (80.0, 1500.0)))
        time += random.normal(0.55, 0.03)
    return values


def claps(random):
    """Return claps in a room, about as often as somebody claps."""
    values = noise(random, 6.0)
    for time in np.cumsum(random.normal(0.24, 0.02, random.integers(6, 20))):
        add(values, time, click(random, 0.5 * random.lognormal(0.0, 0.3), 6e-3))
    room = 0.2 * random.standard_normal(RATE // 3) * np.exp(-np.arange(RATE // 3) / 3000.0)
    room[0] = 1.0
    return np.convolve(values[: 3 * RATE], room)[: 3 * RATE]


def speech(random):
    """Return syllables: buzzes of a pitch that swell and fade, some with a plosive before."""
    values = noise(random, 4.0)
    time = 0.3
    for _ in range(random.integers(5, 14)):
        long = random.uniform(0.06, 0.25)
        since = np.arange(round(long * RATE)) / RATE
        buzz = np.sign(np.sin(2.0 * np.pi * random.uniform(90.0, 220.0) * since))
        buzz = sosfilt(butter(2, (300.0, 2500.0), "bandpass", fs=RATE, output="sos"), buzz)
        add(values, time, random.uniform(0.1, 0.4) * buzz * np.sin(np.pi * since / long) ** 0.5)
        if random.random() < 0.6:
            add(values, time - 0.02, click(random, 0.2, 2e-3, (1500.0, 8000.0)))
        time += long + random.exponential(0.08)
    return values


def rain(random):
    """Return drops that fall all the time on a window sill."""
    values = 10.0 * noise(random, 3.0)
    for time in 3.0 * random.random(random.integers(60, 300)):
        add(values, time, click(random, random.lognormal(-1.5, 0.8), 1.5e-3, (800.0, 9000.0)))
    return values


@pytest.mark.fast_cases(2)
@pytest.mark.parametrize("seed", range(6))
@pytest.mark.parametrize("made", [clicks, steps, claps, speech, rain])
def test_other_sounds_have_times_but_no_restitution(made, seed):
    values = made(np.random.default_rng([seed, 7]))
    heard = knocks(values, rate=RATE)
    assert heard.against
    assert any(heard.against in note and note.endswith("start, stop.") for note in heard.notes)
    assert len(heard.times) >= 2
    with pytest.raises(InvalidValue, match="times must be those of a bouncing ball, got "):
        bounces(heard)


def test_what_is_no_ball_has_knocks_alone():
    data = sound(falls(0.5, 0.8, bounces=4), seed=1)
    (heard,) = analyse(data.assign(sound=("time", data.sound.values[::-1])))
    assert isinstance(heard, Knocks)


@pytest.mark.fast_cases(4)
@pytest.mark.parametrize("count", [3, 5, 7, 8, 12])
@pytest.mark.parametrize(
    "options", [{}, {"noise": 0.01}, {"room": 0.4, "alike": 0.7}, {"double": (0.003, 0.8)}], ids=str
)
@pytest.mark.parametrize("restitution", [0.6, 0.9])
def test_bounces_of_a_ball_are_kept(count, options, restitution):
    fall = falls(1.0, restitution, bounces=count if restitution > 0.7 else min(count, 6))
    found = knocks(sound(fall, seed=count, **options))
    assert found.against == ""
    assert len(found.times) == len(fall.touches)


def test_few_loud_sounds_among_others_are_no_series():
    values = noise(np.random.default_rng(1), 3.0)
    for time, loud in ((0.3, 0.5), (0.9, 0.45), (1.2, 0.6), (1.4, 0.4), (2.2, 0.55)):
        add(values, time, click(np.random.default_rng(2), loud))
    assert knocks(values, rate=RATE).against
    part = values[round(0.2 * RATE) : round(1.0 * RATE)]
    assert knocks(part, rate=RATE).against == ""  # two tell of a flight


@pytest.mark.parametrize("late", [0.02, 0.04])
def test_an_onset_is_not_left_out_for_its_louder_tail(late):
    values = noise(np.random.default_rng(1), 4.0)
    times = np.array([0.5, 1.2, 1.4, 2.4, 2.6, 3.4])
    for time in times:
        add(values, time, click(np.random.default_rng(3), 0.2, 30e-3))
        add(values, time + late, click(np.random.default_rng(4), 0.5, 30e-3))
    heard = knocks(values, rate=RATE)
    assert heard.against
    assert [time.nominal_value for time in heard.times] == pytest.approx(times, abs=1e-3)
    assert {dropped.why for dropped in heard.dropped} <= {
        "tail of a sound",
        "second sound of one impact",
    }


@pytest.mark.parametrize("silent", [0.004, 0.01, 0.02])
def test_where_a_codec_begins_is_no_knock(silent):
    data = sound(falls(0.5, 0.8, bounces=6), noise=5e-3, before=0.3, seed=3)
    values = data.sound.values.copy()
    values[: round(silent * 48000)] = 0.0
    found = knocks(values, rate=48000.0)
    assert len(found.times) == 6
    assert found.dropped == () or found.dropped[0].time > 0.3


def test_a_codecs_echo_before_a_knock_shifts_no_time():
    fall = falls(0.3, 0.85, bounces=9)
    found = knocks(sound(fall, coarse=0.5, noise=1e-5, room=0.4, uneven=0.2, seed=6))
    assert any("precedes some knocks" in note for note in found.notes)
    off = np.array([time.nominal_value for time in found.times]) - fall.touches
    assert np.abs(off - np.median(off)).max() < 0.25e-3  # 0.42 ms with the echo


def test_a_drop_from_above_five_metres_must_be_told():
    data = sound(falls(8.0, 0.5, bounces=5), seed=1)
    (heard,) = analyse(data)
    assert "the fall before the first sound" in heard.against
    told, _ = analyse(data, height=8.0)
    assert told.restitutions[1].nominal_value == pytest.approx(0.5, abs=2e-3)
