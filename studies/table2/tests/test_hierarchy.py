"""The posterior probabilities of the study: evidence, tables, scatter, priors and sentences."""

from dataclasses import replace

import numpy as np
import pytest
from scipy import stats
from studies.table2 import hierarchy, inputs
from studies.table2.bounce_likelihood import (
    CHOICES,
    EXTRA,
    MODELS,
    SCATTER,
    Draws,
    Priors,
    Size,
    draw_numbers,
    find_spans,
    likelihoods,
    score_pair,
    tabulate,
    weigh_draws,
)
from studies.table2.evidence import average_sets, draw_normal
from studies.table2.hierarchy import Hierarchy, Likelihoods, describe_undecided
from studies.table2.ratio_tables import (
    SEPARATE,
    fall_gaps,
    make_drops,
    make_table,
    run_pair,
    run_rows,
)
from studies.table2.readings import READINGS
from studies.table2.scatter import Moments, scatter_bounces

from stackbounce.run.driver import simulate

HEIGHTS = "ratios of heights"
SMALL = Size(step=0.4e-3, lower=2, upper=2, between=2, stiffness=2, separate=3, sets=2, each=32)


def middle():
    """One trial in the middle of the priors."""
    found = {name: np.array([0.5 * sum(span)]) for name, span in find_spans(HEIGHTS).items()}
    return {**found, "e_between": np.array([0.9])}


@pytest.mark.parametrize("each", [256, 2048])
def test_evidence_of_a_linear_model_is_its_closed_form(each):
    """Data A z + noise with standard normal z have the covariance A A' + noise."""
    random = np.random.default_rng(4)
    slopes, noise = random.normal(size=(10, 7)), 3.0
    data = 3.0 * random.normal(size=10)
    z = draw_normal(7, 8, each, seed=5)
    logs = stats.norm(0.0, noise).logpdf(data - z @ slopes.T).sum(axis=-1)
    found = average_sets(logs)
    cover = slopes @ slopes.T + noise**2 * np.eye(10)
    exact = stats.multivariate_normal(np.zeros(10), cover).logpdf(data)
    assert abs(found.log - exact) < 4.0 * found.error + 1e-3
    assert found.error < 0.1 * np.sqrt(256 / each)


def test_draws_are_the_priors():
    draws = draw_numbers(draw_normal(7, 4, 1024, 1), HEIGHTS)
    e = draws.values["e_B1"]
    assert e.mean() == pytest.approx(np.sqrt(0.78), abs=2e-3)
    assert e.std() == pytest.approx(0.02 / (2.0 * np.sqrt(0.78)), rel=0.03)
    assert draw_numbers(draw_normal(7, 4, 1024, 1), "as printed").values["e_B2"].std() == (
        pytest.approx(0.02, rel=0.03)
    )
    between = draws.values["e_between"]
    assert (between.min() > 0.7, between.max() < 1.0) == (True, True)
    assert np.quantile(between, [0.25, 0.75]) == pytest.approx([0.775, 0.925], abs=2e-3)
    assert np.log(draws.extra).mean() == pytest.approx(np.log(EXTRA).mean(), abs=0.02)
    assert draws.speed.std() == pytest.approx(0.025, rel=0.03)


@pytest.mark.parametrize("priors", list(hierarchy.PRIORS.values()))
def test_weights_of_priors_have_the_mean_one(priors):
    draws = draw_numbers(draw_normal(7, 8, 2048, 1), HEIGHTS)
    assert np.exp(weigh_draws(draws, priors)).mean() == pytest.approx(1.0, abs=0.01)
    assert sum(priors.scatter) == pytest.approx(1.0)


def test_weights_give_the_mean_of_a_half_normal():
    draws = draw_numbers(draw_normal(7, 8, 2048, 1), HEIGHTS)
    weights = np.exp(weigh_draws(draws, Priors(extra=0.02)))
    expected = stats.truncnorm(EXTRA[0] / 0.02, EXTRA[1] / 0.02, scale=0.02).mean()
    assert np.average(draws.extra, weights=weights) == pytest.approx(expected, rel=0.01)


def test_likelihood_of_a_pair_is_that_of_a_normal_distribution():
    parts = np.array([0.3, 1.8, 0.01, 0.02, -0.008])
    moments = Moments(np.array([2e-3]), parts[None, :, None])
    draws = Draws({}, np.array([0.02]), np.array([0.03]))
    found = score_pair(np.ones((1, 1)), moments, (0.28, 1.91), draws, np.ones((2, 1)))
    cover = 1.02**2 / 3.5 * np.array([[0.01, -0.008], [-0.008, 0.02]])
    cover = cover + (0.02**2 + 0.03**2) * np.eye(2)
    exact = stats.multivariate_normal(1.02 * parts[:2], cover).logpdf([0.28, 1.91])
    assert found == pytest.approx(np.full((2, 1), exact), rel=1e-12)


