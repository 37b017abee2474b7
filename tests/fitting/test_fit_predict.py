"""What follows of a fitted drop, with the errors of the fit."""

from dataclasses import replace

import pytest

import stackbounce as sb
from drops import STACK
from stackbounce.errors import InvalidValue

PAIR = replace(STACK, gaps=[0.003], height=0.6, impact_speed=None)
DATA = {"rebound_ratios.1": "1.90 ± 0.02", "durations.0": "20.0 ± 0.5 ms"}


@pytest.mark.slow
def test_a_fitted_quantity_has_the_error_of_its_datum():
    drop = sb.Drop([sb.Ball(0.0567)], [sb.Spring(1e4)], height=0.3)
    found = sb.fit(drop, {"durations.0": "5.0 ± 0.1 ms"}, ["contacts.0.stiffness"])
    normal = found.predict()
    assert normal["durations.0"].std_dev == pytest.approx(1e-4, rel=1e-3)
    error = pytest.approx(found["contacts.0.stiffness"].std_dev, rel=1e-6)
    assert normal.errors["contacts.0.stiffness"].std_dev == error
    drawn = found.predict(posterior=found.sample(6400, rng=1))
    assert drawn.how == "errors by 4800 draws: draws were given"
    assert drawn["durations.0"].std_dev == pytest.approx(1e-4, rel=0.1)


def test_correlated_parameters_reproduce_the_errors_of_the_data():
    data = {"rebound_ratios.1": (1.8355, 0.005), "durations.0": (0.030984, 1e-4)}
    found = sb.fit(PAIR, data, {"contacts.0.stiffness": (1e3, 5e3), "gaps.0": (5e-4, 6e-3)})
    again = found.predict()
    for name, (value, error) in data.items():
        assert again[name].nominal_value == pytest.approx(value, abs=0.1 * error)
        assert again[name].std_dev == pytest.approx(error, rel=0.01)


def test_tied_numbers_follow():
    tie = {"contacts.1.stiffness": "0.4 * contacts.0.stiffness"}
    errors = sb.fit(PAIR, DATA, {"contacts.0.stiffness": (1e3, 5e3)}, tie=tie).predict().errors
    lower, upper = errors["contacts.0.stiffness"], errors["contacts.1.stiffness"]
    assert upper.std_dev == pytest.approx(0.4 * lower.std_dev, rel=1e-6)
    assert (upper - 0.4 * lower).std_dev < 1e-6 * upper.std_dev


@pytest.mark.slow
def test_of_several_drops_one_is_named():
    drops = {"low": PAIR, "high": sb.Drop(PAIR.balls, PAIR.contacts, PAIR.gaps, height=1.0)}
    data = {key: {"rebound_ratios.1": "1.90 ± 0.02"} for key in drops}
    found = sb.fit(drops, data, {"contacts.0.stiffness": (1e3, 5e3)})
    assert found.predict("high").drop.height == 1.0
    with pytest.raises(InvalidValue, match="drop must name one of the drops"):
        found.predict()
