"""Under strong damping the force passes zero so gently that its end was found too late.

The end was where the sign of the force was clear of its round-off. An end is now the zero itself.
"""

import pytest

import stackbounce as sb
from drops import drop_of
from reference import data

ROWS = data.read("laws")


@pytest.mark.parametrize(
    ("time", "rtol", "error"),
    [
        (0.1, 1e-12, 1e-11),  # it was 1e-9
        (0.1, 1e-14, 1e-12),  # 2e-10
        (1.0, 1e-12, 2e-9),  # 2e-6
        (1.0, 1e-14, 2e-11),  # 2e-7
    ],
)
def test_one_viscoelastic_ball(time, rtol, error):
    law = {"law": "Viscoelastic", "stiffness": 2e5, "dissipative_time": time}
    row = next(row for row in ROWS if row["case"]["contacts"] == [law])
    drop = drop_of(row["case"])
    ends = {sb.simulate(drop, rtol=rtol, compiled=c).intervals["end"][0] for c in (True, False)}
    assert len(ends) == 1
    assert ends.pop() == pytest.approx(row["intervals"][0][2], rel=error)


@pytest.mark.parametrize("rtol", [1e-3, 1e-6, 1e-9])
@pytest.mark.parametrize("time", [0.1, 1.0, 10.0])
def test_no_run_ends_before_its_contact(time, rtol):
    """At a coarse tolerance, too, the run ends with the contact."""
    drop = sb.Drop([sb.Ball(0.1)], [sb.Viscoelastic(2e5, time)], impact_speed=2.0)
    result = sb.simulate(drop, rtol=rtol)
    [row] = result.intervals
    assert 0.0 < row["end"] <= result.end_time
    assert result.sample([row["end"] * (1.0 + 1e-9)]).force.values.max() == 0.0
