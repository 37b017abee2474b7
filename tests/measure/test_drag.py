"""Drag in times and heights of bounces: against falls that an integrator of scipy makes."""

import math

import numpy as np
import pytest
import xarray as xr
from uncertainties import correlation_matrix, ufloat

import stackbounce as sb
from measure.falls_in_air import AIR, AT_REST, BALL, SLOPE, UNSURE, falls_in_air, kept
from measure.near import near, nominal, possible
from stackbounce import plots
from stackbounce.errors import InvalidType, InvalidValue
from stackbounce.explorer.answers import records
from stackbounce.measure import Drag, analyse, bounces, heights, knocks, one_ball, one_law, track
from stackbounce.measure.kinds.sound.few_bounces import few_bounces
from synthetic.falls import falls
from synthetic.sound import sound
from synthetic.track import track as tracked

UGLY = {"uneven": 0.2, "room": 0.4, "alike": 0.5, "wind": 0.01, "coarse": 0.4, "level": 2.0}
TYPED = {"mass": "2.7 g", "diameter": "40 mm", "drag_coefficient": "0.45 ± 0.05"}
FALL = falls_in_air(0.5, kept, bounces=9)
KNOCKS = xr.Dataset({"knock_time": ("knock", FALL.touches)}, attrs={"holds": "knocks"})


def test_exact_times_give_what_went_in():
    found = bounces(FALL.touches, drop_height=FALL.height, time_error=1e-6, drag=AIR)
    assert found.numbers == tuple(range(8))
    assert nominal(found.restitutions) == pytest.approx(FALL.restitutions[:8], abs=1e-8)
    assert nominal(found.impact_speeds) == pytest.approx(FALL.speeds[:8], rel=1e-8)
    assert found.laws[0].coefficient.nominal_value == pytest.approx(AT_REST, abs=1e-6)
    assert found.laws[0].slope.nominal_value == pytest.approx(SLOPE, abs=1e-6)
    free = bounces(FALL.touches, drop_height=FALL.height, time_error=1e-6)
    assert AT_REST - free.laws[0].coefficient.nominal_value < 0.01
    assert free.laws[0].slope.nominal_value > 2.0 * SLOPE  # air looks like a loss by speed


def test_a_drop_height_that_is_inferred_is_that_of_a_fall_in_air():
    found = bounces(falls_in_air(0.5, lambda _: 0.9, bounces=7).touches, time_error=1e-6, drag=AIR)
    assert found.inferred
    assert found.drop_height.nominal_value == pytest.approx(0.5, rel=1e-6)
    fast = [0.0, 3.0, 3.3, 3.55]  # no fall in this air is fast enough for such a first flight
    assert bounces(fast, time_error=1e-3, drag=Drag(1e-3, 0.1, 0.5)).drop_height is None


def test_a_contact_time_and_a_missing_bounce_are_as_without_air():
    times = FALL.touches + 1e-3 * np.arange(9)
    found = bounces(np.delete(times, 4), contact_time=1e-3, time_error=1e-6, drag=AIR)
    free = bounces(np.delete(times, 4), contact_time=1e-3, time_error=1e-6)
    assert found.numbers == free.numbers == (1, 2, 6, 7)
    assert found.flights[3] is None
    assert nominal(found.restitutions) == pytest.approx(FALL.restitutions[[1, 2, 6, 7]], abs=1e-7)


@pytest.mark.parametrize("drag", [None, AIR, UNSURE])
def test_times_without_errors_get_them_from_the_scatter(drag):
    """The scatter is the timing's, however unsure the drag is."""
    found = bounces(FALL.touches + np.random.default_rng(3).normal(0.0, 1e-3, 9), drag=drag)
    assert found.times[0].std_dev == pytest.approx(1e-3, rel=0.7)


