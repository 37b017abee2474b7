"""Smooth fits beside lmfit and scipy used plainly, with `simulate` one drop at a time."""

import lmfit
import numpy as np
import pytest
from scipy.optimize import least_squares
from scipy.stats import chi2

import stackbounce as sb

BALLS = [sb.Ball(0.150), sb.Ball(0.057)]
NAMES = ["contacts.0.stiffness", "contacts.1.stiffness"]


def predicted(law, stiffnesses):
    """Return rebound ratios, and the floor's last release in ms, by a run of their own."""
    drop = sb.Drop(BALLS, [law(k) for k in stiffnesses], impact_speed=3.5)
    result = sb.simulate(drop)
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
def test_intervals_are_those_of_lmfit():
    law, truth = CASES["springs"]
    target, found = ours(law, truth)
    parameters = lmfit.Parameters()
    for k, value in enumerate(truth):
        parameters.add(f"k{k}", value=value, min=value / 4, max=value * 4)
    minimizer = lmfit.Minimizer(
        lambda trial: (predicted(law, trial.valuesdict().values()) - target) / ERRORS,
        parameters,
        scale_covar=False,
    )
    limits = lmfit.conf_interval(
        minimizer,
        minimizer.minimize(),
        sigmas=[1, 2],  # lmfit's default is an F test; ours is a rise of chi squared
        prob_func=lambda best, other: float(chi2.cdf(max(other.chisqr - best.chisqr, 0.0), 1)),
    )
    for sigma, (low, high) in {1.0: (1, 3), 2.0: (0, 4)}.items():
        own = found.intervals(sigma=sigma)
        for k, name in enumerate(NAMES):
            rows = [value for _, value in limits[f"k{k}"]]
            margin = 5e-3 * found[name].std_dev
            assert own[name][:2] == pytest.approx((rows[low], rows[high]), abs=margin)
