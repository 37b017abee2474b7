"""The runs of draws, in parts: their work together is limited, and their progress is reported."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from stackbounce.errors import InvalidValue
from stackbounce.prediction.inputs import FEWEST, Array, Inputs
from stackbounce.run.options import Options
from stackbounce.run.quantities import Solved
from stackbounce.run.result import Status

__all__ = ["DRAWS", "Progress", "budget", "solve_draws"]

DRAWS = 10_000
"""The number of draws by default."""

_RUNS = 5  # that meet the limit of work: what all draws together may cost, up to half a minute
_FIRST = 4  # draws that are run before it is known what they cost

Progress = Callable[[int, int], object]
"""Is called with the number of draws done and the number of all."""


def budget(options: Options, draws: int) -> int:
    """Return the work of all draws together: more for more draws, or for runs with more events."""
    return _RUNS * options.work_limit * max(draws, DRAWS) // DRAWS


def solve_draws(
    inputs: Inputs, draws: Array, options: Options, progress: Progress | None = None
) -> Solved:
    """Run draws until all are done, or until further ones would exceed the budget.

    The number of draws that are run does not depend on the machine.

    Parameters
    ----------
    inputs : Inputs
        The numbers with errors.
    draws : ndarray
        (n, numbers) draws of them.
    options : Options
        Of each run.
    progress : callable, optional
        Is called after each part.

    Returns
    -------
    Solved
        Of the first draws.

    Raises
    ------
    InvalidValue
        If fewer than 100 draws would be run.
    """
    most, parts = budget(options, len(draws)), list[Solved]()
    done, spent, stopped = 0, 0, 0
    while done < len(draws):
        affordable = done * most // spent if spent else len(draws)
        stop = min(len(draws), max(_FIRST, 2 * done), affordable)
        if stop <= done or (affordable < FEWEST and stopped == done):
            break
        parts.append(inputs.solve(draws[done:stop], options))
        spent += int(np.sum(parts[-1].work))
        stopped += int(np.sum(parts[-1].status == Status.EVENT_LIMIT))
        done = stop
        if progress is not None:
            progress(done, len(draws))
    status = np.concatenate([part.status for part in parts])
    if done < min(FEWEST, len(draws)):
        raise InvalidValue(_why_few(inputs, draws[:done], status))
    names = parts[0].tables
    tables = {name: np.concatenate([part.tables[name] for part in parts]) for name in names}
    return Solved(tables, status, np.concatenate([part.work for part in parts]))


def _why_few(inputs: Inputs, draws: Array, status: NDArray[np.int64]) -> str:
    """Return the message of why too few draws were run."""
    limited, met = np.flatnonzero(status == Status.EVENT_LIMIT), ""
    if len(limited):
        values = zip(inputs.paths, draws[limited[0]].tolist(), strict=True)
        there = ", ".join(f"{path} = {value:.4g}" for path, value in values)
        met = f" ({len(limited)} met a limit, the first with {there})"
    return (
        f"errors lead to drops that take too long: {FEWEST} draws are needed, and only "
        f"{len(draws)} could be run{met}; give smaller errors, or raise event_limit"
    )
