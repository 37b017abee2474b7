"""Fits that take long are shown on the way, and leave the best so far at Ctrl+C."""

import os

import numpy as np
import pytest

import stackbounce as sb
from stackbounce.errors import InvalidValue
from stackbounce.fitting import Interrupted

DROP = sb.Drop([sb.Ball(0.15), sb.Ball(0.057)], [sb.Hertz(1e6), sb.Hertz(1e6)], height=0.63)
DATA = {"rebound_ratios.1": "1.64 ± 0.02", "first_touch.1": "1 ± 0.2 ms"}
VARY = {"contacts.1.stiffness": (1e4, 1e8), "gaps.0": (0.0, 5e-3)}


def stop_after(trials):
    def progress(done, _):
        if done >= trials:
            raise KeyboardInterrupt

    return progress


@pytest.mark.parametrize("trials", [0, 300])
def test_ctrl_c_leaves_the_best_so_far(trials):
    with pytest.raises(Interrupted) as stopped:
        sb.fit(DROP, DATA, VARY, progress=stop_after(trials))
    fit = stopped.value.fit
    assert fit.objective.course.trials >= max(8, trials)
    assert np.isfinite(fit.chi_squared)
    for name, value in fit.best.items():
        low, high = VARY[name]
        assert low <= value <= high
        assert f"{name} = {value:.6g}" in str(stopped.value)


def test_progress_ends_with_all_trials_done():
    seen = []
    fit = sb.fit(DROP, DATA, VARY, progress=lambda done, every: seen.append((done, every)))
    assert all(done <= every for done, every in seen)
    assert seen[-1] == (fit.objective.course.trials,) * 2


@pytest.mark.skipif(os.name != "posix", reason="the size of the memory is not known elsewhere")
def test_what_does_not_fit_into_memory_is_refused_with_the_size_and_the_way():
    found = sb.fit(DROP, DATA, VARY)
    for draws, said in ((10**13, "would take 7.2e.05 GB .*: take fewer"), (10**400, "from 640 to")):
        with pytest.raises(InvalidValue, match=said):
            found.sample(draws)
    values = np.linspace(1e5, 1e6, 400_000)
    varied = {f"contacts.{i}.stiffness": values for i in (0, 1)}
    with pytest.raises(InvalidValue, match=r"160000000000 drops would take 1.41e.04 GB .*block by"):
        sb.sweep(DROP, varied)
