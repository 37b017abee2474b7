"""Where engine and mode are chosen, and which exceptions of plain Python mean a lost number."""

import dataclasses

import numpy as np
import pytest

import stackbounce as sb
from stackbounce.run import batch, driver
from stackbounce.run.engines import (
    FINITE,
    OUT_OF_RANGE,
    PLAIN_BALLS,
    PLAIN_DROPS,
    PLAIN_EVENTS,
    RIGID,
    Mode,
    choose_engine,
    choose_mode,
    suits_two_springs,
)
from stackbounce.run.options import run_options
from stackbounce.run.paths import number_at

BALLS = [sb.Ball(0.15), sb.Ball(0.057)]
SPRINGS = sb.Drop(BALLS, [sb.Spring(2500.0), sb.Spring(1000.0)], impact_speed=3.53)
HERTZ = sb.Drop(BALLS, [sb.Hertz(1e5)] * 2, impact_speed=3.53)
STONES = sb.Drop(BALLS, [sb.Rigid(0.9)] * 2, impact_speed=3.53)
BUGS = (TypeError, AttributeError, NameError, IndexError, KeyError, AssertionError)


@pytest.mark.parametrize(
    ("asked", "drops", "balls", "mode"),
    [
        (None, 1, 2, Mode.TRIAL),
        (None, PLAIN_DROPS, PLAIN_BALLS, Mode.TRIAL),
        (None, PLAIN_DROPS + 1, 2, Mode.COMPILED),
        (None, 1, PLAIN_BALLS + 1, Mode.COMPILED),
        (True, 1, 1, Mode.COMPILED),
        (False, 10**6, 100, Mode.PLAIN),
    ],
)
def test_mode(asked, drops, balls, mode):
    assert choose_mode(asked, drops, balls) is mode


def test_a_trial_alone_has_a_limit_of_its_own():
    assert [mode.event_limit(10**6) for mode in Mode] == [10**6, PLAIN_EVENTS, 10**6]
    assert Mode.TRIAL.event_limit(5) == 5


def test_engine():
    assert [choose_engine(drop) for drop in (SPRINGS, HERTZ, STONES)] == [FINITE, FINITE, RIGID]


def test_two_springs_of_any_mass_have_an_engine_of_their_own():
    options = run_options(SPRINGS, None, 1e-12, 10**6)
    mass = [number_at(SPRINGS, "balls.0.mass")]
    assert suits_two_springs(SPRINGS, mass, options)
    assert not suits_two_springs(HERTZ, mass, options)
    assert not suits_two_springs(SPRINGS, [number_at(SPRINGS, "gravity")], options)
    assert not suits_two_springs(SPRINGS, mass, options._replace(until=1.0))


def broken(monkeypatch, error):
    """Let the finite engine's kernels raise an exception."""

    def raising(*_):
        raise error

    engine = dataclasses.replace(FINITE, advance=raising, run_batch=raising)
    for module in (driver, batch):
        monkeypatch.setattr(module, "choose_engine", lambda _: engine)


@pytest.mark.parametrize("bug", BUGS)
def test_a_programming_error_is_not_taken_for_numbers_out_of_range(monkeypatch, bug):
    broken(monkeypatch, bug("a bug"))
    with pytest.raises(bug, match="a bug"):
        sb.simulate(HERTZ)
    with pytest.raises(bug, match="a bug"):
        sb.sweep(HERTZ, {"balls.0.mass": [1.0, 2.0]})


@pytest.mark.parametrize("error", OUT_OF_RANGE)
def test_numbers_out_of_range_make_a_run_invalid(monkeypatch, error):
    broken(monkeypatch, error("math"))
    assert sb.simulate(HERTZ).status is sb.Status.INVALID


@pytest.mark.parametrize("stiffness", [1e5, 1e308])
@pytest.mark.parametrize("law", [sb.Spring, sb.Hertz, lambda k: sb.Dashpot(k, 1.0)])
def test_a_sweep_has_the_status_of_a_run_out_of_range(law, stiffness):
    drop = sb.Drop([sb.Ball(1e-300), sb.Ball(1.0)], [law(stiffness)] * 2, impact_speed=1e200)
    ds = sb.sweep(drop, {"balls.1.mass": [1.0, 1e300]})
    for mass, status in zip((1.0, 1e300), ds.status.values, strict=True):
        one = sb.Drop([sb.Ball(1e-300), sb.Ball(mass)], [law(stiffness)] * 2, impact_speed=1e200)
        assert sb.simulate(one, compiled=True).status == status


def test_ratios_and_velocities_have_fields_of_their_own():
    options = run_options(SPRINGS, None, 1e-12, 10**6)
    mass = np.array([0.1, 0.2, 0.3])
    out = batch.solve(SPRINGS, {number_at(SPRINGS, "balls.0.mass"): mass}, (3,), options)
    assert out.velocity == pytest.approx(out.rebound_ratio * 3.53)
    assert out.velocity.max() > 3.53 > out.rebound_ratio.max()
