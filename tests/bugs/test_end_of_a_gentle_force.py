"""Under strong damping the force passes zero so gently that its end was found too late.

The end was where the sign of the force was clear of its round-off. An end is now the zero itself.
"""

import pytest
from benchmarks.impacts import score

import stackbounce as sb
from drops import drop_of_laws
from reference import data

ROWS = data.read("laws")
PROBLEMS = score.read(score.FOLDER / "problems.json", "problems")["problems"]
ANSWERS = score.read(score.FOLDER / "answers.json", "answers")["answers"]


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
    drop = drop_of_laws(row["case"])
    ends = {sb.simulate(drop, rtol=rtol, compiled=c).intervals["end"][0] for c in (True, False)}
    assert len(ends) == 1
    assert ends.pop() == pytest.approx(row["intervals"][0][2], rel=error)


@pytest.mark.parametrize("name", ["viscoelastic-strong", "viscous-resumed"])
def test_ends_of_the_benchmark(name):
    problem = next(one for one in PROBLEMS if one["name"] == name)
    expected = next(one for one in ANSWERS if one["name"] == name)["last_release"]
    rows = sb.simulate(drop_of_laws(problem), rtol=1e-14).intervals
    for contact, end in enumerate(expected):
        found = rows["end"][rows["contact"] == contact].max()
        assert found == pytest.approx(float(end), rel=1e-12)


@pytest.mark.parametrize("rtol", [1e-3, 1e-6, 1e-9])
@pytest.mark.parametrize("time", [0.1, 1.0, 10.0])
def test_no_run_ends_before_its_contact(time, rtol):
    """At a coarse tolerance, too, the run ends with the contact."""
    drop = sb.Drop([sb.Ball(0.1)], [sb.Viscoelastic(2e5, time)], impact_speed=2.0)
    result = sb.simulate(drop, rtol=rtol)
    [row] = result.intervals
    assert 0.0 < row["end"] <= result.end_time
    assert result.sample([row["end"] * (1.0 + 1e-9)]).force.values.max() == 0.0
