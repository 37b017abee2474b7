"""The course of a search: what it costs, how long it takes, and the best trial so far."""

import contextlib
import math
import warnings
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from stackbounce.errors import InvalidValue
from stackbounce.prediction.draws import Progress
from stackbounce.run.quantities import Array

_SECOND = 5e7  # work of a second, in the unit of `engine.work`: it is between 3e7 and 2e8
_LONG, _LONGEST = 60.0, 86_400.0  # s, from which on a computation is announced, and refused
_UNITS = {"days": 86_400.0, "h": 3600.0, "min": 60.0}


@dataclass
class Course:
    """The trials so far: their number and work, and the best one with its chi squared."""

    trials: int = 0
    work: int = 0
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

    def cost(self, trials: float) -> float:
        """Return about what so many further trials cost."""
        return self.work * trials / max(1, self.trials)

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


def announce(what: str, work: float, way: str) -> None:
    """Warn of a computation that takes long, before it begins; refuse one that takes days.

    Parameters
    ----------
    what : str
        What would take so long.
    work : float
        About what it costs.
    way : str
        How it takes less.

    Raises
    ------
    InvalidValue
        If it takes more than a day.

    Examples
    --------
    >>> announce("a fit of 60 numbers", 1e13, "fix some")
    Traceback (most recent call last):
    stackbounce.errors.InvalidValue: a fit of 60 numbers would take about 2.3 days: fix some
    """
    seconds = work / _SECOND
    unit = next((unit for unit, size in _UNITS.items() if seconds >= 1.5 * size), "min")
    about = f"take about {seconds / _UNITS[unit]:.2g} {unit}: {way}"
    if seconds > _LONGEST:
        raise InvalidValue(f"{what} would {about}")
    if seconds > _LONG:
        warnings.warn(f"{what} will {about}, or end it with Ctrl+C", stacklevel=4)
