"""`integrate` agrees with the data files, and says so where it cannot be trusted."""

import numpy as np
import pytest

from reference import make_data
from reference.integrate import integrate

pytestmark = pytest.mark.slow  # numba compiles the integrator first, for a minute


def solved(name):
    """Yield the rows of a data file, and what `integrate` makes of each."""
    for row in make_data.read(name):
        yield row, integrate(**make_data.with_names(row["case"]))


@pytest.mark.parametrize("name", ["laws", "hysteretic", "springs"])
def test_data_files(name):
    for row, found in solved(name):
        speed = max(map(abs, row["case"]["velocities"]))
        error = np.max(np.abs(found.velocities - row["rebound_speeds"])) / speed
        assert error < 1e-9, row["case"]
        assert not found.doubtful, row["case"]
        theirs = sorted(i[:2] for i in row["intervals"])
        assert len(found.intervals) == len(theirs)
        ours = sorted(found.intervals[:, :2].tolist())
        assert np.array(ours) == pytest.approx(np.array(theirs), abs=1e-9 * row["end_time"])
        for i, count in enumerate(found.counts):
            assert count == sum(contact == i for contact, _ in theirs)


def test_too_long_a_story():
    spring = {"law": "Spring", "stiffness": 1.0}
    found = integrate([1.0, 1e6], [spring, spring], [1.0], [-1.0, -1.0], limit=1000)
    assert (found.status, found.steps) == ("too long", 1000)


def test_a_tie_at_the_end_is_doubtful():
    """Masses 1 and 3 leave with equal velocities, so that round-off decides what follows."""
    spring = {"law": "Spring", "stiffness": 1.0}
    found = integrate([1.0, 3.0], [spring, spring], [10.0], [-1.0, -1.0])
    assert found.doubtful or found.counts == [3, 2]


def test_gravity_until_a_time():
    spring = {"law": "Spring", "stiffness": 1e4}
    found = integrate([1.0], [spring], [], [-1.0], gravity=10.0, until=0.71)
    assert found.status == "time reached"
    assert found.counts == [4]
    heights = found.intervals[:3, 4]  # the fourth bounce is not over
    assert heights == pytest.approx(heights[0], rel=1e-12)
