"""Plain Python and compiled: one source, the same bits."""

import numpy as np
import pytest

import stackbounce as sb
from drops import drop_of, rigid, springs
from reference import make_data

ROWS = [*make_data.read("springs")[::12], *make_data.read("hysteretic")[::5]]


def assert_same_bits(drop, **options):
    plain = sb.simulate(drop, compiled=False, **options)
    compiled = sb.simulate(drop, compiled=True, **options)
    assert plain.status is compiled.status
    for name in ("intervals", "events", "rebound_speeds", "collisions"):
        assert getattr(plain, name).tolist() == getattr(compiled, name).tolist()
    assert plain.end_time == compiled.end_time
    return plain, compiled


@pytest.mark.parametrize("row", ROWS, ids=range(len(ROWS)))
def test_finite_contacts(row):
    plain, compiled = assert_same_bits(drop_of(row["case"]))
    times = np.linspace(0.0, 1.1 * plain.end_time, 57)
    one, other = plain.sample(times), compiled.sample(times)
    for name in one.data_vars:
        assert one[name].values.tolist() == other[name].values.tolist()


@pytest.mark.parametrize(
    "drop",
    [
        rigid([1.0]),
        rigid([1.0, 3.0]),
        rigid([1.0, 1e4]),
        rigid([1.0, 7.9], 0.5),
        rigid([1.0, 7.999], 0.5, gaps=[0.2]),
        rigid([1.0, 9.0], 0.5, gaps=[0.2]),
        rigid([6.0, 2.0, 1.0]),
        rigid([1.0, 0.7, 2.0, 0.3], 0.8, gaps=[0.1, 0.0, 0.3]),
        rigid([1.0, 1.0, 1.0], 0.1),
        rigid([1.0] * 5, [None] + [1.0] * 4, velocities=[1.0, 1.0, 0.0, 0.0, 0.0]),
    ],
    ids=range(10),
)
def test_rigid(drop):
    assert_same_bits(drop)


def test_stopped_runs():
    assert_same_bits(springs([1.0, 5.0], [1.0, 1.0], [0.3]), until=2.0)
    assert_same_bits(springs([1.0, 5.0], [1.0, 1.0], [0.3]), event_limit=3)
    assert_same_bits(rigid([1.0, 1e4]), event_limit=100)


def test_the_choice_of_mode_changes_nothing():
    for drop in (springs([1.0, 2.0], [1.0, 3.0]), springs([1.0] * 6, [1.0] * 6)):
        chosen = sb.simulate(drop)
        plain, _ = assert_same_bits(drop)
        assert chosen.intervals.tolist() == plain.intervals.tolist()
