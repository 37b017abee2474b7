"""Each usual model wins on data of its own, or is not told apart by them from the one that wins."""

import functools
from dataclasses import replace

import numpy as np
import pytest
from scipy.stats import chi2, kstest

import stackbounce as sb
from coverage_cases import chosen

HEIGHTS = {"at_10": 0.1, "at_25": 0.25, "at_50": 0.5, "at_100": 1.0, "at_200": 2.0}  # m
HEAVY, LIGHT = sb.Ball(0.150), sb.Ball(0.057)
STACKS = {
    "one ball": ([LIGHT], [sb.Spring(22.5e3)], {"rebound_ratios.0": 0.01, "durations.0": 5e-5}),
    "two balls": (
        [HEAVY, LIGHT],
        [sb.Spring(25e3), sb.Spring(10e3)],
        {"rebound_ratios.0": 0.01, "rebound_ratios.1": 0.01},
    ),
}
TRUE = {
    "restitution": 0.8,
    "contacts.0.restitution": 0.75,
    "contacts.1.restitution": 0.85,
    "speed_exponent": 0.2,
    "gaps.0": 1e-3,
}
OFF = 1.2  # true stiffnesses and other losses in units of those that a search starts from
SEEDS = 200
REACH = 30.0
"""Chi squared of a model fitted to the data without noise, above which it is no rival.

With noise, chi squared of a model at a distance d in errors exceeds that of the truth by a normal
number of mean d**2 and standard deviation 2 d, less some 5 that its own numbers take up. It falls
below it by 11, as it must to beat the truth, in one of 2000 data sets.
"""
CHANCE = 0.01
"""How often noise may take that much off the chi squared of a rival, were it linear."""
LOST = 0.05
"""The share of data sets in which a rival may do better: those that bend follow noise further.

Of a stack with a wide gap, which collides separately, the data do not determine the stiffness, and
a fit may look for a trend with the height at any of its values.
"""


@functools.cache
def usual(stack):
    balls, contacts, errors = STACKS[stack]
    drops = {key: sb.Drop(balls, contacts, height=height) for key, height in HEIGHTS.items()}
    return sb.standard_models(drops, times="durations.0" in errors)


CASES = {f"{name}, {stack}": (name, stack) for stack in STACKS for name in usual(stack)}


def measured(stack, numbers, draw=None):
    """Return numbers of all drops, (drops, data), with their errors as data; noise if drawn."""
    errors = STACKS[stack][2]
    noise = 0.0 if draw is None else draw.standard_normal(numbers.shape) * list(errors.values())
    return {
        key: dict(zip(errors, zip(row, errors.values(), strict=True), strict=True))
        for key, row in zip(HEIGHTS, numbers + noise, strict=True)
    }


def true_numbers(stack, model):
    """Return what the drops of a model show, (drops, data)."""
    nothing = np.zeros((len(HEIGHTS), len(STACKS[stack][2])))
    objective = replace(model, data=measured(stack, nothing)).objective
    trial = np.array(
        [
            parameter.coordinate(
                TRUE.get(parameter.name, OFF * np.sqrt(parameter.low * parameter.high))
            )
            for parameter in objective.parameters
        ]
    )
    return np.concatenate(list(objective.predict(HEIGHTS, trial[None]).values()))


def is_lost(name, compared):
    """Return whether another model wins by more than noise does.

    A linear model of k numbers whose predictions lie beside the truth takes at most the chi squared
    of k + 1 numbers off that of the truth: one is the direction in which it lies.
    """
    winner = compared.scores[0]
    more = compared[name].chi_squared - winner.chi_squared
    told_apart = name not in (winner.model, *winner.same_as)
    return told_apart and more > chi2.isf(CHANCE, winner.parameters + 1)


@pytest.mark.parametrize("name", ["Viscoelastic", "Hertz"])
def test_a_model_wins_on_its_own_data(name):
    """With contacts calibrated anew for each drop, `Hysteretic` won on data of `Viscoelastic`."""
    models = usual("one ball")
    numbers = true_numbers("one ball", models[name])
    for seed in range(2):
        data = measured("one ball", numbers, np.random.default_rng(seed))
        compared = sb.compare(models, data, starts=1)
        assert compared.scores[0].model == name
        assert compared[name].probability > 0.01


@pytest.mark.slow
@pytest.mark.parametrize("case", chosen(CASES, "HuntCrossley, two balls"))
def test_a_model_wins_on_200_data_sets_of_its_own_and_p_is_uniform(case):
    name, stack = CASES[case]
    models = usual(stack)
    numbers = true_numbers(stack, models[name])
    exact = sb.compare(models, measured(stack, numbers))
    assert exact[name].chi_squared < 1e-6
    rivals = {
        key: replace(models[key], drops=fit.drops)  # where the descents start
        for key, fit in exact.fits.items()
        if fit.chi_squared < REACH
    }
    lost, chances = 0, []
    for seed in range(SEEDS):
        data = measured(stack, numbers, np.random.default_rng(seed))
        compared = sb.compare(rivals, data, starts=1)
        lost += is_lost(name, compared)
        chances.append(compared[name].probability)
    assert lost <= LOST * SEEDS
    assert kstest(chances, "uniform").pvalue > 1e-3
