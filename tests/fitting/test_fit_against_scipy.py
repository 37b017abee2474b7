"""Smooth fits beside scipy used plainly, with `simulate` one drop at a time."""

import numpy as np
import pytest
from scipy.optimize import least_squares, minimize_scalar

import stackbounce as sb

BALLS = [sb.Ball(0.150), sb.Ball(0.057)]
NAMES = ["contacts.0.stiffness", "contacts.1.stiffness"]


def predicted(law, stiffnesses):
    """Return rebound ratios, and the floor's last release in ms, by a run of their own."""
    result = sb.simulate(sb.Drop(BALLS, [law(k) for k in stiffnesses], impact_speed=3.5))
    floor = result.intervals[result.intervals["contact"] == 0]
    return np.array([*result.rebound_ratios, 1e3 * floor["end"].max()])


CASES = {
    "springs": (sb.Spring, np.array([2500.0, 1000.0])),
    "Hertz": (sb.Hertz, np.array([1e5, 5e4])),
}
ERRORS = np.array([0.02, 0.03, 0.3])
PULLS = np.array([0.8, -0.5, 0.6])


def ours(law, truth):
    target = predicted(law, truth) + PULLS * ERRORS
    ratios = list(zip(target[:2], ERRORS[:2], strict=True))
    data = {"rebound_ratios": ratios, "durations.0": (1e-3 * target[2], 1e-3 * ERRORS[2])}
    drop = sb.Drop(BALLS, [law(k) for k in truth], impact_speed=3.5)
    vary = {name: (k / 4, k * 4) for name, k in zip(NAMES, truth, strict=True)}
    return target, sb.fit(drop, data, vary)


@pytest.mark.parametrize("case", CASES)
def test_values_errors_and_correlations_are_those_of_scipy(case):
    law, truth = CASES[case]
    target, found = ours(law, truth)
    options = {"x_scale": truth, "diff_step": 1e-5, "jac": "3-point", "xtol": 1e-12}
    plain = least_squares(lambda one: (predicted(law, one) - target) / ERRORS, truth, **options)
    covariance = np.linalg.inv(plain.jac.T @ plain.jac)
    errors = np.sqrt(np.diag(covariance))
    assert list(found.best.values()) == pytest.approx(plain.x, abs=1e-4 * errors.min())
    assert [found[name].std_dev for name in NAMES] == pytest.approx(errors, rel=1e-3)
    correlation = covariance[0, 1] / errors.prod()
    assert found.correlations.values[0, 1] == pytest.approx(correlation, abs=1e-3)
    assert found.chi_squared == pytest.approx(2.0 * plain.cost, rel=1e-7)


@pytest.mark.slow
def test_intervals_end_where_the_least_chi_squared_of_scipy_has_risen():
    law, truth = CASES["springs"]
    target, found = ours(law, truth)

    def rise(k, value):
        """Return how much more chi squared is, with the other stiffness refitted."""

        def chi_squared(other):
            trial = [other, value] if k else [value, other]
            return np.sum(((predicted(law, trial) - target) / ERRORS) ** 2)

        bounds = (truth[1 - k] / 4, truth[1 - k] * 4)
        return minimize_scalar(chi_squared, bounds=bounds, method="bounded").fun - found.chi_squared

    for sigma in (1.0, 2.0):
        for k, interval in enumerate(found.intervals(sigma=sigma).values()):
            for end in interval[:2]:
                assert rise(k, end) == pytest.approx(sigma**2, rel=5e-3)
