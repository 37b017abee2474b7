"""A few thousand random drops of the million that `make fuzz` runs: nothing may be wrong in any."""

import pytest

import stackbounce as sb
from fuzz import compare
from fuzz.check import FAULTS
from fuzz.draw import BALLS, RIGID_EVERY, drops_of
from fuzz.replay import drop_of, expression
from fuzz.tally import OTHER, PLAIN, Tally, tally_of

ALL = len(BALLS) * RIGID_EVERY  # batches after which every height was drawn, of both kinds


@pytest.fixture(scope="module")
def total():
    tally = Tally()
    for index in range(ALL):
        tally.add(tally_of(seed=7, index=index, count=50, plain=1, other=1))
    return tally


@pytest.mark.slow
def test_nothing_is_wrong(total):
    assert total.drops == 50 * ALL
    assert not total.violations


@pytest.mark.slow
def test_enough_was_compared(total):
    assert total.compared[PLAIN, compare.SAME] > 50
    assert total.compared[OTHER, compare.SAME] > 30
    assert total.compared[OTHER, compare.SAME] > total.compared[OTHER, compare.DOUBTFUL]


def test_the_report_counts_every_drop_and_every_check():
    tally = Tally()
    for index in (5, 6):
        tally.add(tally_of(seed=3, index=index, count=20))
    report = tally.report()
    assert "40 drops" in report
    assert all(name in report for name in FAULTS)
    assert sum(tally.statuses.values()) == 40
    assert not tally.violations


@pytest.mark.parametrize("index", [0, 2])
def test_a_printed_drop_is_the_same(index):
    drops = drops_of(seed=3, batch=index, count=20)
    for row in range(20):
        again = eval(expression(drops, row), {"sb": sb})
        assert again.drop == drop_of(drops, row)
