"""Columns of times: rounded, repeated, since 1970, in a unit that nobody tells."""

import numpy as np
import pytest

import stackbounce as sb
from stackbounce.errors import InvalidValue
from stackbounce.measure.reading.series import even_times, rounding_steps, spread


@pytest.fixture
def read(read):
    """Read columns below a header."""

    def reader(head, *columns, **options):
        rows = zip(*(map(str, column) for column in columns), strict=True)
        return read("\n".join([head, *map(",".join, rows)]), **options)

    return reader


def noise(count):
    """Return numbers that stand for a sound or a force."""
    return np.random.default_rng(3).integers(-500, 500, count)


def singles(start, rate, count):
    return np.float32(start + np.arange(count) / rate)


ROUNDED = {
    "six digits at 44.1 kHz, in ms": ([f"{k / 44.1:.6g}" for k in range(20_000)], 1 / 44.1),
    "four digits, as an oscilloscope": ([f"{-5 + k / 1000:.2f}" for k in range(10_000)], 1e-3),
    "three digits": ([f"{k / 100:.2E}" for k in range(4106)], 1e-2),
    "whole milliseconds at 30 per second": ([f"{1e3 * k / 30:.0f}" for k in range(200)], 1e3 / 30),
    "cut to whole milliseconds": ([str(int(1e3 * k / 30)) for k in range(200)], 1e3 / 30),
    "whole milliseconds at 2.5 kHz": ([f"{0.4 * k:.0f}" for k in range(5000)], 0.4),
    "floats of 32 bits": ([str(float(one)) for one in singles(1e3, 1e3, 3000)], 1e-3),
    "nine digits of these": ([f"{one:.9g}" for one in singles(100, 44100, 3000)], 1 / 44100),
}


@pytest.mark.parametrize(("written", "step"), ROUNDED.values(), ids=ROUNDED)
def test_rounded_times_are_even(read, written, step):
    data = read("t (s),F (N)", written, noise(len(written)))
    count = len(written)
    assert data.sizes == {"time": count}
    steps = np.diff(data.time)
    assert np.ptp(steps) < 1e-6 * steps[0]
    assert steps[0] == pytest.approx(step, rel=1.0 / count)
    assert "taken as even, with a step of" in data.attrs["doubt"]
    as_written = np.array([float(one) for one in written])
    off = np.abs(data.time.values - as_written)
    assert (off <= 0.51 * rounding_steps(as_written)).all()


AS_THEY_ARE = {
    "exact": np.round(np.arange(2000) / 44100, 9),
    "jitter": np.round(10 * np.arange(300) + np.random.default_rng(1).normal(0, 2, 300)),
    "a lost sample": np.delete(np.arange(300), 150),
    "some lost samples": np.delete(np.arange(300), [20, 150, 160]),
    "a lost frame": np.round(np.delete(np.arange(300), 150) * 1e3 / 30),
}


@pytest.mark.parametrize("times", AS_THEY_ARE.values(), ids=AS_THEY_ARE)
def test_exact_times_and_those_with_gaps_or_jitter_stay_as_they_are(read, times):
    data = read("t (s),F (N)", times, noise(len(times)))
    np.testing.assert_array_equal(data.time, times)
    assert "even" not in data.attrs["doubt"]


def test_the_rate_of_a_sound_is_not_that_of_its_rounded_steps(read):
    data = read("Time (ms),Sound", [f"{k / 44.1:.6g}" for k in range(20_000)], noise(20_000))
    assert data.sound.attrs["rate"] == pytest.approx(44100, rel=1e-6)


def test_times_that_repeat_are_spread_where_they_are_not_even(read):
    times = np.round(np.cumsum(np.random.default_rng(2).exponential(0.04, 500)), 1)
    data = read("t (s),F (N)", times, noise(500))
    assert data.sizes == {"time": 500}
    assert (np.diff(data.time) > 0.0).all()
    assert np.abs(data.time - times).max() < 0.05 + 1e-9
    assert "times are repeated: spread over the 0.1 s of their digits" in data.attrs["doubt"]


def test_times_of_fewer_digits_from_ten_on_are_spread_in_order():
    times = np.array([9.98, 9.99, 9.99, 10.0, 10.0, 10.0, 10.1])
    assert (np.diff(spread(times, rounding_steps(times))) > 0.0).all()