@pytest.mark.parametrize("seeds", [range(1), pytest.param(range(1, 7), marks=pytest.mark.slow)])
def test_ugly_recordings_in_air(seeds):
    hits = count = 0
    for seed in seeds:
        fall = falls_in_air(0.3 + 0.01 * seed, kept, bounces=6)
        heard = knocks(sound(fall, seed=seed, before=0.1, after=0.1, rate=22050.0, **UGLY))
        first = int(np.argmin(abs(fall.touches - fall.touches[0] + 0.1 - heard.times[0].n)))
        found, free = bounces(heard, drag=AIR), bounces(heard)
        true = fall.restitutions[np.array(found.numbers) + first]
        hits += sum(near(*pair, 1.0) for pair in zip(found.restitutions, true, strict=True))
        count += len(true)
        low = [one.n - e for one, e in zip(free.restitutions[:3], true[:3], strict=True)]
        assert max(low) < -0.005
    # The restitutions of a recording share flights: about half of them are independent.
    assert possible(round(0.5 * hits), round(0.5 * count))


def drawn(seed):
    """Return times with errors of a ball whose drag coefficient is not known well."""
    random = np.random.default_rng([seed, 5])
    fall = falls_in_air(0.4, kept, coefficient=random.normal(0.45, 0.05), bounces=7)
    return fall, fall.touches + random.normal(0.0, 2e-4, 7), random


@pytest.mark.slow
def test_an_unsure_drag_is_in_the_errors():
    """The truth lies within one sigma as often as it should; an exact drag would promise more."""
    found = {"first": [], "mean of a line": [], "height": [], "exact": []}
    for seed in range(60):
        fall, times, random = drawn(seed)
        told = bounces(times, time_error=2e-4, drag=UNSURE)
        found["first"].append(near(told.restitutions[0], fall.restitutions[1], 1.0))
        found["mean of a line"].append(near(told.laws[0].at(1.5), kept(1.5), 1.0))
        exact = bounces(times, time_error=2e-4, drag=AIR)
        found["exact"].append(near(exact.restitutions[0], fall.restitutions[1], 1.0))
        read = np.array([fall.height, *fall.apexes]) + random.normal(0.0, 1e-3, 8)
        ruler = heights(read[0], read[1:], height_error=1e-3, drag=UNSURE)
        found["height"].append(near(ruler.restitutions[0], fall.restitutions[0], 1.0))
    hits = {name: sum(one) for name, one in found.items()}
    assert all(possible(hits[name], 60) for name in ("first", "mean of a line", "height")), hits
    assert hits["exact"] < hits["first"] - 9


def test_an_error_of_the_drag_is_one_of_all_restitutions():
    told = bounces(FALL.touches, time_error=1e-6, drag=UNSURE)
    assert correlation_matrix(told.restitutions).min() > 0.99
    more, less = (
        bounces(FALL.touches, time_error=1e-6, drag=Drag(*BALL, one)) for one in (0.50, 0.40)
    )
    assert told.restitutions[0].s == pytest.approx(
        0.5 * (more.restitutions[0].n - less.restitutions[0].n), rel=1e-3
    )
    law = [one.laws[0].coefficient for one in (told, more, less)]
    assert law[0].s == pytest.approx(0.5 * abs(law[1].n - law[2].n), rel=0.02)
    other = bounces(FALL.touches, time_error=1e-6, drag=Drag(ufloat(2.7e-3, 2.7e-4), 0.040, 0.45))
    assert other.restitutions[0].s == pytest.approx(0.9 * told.restitutions[0].s, rel=0.01)


def test_heights_in_air_give_what_went_in():
    found = heights(FALL.height, FALL.apexes, height_error=1e-6, drag=AIR)
    assert nominal(found.restitutions) == pytest.approx(FALL.restitutions, abs=1e-8)
    same = falls_in_air(1.0, lambda _: 0.85, bounces=4)
    told = heights(1.0, same.apexes, height_error=1e-3, drag=AIR)
    assert told.mean.nominal_value == pytest.approx(0.85, abs=1e-8)
    again = heights(ufloat(1.0, 1e-6), [same.apexes[0]] * 3, repeated=True, drag=AIR)
    assert again.mean.nominal_value == pytest.approx(0.85, abs=1e-8)
    centre = heights(1.02, list(same.apexes + 0.02), diameter=0.04, measured_to="centre", drag=AIR)
    assert centre.mean.nominal_value == pytest.approx(0.85, abs=1e-8)
    assert math.isnan(centre.mean.std_dev)
    assert told.law_arguments()["impact_speed"].n == pytest.approx(same.speeds[0], rel=1e-8)


