"""Laws beside series that are known: a law's own numbers, with errors."""

import dataclasses

import numpy as np
import pytest
from scipy.stats import chi2

import stackbounce as sb
from stackbounce import datasets
from stackbounce.fitting.series import comparison
from stackbounce.fitting.series.comparison import AGREES, REFUTED, compare_laws
from stackbounce.fitting.series.family import Family, reason_to_skip
from stackbounce.fitting.series.series import Series, make_series
from stackbounce.model import LAWS

SPEEDS = np.array([4.0, 3.0, 2.0, 1.0, 0.5])
ERROR = 0.004


def series_of(law_class, generator=None, *, value=0.8, error=ERROR):
    values = Family(law_class, 4.0).at(value, SPEEDS)
    covariance = np.diag(np.full(SPEEDS.size, error**2))
    if generator is not None:
        values = values + error * generator.standard_normal(SPEEDS.size)
    nothing = np.zeros_like(covariance)
    return Series("made", "made", "a ball", SPEEDS, values, covariance, nothing, 0.0)


def outcome(found, law):
    return next(one for one in found.outcomes if law in one.laws)


@pytest.mark.parametrize("law", ["Rigid", "Viscoelastic", "HuntCrossley"])
def test_a_law_agrees_with_its_own_numbers_and_the_others_are_refuted(law):
    asked = ("Rigid", "Viscoelastic", "HuntCrossley")
    found = compare_laws(series_of(LAWS[law]), laws=asked)
    own = outcome(found, law)
    assert own.chi_squared < 1e-6
    assert own.value == pytest.approx(0.8, abs=1e-5)
    assert own.verdict == AGREES
    others = [one for one in found.outcomes if one is not own]
    assert others
    assert {one.verdict for one in others} == {REFUTED}
    assert found.tells_apart


@pytest.mark.parametrize("readings", [2, 3])
def test_a_true_law_is_refuted_as_often_as_p_says_if_its_errors_are_a_scatter(
    readings, monkeypatch
):
    """With χ² in place of F one true law in ten would be refuted by two readings a height."""
    monkeypatch.setattr(comparison, "_power", lambda _: (0.0, 0.0, None))
    generator = np.random.default_rng(11)
    data = datasets.load("golf-marble-heights").drop_vars("rebound_height")
    del data.drop_height.attrs["assumed_error"]
    heights = 0.8 * data.drop_height.values[:, None]
    found = []
    for _ in range(400):
        read = heights + 0.005 * generator.standard_normal((4, readings))
        made = make_series(data.assign(rebound_height=(("row", "reading"), read)), air=False)
        found.append(outcome(compare_laws(made, laws=["Rigid"]), "Rigid").p)
    for limit in (0.01, 0.05, 0.5):
        error = np.sqrt(limit * (1.0 - limit) / len(found))
        assert np.mean(np.array(found) < limit) == pytest.approx(limit, abs=3.0 * error)


def test_a_constant_has_the_error_and_the_p_of_its_mean():
    found = compare_laws(series_of(sb.Rigid, np.random.default_rng(5)), laws=["Rigid"])
    own = outcome(found, "Rigid")
    assert own.error == pytest.approx(ERROR / np.sqrt(SPEEDS.size), rel=1e-3)
    assert own.p == pytest.approx(chi2.sf(own.chi_squared, SPEEDS.size - 1), rel=1e-9)


def test_assumed_errors_are_halved_and_doubled():
    made = series_of(sb.Rigid, np.random.default_rng(6))
    supposed = dataclasses.replace(made, published=made.assumed, assumed=made.published)
    own = outcome(compare_laws(supposed, laws=["Rigid"]), "Rigid")
    assert own.p_half < own.p < own.p_twice
    assert outcome(compare_laws(made, laws=["Rigid"]), "Rigid").p_half is None


def test_every_law_is_asked_or_has_a_reason_and_one_curve_is_one_outcome():
    found = compare_laws(series_of(sb.Rigid))
    same = {"Rigid", "Dashpot", "Hysteretic", "StandardLinearSolid"}
    assert same <= set(outcome(found, "Rigid").laws)
    asked = [name for one in found.outcomes for name in one.laws]
    assert sorted([*asked, *found.skipped]) == sorted(LAWS)
    assert found.skipped["Spring"] == "it loses nothing"


def test_the_exponent_of_the_loss_is_that_of_weak_viscoelasticity():
    found = compare_laws(series_of(sb.Viscoelastic, value=0.99, error=1e-4), laws=())
    assert found.exponent == pytest.approx(0.2, abs=0.005)
    found = compare_laws(series_of(sb.HuntCrossley, value=0.99, error=1e-4), laws=())
    assert found.exponent == pytest.approx(1.0, abs=0.02)


@pytest.mark.parametrize("name", list(LAWS))
def test_mass_and_contact_time_do_not_matter_to_a_law_that_is_asked(name):
    series = series_of(sb.Rigid)
    family = Family(LAWS[name], float(SPEEDS.max()))
    if reason_to_skip(family, series):
        pytest.skip("it is not asked")
    found = family.at(0.8, SPEEDS)
    law = sb.calibrate(LAWS[name], mass=3.0, restitution=0.8, contact_time=1e-4, impact_speed=4.0)
    other = [sb.restitution(law, 3.0, float(speed)) for speed in SPEEDS]
    assert found == pytest.approx(other, rel=1e-6)


class Forgetful(Family):
    """A family whose calibration does not give the law again at another speed."""

    def law(self, value):
        return sb.Rigid(min(1.0, value * self.speed / 4.0))


class Narrow(Family):
    """A family that has no law with a small restitution."""

    def law(self, value):
        if value < 0.7:
            raise sb.errors.InvalidValue("too small")
        return super().law(value)


def test_a_law_that_cannot_be_fitted_is_skipped(monkeypatch):
    monkeypatch.setattr(comparison, "Family", Narrow)
    found = compare_laws(series_of(sb.Rigid), laws=["HuntCrossley"])
    assert found.outcomes == ()
    assert found.skipped == {"HuntCrossley": "it cannot be fitted: too small"}


def test_a_calibration_that_depends_on_the_speed_is_skipped():
    reason = reason_to_skip(Forgetful(sb.Rigid, 4.0), series_of(sb.Rigid))
    assert reason == "what it gives depends on the speed at which it is calibrated"
