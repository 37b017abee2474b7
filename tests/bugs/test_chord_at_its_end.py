"""A contact that opened as its chord's impulse was used up took the power law with c < 0."""

import stackbounce as sb


def test_chord_at_its_end():
    contacts = [
        sb.Hysteretic(2.3867518529685054, unloading_exponent=14.113140652121512),
        sb.Hysteretic(13.752430358911065, exponent=2.0, unloading_exponent=3.1740939800303334),
    ]
    balls = [sb.Ball(0.04101783107005437), sb.Ball(5.559215021304943)]
    drop = sb.Drop(balls, contacts, [1.579252862619208e-07], velocities=[1.0, -1.0])
    result = sb.simulate(drop)
    assert result.status is sb.Status.FINISHED
    assert result.energy_retained < 1.0
