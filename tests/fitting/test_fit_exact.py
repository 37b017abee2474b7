"""Fits whose answer is known in closed form, and the statistics by hand."""

import math

import numpy as np
import pytest
from scipy.stats import chi2

import stackbounce as sb
from drops import STACK

MASS = 0.0567


def test_a_contact_time_gives_the_stiffness_of_one_spring():
    time, error = 5.0e-3, 0.1e-3
    drop = sb.Drop([sb.Ball(MASS)], [sb.Spring(1e4)], height=0.3)
    found = sb.fit(drop, {"durations.0": (time, error)}, ["contacts.0.stiffness"])
    exact = MASS * (math.pi / time) ** 2
    assert found.best["contacts.0.stiffness"] == pytest.approx(exact, rel=1e-9)
    spread = found["contacts.0.stiffness"].std_dev
    assert spread == pytest.approx(2.0 * exact * error / time, rel=1e-6)
    assert found.chi_squared < 1e-15
    assert found.drop.contacts[0].stiffness == found.best["contacts.0.stiffness"]
    assert (found.degrees_of_freedom, found.aicc) == (0, math.inf)
    assert math.isnan(found.probability)


@pytest.mark.parametrize(
    ("name", "of_time"),
    [
        ("contacts.0.stiffness", lambda time: MASS * (math.pi / time) ** 2),
        ("balls.0.mass", lambda time: 1e4 * (time / math.pi) ** 2),
    ],
)
def test_its_interval_is_where_the_time_is_one_error_off(name, of_time):
    time, error = 5.0e-3, 0.5e-3
    drop = sb.Drop([sb.Ball(MASS)], [sb.Spring(1e4)], height=0.3)
    found = sb.fit(drop, {"durations.0": (time, error)}, [name])
    for sigma in (1.0, 2.0):
        low, high, *bounds = found.intervals(sigma=sigma)[name]
        ends = sorted(of_time(time + sign * sigma * error) for sign in (1, -1))
        assert [low, high] == pytest.approx(ends, rel=1e-3)
        assert bounds == [False, False]


def test_rebound_ratios_of_rigid_balls_give_their_restitution():
    drop = sb.Drop(STACK.balls, [sb.Rigid(0.9), sb.Rigid(0.5)], gaps=[0.01], impact_speed=2.0)
    lower = (0.9 * 0.150 - 0.057 - 0.057 * 0.7 * 1.9) / 0.207
    upper = lower + 0.7 * 1.9  # the balls part with e times the speed at which they met
    data = {"rebound_ratios": [(lower, 0.02), (upper, 0.01)]}
    found = sb.fit(drop, data, {"contacts.1.restitution": (0.1, 1.0)})["contacts.1.restitution"]
    slopes = np.array([-0.057 * 1.9 / 0.207, 0.150 * 1.9 / 0.207])
    assert found.nominal_value == pytest.approx(0.7, abs=1e-8)
    assert found.std_dev == pytest.approx(np.sum((slopes / [0.02, 0.01]) ** 2) ** -0.5, rel=1e-6)


def test_heights_and_speeds_say_the_same_as_ratios():
    ratios = sb.simulate(STACK).rebound_ratios
    vary = {"contacts.1.stiffness": (500.0, 2000.0)}
    speed = ratios[1] * 3.5
    given = {
        "rebound_ratios.1": (ratios[1], 0.02),
        "rebound_speeds.1": (speed, 0.02 * 3.5),
        "rebound_heights.1": (speed**2 / (2 * 9.80665), speed * 0.02 * 3.5 / 9.80665),
    }
    found = [sb.fit(STACK, {k: v}, vary)["contacts.1.stiffness"] for k, v in given.items()]
    for one in found:
        assert one.nominal_value == pytest.approx(1000.0, rel=1e-6)
        assert one.std_dev == pytest.approx(found[0].std_dev, rel=1e-4)


def test_heights_heed_a_gravity_that_is_varied():
    drop = sb.Drop([sb.Ball(0.1)], [sb.Rigid(0.8)], impact_speed=2.0, gravity=9.81)
    height = (0.8 * 2.0) ** 2 / (2.0 * 1.62)
    found = sb.fit(drop, {"rebound_heights.0": (height, 0.01 * height)}, {"gravity": (1.0, 20.0)})
    assert found.best["gravity"] == pytest.approx(1.62, rel=1e-6)
    assert found["gravity"].std_dev == pytest.approx(0.01 * 1.62, rel=1e-4)


def test_the_statistics_are_what_their_names_say():
    ratios = sb.simulate(STACK).rebound_ratios
    seen = [(ratios[0] + 0.01, 0.01), (ratios[1] - 0.015, 0.02)]
    data = {"rebound_ratios": seen, "energy_retained": (0.99, 0.02)}
    vary = {"contacts.1.stiffness": sb.Range(500.0, 2000.0, prior=(1050.0, 100.0))}
    found = sb.fit(STACK, data, vary)
    stiffness = found.best["contacts.1.stiffness"]
    again = sb.simulate(sb.Drop(STACK.balls, [sb.Spring(2500.0), sb.Spring(stiffness)], height=1.0))
    pulls = [
        (again.rebound_ratios[0] - ratios[0] - 0.01) / 0.01,
        (again.rebound_ratios[1] - ratios[1] + 0.015) / 0.02,
        (again.energy_retained - 0.99) / 0.02,
        (stiffness - 1050.0) / 100.0,
    ]
    assert [one.pull for one in found.residuals] == pytest.approx(pulls, abs=1e-9)
    chi = sum(pull**2 for pull in pulls)
    assert found.chi_squared == pytest.approx(chi, rel=1e-12)
    assert found.degrees_of_freedom == 3
    assert found.probability == pytest.approx(chi2.sf(chi, 3), rel=1e-12)
    assert found.aicc == pytest.approx(chi + 2.0 + 4.0 / 2.0, rel=1e-12)
    assert found.bic == pytest.approx(chi + math.log(4), rel=1e-12)


def test_a_wrong_model_is_told():
    drop = sb.Drop([sb.Ball(0.1)], [sb.Spring(1e4)], impact_speed=1.0)
    data = {"durations.0": "10 ± 0.1 ms", "rebound_ratios.0": "0.8 ± 0.01"}
    found = sb.fit(drop, data, ["contacts.0.stiffness"])
    assert found.chi_squared == pytest.approx(400.0, rel=1e-6)
    (note,) = found.notes
    assert note == (
        "the model does not describe the data: chi squared is 400 for 1 degree of freedom; "
        "its parameters' errors mean little"
    )


def test_a_touch_that_does_not_come_is_told():
    drop = sb.Drop([sb.Ball(0.1)] * 2, [None, sb.Spring(1e4)], gaps=[0.01], velocities=[1.0, 0.0])
    away = sb.Drop(drop.balls, drop.contacts, gaps=[0.01], velocities=[-1.0, 0.5])
    met = sb.fit(drop, {"durations.1": "7 ± 1 ms"}, ["contacts.1.stiffness"])
    missed = sb.fit(away, {"durations.1": "7 ± 1 ms"}, ["contacts.1.stiffness"])
    assert met.notes == ()
    assert "durations.1: the fitted drop has none" in missed.notes
    assert missed.undetermined
