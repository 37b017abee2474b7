"""Some 800 random drops of the million that `make fuzz` runs: nothing may be wrong in any."""

import pytest

from fuzz import compare, files
from fuzz.draw import BALLS, RIGID_EVERY
from fuzz.mutate import minimal_cases
from fuzz.tally import OTHER, PLAIN, Tally, tally_of

ALL = len(BALLS) * RIGID_EVERY  # batches after which every height was drawn, of both kinds


@pytest.mark.slow
def test_nothing_is_wrong_and_enough_is_compared():
    total = Tally()
    for index in range(ALL):
        total.add(tally_of(seed=7, index=index, count=10, plain=1, other=1))
    assert total.drops == 10 * ALL
    assert not total.violations
    assert total.compared[PLAIN, compare.SAME] > 50
    assert total.compared[OTHER, compare.SAME] > 30
    assert total.compared[OTHER, compare.SAME] > total.compared[OTHER, compare.DOUBTFUL]


# --- some of the changed files that `make fuzz` measures: results or one line of refusal of each
@pytest.fixture(scope="module")
def sources():
    return minimal_cases()


@pytest.mark.parametrize("count", [12, pytest.param(120, marks=pytest.mark.slow)])
def test_changed_files_end_in_results_or_in_one_line(sources, tmp_path, count):
    cases = [files.measured(sources, 11, index, tmp_path) for index in range(count)]
    assert [(case.index, case.wrong) for case in cases if case.wrong] == []
    assert {case.code for case in cases} == {0, 2}


def stumble(*_):
    raise IndexError("index 3 is out of bounds for axis 0")


def test_an_inner_error_is_found_out(sources, monkeypatch, tmp_path):
    from stackbounce.measure import measurement

    monkeypatch.setattr(measurement, "read", stumble)
    case = files.measured(sources, 1, 1, tmp_path)
    assert "index 3 is out of bounds" in case.wrong
