"""A fit ended in an AbortFitException where the simplex took just as many steps as it may."""

import numpy as np
import pytest

from stackbounce.fitting import least_squares


class Bowl:
    """Two residuals of one number, smallest at 0.4."""

    spans = np.array([[0.0, 1.0]])

    def __init__(self):
        self.trials = 0

    def residuals(self, trials):
        self.trials += 1
        return np.column_stack([trials - 0.4, 2.0 * (trials - 0.4)])


def test_simplex_that_ends_at_its_limit(monkeypatch):
    start, free = np.array([0.8]), Bowl()
    monkeypatch.setattr(least_squares, "_SHORT", 5000)
    least_squares._cross_kink(free, start, None)
    for steps in range(free.trials - 3, free.trials + 3):
        monkeypatch.setattr(least_squares, "_SHORT", steps)
        assert least_squares._cross_kink(Bowl(), start, None) == pytest.approx([0.4], abs=1e-3)
