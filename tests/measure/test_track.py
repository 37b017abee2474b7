"""Tracks of bouncing balls, ordinary and bad ones, and what is no bounce."""

import math
import time

import numpy as np
import pytest
import xarray as xr

import stackbounce as sb
from measure.near import near, nominal
from motions import TRACKS, G, jumps, rectified_sine, swings
from stackbounce.errors import InvalidType, InvalidValue
from stackbounce.measure import accelerometer, analyse, one_ball
from stackbounce.measure.kinds.track.analysis import track
from stackbounce.plots.measurements.track import draw as draw_track
from synthetic.accelerometer import accelerometer as record_of
from synthetic.falls import falls
from synthetic.track import track as tracked

FALL = falls(1.0, 0.8)
BALLS = [sb.Ball(0.6, diameter=0.24), sb.Ball(0.06, diameter=0.065)]
STACK = sb.Drop(BALLS, [sb.Rigid(0.8)] * 2, height=0.6, gravity=9.80665)

NO_BALL = xr.Dataset({"y": (("track", "time"), np.zeros((0, 9)))}, {"time": np.arange(9.0)})
FRAMES = np.arange(20.0)


@pytest.mark.fast_cases(3)
@pytest.mark.parametrize(
    "options",
    [
        {},
        {"frame_rate": 30.0},
        {"frame_rate": 240.0},
        {"missing": 0.2},
        {"pixel": 0.003},
        {"tilt": 0.1, "drift": 0.2},
        {"tilt": -0.1},
        {"down": True},
        {"correlation": 0.6},
        {"before": -0.2},
        {"before": 0.6},
        {"noise": 0.005},
        {"noise": 1e-6},
    ],
    ids=str,
)
def test_what_went_in_comes_out(options):
    found = track(tracked(FALL, seed=5, **options))
    ball = found.balls[0]
    assert near(ball.drop_height, 1.0)
    assert near(ball.impact_speeds[0], FALL.speeds[0])
    assert near(ball.rebound_speeds[0], FALL.rebounds[0])
    assert near(ball.apex_heights[0], 0.64)
    assert near(ball.restitutions[0], 0.8)
    assert len(ball.impact_times) in (3, 4)
    assert found.time_base.agrees
    assert not any("lens" in note for note in found.notes)
    assert any("begins 0.2" in note for note in found.notes) == (options.get("before", 0.0) < 0.0)


def test_axes_are_found_and_told():
    found = track(tracked(FALL, tilt=0.1, seed=1))
    assert found.tilt == pytest.approx(0.1, abs=0.005)
    assert any("degrees off" in note for note in found.notes)
    assert track(tracked(FALL, down=True, seed=1)).axis == "-y"
    assert track(tracked(FALL, seed=1).rename(x="y", y="x")).axis == "x"


@pytest.mark.parametrize(("rate", "read"), [(240, 60), (240, 30), (60, 30), (30, 60)])
def test_a_wrong_frame_rate_is_told_never_corrected(rate, read):
    data = tracked(FALL, frame_rate=float(rate), read_as=float(read), seed=2)
    found = track(data)
    assert found.time_base.frame_rate_factor == pytest.approx(rate / read)
    (note,) = [one for one in found.notes if "Gravity comes out" in one]
    assert f"{rate:.0f} frames per second read as {read:.0f}" in note
    assert "lengths must be" in note
    assert found.balls[0].drop_height.nominal_value == pytest.approx(1.0, abs=0.02)
    right = track(data.assign_coords(time=data.time * (read / rate)))
    assert right.time_base.agrees
    assert near(right.balls[0].impact_speeds[0], FALL.speeds[0])


def test_two_balls_of_a_stack():
    found = track(tracked(sb.simulate(STACK, until=0.2), names=["basketball", "tennis"], seed=1))
    true = sb.simulate(sb.Drop(STACK.balls, STACK.contacts, height=0.6)).rebound_ratios
    assert [ball.name for ball in found.balls] == ["basketball", "tennis"]
    assert all(near(one, value) for one, value in zip(found.rebound_ratios, true, strict=True))
    assert found.rows()[1].name == "tennis: rebound ratio"
    assert list(found.parts()) == ["impact_speed"]


