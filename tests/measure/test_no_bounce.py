"""What is no bounce is said to be none, in a time that grows with the record, not faster."""

import time

import numpy as np
import pytest
import xarray as xr

import stackbounce as sb
from measure.near import nominal
from motions import TRACKS, G, jumps, rectified_sine, swings
from stackbounce.errors import InvalidValue
from stackbounce.measure import accelerometer, analyse
from stackbounce.measure.kinds.track.analysis import track
from synthetic.accelerometer import accelerometer as record_of
from synthetic.falls import falls
from synthetic.track import track as tracked

FALL = falls(1.0, 0.8)
LAW = sb.calibrate(sb.Dashpot, mass=0.2, contact_time=0.012, restitution=0.6)


@pytest.mark.parametrize("name", TRACKS)
def test_what_does_not_fly_freely_and_bounce(name):
    make, words = TRACKS[name]
    with pytest.raises(InvalidValue, match=words):
        track(make())


@pytest.mark.parametrize("name", ["rectified sine", "pendulum", "bowl", "throw", "coaster"])
def test_neither_where_the_scale_is_unknown(name):
    times, heights = TRACKS[name][0]()
    data = over_time("y", np.arange(len(times)) * 1.0, 500.0 * heights, "px", "frame")
    with pytest.raises(InvalidValue, match="must hold a ball that falls and bounces"):
        track(data)


def test_a_bounce_in_pixels_and_frames_is_one():
    data = tracked(FALL, down=True, seed=2) / 2e-3
    data["time"] = ("time", np.arange(data.sizes["time"]) * 1.0, {"units": "frame"})
    for name in "xy":
        data[name].attrs["units"] = "px"
    assert nominal(track(data).balls[0].restitutions) == pytest.approx([0.8] * 3, abs=0.005)


@pytest.mark.parametrize("scale", [0.8, 1.2, 1.4, 100.0, 1000.0])
def test_a_wrong_scale_is_warned_of_not_refused(scale):
    found = track(tracked(FALL, seed=2) * scale)
    assert not found.time_base.agrees
    assert nominal(found.balls[0].restitutions)[0] == pytest.approx(0.8, abs=0.005)


def test_an_incline_needs_its_own_gravity():
    data = tracked(falls(0.3, 0.8, gravity=2.3), frame_rate=57.0, seed=2)
    with pytest.raises(InvalidValue, match=r"along y are 2\.3 m/s.2 .* gravity tells how fast"):
        track(data)
    (ball,) = track(data, gravity=2.3).balls
    assert ball.restitutions[0].n == pytest.approx(0.8, abs=0.01)


def test_an_elastic_bounce_is_no_gain():
    found = track(tracked(falls(1.0, 1.0, bounces=3), until=1.6, noise=5e-3, seed=1))
    assert nominal(found.balls[0].restitutions)[0] == pytest.approx(1.0, abs=0.01)


@pytest.mark.parametrize("bend", [0.1, 0.03, -0.05])
def test_a_lens_is_told(bend):
    data = tracked(FALL, frame_rate=240.0, noise=1e-4, seed=1)
    data["y"] = data.y * (1.0 + bend * data.y)
    found = track(data)
    assert any("a lens or air changes it" in note for note in found.notes)
    kept = found.balls[0].restitutions[0]
    assert abs(kept.nominal_value - 0.8) < 1.5 * kept.std_dev < 0.05
    assert found.balls[0].drop_height.std_dev > 1e-3


def test_a_straight_scale_has_no_lens():
    assert not any("lens" in note for note in track(tracked(FALL, seed=1)).notes)


@pytest.mark.parametrize("period", [0.4, 2.0])
def test_twenty_thousand_rows_take_seconds(period):
    began = time.process_time()
    with pytest.raises(InvalidValue, match="must hold a ball"):
        track(rectified_sine(20_000, period=period))
    assert time.process_time() - began < 10.0


def test_a_very_long_track_is_shortened_and_says_so():
    data = tracked(FALL, frame_rate=20_000.0, until=1.2, seed=1)
    found = track(data)
    assert any("means of 2 neighbouring points" in note for note in found.notes)
    assert nominal(found.balls[0].restitutions)[0] == pytest.approx(0.8, abs=1e-3)


