"""A record whose times are not exact in binary lost samples when its times were shifted."""

import numpy as np

import stackbounce as sb
from stackbounce.fitting.question import read_problem


def test_every_sample_of_a_record_has_a_force():
    drop = sb.Drop([sb.Ball(0.057)], [sb.Spring(2.2e4)], height=1.0)
    times = np.arange(0.0, 0.01068, 2e-5)
    force = 150.0 * np.sin(np.clip((times - 0.0027) * 620.0, 0.0, np.pi))
    noisy = force + np.random.default_rng(1).normal(0.0, 0.5, len(times))
    problem = read_problem(drop, {"force.0": (times, noisy)}, ["contacts.0.stiffness"], None, 1e-9)
    starts = np.linspace(*problem.spans[1], 50)
    for start in starts:
        (forces,) = problem.forces("", np.array([problem.spans[0, 0], start]))
        assert forces.shape == problem.measured[""].waveforms[0].times.shape
