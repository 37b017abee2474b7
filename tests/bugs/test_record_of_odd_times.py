"""A record whose times are not exact in binary lost samples when its times were shifted."""

import numpy as np

import stackbounce as sb
from stackbounce.fitting import FitProblem


def test_every_sample_of_a_record_has_a_force():
    drop = sb.Drop([sb.Ball(0.057)], [sb.Spring(2.2e4)], height=1.0)
    times = np.arange(0.0, 0.01068, 2e-5)
    force = 150.0 * np.sin(np.clip((times - 0.0027) * 620.0, 0.0, np.pi))
    noisy = force + np.random.default_rng(1).normal(0.0, 0.5, len(times))
    data = {"force.0": (times, noisy)}
    objective = FitProblem(drop, data, ["contacts.0.stiffness"]).objective
    starts = np.linspace(*objective.spans[1], 50)
    for start in starts:
        (forces,) = objective.forces("", np.array([objective.spans[0, 0], start]))
        assert forces.shape == objective.measured[""].waveforms[0].times.shape
