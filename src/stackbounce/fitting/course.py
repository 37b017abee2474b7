"""The course of a search: its trials so far, and the best one of them."""

import contextlib
import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from stackbounce.prediction.draws import Progress
from stackbounce.run.quantities import Array


@dataclass
class Course:
    """The trials so far: their number, and the best one with its chi squared."""

    trials: int = 0
    best: Array | None = None
    chi_squared: float = math.inf
    progress: Progress | None = None
    expected: int = 0

    def add(self, x: Array, chi_squared: Array) -> None:
        """Count trials (n, parameters), whose chi squared (n,) is known now."""
        least = int(np.argmin(chi_squared))
        if chi_squared[least] < self.chi_squared:
            self.best, self.chi_squared = x[least].copy(), float(chi_squared[least])
        self.trials += len(x)
        if self.progress is not None:
            self.progress(self.trials, max(self.trials, self.expected))

    @contextlib.contextmanager
    def reported(self, progress: Progress | None, expected: int) -> Iterator[None]:
        """Report the progress of about so many trials that follow."""
        self.progress, self.expected = progress, self.trials + expected
        try:
            yield
            if progress is not None:
                progress(self.trials, self.trials)
        finally:
            self.progress = None