def test_gaps_give_the_delays():
    delays = np.array([0.5e-3, 2e-3, 5e-3])
    for name in ("S", "H, linear"):
        values = middle()
        gaps = fall_gaps(name, "B1_on_B2", values, delays)[0]
        for gap, delay in zip(gaps, delays, strict=True):
            (drop,) = make_drops(name, "B1_on_B2", values, np.array([gap]))
            found = simulate(replace(drop, gravity=0.0), rtol=1e-9).first_touch[1]
            assert found == pytest.approx(delay, abs=2e-7)


def test_a_table_gives_its_own_drops_and_those_between():
    spans = find_spans(HEIGHTS)
    delays = np.array([1e-3, 2e-3, 3e-3])
    table = make_table("S", "B2_on_B1", delays, spans, dict.fromkeys(spans, 3))
    nodes = {axis: nodes[[0, 2, 1]] for axis, nodes in zip(table.axes, table.nodes, strict=True)}
    flat = table.ratios.reshape(-1, 3, 2)
    found = np.tensordot(table.weights(nodes), flat, 1)
    assert found == pytest.approx(table.ratios[[0, 2, 1], [0, 2, 1], [0, 2, 1]], abs=1e-12)
    between = {**middle(), "log_stiffer": np.array([0.2])}
    exact = run_pair("S", "B2_on_B1", between, delays)
    assert np.tensordot(table.weights(between), flat, 1) == pytest.approx(exact, abs=1e-3)


def test_separate_collisions_depend_on_no_delay():
    table = tabulate(SEPARATE, "B2_on_B1", find_spans(HEIGHTS), SMALL)
    assert table.ratios.shape == (3, 3, 1, 2)
    found = run_pair(SEPARATE, "B2_on_B1", middle(), np.array([1e-3, 4e-3]))[0]
    e, between = float(middle()["e_B1"][0]), 0.9
    lower, upper = (ball.mass for ball in inputs.make_balls("B2_on_B1"))
    centre = (lower * e - upper) / (lower + upper)
    closing = between * (1.0 + e)
    expected = (
        centre - upper / (lower + upper) * closing,
        centre + lower / (lower + upper) * closing,
    )
    assert found == pytest.approx(np.tile(expected, (2, 1)), rel=1e-9)


def test_scatter_of_restitutions_follows_the_slopes():
    spans = {"e_B1": (0.8, 0.9), "log_stiffer": (-0.1, 0.1)}
    table = make_table("S", "B1_on_B1", np.array([2e-3, 2.1e-3]), spans, dict.fromkeys(spans, 4))
    found = scatter_bounces(table, np.array([2e-3]), 1e-9, 0.01).parts
    here = {"e_B1": np.array([0.84, 0.86]), "log_stiffer": np.zeros(2)}
    low, high = run_pair("S", "B1_on_B1", here, table.delays[:1])[:, 0]
    centre = {"e_B1": np.array([0.85]), "log_stiffer": np.zeros(1)}
    variances = np.tensordot(table.weights(centre), found, 1)[0, 2:4, 0]
    assert np.sqrt(variances) == pytest.approx(np.abs(high - low) / 2.0, rel=0.05)


@pytest.mark.slow
@pytest.mark.parametrize("pair", ["B2_on_B1", "B1_on_B2", "B1_on_B3"])
def test_ratios_with_gravity_are_those_of_the_first_apexes(pair):
    """The shift is exact at some delays and interpolated between them."""
    delays = 0.08e-3 * np.arange(1, 103)
    values = {**middle(), "e_B1": np.array([0.89]), "log_stiffer": np.array([-0.05])}
    usual = {key: float(array[0]) for key, array in middle().items()}
    found = run_pair("H", pair, values, delays, gravity=usual)[0, 12::5]
    gaps = fall_gaps("H", pair, values, delays[12::5])[0]
    off = []
    for drop, ratios in zip(make_drops("H", pair, values, gaps), found, strict=True):
        apexes = simulate(drop, until=0.5, rtol=1e-8).apexes
        first = [apexes[apexes["ball"] == ball]["height"][0] for ball in (0, 1)]
        off.append(ratios - np.sqrt(np.array(first) / inputs.HEIGHT))
    assert np.sqrt(np.mean(np.square(off))) < 0.005
    assert np.max(np.abs(off)) < 0.025


def test_late_second_bounces_count_as_missing():
    """Two balls B1 that touch at their next bounce are no outcome of this one."""
    delays = np.array([3.2e-3, 3.6e-3, 4.0e-3])
    values = {"e_B1": np.array([0.885]), "log_stiffer": np.array([-0.05])}
    gaps = fall_gaps("H", "B1_on_B1", values, delays)
    ratios = run_rows("H", "B1_on_B1", values, gaps, gravity=True)[0]
    assert np.all(ratios > 0.7)


