"""Expected information: closed forms, predictions of measurements, and their ranking."""

import numpy as np
import pytest
from studies.table2.bounce_likelihood import (
    CHOICES,
    SCATTER,
    draw_numbers,
)
from studies.table2.evidence import draw_normal
from studies.table2.hierarchy import Hierarchy, Likelihoods
from studies.table2.information import (
    draw_samples,
    expect_information,
    measure_gain,
    rank_measurements,
)
from studies.table2.measurements import (
    MEASUREMENTS,
    Measurement,
    Outcome,
    measure_loops,
)
from studies.table2.readings import READINGS

NAMES = {one.what: one for one in MEASUREMENTS}


@pytest.fixture(scope="module")
def made_up():
    """Equal likelihoods of two models, except that 0.78 is no restitution."""
    normal = draw_normal(7, 2, 64, 1)
    shape = (*map(len, CHOICES.values()), len(SCATTER), 2, 64)
    logs = {"S": np.zeros(shape), "H": np.zeros(shape)}
    for one in logs.values():
        one[0] -= 50.0
    draws = {reading: draw_numbers(normal, reading) for reading in READINGS}
    return Hierarchy(Likelihoods(logs, draws), {})


@pytest.fixture(scope="module")
def samples(made_up):
    return draw_samples(made_up, 64)


def two_answers(apart, share, each=4000):
    """Return the information of an outcome N(0, 1) or N(apart, 1) about which of both it is."""
    label = np.repeat([0, 1], each)
    weights = np.repeat([share / each, (1.0 - share) / each], each)
    outcome = Outcome(apart * label[:, None], np.ones((2 * each, 1)))
    return expect_information(outcome, weights, [label])[0]


@pytest.mark.parametrize(("apart", "share"), [(1.0, 0.5), (2.0, 0.5), (2.0, 0.1)])
def test_information_of_two_normal_distributions_is_their_integral(apart, share):
    y = np.linspace(-8.0, 8.0 + apart, 20001)
    first, second = (np.exp(-0.5 * (y - at) ** 2) / np.sqrt(2.0 * np.pi) for at in (0.0, apart))
    both = share * first + (1.0 - share) * second
    whole = share * first * np.log2(first / both) + (1.0 - share) * second * np.log2(second / both)
    exact = float(np.trapezoid(whole, y))
    bits, error = two_answers(apart, share, each=1000)
    assert bits == pytest.approx(exact, abs=4.0 * error + 1e-3)
    assert error < 0.03


def test_an_outcome_that_does_not_depend_on_the_answer_says_nothing():
    bits, error = two_answers(0.0, 0.5, each=500)
    assert abs(bits) < 1e-9
    assert error < 1e-9


def test_information_is_repeated_bit_for_bit(samples):
    one, shares = NAMES["B1 alone from 5 cm"], np.array([0.5, 0.5])
    assert measure_gain(one, samples, shares) == measure_gain(one, samples, shares)


def test_draws_of_the_posterior_have_its_readings(made_up, samples):
    assert [one.name for one in samples] == ["S", "H"]
    for one in samples:
        assert not np.any(one.reading == 0)
        assert np.mean(one.reading == 1) == pytest.approx(0.5, abs=0.05)
        high = one.values["e_B2"][one.reading == 1].mean()
        assert high == pytest.approx(np.sqrt(0.9), abs=0.01)
    again = draw_samples(made_up, 64)
    assert np.array_equal(again[1].values["e_B1"], samples[1].values["e_B1"])


def test_a_ball_alone_has_its_restitution_at_twenty_centimetres(samples):
    for one in samples:
        found = NAMES["B1 alone from 20 cm"].predict(one)
        assert found.values[0, :, 0] == pytest.approx(one.values["e_B1"], abs=1e-5)
        low, _, high = NAMES["B1 alone from 5, 20 and 80 cm"].predict(one).values[0].T
        if one.name == "H":  # hysteresis: the same at any speed
            assert low == pytest.approx(high, abs=1e-5)
        else:
            assert np.all(low > high + 0.02)


def test_two_equal_balls_meet_as_one_meets_the_floor(samples):
    """At 2.0 m/s each half has 1.0 m/s: hysteresis has its restitution at any speed."""
    slow = next(one for one in samples if one.name == "H")
    found = NAMES["two balls B1 as pendulums, closing at 2 m/s"].predict(slow)
    assert found.values[0, :, 0] == pytest.approx(slow.values["e_B1"], abs=1e-5)


def test_loops_tell_laws_apart():
    e = np.array([0.88])
    linear, hertz, hunt = (measure_loops(name, e)[0] for name in ("H, linear", "H", "S"))
    assert hertz[0] > linear[0] + 0.1
    assert hunt[0] < hertz[0] - 0.1
    assert hunt[1] < hertz[1] - 0.03
    assert [one[2] for one in (linear, hertz, hunt)] == pytest.approx([1.0 - 0.88**2] * 3)


def test_filmed_gaps_have_an_outcome_for_each_gap(samples):
    few = [one for one in samples if one.name == "H"]
    found = NAMES["B1 on B2, gap filmed"].predict(few[0])
    assert found.values.shape == (5, 64, 2)
    assert found.errors.shape == (5, 64, 2)
    assert np.all(found.errors >= 0.02)
    assert np.all(np.isfinite(found.values))


def test_the_best_design_is_named(samples):
    def predict(sample):
        shift = float(sample.name == "H") * np.array([0.0, 5.0])[:, None, None]
        middle = np.zeros((2, 64, 1)) + shift
        return Outcome(middle, np.ones_like(middle))

    both = Measurement("made up", "", "", ("near", "far"), predict)
    gain = measure_gain(both, samples, np.array([0.5, 0.5]))
    assert (gain.design, gain.what) == ("far", "made up")
    assert gain.best > 0.9
    assert gain.model == pytest.approx(gain.best / 2.0, abs=0.01)


@pytest.mark.slow
def test_measurements_are_ranked(made_up):
    told = []
    found = rank_measurements(made_up, told.append, each=64)
    bits = [one.model for one in found.gains]
    assert bits == sorted(bits, reverse=True)
    assert {one.what for one in found.gains} == set(NAMES)
    assert len(told) == len(NAMES)
    assert found.model == pytest.approx(1.0, abs=0.01)
    assert max(bits) < 1.0 + 0.05
    assert found.in_minutes in found.gains
    assert "alone" in found.in_minutes.what
    assert set(found.as_dict()) == {"model", "reading", "gains"}
