"""Drops of equal laws in one sweep; the inner masses that give the top ball its highest rebound."""

import dataclasses
from collections.abc import Callable, Sequence
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from stackbounce.errors import InvalidType, InvalidValue, listed, positive, shown
from stackbounce.extras import need
from stackbounce.library_types import Dataset
from stackbounce.model import Ball, ContactLaw, Drop
from stackbounce.model.laws import contact_numbers
from stackbounce.run.options import run_options
from stackbounce.run.paths import identifier, numbers_of, value_in
from stackbounce.sweeps import sweep
from stackbounce.units import checked

Contacts: TypeAlias = Callable[[Sequence[Ball]], Sequence[ContactLaw | None]]
"""A function of the balls that returns their contacts, the lowest first."""

_STARTS = 24  # stacks in a generation, for each inner mass
_GENERATIONS = 400
_SEED = 2007
_ALIKE = 1e-13  # standard deviation of the rebound ratios at which the search stops


def solve_drops(drops: Sequence[Drop], gaps: Sequence[float] | None = None) -> Dataset:
    """Solve many drops and return their results as `sweep` does.

    Parameters
    ----------
    drops : sequence of Drop
        At least one. All have the same number of balls, the same gaps and the same impact speed.
    gaps : sequence of float, optional
        In m. Each drop is solved once for each value, which replaces all of its gaps. By default
        each drop keeps its own gaps.

    Returns
    -------
    xarray.Dataset
        As from `sweep`, with the dimensions (stack, ...), or (stack, gap, ...) with `gaps`.

    Examples
    --------
    >>> from stackbounce.model import Ball, Hysteretic, Spring
    >>> laws = Spring(1e4), Hysteretic(1e4, restitution=0.8)
    >>> drops = [Drop([Ball(1.0)], [law], impact_speed=1.0) for law in laws]
    >>> solve_drops(drops).rebound_ratio.values.round(6)
    array([[1. ],
           [0.8]])
    """
    import xarray as xr

    kinds: dict[Any, list[int]] = {}
    for i, drop in enumerate(drops):
        kinds.setdefault(tuple(map(_kind, drop.contacts)), []).append(i)
    parts = []
    for places in kinds.values():
        own = [drops[i] for i in places]
        values = {path: xr.DataArray(row, dims="stack") for path, row in _varied(own).items()}
        if gaps is not None:
            one = xr.DataArray(list(gaps), dims="gap")
            values |= {f"gaps.{i}": one for i in range(len(own[0].gaps))}
        swept = sweep(own[0], values).drop_vars(map(identifier, values))
        parts.append(swept.assign_coords(stack=places))
    how: Any = {"data_vars": "all", "coords": "minimal", "compat": "override", "join": "outer"}
    return xr.concat(parts, "stack", **how).sortby("stack")


def _kind(law: ContactLaw | None) -> tuple[int, str]:
    """Return the form of a contact and, as a text, what of it a sweep cannot vary."""
    plain, numbers = (law.to_mapping(), law.units()) if law else ({}, {})
    fixed = {name: value for name, value in plain.items() if name not in numbers}
    return contact_numbers(law)[0], repr(fixed)


def _varied(drops: Sequence[Drop]) -> dict[str, NDArray[np.float64]]:
    """Return the numbers of balls and contacts that differ between the drops, by their paths.

    The lowest ball's mass is always included, because a sweep needs at least one number.
    """
    found = {}
    for path, number in numbers_of(drops[0]).items():
        if number.part in ("balls", "contacts"):
            derived = getattr(getattr(drops[0], number.part)[number.index], "derived", "")
            # nan is a ball's size or material that is not given, which does not affect a run
            row = np.array([value_in(drop, number) for drop in drops])
            if number.field != derived and (path == "balls.0.mass" or np.ptp(row) > 0.0):
                found[path] = row
    return found