def test_three_points_a_flight():
    times = np.arange(0.0, 0.95, 0.07)
    noise = np.random.default_rng(1).normal(0.0, 1e-3, len(times))
    found = track((times, falls(0.3, 0.7).position(times) + noise))
    assert near(found.balls[0].restitutions[0], 0.7)
    assert any("points; a higher frame rate" in note for note in found.notes)


def test_frames_may_come_at_uneven_times():
    random = np.random.default_rng(1)
    times = np.sort(random.uniform(0.0, 0.95, 90))
    fall = falls(0.5, 0.8)
    ball = track((times, fall.position(times) + random.normal(0.0, 1e-3, 90))).balls[0]
    assert near(ball.impact_speeds[0], fall.speeds[0])


@pytest.mark.parametrize("seed", [10, 11, 17, 48])
def test_a_ball_that_is_held_does_not_bounce_in_the_air(seed):
    # three or four points in the hand may lie on a parabola by chance
    fall = falls(0.5, 0.8)
    ball = track(tracked(fall, frame_rate=60.0, until=0.95, noise=1.5e-3, seed=seed)).balls[0]
    assert len(ball.impact_times) == 2
    assert near(ball.impact_speeds[0], fall.speeds[0])


def test_a_soft_ball_comes_out_too_fast_unless_the_floor_is_given():
    how = {"mass": 0.06, "restitution": 0.8, "contact_time": 0.015, "impact_speed": 3.13}
    fall = falls(0.5, sb.calibrate(sb.HuntCrossley, **how), mass=0.06)
    data = tracked(fall, frame_rate=240.0, until=0.95, seed=1)
    alone, told = (track(data, floor=floor) for floor in (None, 0.0))
    assert any("is in contact for" in note for note in alone.notes)
    fast = alone.balls[0].impact_speeds[0].nominal_value
    assert fast == pytest.approx(1.02 * fall.speeds[0], rel=0.005)
    assert near(told.balls[0].impact_speeds[0], fall.speeds[0])
    with pytest.raises(InvalidValue, match="floor must be a level"):
        track(data, floor=5.0)


def test_parts_make_a_drop():
    drop = one_ball([track(tracked(FALL, seed=1)).parts()], mass=0.05)
    assert sb.simulate(drop).rebound_ratios[0] == pytest.approx(0.8, abs=0.01)


@pytest.mark.parametrize("slowing", [0.3, 1.0])
@pytest.mark.parametrize("tilt", [0.0, 0.03])
def test_a_ball_that_slows_down_across_turns_no_camera(slowing, tilt):
    found = track(tracked(FALL, before=-0.05, drift=3.0, slowing=slowing, tilt=tilt, seed=1))
    kept = found.balls[0].restitutions[0]
    assert near(kept, 0.8)
    assert kept.std_dev < 0.004
    assert found.tilt == pytest.approx(tilt, abs=0.005)
    assert any("slow down across" in note for note in found.notes)


def test_after_one_bounce_air_and_a_turned_camera_are_the_same():
    how = {"before": -0.05, "drift": 2.0, "until": 0.6, "seed": 1}
    for options in ({"slowing": 0.3}, {"tilt": 0.03}):
        found = track(tracked(falls(0.5, 0.8), **options, **how))
        kept = found.balls[0].restitutions[0]
        assert abs(kept.nominal_value - 0.8) < 1.5 * kept.std_dev
        assert kept.std_dev > 0.02
        assert any("degrees off the vertical" in note for note in found.notes)


def test_heights_alone_tell_of_no_turn_and_one_slip_is_left_out():
    data = tracked(FALL, seed=1)
    found = track(data.assign(x=math.nan * data.x, y=data.y + 50.0 * (data.time == data.time[20])))
    assert "1 point left out: far from both neighbours." in found.notes
    assert found.tilt == 0.0
    assert near(found.balls[0].restitutions[0], 0.8)


@pytest.mark.parametrize("seed", range(4))
def test_a_camera_that_sways_widens_the_errors(seed):
    found = track(tracked(falls(0.5, 0.8), sway=0.006, until=1.4, noise=5e-4, seed=seed))
    ball = found.balls[0]
    assert near(ball.restitutions[0], 0.8)
    assert near(ball.drop_height, 0.5)
    assert 0.005 < ball.restitutions[0].std_dev < 0.05
    assert any("levels that differ" in note for note in found.notes)
    still = track(tracked(falls(0.5, 0.8), until=1.4, noise=5e-4, seed=seed))
    assert not any("levels that differ" in note for note in still.notes)


