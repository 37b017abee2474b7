"""Draws that cost much: fewer are run, or none, and it is said why."""

import numpy as np
import pytest

import stackbounce as sb
from stackbounce.errors import InvalidValue
from stackbounce.prediction import draws, result

BALLS = [sb.Ball(0.6), sb.Ball(0.06)]
LOSSY = sb.HollowBall(3e4, 0.01, 0.5, 0.95)  # its work is counted
DROP = sb.Drop(BALLS, [LOSSY, sb.Hertz(1e7)], [1e-3], height=0.63)
ERRORS = {"gaps.0": (1e-3, 0.5e-3), "balls.1.mass": (0.06, 0.001)}  # not all are possible


@pytest.fixture
def limited(monkeypatch):
    """Return a function that limits the work of all draws together."""

    def limit(work):
        for module in (draws, result):
            monkeypatch.setattr(module, "budget", lambda *_: work)

    return limit


def test_fewer_draws_are_run_where_they_cost_much(limited):
    whole = sb.predict(DROP, ERRORS, draws=1000)
    assert len(whole.drawn) == whole.asked == 1000
    limited(int(np.sum(whole.solved.work[:300])))
    told = []
    found = sb.predict(DROP, ERRORS, draws=1000, progress=lambda *done: told.append(done))
    few = len(found.drawn)
    assert 250 < few < 350
    assert found.drawn.tolist() == whole.drawn[:few].tolist()
    assert found.draws.identical(whole.draws.isel(draw=slice(few)))
    assert f"{few} of 1000 draws were run, for they take long; a larger" in found.notes[0]
    assert told[0] == (4, 1000)
    assert told[-1] == (few, 1000)
    assert found.apexes == []
    assert len(found._results) == few // 3


def test_too_few_draws_are_refused(limited):
    limited(int(np.sum(sb.predict(DROP, ERRORS, draws=100).solved.work)) // 2)
    with pytest.raises(InvalidValue, match=r"100 draws are needed, and only [45]\d could be run; "):
        sb.predict(DROP, ERRORS)


@pytest.mark.slow
@pytest.mark.usefixtures("little_work")
def test_a_mistyped_unit_costs_no_more_than_all_draws_may():
    """Five minutes and more were spent on draws of a million tons; these are of ten thousand."""
    springs = sb.Drop(BALLS, [sb.Spring(2500.0), sb.Spring(1000.0)], height=0.63)
    found = sb.predict(springs, {"balls.0.mass": "0.6 ± 10000000 kg"})
    assert np.sum(found.solved.work) < 1.1 * draws.budget(found.options, found.asked)
    assert 100 < len(found.drawn) < 1000
    assert any("for they take long" in note for note in found.notes)


@pytest.mark.slow
@pytest.mark.usefixtures("little_work")
def test_draws_that_all_meet_the_limit_are_refused_after_a_few():
    light = sb.Drop(map(sb.Ball, (1e-12, 1.0)), [sb.HuntCrossley(1e4, 1.5, 0.2)] * 2, height=0.63)
    with pytest.raises(InvalidValue, match=r"only 4 could be run \(4 met a limit, the first with"):
        sb.predict(light, {"balls.1.mass": (1.0, 0.1)})