def best_masses(
    drop: Drop, contacts: Contacts | None = None, *, within: Sequence[float] | None = None
) -> Drop:
    """Return the stack with the inner masses that give the top ball its highest rebound.

    Parameters
    ----------
    drop : Drop
        Three balls or more. The lowest and the top one stay as they are; the masses of the inner
        balls are replaced.
    contacts : callable, optional
        A function of the balls that returns their contacts, the lowest first, for contacts that
        depend on the masses. By default the contacts of the drop for all masses.
    within : (float, float), optional
        The smallest and the largest mass in kg that are tried. By default the masses of the two
        outer balls.

    Returns
    -------
    Drop
        The drop with other inner masses. Diameters, where given, change at constant density. A
        mass at an end of the range `within` means that the optimum lies outside of the range.

    Raises
    ------
    InvalidValue
        If there are fewer than three balls, or a number is out of its range.
    InvalidType
        If something has the wrong type.

    Notes
    -----
    The rebound ratio has kinks where a count of collisions changes, and several maxima. The search
    is differential evolution (R. Storn and K. Price, J. Global Optim. 11, 341, 1997) on the
    logarithms of the masses, with a fixed seed and one sweep for each generation. It does not prove
    that the maximum is the global one.

    For rigid balls that collide once each, from the bottom up, the geometric means are best for any
    restitution: ``m[i]**2 = m[i - 1] m[i + 1]``. In the frame of the falling balls, ball i gets
    ``(1 + e) m[i - 1]/(m[i - 1] + m[i])`` times the speed of the ball below, and the product of
    these factors is largest if all mass ratios are equal.

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
    need("a search for masses", "scipy")
    from scipy.optimize import differential_evolution

    run_options(drop, None, 1e-12, 1)
    if len(drop.balls) < 3:
        raise InvalidValue(f"balls must be three or more, got {len(drop.balls)}")
    if contacts is not None and not callable(contacts):
        raise InvalidType(f"contacts must be a function of the balls, got {shown(contacts)}")
    ends = np.log(mass_range(drop, within))

    def lost(logs: NDArray[np.float64]) -> NDArray[np.float64]:
        stacks = [_replace_masses(drop, np.exp(row), contacts) for row in logs.T]
        ratio = solve_drops(stacks).rebound_ratio.values[:, -1]
        return -np.where(np.isfinite(ratio), ratio, -np.inf)

    lost(np.full((len(drop.balls) - 2, 1), ends[0]))  # scipy would hide what is wrong with contacts
    search: Any = {"updating": "deferred", "vectorized": True, "polish": False, "seed": _SEED}
    found = differential_evolution(
        lost,
        [tuple(ends)] * (len(drop.balls) - 2),
        popsize=_STARTS,
        maxiter=_GENERATIONS,
        tol=0.0,
        atol=_ALIKE,
        init="sobol",
        **search,
    )
    return _replace_masses(drop, np.exp(found.x), contacts)


def geometric_means(drop: Drop) -> Drop:
    """Return a stack with inner masses that give all neighbours the same mass ratio.

    Examples
    --------
    >>> from stackbounce.model import Spring
    >>> balls = [Ball(1.0), Ball(0.8, diameter=0.1), Ball(0.01)]
    >>> drop = geometric_means(Drop(balls, [Spring(1.0)] * 3, impact_speed=1.0))
    >>> round(drop.balls[1].mass, 9), round(drop.balls[1].diameter, 9)
    (0.1, 0.05)
    """
    masses = np.geomspace(drop.balls[0].mass, drop.balls[-1].mass, len(drop.balls))
    return _replace_masses(drop, masses[1:-1])


def _replace_masses(drop: Drop, inner: Any, contacts: Contacts | None = None) -> Drop:
    """Return a stack with other inner masses; diameters change at constant density."""
    balls = list(drop.balls)
    for i, mass in enumerate(inner, start=1):
        ball = balls[i]
        wide = ball.diameter and ball.diameter * (mass / ball.mass) ** (1.0 / 3.0)
        balls[i] = dataclasses.replace(ball, mass=float(mass), diameter=wide)
    laws = drop.contacts if contacts is None else contacts(balls)
    return dataclasses.replace(drop, balls=balls, contacts=laws)


def mass_range(drop: Drop, within: object) -> tuple[float, float]:
    """Return the smallest and the largest mass in kg that `best_masses` tries.

    Examples
    --------
    >>> from stackbounce.model import Spring
    >>> drop = Drop([Ball(1.0), Ball(0.5), Ball(0.01)], [Spring(1.0)] * 3, impact_speed=1.0)
    >>> mass_range(drop, None)
    (0.01, 1.0)
    """
    outer = sorted([drop.balls[0].mass, drop.balls[-1].mass])
    if within is None:
        low, high = outer
        right = "balls must have outer masses that differ, unless within is given"
    else:
        ends = listed("within", within, 2)
        if len(ends) != 2:
            raise InvalidType(f"within must be two masses, got {shown(within)}")
        low, high = (checked(positive, "within", mass, "kilograms") for mass in ends)
        right = "within must be two masses, the smaller first"
    if not low < high:
        raise InvalidValue(f"{right}, got {low!r} and {high!r}")
    return low, high