def test_the_mean_lies_between_the_bounces_and_its_error_is_that_of_draws():
    rows = np.array([1.0, 0.70, 0.50, 0.38])
    found = heights(rows[0], list(rows[1:]), height_error=5e-3, drag=UNSURE)
    assert min(nominal(found.restitutions)) < found.mean.n < max(nominal(found.restitutions))
    random = np.random.default_rng(1)
    means = []
    for _ in range(300):
        start, *after = rows + random.normal(0.0, 5e-3, 4)
        air = Drag(*BALL, random.normal(0.45, 0.05))
        means.append(heights(start, after, drag=air).mean.n)
    assert found.mean.std_dev == pytest.approx(np.std(means), rel=0.15)


def test_two_knocks_tell_how_high_it_rose_in_air():
    heard = knocks(sound(falls_in_air(0.5, kept, bounces=2), seed=1))
    found = few_bounces(heard, drag=AIR)
    assert found.apex_heights[0].n == pytest.approx(FALL.apexes[0], rel=2e-3)
    assert few_bounces(heard).apex_heights[0].n > found.apex_heights[0].n
    assert found.rows()[-1] == AIR.rows()[-1]


def test_no_drag_is_no_air():
    known = {"drop_height": 0.5, "time_error": 1e-4}
    thin = bounces(FALL.touches, drag=Drag(*BALL, 1e-9), **known)
    free = bounces(FALL.touches, **known)
    assert nominal(thin.restitutions) == pytest.approx(nominal(free.restitutions), rel=1e-9)
    options = {"height": 0.5, "mass": BALL[0], "diameter": BALL[1]}
    plain, none = (
        [one.rows() for one in analyse(KNOCKS, **options, **air)]
        for air in ({}, {"drag_coefficient": 0.0})
    )
    assert repr(none) == repr(plain)


def test_air_is_told_with_its_density():
    told = bounces(FALL.touches, drag=UNSURE)
    rows = {row.name: row for row in told.rows()}
    assert str(rows["drag coefficient"].value) == "0.45+/-0.05"
    density = rows["density of the air"]
    assert (density.value.n, density.value.s, density.unit) == (1.204, 0.0, "kg/m^3")
    assert told.notes[0].startswith("The drag of the air is taken into account, with a coeff")
    assert bounces(FALL.touches, drag=Drag(*BALL, 0.45, 1.3)).mean.n > told.mean.n


def test_heights_in_air_are_drawn_with_a_curve_through_them():
    same = falls_in_air(1.0, lambda _: 0.85, bounces=3)
    figure = plots.measured(None, heights(1.0, same.apexes, drag=AIR))
    (line,) = [one for one in figure.axes[0].lines if len(one.get_xdata()) > 9]
    curve = dict(zip(np.round(line.get_xdata(), 9), line.get_ydata(), strict=True))
    assert (curve[0.0], curve[3.0]) == pytest.approx((1.0, same.apexes[2]))


def test_a_ball_has_the_impact_speed_in_air():
    """A simulated drop falls without air: from the height it would be too fast."""
    found = bounces(FALL.touches, drop_height=FALL.height, drag=AIR)
    drop = one_ball([found.parts()], mass=BALL[0])
    assert drop.height is None
    assert drop.impact_speed == pytest.approx(FALL.speeds[0], rel=1e-9)
    ruler = heights(FALL.height, 0.4, height_error=1e-3, drag=AIR)
    law = one_law("hunt-crossley", [ruler], mass=BALL[0], contact_time=1e-3).law
    shape = {"mass": BALL[0], "contact_time": 1e-3, "impact_speed": FALL.speeds[0]}
    wanted = sb.calibrate(sb.HuntCrossley, restitution=ruler.mean.n, **shape)
    assert law.stiffness == pytest.approx(wanted.stiffness, rel=1e-8)


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"drag_coefficient": 0.45, "mass": 1.0}, "needs mass and diameter of the ball: give diam"),
        ({"air_density": 1.2}, "of the air counts with a drag_coefficient only, got none"),
        (
            {"drag_coefficient": ufloat(0.0, 0.1)},
            "be above 0 where it has an error, or 0 for no air, got 0.0.*0.1",
        ),
        ({"drag_coefficient": -1.0}, "drag_coefficient must be"),
        ({"drag_coefficient": "x"}, "drag_coefficient must be"),
    ],
)
def test_options_of_air_that_are_missing_or_out_of_range(options, words):
    with pytest.raises((InvalidValue, InvalidType), match=words):
        analyse(KNOCKS, **options)


