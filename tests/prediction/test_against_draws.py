"""Errors carried forward beside the spread of 100 000 drops that are drawn directly."""

import numpy as np
import pytest
import xarray as xr

import stackbounce as sb
from stackbounce.prediction.inputs import error_of_deviation

COUNT = 100_000
SEED = 20_07
WITHIN = 0.05
SETTLED = 0.01  # a standard deviation of direct draws that is known to that is one to compare with

HEAVY = [sb.Ball(0.6), sb.Ball(0.06)]
SUPER = [sb.Ball(0.105), sb.Ball(0.0248)]
LOSSY = [sb.Hysteretic(5.6e4, restitution=0.78), sb.Spring(1.6e4)]

STACKS = {
    "springs": (
        sb.Drop(HEAVY, [sb.Spring(2e4), sb.Spring(1e4)], gaps=[2e-3], height=0.63),
        {"height": (0.63, 0.01), "balls.1.mass": (0.06, 1e-3)},
    ),
    "rigid": (
        sb.Drop(HEAVY, [sb.Rigid(0.8), sb.Rigid(0.9)], height=1.0),
        {"height": (1.0, 0.01), "contacts.1.restitution": (0.9, 0.02)},
    ),
    "hertz": (
        sb.Drop(SUPER, [sb.Hertz(5e6), sb.Hertz(1e6)], gaps=[1e-4], impact_speed=2.0),
        {"impact_speed": (2.0, 0.02), "contacts.1.stiffness": (1e6, 5e4)},
    ),
    "hysteretic": (
        sb.Drop(SUPER, LOSSY, gaps=[1e-3], height=0.2),
        {"height": (0.2, 5e-3), "contacts.0.restitution": (0.78, 0.01), "gaps.0": (1e-3, 5e-5)},
    ),
    "a gap that may be none": (
        sb.Drop(SUPER, LOSSY, gaps=[1e-3], height=0.2),
        {"height": (0.2, 5e-3), "gaps.0": (1e-3, 9e-4)},
    ),
    "one touch or two": (
        sb.Drop([sb.Ball(0.03), SUPER[1]], LOSSY, gaps=[1.4e-3], height=0.2),
        {"gaps.0": (1.4e-3, 3e-4), "balls.0.mass": (0.03, 1e-3)},
    ),
}
DRAWN = {"a gap that may be none", "one touch or two"}


def drawn_directly(drop, errors):
    """Return a sweep of drops that are drawn from normal distributions; no gap is negative."""
    random = np.random.default_rng(SEED)
    numbers = {path: random.normal(*one, 2 * COUNT) for path, one in errors.items()}
    possible = np.all([x >= 0.0 for x in numbers.values()], axis=0)
    return sb.sweep(
        drop, {path: xr.DataArray(x[possible][:COUNT], dims="draw") for path, x in numbers.items()}
    )


@pytest.mark.slow
@pytest.mark.parametrize("name", STACKS)
def test_errors_are_those_of_direct_draws(name):
    drop, errors = STACKS[name]
    found = sb.predict(drop, errors)
    assert name not in DRAWN or found.method == "draws"
    ds = drawn_directly(drop, errors)
    assert ds.sizes["draw"] == COUNT
    duration = ds.last_release - ds.first_touch
    pairs = [("energy_retained", ds.energy_retained)]
    for i in range(len(drop.balls)):
        pairs.append((f"rebound_ratios.{i}", ds.rebound_ratio.sel(ball=i)))
        pairs.append((f"first_touch.{i}", ds.first_touch.sel(contact=i)))
        pairs.append((f"durations.{i}", duration.sel(contact=i)))
    compared, rare = 0, []
    for quantity, values in pairs:
        mean, deviation = float(values.mean()), float(values.std())
        if error_of_deviation(values.values) > SETTLED:  # few draws far out make this error
            low, high = np.nanquantile(values, (0.159, 0.841))
            assert np.diff(found.quantiles(quantity)[::2]) == pytest.approx(high - low, rel=WITHIN)
            rare.append(quantity)
        elif deviation > 1e-9 * abs(mean):
            assert found[quantity].std_dev == pytest.approx(deviation, rel=WITHIN), quantity
            assert abs(found[quantity].nominal_value - mean) < 0.1 * deviation, quantity
            compared += 1
    assert compared >= 2
    assert len(rare) <= 3
