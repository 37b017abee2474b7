"""In a touching row, later contacts began when an earlier one opened, not at the start."""

import pytest

import stackbounce as sb


@pytest.mark.parametrize("law", [sb.Hertz(1.0), sb.Spring(1.0)])
def test_start_in_a_touching_row(law):
    drop = sb.Drop([sb.Ball(1.0)] * 20, [None] + [law] * 19, velocities=[1.0] + [0.0] * 19)
    assert (sb.simulate(drop).intervals["start"] == 0.0).all()
