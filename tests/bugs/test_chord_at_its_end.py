"""A chord that had just used up its impulse where its contact opened was exchanged for c < 0."""

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
