"""A few thousand random drops of the million that `make fuzz` runs: nothing may be wrong in any."""

import os
import time

import pytest

import stackbounce as sb
from fuzz import compare, files
from fuzz.check import FAULTS
from fuzz.draw import BALLS, RIGID_EVERY, drops_of
from fuzz.mutate import minimal_cases
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


# --- some of the changed files that `make fuzz` measures: results or one line of refusal of each
@pytest.fixture(scope="module")
def sources():
    return minimal_cases()


@pytest.mark.parametrize("count", [12, pytest.param(300, marks=pytest.mark.slow)])
def test_changed_files_end_in_results_or_in_one_line(sources, tmp_path, count):
    cases = [files.measured(sources, 11, index, tmp_path) for index in range(count)]
    assert [(case.index, case.wrong) for case in cases if case.wrong] == []
    assert {case.code for case in cases} == {0, 2}


def test_the_same_number_makes_the_same_file(sources):
    assert files.made(sources, 1, 5) == files.made(sources, 1, 5)
    assert files.made(sources, 1, 5) != files.made(sources, 1, 6)


def hang(*_):
    while True:
        time.process_time()


def crash(*_):
    os._exit(9)


def swell(*_):
    bytearray(b"1" * 2**28)
    return 0


def stumble(*_):
    raise IndexError("index 3 is out of bounds for axis 0")


@pytest.mark.parametrize(
    ("main", "wrong"),
    [
        (hang, "longer than 0.2 s"),
        (crash, "its process hung or died"),
        (swell, "more than 250 MiB of memory"),
    ],
)
def test_what_is_wrong_is_found_out(sources, monkeypatch, main, wrong):
    monkeypatch.setattr(files, "main", main)
    monkeypatch.setattr(files, "SECONDS", 0.2 if main is hang else 10.0)
    monkeypatch.setattr(files, "MEBIBYTES", 250.0 if main is swell else 4096.0)
    (case,) = files.run(sources, 1, 1)
    assert case.wrong.startswith(wrong)
    assert wrong in files.report([case], sources, 1)


def test_an_inner_error_is_found_out(sources, monkeypatch, tmp_path):
    from stackbounce.measure import measurement

    monkeypatch.setattr(measurement, "read", stumble)
    case = files.measured(sources, 1, 1, tmp_path)
    assert "index 3 is out of bounds" in case.wrong
