"""The paper's measurements as data sets: each can be fitted, and holds what the paper prints."""

import pytest

import stackbounce as sb
from stackbounce.cross2007.datasets import NAMES, load_dataset


@pytest.mark.parametrize("name", NAMES)
def test_each_is_fitted_out_of_the_box(name):
    drop, data, vary, what = load_dataset(name)
    found = sb.fit(drop, data, vary)
    assert found.minima[0].converged
    assert what
    assert found.chi_squared < 700.0  # the tennis ball on springs without loss does worst: 645


@pytest.mark.parametrize(("name", "stiffness"), [("B1", 6.05e4), ("B2", 3.78e4), ("B3", 2.43e4)])
def test_a_ball_alone_gives_back_table_one(name, stiffness):
    """Its k_d is that of half an oscillation; with loss a contact lasts longer at the same k."""
    drop, data, vary, _ = load_dataset(name)
    found = sb.fit(drop, data, vary)
    assert found.chi_squared < 1e-9
    assert found["contacts.0.stiffness"].nominal_value == pytest.approx(stiffness, rel=2e-3)
    # k goes with the time to the power -2
    time, error = data["durations.0"]
    relative = found["contacts.0.stiffness"].std_dev / found["contacts.0.stiffness"].nominal_value
    assert relative == pytest.approx(2.0 * error / time, rel=0.05)


def test_the_two_large_balls_are_not_equal():
    drop, data, *_ = load_dataset("B1-B1")
    assert drop.balls[0].mass / drop.balls[1].mass == pytest.approx(1.040)
    assert data["rebound_ratios"] == [(0.76, 0.02), (0.76, 0.02)]
    # two equal springs in series are half as stiff
    assert drop.contacts[1].stiffness == pytest.approx(drop.contacts[0].stiffness / 2.0)
