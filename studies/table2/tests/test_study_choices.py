"""The choices of the study's analysis: what each changes, and what depends on it."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from studies.table2 import inputs
from studies.table2.catalogue import AS_HEIGHTS, AS_PRINTED, NAMES, THEORIES
from studies.table2.choice_fits import MODELS, Cell, fit_row
from studies.table2.choices import (
    ALL_EARLY,
    ALL_LATE,
    BASE,
    CHOICES,
    FALLING,
    FALLING_LATE,
    LATE,
    known_errors,
)
from studies.table2.claims import Claim, check_claims, state_headline
from studies.table2.comparison import Score, score
from studies.table2.cross_validation import predict_held_out
from studies.table2.observed import observe
from studies.table2.readings import penalty
from studies.table2.searches import fit_model, fit_near
from studies.table2.workers import spread

import stackbounce as sb
from stackbounce.fitting import Fit
from stackbounce.fitting.least_squares import Minimum
from stackbounce.model import STANDARD_GRAVITY

BY_NAME = {one.name: one for one in CHOICES}
UNEVEN = BY_NAME["without the rolling pair"]


def objective_of(choice, name):
    return observe(replace(choice.model(name), data=choice.data()))


def trial_of(objective, **numbers):
    """A trial with gaps of 4 mm, the middle of other bounds, and these numbers."""
    middle = np.mean(objective.spans, axis=1)
    known = {**{f"{key}.gaps.0": 4e-3 for key in objective.measured}, **numbers}
    return np.array([[known.get(n, m) for n, m in zip(objective.names, middle, strict=True)]])


def test_the_base_is_what_the_catalogue_has():
    assert BASE.data() == inputs.MEASURED
    assert all(BASE.theory(theory) == theory for theory in THEORIES.values())


def test_each_choice_changes_one_thing():
    assert BY_NAME["delays ± 1 ms"].data()["B1_on_B2"][inputs.DELAY] == (2e-3, 1e-3)
    assert BY_NAME["delays ± 1 ms"].data()["B1_on_B1"][inputs.DELAY] == (3e-3, 2e-3)
    assert set(BASE.data()) - set(UNEVEN.data()) == {"B1_on_B1"}
    assert [drop.gravity for drop in FALLING.model("S").drops.values()] == [9.80665] * 5
    assert BY_NAME["Table I: as printed"].theory(THEORIES["S"]).known == AS_PRINTED
    only = {"e_B2": AS_HEIGHTS["e_B2"]}
    assert BY_NAME["Table I: ratios of heights"].theory(THEORIES["B"]).known == only
    one_thing = [one for one in CHOICES if one not in (BASE, LATE, ALL_EARLY, ALL_LATE)]
    together = [one for one in one_thing if one is FALLING or not one.gravity]
    for field in ("rolling", "gravity", "table_errors", "height_error", "loose"):
        usual = getattr(BASE, field)
        assert sum(getattr(one, field) != usual for one in together) == 1
        assert getattr(ALL_EARLY, field) == getattr(ALL_LATE, field) != usual


def test_equal_inputs_are_recognised():
    printed = BY_NAME["Table I: as printed"]
    assert BASE.same(printed, "X")
    assert BASE.same(printed, "S, fitted")
    assert not BASE.same(printed, "S")
    assert BASE.same(BY_NAME["Table I ± its errors"], "rigid, one")
    assert not BASE.same(FALLING, "rigid, one")
    assert not any(BASE.same(LATE, name) for name in MODELS)


def test_errors_of_table_one_are_those_of_what_was_read():
    """The error of a root is that of the number over twice the root."""
    rooted, printed = known_errors(THEORIES["S"]), known_errors(THEORIES["A"])
    assert printed["e_B1"] == (0.78, 0.02)
    assert rooted["e_B1"] == pytest.approx((0.78**0.5, 0.01 / 0.78**0.5))
    assert known_errors(THEORIES["B"])["e_B3"] == (0.90, 0.02)
    assert set(known_errors(THEORIES["S, six"])) == {"longer_B1", "longer_B2", "longer_B3"}


def test_a_longer_contact_is_a_softer_one():
    objective = objective_of(BY_NAME["Table I ± its errors"], "S")
    usual = {name: mean for name, (mean, _) in known_errors(THEORIES["S"]).items()}
    one, other = (
        objective.drop("B2_on_B1", trial_of(objective, **{**usual, "longer_B1": more})[0])
        for more in (0.0, 1e-4)
    )
    ratio = other.contacts[0].stiffness / one.contacts[0].stiffness
    assert ratio == pytest.approx((4.3 / 4.4) ** 2.5, rel=1e-9)  # T**2 (v T)**0.5
    assert one.contacts[0] == THEORIES["S"].drop("B2_on_B1").contacts[0]


@pytest.mark.parametrize("pair", ["B2_on_B1", "B1_on_B3"])
def test_with_gravity_ratios_are_those_of_the_apexes(pair):
    objective = objective_of(FALLING, "S")
    drop = replace(THEORIES["S"].drop(pair, 4e-3), gravity=STANDARD_GRAVITY)
    apexes = sb.simulate(drop, until=0.5, rtol=1e-8).apexes
    heights = [float(apexes[apexes["ball"] == ball]["height"][0]) for ball in (0, 1)]
    found = objective.predict(pair, np.repeat(trial_of(objective), 3, axis=0))
    assert found.shape == (3, 3)
    np.testing.assert_allclose(found[:, :2], [np.sqrt(np.divide(heights, 0.2))] * 3, rtol=1e-5)


def test_another_drop_height_scales_the_ratios():
    objective = objective_of(BY_NAME["drop height ± 1 cm"], "rigid, one")
    low, high = (
        objective.predict("B2_on_B1", trial_of(objective, height=one))[0] for one in (0.2, 0.22)
    )
    assert high[:2] == pytest.approx(low[:2] * 1.1**0.5, rel=1e-9)  # rigid: no speed matters
    assert high[2] == pytest.approx(low[2] / 1.1**0.5, rel=1e-9)


def test_what_is_known_counts_in_p_and_not_in_bic():
    objective = objective_of(BY_NAME["Table I ± its errors"], "S")
    x = trial_of(objective)[0]
    found = score(Fit(objective, [Minimum(x, 20.0, True)]))
    assert found.degrees_of_freedom == 10
    assert found.bic == pytest.approx(20.0 + 5 * np.log(15))
    assert found.probability == pytest.approx(0.0293, abs=1e-4)


def test_one_of_many_costs_information():
    assert penalty(1) == 0.0
    assert penalty(15) == pytest.approx(-2.0 * np.log(1 / 15))


def fits_with(table):
    """Stands for fits: by choice and model, the probability and BIC."""
    cells = {}
    for choice, column in table.items():
        least = min(bic for _, bic in column.values())
        for name, (p, bic) in column.items():
            cells.setdefault(name, {})[choice] = Cell(Score(1.0, 1, p, bic), bic - least)
    leaders = {choice: min(one, key=lambda name: one[name][1]) for choice, one in table.items()}
    made = SimpleNamespace(drop=lambda *_: THEORIES["S"].drop("B2_on_B1"))
    return SimpleNamespace(cells=cells, leaders=leaders, columns=dict.fromkeys(table, made))


def test_claims_are_checked_with_every_choice():
    usual = dict.fromkeys(MODELS, (1e-09, 300.0))
    table = {
        "one": {**usual, "S": (0.2, 30.0), "B": (0.01, 45.0)},
        "two": {**usual, "S": (1e-4, 60.0), "B": (0.03, 50.0), "rigid, one": (0.1, 52.0)},
        FALLING.name: {**usual, "H": (0.03, 30.0), "P": (1e-4, 33.0), "S": (1e-4, 60.0)},
    }
    fits = fits_with(table)
    found = {one.text: one for one in check_claims(fits)}
    assert found["elastic balls are excluded"].survives
    assert found["separate collisions are excluded"].fails == ["two"]
    assert found["no model gives all values"].fails == ["one", "two"]
    floor = "a loss at the floor only is behind another model by more than"
    assert found[f"{floor} 2 in BIC"].survives
    assert found[f"{floor} 10 in BIC"].fails == [FALLING.name]  # the paper's own law, P
    assert found["S has a smaller BIC than B"].fails == ["two"]
    text = state_headline(fits, list(found.values()))
    assert text.startswith(
        "Which model describes Table II is undecided. With gravity, which is a fact, the smallest "
        "BIC belongs to “H” with 1 of 1 choices. Without gravity the smallest BIC belongs to "
        "“S” with 1, “B” with 1 of 2 choices."
    )
    always, _, falling = text.partition("With gravity also: ")
    assert "elastic balls are excluded" in always
    assert "separate collisions are excluded" in falling
    assert "a hysteresis in every contact has the smallest BIC" in falling
    assert "10 in BIC" not in text


def test_a_headline_without_survivors_says_so():
    table = {"one": {name: (0.5, 10.0 if name == "S" else 12.0) for name in MODELS}}
    text = state_headline(fits_with(table), [Claim("it is so", [], ["one"])])
    assert text == (
        "Model “S” has the smallest BIC with every choice of the analysis. "
        "No claim holds with every choice."
    )


def test_an_exact_prediction_scores_nothing():
    data = {"B2_on_B1": BASE.data()["B2_on_B1"]}
    theory = THEORIES["S"]
    model = theory.model(("B2_on_B1",))
    middle = observe(replace(model, data=data))
    right = middle.predict("B2_on_B1", np.array([[2e-3]]))[0]
    data["B2_on_B1"] = {
        "rebound_ratios": [(right[0], 0.02), (right[1], 0.02)],
        inputs.DELAY: (right[2], 1e-6),
    }
    objective = observe(replace(model, data=data))
    whole = Fit(objective, [Minimum(np.array([2e-3]), 0.0, True)])
    held = predict_held_out(whole, {}, "B2_on_B1")
    assert held.score < 0.01
    assert held.expected == pytest.approx(2.0, abs=0.1)
    assert held.predicted == pytest.approx(right[:2], abs=1e-3)
    data["B2_on_B1"]["rebound_ratios"][0] = (right[0] + 0.06, 0.02)
    wrong = Fit(observe(replace(model, data=data)), whole.minima)
    assert predict_held_out(wrong, {}, "B2_on_B1").score == pytest.approx(9.0, abs=0.3)


@pytest.mark.slow
def test_the_number_of_workers_changes_nothing():
    assert list(spread(fit_row, ["rigid, one"], 2)) == [fit_row("rigid, one")]


@pytest.fixture(scope="module")
def late():
    return {name: fit_model(LATE.model(name), LATE.data()) for name in ("S", "B")}


@pytest.fixture(scope="module")
def base():
    return {name: fit_model(BASE.model(name), BASE.data()) for name in ("S", "B")}


@pytest.mark.slow
def test_s_is_ahead_of_b_at_either_delay(base, late):
    leads = [score(fits["S"]).bic - score(fits["B"]).bic for fits in (base, late)]
    assert leads == pytest.approx([-38.3, -45.8], abs=0.5)


@pytest.mark.slow
def test_gravity_leaves_neither_s_nor_b(base, late):
    found = {
        name: fit_near(FALLING.model(name), FALLING.data(), [base[name], late[name]])
        for name in ("S", "B")
    }
    assert found["S"].chi_squared == pytest.approx(31.3, abs=0.2)
    assert found["S"].probability == pytest.approx(5e-4, rel=0.1)
    assert found["B"].probability < 1e-6


@pytest.mark.slow
def test_without_the_rolling_pair_s_is_doubtful(base):
    found = fit_near(UNEVEN.model("S"), UNEVEN.data(), [base["S"]])
    assert found.probability == pytest.approx(0.042, rel=0.1)


@pytest.mark.slow
def test_the_papers_own_law_is_excluded():
    """Linear hysteresis at the floor only, two restitutions: section V's, for all pairs at once."""
    name = "P, fitted"
    near = [fit_model(one.model(name), one.data()) for one in (BASE, LATE)]
    found = fit_near(UNEVEN.model(name), UNEVEN.data(), near)
    assert max(score(one).probability for one in (*near, found)) < 1e-6


@pytest.mark.slow
def test_linear_hysteresis_gives_all_values_with_gravity_and_the_long_delay():
    name = "H, linear"
    near = [fit_model(one.model(name), one.data()) for one in (BASE, LATE)]
    early, late = (
        fit_near(choice.model(name), choice.data(), near).probability
        for choice in (FALLING, FALLING_LATE)
    )
    assert early < 1e-6
    assert late > 0.05


def test_rigid_models_and_theories_are_all_models():
    assert (*NAMES, *THEORIES) == MODELS


@pytest.mark.parametrize("name", MODELS)
def test_every_model_takes_many_trials(name):
    """Numbers that are fixed and numbers that are varied meet in the ties."""
    objective = objective_of(BASE, name)
    one = np.tile(trial_of(objective), (3, 1))
    found = objective.chi_squared(one)
    assert np.all(np.isfinite(found))
    assert found == pytest.approx([found[0]] * 3, rel=1e-9)
