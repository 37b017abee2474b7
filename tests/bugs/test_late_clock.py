"""Late in a run, the round-off of time exceeded that of the solution, and events alternated."""

import stackbounce as sb


def test_second_impact_after_a_long_flight():
    drop = sb.Drop(
        balls=[sb.Ball(0.1), sb.Ball(0.002)],
        contacts=[sb.Spring(1e4), sb.Spring(1e4)],
        height=1.0,
        gravity=9.81,
    )
    result = sb.simulate(drop, until=3.0)
    assert result.status is sb.Status.TIME_REACHED
    assert result.collisions.tolist() == [4, 2]
    energy = result.sample([0.0, 1.5, 3.0]).energy.values
    assert abs(energy / energy[0] - 1.0).max() < 1e-12