def test_no_second_ball_gains_speed():
    ball, hit = (tracked(fall, until=1.2, seed=1) for fall in (FALL, falls(0.3, lambda _: 1.3)))
    hit["y"] = hit.y + 0.1
    with pytest.raises(InvalidValue, match=r"a restitution of 1\.3.* it is hit or thrown there"):
        track(xr.concat([ball, hit.assign_coords(track=["hit"])], "track"))


@pytest.mark.parametrize(
    ("data", "error", "words"),
    [
        ((FRAMES, 0.0 * FRAMES), InvalidValue, "falls and bounces"),
        ((FRAMES, math.nan * FRAMES), InvalidValue, "falls and bounces"),
        ((FRAMES, -(FRAMES**2)), InvalidValue, "falls and bounces"),
        ((0.0 * FRAMES, FRAMES), InvalidValue, "times must ascend"),
        ((np.arange(3.0), np.zeros(3)), InvalidValue, "at least 4"),
        ((FRAMES, np.zeros(3)), InvalidValue, "time and y of one length"),
        (NO_BALL, InvalidValue, "the track of a ball, got none"),
        ("track.txt", InvalidType, "data must be"),
        (xr.Dataset({"z": ("time", [1.0])}), InvalidType, "variables x and y"),
    ],
)
def test_what_is_no_track(data, error, words):
    with pytest.raises(error, match=words):
        track(data)


def test_pictures():
    data = tracked(FALL, seed=1)
    figure = draw_track(data, track(data))
    assert [axes.get_ylabel() for axes in figure.axes] == ["height (m)", "residual (mm)"]
    assert "gravity of the flights 9.8" in figure.axes[0].get_title(loc="left")
    two = tracked(sb.simulate(STACK, until=0.2), frame_rate=240.0, read_as=60.0, seed=1)
    assert "factor of 4" in draw_track(two, track(two)).axes[0].get_title(loc="left")


# --- what is no bounce is said to be none, in a time that grows with the record, not faster
LAW = sb.calibrate(sb.Dashpot, mass=0.2, contact_time=0.012, restitution=0.6)


@pytest.mark.parametrize("name", TRACKS)
def test_what_does_not_fly_freely_and_bounce(name):
    make, words = TRACKS[name]
    with pytest.raises(InvalidValue, match=words):
        track(make())


@pytest.mark.parametrize("name", ["rectified sine", "pendulum", "bowl", "throw", "drift"])
def test_neither_where_the_scale_is_unknown(name):
    times, heights = TRACKS[name][0]()
    data = over_time("y", np.arange(len(times)) * 1.0, 500.0 * heights, "px", "frame")
    with pytest.raises(InvalidValue, match="must hold a ball that falls and bounces"):
        track(data)


def test_hops_with_long_contacts_are_none_in_frames_either():
    hop = (0.5 * np.arange(n) * (n - 1.0 - np.arange(n)) for n in (40, 36, 32, 28))
    heights = np.concatenate([np.append(flight, np.zeros(28)) for flight in hop])
    heights += np.random.default_rng(1).normal(0.0, 0.5, len(heights))
    data = over_time("y", np.arange(len(heights)) * 1.0, heights, "px", "frame")
    with pytest.raises(InvalidValue, match="the contacts last for more than half of the flights"):
        track(data)


@pytest.mark.parametrize("scale", [0.8, 1.25, 100.0, 1000.0])
def test_a_wrong_scale_is_warned_of_not_refused(scale):
    data = tracked(FALL, seed=2) * scale
    found = track(data)
    assert not found.time_base.agrees
    assert any(f"multiplied by {1.0 / scale:g}" in note for note in found.notes)
    assert near(track(data / scale).balls[0].drop_height, 1.0)
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


@pytest.mark.slow
def test_twenty_thousand_rows_take_seconds():
    began = time.process_time()
    with pytest.raises(InvalidValue, match="must hold a ball"):
        track(rectified_sine(20_000, period=0.4))
    assert time.process_time() - began < 10.0


def test_a_very_long_track_is_shortened_and_says_so():
    found = track(tracked(FALL, frame_rate=10_000.0, until=1.2, seed=1))
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
    with pytest.raises(InvalidValue, match="0 to 1 of its speed"):
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
