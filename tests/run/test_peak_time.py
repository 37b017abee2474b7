"""The time of the peak force in `Result.intervals`."""

import numpy as np
import pytest

import stackbounce as sb

LAWS = {
    "Spring": sb.Spring(2500.0),
    "Hertz": sb.Hertz(1e6),
    "Dashpot": sb.Dashpot(2500.0, 5.0),
    "Viscoelastic": sb.Viscoelastic(1e6, 1e-4),
    "HuntCrossley": sb.HuntCrossley(1e6, 1.5, 0.2),
    "Hysteretic": sb.Hysteretic(4e4, restitution=0.8),
}


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("masses", [(0.06,), (0.06, 0.1, 0.03), (0.1, 1.0)], ids=len)
def test_no_force_is_larger_and_that_one_is_there(law, masses):
    result = sb.simulate(
        sb.Drop([sb.Ball(m) for m in masses], [LAWS[law]] * len(masses), height=0.5)
    )
    for row in result.intervals:
        times = np.linspace(row["start"], row["end"], 2001)
        force = result.sample(np.append(times, row["peak_time"])).force.values[row["contact"]]
        assert force[-1] == pytest.approx(row["peak_force"], rel=1e-13)
        assert force[:-1].max() <= row["peak_force"] * (1.0 + 1e-13)


def test_a_dashpot_alone_has_its_peak_at_the_touch():
    result = sb.simulate(sb.Drop([sb.Ball(1.0)], [sb.Dashpot(1.0, 1.9)], impact_speed=1.0))
    assert result.intervals["peak_time"] == pytest.approx([0.0], abs=1e-12)


def test_rigid_balls_have_it_at_the_collision():
    result = sb.simulate(sb.Drop([sb.Ball(1.0)] * 2, [sb.Rigid(0.5)] * 2, [0.1], impact_speed=1.0))
    assert (result.intervals["peak_time"] == result.intervals["start"]).all()