def over_time(name, times, values, unit, of_time="s", **attrs):
    columns = {name: ("time", values, {"units": unit})}
    return xr.Dataset(columns, {"time": ("time", times, {"units": of_time})}, attrs)


def test_a_swung_phone_and_a_jump():
    how = {"holds": "acceleration", "format": "acceleration without g"}
    without_g = over_time("acceleration_absolute", *swings(), "m/s^2", **how)
    for data in (without_g, swings(), jumps()):
        with pytest.raises(InvalidValue, match="what swings"):
            accelerometer(data)


@pytest.mark.parametrize("rate", [100.0, 200.0, 1000.0])
def test_a_fall_without_g(rate):
    true = falls(0.8, LAW, mass=0.2, bounces=4)
    found = accelerometer(record_of(true, rate=rate, linear=True, full_range=4e3, seed=4))
    assert abs(found.drop_height.nominal_value - 0.8) < 3.5 * found.drop_height.std_dev
    assert nominal(found.restitutions) == pytest.approx([0.6] * 3, abs=0.05)
    assert any("record the acceleration with g" in note for note in found.notes)


def test_linear_acceleration_is_told_by_its_rest():
    record = record_of(falls(0.8, LAW, mass=0.2, bounces=4), linear=True, before=1.5, seed=4)
    record.attrs["format"] = "table of numbers"
    assert accelerometer(record).mean.nominal_value == pytest.approx(0.6, abs=0.02)


def test_a_fall_to_the_end_of_the_record():
    record = record_of(falls(1.5, LAW, mass=0.2), linear=True, seed=1)
    cut = record.isel(time=record.time.values < 0.5 + 0.5)
    with pytest.raises(InvalidValue, match=r"one free flight of 0\.\d+ s .* lacks the bounce"):
        accelerometer(cut)


def test_a_soft_pulse_is_no_bounce_and_a_gain_is_none():
    def felt(pulse, end, top):
        """Return an acceleration with a pulse between two flights, the first from 1 s on."""
        times = np.arange(0.0, 3.0, 0.005)
        size = np.where((times > 1.0) & (times < end), 0.3, G)
        size[(times > pulse[0]) & (times < pulse[1])] = top
        return times, size

    with pytest.raises(InvalidValue, match="above 2 g"):
        accelerometer(felt((1.5, 1.56), 2.0, 1.3 * G))
    assert len(accelerometer(felt((1.5, 1.56), 2.0, 15.0 * G)).restitutions) == 1
    with pytest.raises(InvalidValue, match="nothing rebounds faster than it came"):
        accelerometer(felt((1.2, 1.22), 1.9, 200.0))


def test_a_machine_is_refused():
    times = np.arange(200_000) / 100.0
    with pytest.raises(InvalidValue, match="bounces, more than one drop has"):
        accelerometer((times, np.where(times % 0.1 < 0.08, 0.2, 50.0)))


def test_a_column_of_positions_is_no_table_of_heights():
    many, higher, up = (
        xr.Dataset({"y": ("row", values)}, attrs={"holds": "table"})
        for values in (np.full(325, 39.0), [1.0, 0.7, 0.5, 0.9], [1.0, 1.4])
    )
    with pytest.raises(InvalidValue, match=r"up to 100 of them, got 325 heights"):
        analyse(many)
    with pytest.raises(InvalidValue, match=r"0\.9 m after 0\.5 m in row 4"):
        analyse(higher)
    assert analyse(higher, repeated=True)[0].repeated
    assert analyse(up)[0].restitutions[0].nominal_value > 1.0


def test_kilometres_are_no_heights(read):
    rows = "\n".join(f"{k},{0.01 * k},{15 + k % 3}" for k in range(30))
    data = read(f'"Time (s)","Distance (km)","Altitude (m)"\n{rows}\n')
    assert data.attrs["holds"] != "track"


def test_an_oscillation_has_too_many_contacts():
    times = np.arange(20_000) * 1e-4
    force = np.abs(np.sin(2000.0 * times)) + np.random.default_rng(1).normal(0.0, 0.01, len(times))
    with pytest.raises(InvalidValue, match=r"up to 120, got 1[0-9]+ stretches.* stop choose"):
        analyse(over_time("force", times, force, "N", holds="waveform"))