@pytest.mark.parametrize(
    ("air", "words"),
    [
        ((0.0, 0.04, 0.5), "mass must be a positive"),
        ((1.0, 0.04, 0.0), "coefficient must be"),
        ((1e-100, 1.0, 0.5), r"of a ball in air, got 2.36e\+99 1/m of drag \(a table tennis"),
        ((1.0, 1e300, 0.5), "of a ball in air, got inf 1/m"),
    ],
)
def test_no_ball_in_air(air, words):
    with pytest.raises(InvalidValue, match=words):
        Drag(*air)


def test_a_ball_that_cannot_fly_so_far():
    with pytest.raises(InvalidValue, match="of a ball that can fly so far, got 2"):
        bounces([0.0, 0.5, 0.9, 1.25], drag=Drag(1e-5, 1.0, 0.5))
    page = {"drag_coefficient": "0.5"}  # options are named as the page names them
    with pytest.raises(InvalidValue, match="give “Ball's mass” and “Diameter”"):
        records.measure_record("a.csv", b"height (m)\n1\n0.7\n", page)


# --- drag in tracks: against falls that an integrator of scipy makes, with what is ugly in tracks
TRACK_FALL = falls_in_air(1.0, kept, bounces=5)
UGLY_TRACKS = {
    "errors that go together": {"correlation": 0.5, "frame_rate": 100.0},
    "pixels of 4 mm": {"pixel": 0.004},
    "one point in five missing": {"missing": 0.2},
    "tilted and drifting": {"tilt": 0.07, "drift": 0.1},
    "downward": {"down": True, "frame_rate": 240.0},
}


def seen(fall=TRACK_FALL, **how):
    usual = {"frame_rate": 60.0, "noise": 1e-3, "until": float(fall.touches[3])}
    return tracked(fall, **usual | how)


def pairs(ball, fall):
    yield from zip(ball.restitutions, fall.restitutions, strict=False)
    yield from zip(ball.impact_speeds, fall.speeds, strict=False)
    yield from zip(ball.rebound_speeds, fall.rebounds, strict=False)
    yield from zip(ball.apex_heights, fall.apexes, strict=False)
    yield from ((ball.drop_height, fall.height), (ball.gravity, fall.gravity))


def test_a_track_nearly_without_errors_gives_what_went_in():
    data = seen(noise=1e-5, frame_rate=240.0)
    (ball,) = track(data, drag=AIR).balls
    for found, true in pairs(ball, TRACK_FALL):
        assert found.n == pytest.approx(true, rel=2e-5)
    (free,) = track(data).balls
    assert free.restitutions[0].n < TRACK_FALL.restitutions[0] - 0.04
    assert free.impact_speeds[0].n > 1.02 * TRACK_FALL.speeds[0]


@pytest.mark.parametrize("how", UGLY_TRACKS)
def test_ugly_tracks_in_air(how):
    """All lie within four of their errors; without air the first restitution does not."""
    data = seen(seed=1, **UGLY_TRACKS[how])
    found = track(data, drag=AIR)
    (ball,) = found.balls
    off = [(one.n - true) / one.s for one, true in pairs(ball, TRACK_FALL)]
    assert max(map(abs, off)) < 4.0
    assert ball.restitutions[0].s < 0.006
    assert track(data).balls[0].restitutions[0].n < TRACK_FALL.restitutions[0] - 0.03
    assert found.time_base.agrees