@pytest.fixture(scope="module")
def made_up():
    """Likelihoods without drops: S is e times as likely as L at 7 ms, and equal at 2 ms."""
    normal = draw_normal(7, 2, 64, 1)
    shape = (*map(len, CHOICES.values()), len(SCATTER), 2, 64)
    logs = {"S": np.zeros(shape), "H": np.zeros(shape)}
    logs["S"][:, 1] += 1.0
    logs["H"][0] -= 50.0
    draws = {reading: draw_numbers(normal, reading) for reading in READINGS}
    return Hierarchy(Likelihoods(logs, draws), {})


def test_probabilities_are_shares_of_the_likelihoods(made_up):
    likely, third = np.e, 1.0 / 3.0
    s, t = (1.0 + likely) / 2.0, 2.0 * third
    assert made_up.probabilities["S"] == pytest.approx(s / (s + t), rel=1e-9)
    assert made_up.evidence["H"].log == pytest.approx(
        made_up.evidence["S"].log + np.log(t / s), rel=1e-6
    )
    early = made_up.by_choice["delay of B1 on B3"]["2 ms"]
    assert early["S"] == pytest.approx(1.0 / (1.0 + t), rel=1e-9)
    assert made_up.by_choice["Table I's COR"]["as printed"]["S"] == pytest.approx(1.0)
    late = made_up.choices["delay of B1 on B3"]["7 ms"]
    assert late == pytest.approx((likely + t) / (likely + 1.0 + 2.0 * t), rel=1e-9)
    assert sum(one.probability for one in made_up.cases) == pytest.approx(1.0)
    assert made_up.cases[0].choices["delay of B1 on B3"] == "7 ms"
    assert sum(made_up.numbers["S"][key][1] > 0.0 for key in ("e_B1", "extra", "scatter")) == 3
    for shares in (*made_up.by_prior.values(), *made_up.by_choice["row of two balls B1"].values()):
        assert sum(shares.values()) == pytest.approx(1.0)


def test_a_sentence_says_what_is_undecided():
    said = describe_undecided({"S": 0.97, "H": 0.03}, [{"S": 0.97, "H": 0.03}])
    assert said.startswith("S is decided: over all choices it has the probability 0.970.")
    said = describe_undecided({"S": 0.6, "H": 0.4}, [{"S": 0.6, "H": 0.4}])
    assert "undecided" in said
    assert said.endswith("In none of 1 combinations of choices does a model exceed 0.95.")


@pytest.mark.parametrize("name", [SEPARATE, "B"])
def test_likelihoods_are_the_same_each_time(name):
    told = []
    first = likelihoods(name, SMALL, 3, told.append)
    assert first.shape == (3, 2, 2, 5, 2, 32)
    assert np.all(np.isfinite(first))
    assert np.array_equal(first, likelihoods(name, SMALL, 3))
    assert len(told) == len(READINGS)
    out, late = first[:, :, 1], first[:, 1]
    assert not np.array_equal(out, first[:, :, 0])
    same = np.array_equal(late, first[:, 0])  # only finite contacts know a delay
    assert same == (name == SEPARATE)


@pytest.fixture(scope="module")
def whole():
    return hierarchy.weigh_models()


@pytest.mark.slow
def test_what_the_data_say(whole):
    assert list(whole.probabilities) == list(MODELS)
    assert whole.probabilities["H"] == pytest.approx(0.73, abs=0.04)
    assert whole.probabilities["H, linear"] == pytest.approx(0.103, abs=0.03)
    assert max(whole.errors.values()) < 0.02
    assert whole.choices["Table I's COR"]["as printed"] < 1e-3
    assert whole.choices["delay of B1 on B3"]["7 ms"] > 0.8
    assert whole.groups["where energy is lost"]["floor only"] < 0.01
    assert "undecided" in whole.undecided
    assert max(one.rms for one in whole.tables.values()) < 0.006


@pytest.mark.slow
def test_half_of_the_draws_give_the_same_probabilities(whole):
    halved = Likelihoods(
        {name: logs[..., 4:, :] for name, logs in whole.found.logs.items()},
        {
            reading: Draws(
                {key: array[2048:] for key, array in one.values.items()},
                one.speed[2048:],
                one.extra[2048:],
            )
            for reading, one in whole.found.draws.items()
        },
    )
    found = Hierarchy(halved, {})
    for name, value in whole.probabilities.items():  # half and whole differ by the whole's error
        error = whole.errors[name]
        assert found.probabilities[name] == pytest.approx(value, abs=4.0 * error + 1e-6)


@pytest.mark.slow
def test_finer_tables_give_the_same_evidence():
    size = Size(each=128)
    fine = size._replace(step=0.06e-3, lower=6, upper=5, stiffness=6)
    coarse, fine = (np.logaddexp.reduce(likelihoods("H", one, 7).ravel()) for one in (size, fine))
    assert coarse == pytest.approx(fine, abs=0.15)