def test_a_track_with_repeated_times_is_measured(read):
    since = np.arange(400) / 250.0
    period = since % 0.8
    heights = np.round(4.905 * period * (0.8 - period), 5)
    data = read("t,x,y", [f"{one:.2f}" for one in since], np.zeros(400), heights)
    assert data.attrs["holds"] == "track"
    found = sb.measure.analyse(data)[0]
    assert found.time_base.gravity.nominal_value == pytest.approx(9.8, rel=0.02)
    assert found.balls[0].restitutions[0].nominal_value == pytest.approx(1.0, abs=0.01)


def test_a_time_that_never_changes(read):
    with pytest.raises(InvalidValue, match="time is 3 s in all of 20 rows"):
        read("t (s),F (N)", [3] * 20, noise(20))


def test_even_times_of_a_million():
    times = np.round(np.arange(10**6) / 44100, 6)
    assert np.diff(even_times(times, rounding_steps(times)))[0] == pytest.approx(1 / 44100)


EPOCHS = {"nanoseconds": 10**9, "microseconds": 10**6, "milliseconds": 10**3, "seconds": 1}


@pytest.mark.parametrize(("words", "rate"), EPOCHS.items())
def test_times_since_1970_are_told_by_their_size(read, words, rate):
    step = max(1, rate // 100)
    data = read("time,F (N)", [1_691_674_088 * rate + step * k for k in range(50)], noise(50))
    assert data.time.values[[0, -1]] == pytest.approx([0.0, 49 * step / rate], rel=1e-4)
    told = f"time counts {words} since 1970: taken from the first on, 2023-08-10 13:28:08 UTC"
    assert told in data.attrs["doubt"]


def test_seconds_elapsed_are_taken_rather_than_those_since_1970(read):
    elapsed = 0.03 + np.arange(50) / 100
    epoch = [1691674088430198800 + 10_000_000 * k for k in range(50)]
    data = read("time,seconds_elapsed,F (N)", epoch, elapsed, noise(50))
    np.testing.assert_allclose(data.time, elapsed, rtol=1e-12)
    assert data.attrs["doubt"] == ""


@pytest.mark.parametrize(
    ("head", "step", "unit", "factor"),
    [
        ("time,sound", 1, "ms", 1e-3),
        ("time,sound", 22.6757, "µs", 1e-6),
        ("time,F (N)", 1, "ms", 1e-3),
        ("time,F (N)", 0.1, "s", 1.0),
        ("t,y", 33, "ms", 1e-3),
        ("t,y", 1, "s", 1.0),
        ("bounce time", 640, "ms", 1e-3),
        ("bounce time", 0.64, "s", 1.0),
    ],
)
def test_steps_tell_the_unit_of_times(read, head, step, unit, factor):
    columns = [[f"{step * k:.6g}" for k in range(60)], noise(60)][: len(head.split(","))]
    data = read(head, *columns)
    times = data["knock_time" if "bounce" in head else "time"]
    assert float(times[50]) == pytest.approx(50 * step * factor, rel=1e-5)
    if unit != "s":
        name = head.partition(",")[0]
        assert f"no unit is told for {name}: taken as {unit}, as steps" in data.attrs["doubt"]
        assert f"units={{'{name}': 's'}} tells another" in data.attrs["doubt"]


@pytest.mark.parametrize(
    ("head", "options"),
    [("time (s),F (N)", {}), ("Time(S),Force(N)", {}), ("time,F (N)", {"units": {"time": "s"}})],
)
def test_a_unit_that_is_told_is_not_doubted(read, head, options):
    data = read(head, range(0, 6000, 100), noise(60), **options)
    assert float(data.time[-1]) == 5900.0
    assert data.attrs["doubt"] == ""


def test_a_number_beyond_the_range_of_an_instrument_is_missing(read):
    cells = [1, 2, "9.9E37", 3, "-1e300", 2, "-1.23456789E-300", 1, "1e300"]
    data = read("t (s),F (N)", np.arange(9) / 10, cells)
    np.testing.assert_array_equal(data.force, [1, 2, np.nan, 3, np.nan, 2, np.nan, 1, np.nan])
    assert "4 numbers are beyond any instrument's range: taken as missing" in data.attrs["doubt"]


@pytest.mark.parametrize("unit", ["nan", "inf", "5", "1e3"])
def test_a_unit_that_is_a_number_is_no_unit(read, unit):
    assert read(f"t [s],F [{unit}]", np.arange(8) / 10, noise(8)).force.attrs["units"] in ("", "N")