@pytest.mark.slow
@pytest.mark.parametrize("unsure", [False, True])
def test_the_truth_lies_within_one_sigma_as_often_as_it_should(unsure):
    hits = dict.fromkeys(["restitution", "impact speed", "drop height", "gravity"], 0)
    for seed in range(60):
        random = np.random.default_rng([seed, 7])
        true = random.normal(0.45, 0.05) if unsure else 0.45
        fall = falls_in_air(0.6, kept, coefficient=true, bounces=4)
        (ball,) = track(seen(fall, seed=seed), drag=UNSURE if unsure else AIR).balls
        rows = (
            (ball.restitutions[0], fall.restitutions[0]),
            (ball.impact_speeds[0], fall.speeds[0]),
            (ball.drop_height, fall.height),
            (ball.gravity, fall.gravity),
        )
        for name, (found, value) in zip(hits, rows, strict=True):
            hits[name] += abs(found.n - value) <= found.s
    assert all(possible(count, 60, 0.60, 0.76) for count in hits.values()), hits


def test_an_error_of_the_drag_is_the_change_by_it():
    data = seen(frame_rate=120.0)
    (ball,) = track(data, drag=UNSURE).balls
    more, less = (track(data, drag=Drag(*BALL, one)).balls[0] for one in (0.50, 0.40))
    for name in ("restitutions", "impact_speeds", "rebound_speeds"):
        found, high, low = (getattr(one, name)[0] for one in (ball, more, less))
        exact = getattr(track(data, drag=AIR).balls[0], name)[0]
        assert found.n == exact.n
        assert found.s == pytest.approx(np.hypot(exact.s, 0.5 * (high.n - low.n)), rel=1e-2)


def test_a_soft_ball_and_its_floor():
    fall = falls_in_air(1.0, kept, bounces=5, lasts=lambda _: 0.012)
    data = seen(fall, frame_rate=240.0)
    (ball,) = track(data, floor=0.0, drag=AIR).balls
    for found, true in pairs(ball, fall):
        assert found.n == pytest.approx(true, rel=5e-3)
    (plain,) = track(data, drag=AIR).balls
    assert plain.impact_speeds[0].n > 1.01 * fall.speeds[0]


def test_without_drag_parabolas_stay():
    data = seen(falls(1.0, 0.8))
    thin = track(data, drag=Drag(*BALL, 1e-12)).balls[0]
    free = track(data).balls[0]
    for name in ("restitutions", "impact_speeds", "apex_heights", "levels"):
        one, other = ([x.n for x in getattr(ball, name)] for ball in (thin, free))
        assert one == pytest.approx(other, rel=1e-9, abs=1e-12)


def test_the_curve_that_is_drawn_passes_through_the_points():
    found = track(seen(frame_rate=240.0), drag=AIR)
    (ball,) = found.balls
    used = np.isfinite(ball.fit.residuals)
    lines = plots.measured(None, found).axes[0].lines
    curves = [line for line in lines if len(line.get_xdata()) == 60]
    assert len(curves) == len(ball.fit.flights)
    for line, (first, last) in zip(curves, ball.fit.flights, strict=True):
        part = slice(first, last)
        there = np.interp(ball.fit.times[part][used[part]], line.get_xdata(), line.get_ydata())
        assert np.std(there - ball.heights[part][used[part]]) < 1.2e-3


def test_the_options_of_air_are_those_of_a_track():
    (told,) = analyse(seen(), mass=BALL[0], diameter=BALL[1], drag_coefficient=0.45)
    found = {row.name: row.value for row in told.rows()}
    assert found["restitution of bounce 0"].n == pytest.approx(TRACK_FALL.restitutions[0], abs=3e-3)
    assert found["drag coefficient"].n == 0.45
    assert any(note.startswith("The drag of the air is taken") for note in told.notes)


def test_what_has_no_air_is_told():
    pixels = seen()
    pixels.y.attrs["units"] = "px"
    with pytest.raises(InvalidValue, match="drag needs lengths in m and times in s, got px and s"):
        track(pixels, drag=AIR)
    two = xr.concat([seen(), seen(names=["other"])], "track")
    with pytest.raises(InvalidValue, match=r"drag is for the track of one ball .*, got 2"):
        track(two, drag=AIR)
    with pytest.raises(InvalidValue, match="it flies faster than it could fall"):
        track(seen(), drag=Drag(1e-4, 0.040, 0.5))
