"""Runs of draws: their work together is limited; and derivatives, which describe them or do not."""

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from stackbounce.errors import InvalidType, InvalidValue, shown
from stackbounce.prediction.inputs import FEWEST, Inputs, of_draws
from stackbounce.run.options import Options
from stackbounce.run.quantities import QUANTITIES, Array, Solved
from stackbounce.run.result import Result, Status

DRAWS = 10_000
"""The number of draws by default."""

_RUNS = 5  # that meet the limit of work: what all draws together may cost, up to half a minute
_FIRST = 4  # draws that are run before it is known what they cost

Progress = Callable[[int, int], object]
"""Is called with the number of draws done and the number of all."""

ROUND_OFF = 1e-10  # relative: differences of this size are none

_ALLOWED = 0.1  # root mean square of their differences, in standard deviations of the result

Slopes = Mapping[str, tuple[Array, Array]]
"""Values (parts,) by the name of a quantity, and derivatives (parts, numbers); nan where none."""


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


def differentiate(
    inputs: Inputs, draws: Array, solved: Solved, options: Options
) -> tuple[Slopes, str, float]:
    """Return the derivatives of all quantities, and why they do not do, if so.

    Parameters
    ----------
    inputs : Inputs
        The numbers with errors.
    draws : ndarray
        (n, numbers) draws of them, by which the derivatives are tested.
    solved : Solved
        The quantities of the draws.
    options : Options
        Of each run.

    Returns
    -------
    slopes : mapping
        By the name of a quantity.
    reason : str
        Why derivatives do not describe the draws; empty if they do.
    difference : float
        The largest difference between a quantity of the draws and its straight line: root mean
        square, in standard deviations of the quantity.
    """
    near = inputs.solve(inputs.neighbours, options)
    reason = _changed_status(np.concatenate([near.status, solved.status]))
    reason = reason or _changed_counts(
        np.concatenate([near.tables.pop("collisions"), solved.tables["collisions"]])
    )
    slopes, largest = {}, 0.0
    for name, around in near.tables.items():
        slope, tested = inputs.slopes(around).T, solved.tables[name]
        slopes[name] = around[0], slope
        lines = around[0] + (draws - inputs.values) @ slope.T
        table = np.concatenate([around, tested])
        for part in np.flatnonzero(np.any(np.isfinite(table), axis=0)):
            here = f"{name}.{part}" if QUANTITIES[name].part else name
            if not np.all(np.isfinite(table[:, part])):
                reason = reason or f"some drops have no {here}"
                continue
            size = ROUND_OFF * np.nanmax(np.abs(table))
            if np.ptp(table[:, part]) <= size:
                slope[part] = 0.0
            off = float(np.sqrt(np.mean((tested[:, part] - lines[:, part]) ** 2)))
            if off <= size:
                continue
            spread = float(np.std(tested[:, part]))
            largest = max(largest, off / spread if spread > 0.0 else np.inf)
            if off > _ALLOWED * spread:
                reason = reason or f"{here} does not change in proportion to the errors"
    return slopes, reason, largest


def carry(
    inputs: Inputs,
    results: Sequence[Result],
    function: Callable[[Result], Mapping[Any, float]],
    *,
    drawn: bool,
) -> dict[Any, Any]:
    """Return numbers of results with errors, and the share of the results with each.

    The results are of draws, or of `Inputs.neighbours`.
    """
    answers = [_numbers_of(function(result)) for result in results]
    found = {}
    for name in dict.fromkeys(name for answer in answers for name in answer):
        column = np.array([answer.get(name, np.nan) for answer in answers])
        column[~np.isfinite(column)] = np.nan
        share = float(np.mean(np.isfinite(column)))
        if drawn or share < 1.0:
            found[name] = of_draws(column), share
            continue
        if np.ptp(column) <= ROUND_OFF * np.max(np.abs(column)):
            column[:] = column[0]
        found[name] = inputs.linear(float(column[0]), inputs.slopes(column)), share
    return found


def _numbers_of(answer: Any) -> dict[Any, float]:
    """Return the numbers that a user's function gives, by their names."""
    try:
        return {name: float(value) for name, value in dict(answer).items()}
    except (TypeError, ValueError):
        raise InvalidType(f"function must return a dict of numbers, got {shown(answer)}") from None


def _changed_status(status: NDArray[np.int64]) -> str:
    names = [Status(code).name for code in sorted(set(status.tolist()))]
    return f"drops end as {_alternatives(names)}" if len(names) > 1 else ""


def _changed_counts(counts: Array) -> str:
    for contact, column in enumerate(counts.T.tolist()):
        known = sorted(set(column), key=lambda count: (count < 0, count))
        if len(known) > 1:
            words = ["infinitely many" if count < 0 else f"{count}" for count in known]
            if len(words) > 3:
                words = [f"{words[0]} to {words[-1]}"]
            return f"contact {contact} collides {_alternatives(words)} times"
    return ""


def _alternatives(words: Sequence[str]) -> str:
    return " or ".join([", ".join(words[:-1]), words[-1]] if words[:-1] else words)


def linear_shares(slopes: Array, covariance: Array) -> Array:
    """Return the shares in the variance of quantities that change in proportion to the numbers.

    Shares of correlated numbers contain half of what a pair makes together, and may be negative.

    Parameters
    ----------
    slopes : ndarray
        (parts, numbers) derivatives.
    covariance : ndarray
        (numbers, numbers) of the numbers.

    Returns
    -------
    ndarray
        (parts, numbers).

    Examples
    --------
    >>> linear_shares(np.array([[1.0, 1.0]]), np.diag([9.0, 1.0]))
    array([[0.9, 0.1]])
    """
    parts = slopes * (slopes @ covariance)
    with np.errstate(all="ignore"):
        return np.asarray(parts / np.sum(parts, axis=1, keepdims=True))


def fit_slopes(draws: Array, answers: Array) -> Array:
    """Return the slopes (parts, numbers) of straight lines through draws; nan of too few.

    Parameters
    ----------
    draws : ndarray
        (n, numbers) of the numbers.
    answers : ndarray
        (n, parts) of a quantity; nan where a draw has none.

    Examples
    --------
    >>> draws = np.arange(6.0).reshape(3, 2) ** 2
    >>> fit_slopes(draws, 2.0 * draws[:, :1]).round(9) + 0.0
    array([[2., 0.]])
    """
    slopes = np.full((answers.shape[1], draws.shape[1]), np.nan)
    for part, column in enumerate(answers.T):
        known = np.isfinite(column)
        if np.count_nonzero(known) > draws.shape[1]:
            x, y = draws[known], column[known]
            size = np.std(x, axis=0)
            size[size == 0.0] = 1.0
            lines = np.linalg.lstsq((x - np.mean(x, axis=0)) / size, y - np.mean(y), rcond=None)
            slopes[part] = lines[0] / size
    return slopes
