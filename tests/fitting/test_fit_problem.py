"""`FitProblem`: what a fit needs, checked when it is made; a model until it has data."""

from dataclasses import replace
from unittest.mock import Mock

import numpy as np
import pytest

import stackbounce as sb
from stackbounce.errors import InvalidType
from stackbounce.fitting import FitProblem, objective

STIFFNESS = "contacts.0.stiffness"
DROP = sb.Drop([sb.Ball(0.0567)], [sb.Spring(1e4)], height=0.3)
DATA = {"durations.0": "5.0 ± 0.1 ms"}


def test_a_problem_is_fitted_as_its_parts_are():
    problem = FitProblem(DROP, DATA, [STIFFNESS])
    same = sb.fit(DROP, DATA, [STIFFNESS])
    assert problem.fit().as_dict() == same.as_dict()
    same = sb.fit(DROP, DATA, [STIFFNESS], starts=16, rng=3)
    assert problem.fit(starts=16, rng=3).best == same.best
    assert problem.fit(rtol=1e-6).objective.rtol == 1e-6


def test_runs_without_an_end_are_counted_for_each_fit():
    """A second fit of the same problem begins to count anew."""
    problem = FitProblem(DROP, DATA, [STIFFNESS])
    problem.objective.unsolved["EVENT_LIMIT"] += 7
    assert problem.fit(starts=4).unsolved == {}


def test_a_model_is_a_problem_without_data():
    model = sb.Model(DROP, [STIFFNESS])
    assert isinstance(model, FitProblem)
    assert (model.drop, model.data, model.vary, model.tie) == (DROP, {}, [STIFFNESS], None)
    with pytest.raises(InvalidType, match="data must map names to what was measured"):
        model.fit()
    assert replace(model, data=DATA).fit().best == sb.fit(DROP, DATA, [STIFFNESS]).best
    compared = sb.compare({"spring": model}, DATA)
    assert compared["spring"].best == sb.fit(DROP, DATA, [STIFFNESS]).best


def test_several_drops_stay_several():
    drops = {"low": DROP, "high": replace(DROP, height=1.0)}
    problem = FitProblem(drops, dict.fromkeys(drops, DATA), [STIFFNESS])
    assert problem.drop == problem.drops == drops
    assert [one.drop for one in problem.fit(starts=4).residuals] == ["low", "high"]


def test_drops_with_the_same_contacts_are_solved_together(monkeypatch):
    stack = sb.Drop([sb.Ball(0.6), sb.Ball(0.06)], [sb.Hertz(1e5)] * 2, height=1.0, gaps=[1e-3])
    heavy, springs = [sb.Ball(0.7, 0.2), sb.Ball(0.06)], [sb.Spring(1e4)] * 2
    changes = {"gaps": [0.0]}, {"contacts": springs}, {"height": 0.3}, {"balls": heavy}
    drops = {f"d{k}": stack.replace(**change) for k, change in enumerate(changes)}
    vary, trials = {"contacts.1.stiffness": (1e4, 1e6)}, np.linspace(9.5, 13.5, 7)[:, None]
    data = {"rebound_ratios": [(0.4, 0.1), (2.0, 0.1)], "first_touch.1": (1e-3, 1e-4)}
    together = FitProblem(drops, dict.fromkeys(drops, data), vary).objective
    each = (FitProblem(drop, data, vary).objective for drop in drops.values())
    alone = np.array([single.predict([""], trials)[""] for single in each])
    solve = Mock(wraps=objective.solve_quantities)
    monkeypatch.setattr(objective, "solve_quantities", solve)
    found = together.predict(drops, trials)
    assert [call.args[2] for call in solve.call_args_list] == [21, 7]
    assert np.array(list(found.values())) == pytest.approx(alone, rel=1e-8)


def test_bounds_around_a_number_stay_in_the_range_of_its_law():
    law = sb.Hysteretic(1e4, exponent=1.5, unloading_exponent=3.0)  # which is at least the exponent
    drop = sb.Drop([sb.Ball(0.1)], [law], impact_speed=1.0)
    (own,) = FitProblem(drop, DATA, ["contacts.0.unloading_exponent"]).objective.parameters
    assert (own.low, own.high) == (pytest.approx(1.5), 300.0)
