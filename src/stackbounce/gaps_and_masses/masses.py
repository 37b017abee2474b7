"""The masses in between that throw the top ball of a stack highest."""

import dataclasses
from collections.abc import Callable, Sequence
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from stackbounce.errors import InvalidType, InvalidValue, StackbounceError, positive, shown
from stackbounce.gaps_and_masses.batch import solved
from stackbounce.model import Ball, ContactLaw, Drop
from stackbounce.run.options import run_options

__all__ = ["Contacts", "best_masses", "geometric_masses", "with_masses"]

Contacts: TypeAlias = Callable[[Sequence[Ball]], Sequence[ContactLaw | None]]
"""Returns the contacts of balls, the lowest first."""

_STARTS = 24  # stacks of the first generation, for each mass
_GENERATIONS = 400
_SEED = 2007
_ALIKE = 1e-13  # rebound ratios of a generation that is done


def best_masses(
    drop: Drop, contacts: Contacts | None = None, *, within: Sequence[float] | None = None
) -> Drop:
    """Return the stack with the masses between the outer balls that throw the top one highest.

    Parameters
    ----------
    drop : Drop
        Three balls or more. The lowest and the top one stay; the masses of those between them do
        not count.
    contacts : callable, optional
        Returns the contacts of balls, the lowest first, where they depend on the masses. By default
        those of the drop, whatever the masses.
    within : (float, float), optional
        The smallest and the largest mass in kg that are tried; by default those of the two outer
        balls.

    Returns
    -------
    Drop
        The drop with other masses in between, and diameters, where there are any, at the same
        density. A mass at the end of what was tried is not the best: that lies beyond.

    Raises
    ------
    InvalidValue
        If there are fewer than three balls, or a number is out of its range.
    InvalidType
        If something has the wrong type.

    Notes
    -----
    Rebound ratios have kinks where a count of collisions changes, and several maxima; so they are
    searched by differential evolution (R. Storn and K. Price, J. Global Optim. 11, 341, 1997) on
    the logarithms of the masses, a generation in one sweep, the same in each run. Nothing proves
    that there is no higher maximum.

    Rigid balls that collide once each, from the bottom up, are best with geometric means, whatever
    the restitution: ``m[i]**2 = m[i - 1] m[i + 1]``, as ball i gets ``(1 + e) m[i - 1]/(m[i - 1] +
    m[i])`` of the speed, seen from the falling balls, of the one below, and the product of these is
    largest where all mass ratios are equal.

    Examples
    --------
    >>> import stackbounce as sb
    >>> balls = [sb.Ball(1.0), sb.Ball(0.5), sb.Ball(0.01)]
    >>> rigid = sb.Drop(balls, [sb.Rigid(1.0)] * 3, impact_speed=1.0)
    >>> round(sb.best_masses(rigid).balls[1].mass, 5)
    0.1
    >>> springs = sb.Drop(balls, [sb.Spring(1e4)] * 3, impact_speed=1.0)
    >>> round(sb.best_masses(springs).balls[1].mass, 5)
    0.48518
    """
    from scipy.optimize import differential_evolution

    run_options(drop, None, 1e-12, 1)
    if len(drop.balls) < 3:
        raise InvalidValue(f"balls must be three or more, got {len(drop.balls)}")
    if contacts is not None and not callable(contacts):
        raise InvalidType(f"contacts must be a function of the balls, got {shown(contacts)}")
    ends = np.log(_limits(drop, within))

    def lost(logs: NDArray[np.float64]) -> NDArray[np.float64]:
        stacks = [with_masses(drop, np.exp(row), contacts) for row in logs.T]
        ds = solved(stacks)
        ratio = ds.rebound_ratio.values[:, -1]
        return -np.where(np.isfinite(ratio), ratio, -np.inf)

    between = len(drop.balls) - 2
    search: Any = {"updating": "deferred", "vectorized": True, "polish": False, "seed": _SEED}
    found = differential_evolution(
        lost,
        [tuple(ends)] * between,
        popsize=_STARTS,
        maxiter=_GENERATIONS,
        tol=0.0,
        atol=_ALIKE,
        init="sobol",
        **search,
    )
    return with_masses(drop, np.exp(found.x), contacts)


def geometric_masses(drop: Drop) -> list[float]:
    """Return the masses in kg of a stack whose neighbours all have one mass ratio.

    Examples
    --------
    >>> from stackbounce.model import Spring
    >>> balls = [Ball(1.0), Ball(0.5), Ball(0.01)]
    >>> [round(m, 9) for m in geometric_masses(Drop(balls, [Spring(1.0)] * 3, impact_speed=1.0))]
    [1.0, 0.1, 0.01]
    """
    masses = np.geomspace(drop.balls[0].mass, drop.balls[-1].mass, len(drop.balls))
    return [float(mass) for mass in masses]


def with_masses(drop: Drop, between: Sequence[float], contacts: Contacts | None = None) -> Drop:
    """Return a stack with other masses between its outer balls, each at its density.

    Examples
    --------
    >>> from stackbounce.model import Spring
    >>> balls = [Ball(1.0), Ball(0.5, diameter=0.1), Ball(0.01)]
    >>> with_masses(Drop(balls, [Spring(1.0)] * 3, impact_speed=1.0), [4.0]).balls[1]
    Ball(mass=4.0, diameter=0.2, name=None, young_modulus=None, poisson_ratio=None)
    """
    balls = list(drop.balls)
    for i, mass in enumerate(between, start=1):
        ball = balls[i]
        wide = ball.diameter and ball.diameter * (mass / ball.mass) ** (1.0 / 3.0)
        balls[i] = dataclasses.replace(ball, mass=float(mass), diameter=wide)
    laws = drop.contacts if contacts is None else contacts(balls)
    return dataclasses.replace(drop, balls=balls, contacts=laws)


def _limits(drop: Drop, within: object) -> tuple[float, float]:
    """Return the smallest and the largest mass to try, in kg."""
    outer = sorted([drop.balls[0].mass, drop.balls[-1].mass])
    if within is None:
        low, high = outer
        right = "balls must have outer masses that differ, unless within is given"
    else:
        try:
            low, high = (positive("within", one, "kilograms") for one in within)  # type: ignore[attr-defined]
        except (TypeError, ValueError) as error:
            if isinstance(error, StackbounceError):
                raise
            raise InvalidType(f"within must be two masses, got {shown(within)}") from None
        right = "within must be two masses, the smaller first"
    if not low < high:
        raise InvalidValue(f"{right}, got {low!r} and {high!r}")
    return low, high
