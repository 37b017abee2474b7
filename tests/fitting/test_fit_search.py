"""Surfaces with kinks and several minima: the best is found from any seed, the same each time."""

from dataclasses import replace

import numpy as np
import pytest

import stackbounce as sb
from drops import STACK
from stackbounce.fitting import FitProblem
from stackbounce.fitting.least_squares import find_minima

STIFFNESS = "contacts.1.stiffness"


def stack(lower=2500.0, upper=1000.0):
    return replace(STACK, contacts=[sb.Spring(lower), sb.Spring(upper)])


def least_on_a_grid(drop, data, stiffnesses):
    """Return chi squared on a fine grid."""
    ratios = sb.sweep(drop, {STIFFNESS: stiffnesses}).rebound_ratio.values
    return sum(((ratios[:, i] - value) / error) ** 2 for i, (value, error) in data.items())


def test_all_crossings_of_one_ratio_are_told():
    """The upper ball's ratio is 1.12 at three stiffnesses: one number cannot decide."""
    grid = np.geomspace(2800.0, 9500.0, 20_001)
    chi = least_on_a_grid(stack(), {1: (1.12, 0.002)}, grid)
    inside = (chi[1:-1] < chi[:-2]) & (chi[1:-1] < chi[2:]) & (chi[1:-1] < 0.1)
    crossings = grid[1:-1][inside]
    assert len(crossings) == 3
    for seed in range(3):
        data, vary = {"rebound_ratios.1": (1.12, 0.002)}, {STIFFNESS: (2800.0, 9500.0)}
        found = sb.fit(stack(), data, vary, rng=seed)
        minima = sorted(found.objective.values(one.x[None])[STIFFNESS][0] for one in found.minima)
        assert minima == pytest.approx(crossings, rel=1e-3)
        assert sum("another minimum is as good" in note for note in found.notes) == 2


def test_of_equal_minima_the_nearest_to_the_drop_comes_first():
    data, vary = {"rebound_ratios.1": (1.12, 0.002)}, {STIFFNESS: (2800.0, 9500.0)}
    for own, seed in [(3000.0, 0), (3000.0, 1), (9000.0, 0), (9000.0, 1)]:
        found = sb.fit(stack(upper=own), data, vary, rng=seed)
        ends = [found.objective.values(end.x[None])[STIFFNESS][0] for end in found.minima]
        distances = [abs(np.log(end / own)) for end in ends]
        assert distances[0] == min(distances)


@pytest.mark.parametrize("upper", [1200.0, 4600.0, 6200.0, 15_000.0, 21_000.0, 60_000.0])
def test_where_contacts_come_and_go_the_best_of_a_grid_is_found(upper):
    """One to many contacts: chi squared has kinks and many minima from bound to bound."""
    truth = sb.simulate(stack(upper=upper)).rebound_ratios
    data = {0: (truth[0] + 0.002, 0.003), 1: (truth[1] - 0.001, 0.006)}
    least = least_on_a_grid(stack(), data, np.geomspace(300.0, 1e5, 20_001)).min()
    measured = {"rebound_ratios": list(data.values())}
    for seed in range(2):
        found = sb.fit(stack(), measured, {STIFFNESS: (300.0, 1e5)}, rng=seed)
        assert found.chi_squared <= least + 1e-3


def test_the_same_seed_gives_the_same_bits_on_any_number_of_threads(monkeypatch):
    """4,096 trials are several blocks, which threads share."""
    data = {"rebound_ratios": ["1.0 ± 0.03", "1.5 ± 0.05"], "durations.0": "25 ± 2 ms"}
    vary = {STIFFNESS: (300.0, 1e5), "contacts.0.stiffness": (500.0, 1e4)}
    found = []
    for threads in (1, 4):
        monkeypatch.setattr("os.cpu_count", lambda count=threads: count)
        found.append(sb.fit(stack(), data, vary, starts=4096, rng=7))
    one, other = ([minimum.x.tobytes() for minimum in fit.minima] for fit in found)
    assert one == other
    assert len({fit.covariance.values.tobytes() for fit in found}) == 1


def test_a_valley_is_one_minimum():
    """With a gap of zero only the ratio of the stiffnesses counts: all of a line is as good."""
    data = {"rebound_ratios": [(0.6, 0.05), (1.6, 0.05)]}
    objective = FitProblem(stack(), data, ["contacts.0.stiffness", STIFFNESS]).objective
    for seed in range(3):
        best, *others = find_minima(objective, np.empty((0, len(objective.parameters))), seed=seed)
        assert all(one.chi_squared > best.chi_squared + 1.0 for one in others)
