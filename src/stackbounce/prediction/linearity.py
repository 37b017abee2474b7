"""Derivatives of what follows from a drop, and whether it follows them within the errors."""

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from stackbounce.prediction.inputs import Array, Inputs
from stackbounce.run.options import Options
from stackbounce.run.quantities import QUANTITIES, Solved
from stackbounce.run.result import Status

__all__ = ["ROUND_OFF", "STEP", "Slopes", "differentiate"]

STEP = 0.1  # of a standard deviation, for central differences
ROUND_OFF = 1e-10  # relative: differences of this size are none

_ALLOWED = 0.1  # root mean square of their differences, in standard deviations of the result

Slopes = Mapping[str, tuple[Array, Array]]
"""Values (parts,) by the name of a quantity, and derivatives (parts, numbers); nan where none."""


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
    count = len(inputs.numbers)
    steps = np.diag(STEP * inputs.deviations)
    x = np.concatenate([inputs.values[None], inputs.values + steps, inputs.values - steps])
    near = inputs.solve(x, options)
    found = {
        name: np.concatenate([table, solved.tables[name]]) for name, table in near.tables.items()
    }
    reason = _changed_status(np.concatenate([near.status, solved.status]))
    reason = reason or _changed_counts(found.pop("collisions"))
    widths = np.where(inputs.deviations > 0.0, 2.0 * STEP * inputs.deviations, np.inf)
    slopes, largest = {}, 0.0
    for name, table in found.items():
        up, down, tested = np.split(table[1:], [count, 2 * count])
        slope = ((up - down) / widths[:, None]).T
        slopes[name] = table[0], slope
        lines = table[0] + (draws - inputs.values) @ slope.T
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
