"""Draws beside the posterior that is known exactly."""

from dataclasses import replace

import numpy as np
import pytest

import stackbounce as sb
from drops import STACK
from stackbounce.errors import InvalidType, InvalidValue

BALL = sb.Drop([sb.Ball(0.1)], [sb.Rigid(0.6)], impact_speed=1.0)
"""Its rebound ratio is its restitution."""

TWO = {"a": BALL, "b": sb.Drop([sb.Ball(0.1)], [sb.Rigid(0.5)], impact_speed=1.0)}
A, B = "a.contacts.0.restitution", "b.contacts.0.restitution"
DRAWS = 32_000


def linear():
    """Two restitutions, of which both, and their mean, are measured: e = A x."""
    mean = sb.Drop([sb.Ball(0.1)], [sb.Rigid(0.5)], impact_speed=1.0)
    return sb.fit(
        {**TWO, "mean": mean},
        {
            "a": {"rebound_ratios.0": (0.60, 0.02)},
            "b": {"rebound_ratios.0": (0.50, 0.03)},
            "mean": {"rebound_ratios.0": (0.56, 0.01)},
        },
        {A: (0.2, 0.9), B: (0.2, 0.9)},
        tie={"mean.contacts.0.restitution": f"0.5 * ({A} + {B})"},
    )


@pytest.mark.slow
def test_a_linear_case_has_the_exact_mean_spread_and_correlation():
    found = linear()
    matrix = np.array([[1.0, 0.0], [0.0, 1.0], [0.5, 0.5]])
    errors = np.array([0.02, 0.03, 0.01])
    scaled = matrix / errors[:, None]
    covariance = np.linalg.inv(scaled.T @ scaled)
    mean = covariance @ scaled.T @ (np.array([0.60, 0.50, 0.56]) / errors)
    assert list(found.best.values()) == pytest.approx(mean, abs=1e-8)
    assert found.covariance.values == pytest.approx(covariance, rel=1e-6)
    draws = found.sample(DRAWS, rng=3)
    both = np.array([draws.draws(name) for name in found.names])
    spread = np.sqrt(np.diag(covariance))
    count = both.shape[1] / max(draws.autocorrelation.values())  # independent ones
    assert count > 2000
    assert both.mean(axis=1) == pytest.approx(mean, abs=4.0 * spread.max() / np.sqrt(count))
    assert both.std(axis=1) == pytest.approx(spread, rel=4.0 / np.sqrt(2.0 * count))
    exact = covariance[0, 1] / spread.prod()
    assert np.corrcoef(both)[0, 1] == pytest.approx(exact, abs=4.0 / np.sqrt(count))
    assert draws.notes == ()
    assert 0.2 < draws.acceptance < 0.6
    assert all(1.0 < one < 20.0 for one in draws.autocorrelation.values())


@pytest.mark.slow
def test_between_wide_bounds_every_logarithm_is_as_probable():
    """Nothing was measured of a number: only the bounds are left."""
    vary = {"balls.0.mass": (0.01, 1.0), "contacts.0.restitution": (0.2, 0.9)}
    data = {"rebound_ratios.0": (0.6, 0.05), "energy_retained": (0.36, 0.05)}
    found = sb.fit(BALL, data, vary).sample(DRAWS, rng=2)
    at = np.linspace(0.1, 0.9, 9)
    assert np.log10(found.quantiles("balls.0.mass", at)) == pytest.approx(-2.0 + 2.0 * at, abs=0.08)


@pytest.mark.slow
@pytest.mark.parametrize("bounds", [(0.02, 0.98), (0.2, 0.98)])
def test_a_prior_is_all_that_is_known_beforehand(bounds):
    """Also where bounds are so wide that the number is searched by its logarithm."""
    mass = sb.Range(*bounds, prior=(0.5, 0.1))
    vary = {"balls.0.mass": mass, "contacts.0.restitution": (0.2, 0.9)}
    fit = sb.fit(BALL, {"rebound_ratios.0": (0.6, 0.05)}, vary)
    found = fit.sample(DRAWS, rng=2)
    assert fit.objective.parameters[0].logarithmic == (bounds[0] == 0.02)
    assert found["balls.0.mass"].nominal_value == pytest.approx(0.5, abs=0.006)
    assert found["balls.0.mass"].std_dev == pytest.approx(0.1, rel=0.04)


def test_the_same_seed_gives_the_same_bits():
    one, drawn = linear().sample(1280, rng=5), linear().sample(1280, rng=np.random.default_rng(5))
    other, third = linear().sample(1280, rng=5), linear().sample(1280, rng=drawn.seed)
    assert third.chain.tobytes() == drawn.chain.tobytes()
    assert one.chain.tobytes() == other.chain.tobytes()
    assert one.log_probability.tobytes() == other.log_probability.tobytes()
    assert one.chain.tobytes() != third.chain.tobytes()


def test_draws_stay_between_the_bounds_and_progress_is_told():
    told = []
    found = sb.fit(
        BALL, {"rebound_ratios.0": (0.58, 0.1)}, {"contacts.0.restitution": (0.5, 0.7)}
    ).sample(3200, rng=1, progress=lambda done, of: told.append((done, of)))
    draws = found.draws("contacts.0.restitution")
    assert 0.5 < draws.min() < draws.max() < 0.7  # not at the bounds, where values are cut
    assert draws.shape == (75 * 32,)
    assert told[0] == (32, 3200)
    assert told[-1] == (3200, 3200)
    assert found.chain.shape == (75, 32, 1)
    assert found.log_probability.shape == (75, 32)


@pytest.mark.parametrize(
    ("options", "kind", "message"),
    [
        ({"draws": 639}, InvalidValue, r"^draws must be .*640.*, got 639"),
        ({"draws": 1e4}, InvalidType, r"^draws must be a whole number"),
        ({"draws": 640, "rng": -1}, InvalidValue, r"^the seed must be"),
        ({"draws": 640, "rng": 2**32}, InvalidValue, r"^the seed must be"),
    ],
)
def test_what_cannot_be_drawn(options, kind, message):
    with pytest.raises(kind, match=message):
        linear().sample(**options)


def test_short_chains_are_noted_and_a_name_that_was_not_varied_is_refused():
    found = linear()
    draws = found.sample(640)
    assert draws.notes[0].startswith("the chains are only ")
    for values in (draws, found):
        with pytest.raises(InvalidValue, match=r"^'contacts' was not varied"):
            values["contacts"]


def test_other_minima_are_told():
    stack = replace(STACK, contacts=[sb.Spring(2500.0), sb.Spring(3000.0)])
    vary = {"contacts.1.stiffness": (2800.0, 9500.0)}
    found = sb.fit(stack, {"rebound_ratios.1": (1.12, 0.002)}, vary)
    assert "the fit has other minima, which the draws may not reach" in found.sample(1280).notes
