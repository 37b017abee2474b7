"""Drag in tracks: against falls that an integrator of scipy makes, with what is ugly in tracks."""

import numpy as np
import pytest
import xarray as xr

from measure.falls_in_air import AIR, BALL, UNSURE, falls_in_air, kept
from measure.near import possible
from stackbounce import plots
from stackbounce.errors import InvalidValue
from stackbounce.measure import Drag, analyse, track
from synthetic.falls import falls
from synthetic.track import track as tracked

FALL = falls_in_air(1.0, kept, bounces=5)
UGLY = {
    "errors that go together": {"correlation": 0.5, "frame_rate": 100.0},
    "pixels of 4 mm": {"pixel": 0.004},
    "one point in five missing": {"missing": 0.2},
    "tilted and drifting": {"tilt": 0.07, "drift": 0.1},
    "downward": {"down": True, "frame_rate": 240.0},
}


def seen(fall=FALL, **how):
    usual = {"frame_rate": 60.0, "noise": 1e-3, "until": float(fall.touches[3])}
    return tracked(fall, **usual | how)


def pairs(ball, fall):
    """Return what was found with what is true."""
    yield from zip(ball.restitutions, fall.restitutions, strict=False)
    yield from zip(ball.impact_speeds, fall.speeds, strict=False)
    yield from zip(ball.rebound_speeds, fall.rebounds, strict=False)
    yield from zip(ball.apex_heights, fall.apexes, strict=False)
    yield from ((ball.drop_height, fall.height), (ball.gravity, fall.gravity))


def test_a_track_nearly_without_errors_gives_what_went_in():
    data = seen(noise=1e-5, frame_rate=240.0)
    (ball,) = track(data, drag=AIR).balls
    for found, true in pairs(ball, FALL):
        assert found.n == pytest.approx(true, rel=2e-5)
    (free,) = track(data).balls
    assert free.restitutions[0].n < FALL.restitutions[0] - 0.04
    assert free.impact_speeds[0].n > 1.02 * FALL.speeds[0]


@pytest.mark.parametrize("how", UGLY)
def test_ugly_tracks_in_air(how):
    """All lie within four of their errors; without air the first restitution does not."""
    data = seen(seed=1, **UGLY[how])
    found = track(data, drag=AIR)
    (ball,) = found.balls
    off = [(one.n - true) / one.s for one, true in pairs(ball, FALL)]
    assert max(map(abs, off)) < 4.0
    assert ball.restitutions[0].s < 0.006
    assert track(data).balls[0].restitutions[0].n < FALL.restitutions[0] - 0.03
    assert found.time_base.agrees


@pytest.mark.slow
@pytest.mark.parametrize("unsure", [False, True])
def test_the_truth_lies_within_one_sigma_as_often_as_it_should(unsure):
    hits = dict.fromkeys(["restitution", "impact speed", "drop height", "gravity"], 0)
    for seed in range(100):
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
    for name, count in hits.items():
        assert possible(count, 100, 0.60, 0.76), (name, count)


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
        there = np.interp(ball.times[part][used[part]], line.get_xdata(), line.get_ydata())
        assert np.std(there - ball.heights[part][used[part]]) < 1.2e-3


def test_the_options_of_air_are_those_of_a_track():
    (told,) = analyse(seen(), mass=BALL[0], diameter=BALL[1], drag_coefficient=0.45)
    found = {row.name: row.value for row in told.rows()}
    assert found["restitution of bounce 0"].n == pytest.approx(FALL.restitutions[0], abs=3e-3)
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
