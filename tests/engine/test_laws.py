"""Every finite law, pure and mixed, against the thirty-digit reference of `reference.precise`."""

import numpy as np
import pytest

import stackbounce as sb
from drops import compared, drop_of
from reference import data

ROWS = data.read("laws")
TOLERANCES = (1e-4, 1e-6, 1e-9, 1e-12, 1e-13)
ROUND_OFF = 1e-12  # of a time, below which the end of a creeping contact is not known
CREEPING = 1e-3  # of the speed before: of a slower contact the end is less exact


@pytest.mark.parametrize("rtol", TOLERANCES)
@pytest.mark.parametrize("index", range(len(ROWS)))
def test_error_is_below_ten_times_the_tolerance_asked_for(index, rtol):
    row = ROWS[index]
    drop = drop_of(row["case"])
    result = sb.simulate(drop, until=row["case"].get("until"), rtol=rtol, compiled=True)
    found, expected = compared(row, result, 10 * rtol)
    for column in (3, 4, 5):  # peaks and impulses, by the largest of them
        size = np.max(expected[:, column], initial=0.0)
        assert found[:, column] == pytest.approx(expected[:, column], abs=100 * rtol * size)
    # a time's error is that of a length over the speed there, which can be small
    time = max(rtol, ROUND_OFF) * row["end_time"]
    assert found[:, 1] == pytest.approx(expected[:, 1], abs=1e3 * time)
    if len(drop.balls) == 1 and abs(row["rebound_speeds"][0]) < CREEPING * drop.reference_speed:
        return
    assert found[:, 2] == pytest.approx(expected[:, 2], abs=1e3 * time, nan_ok=True)
