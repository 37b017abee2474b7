"""One stack over all gaps: the transition from simultaneous to separate collisions."""

import math
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from stackbounce.errors import InvalidValue, positive, shown, whole
from stackbounce.gaps_and_masses.batch import join_sweeps
from stackbounce.gaps_and_masses.separation_limit import (
    find_separation_limit,
    measure_fall,
    replace_gaps,
)
from stackbounce.model import Drop
from stackbounce.run.collision import separate
from stackbounce.run.driver import simulate
from stackbounce.run.options import run_options
from stackbounce.sweeps import sweep

if TYPE_CHECKING:
    import xarray as xr

__all__ = ["transition"]

_EVEN, _LOG = 1025, 97  # first gaps: so many linearly and logarithmically spaced ones
_LOWEST = 1e-4  # the smallest logarithmically spaced gap, over the largest gap
_BEYOND = 1.1  # the largest gap, over the separation limit
_NEVER = 20.0  # the same over the fall during the touching impact, where there is no limit
_STRAIGHT = 2e-3  # tolerated distance of a rebound ratio from the chord of its neighbours
_EXACT = 1e-7  # relative accuracy of a gap at which a count changes
_MOST = 20_000  # gaps at most


def transition(
    drop: Drop, only: int | None = None, *, stop: float | None = None, rtol: float = 1e-12
) -> "xr.Dataset":
    """Return the outcome of a stack for gaps from touching balls to separate collisions.

    Parameters
    ----------
    drop : Drop
        Two balls or more on finite contacts, without gravity. Its own gaps are used only if
        `only` is given.
    only : int, optional
        The index of the gap that varies while the others stay as they are. By default all gaps
        vary together, with the same value.
    stop : float, optional
        The largest gap in m. By default 1.1 times the separation limit or, if there is none, 20
        times the distance that the stack falls in the duration of the impact of touching balls.
    rtol : float, optional
        As in `simulate`.

    Returns
    -------
    xarray.Dataset
        With the dimension `gap`, in m, all that `sweep` returns: `rebound_ratio` (gap, ball);
        `collisions`, `first_touch` and `last_release` (gap, contact); `energy_retained`; `status`.
        The gaps are refined where a curve bends or a count of collisions changes. Without the
        dimension, from `separate`: `textbook_ratio` (ball), `textbook_collisions` (contact) and
        `textbook_energy`. Attributes: `separate_from`, the separation limit in m, above which the
        outcome does not change (inf if there is none); `changes`, the gaps at which a contact gets
        another number of collisions, each one a value of the dimension.

    Raises
    ------
    InvalidValue
        If there is only one ball, gravity is not 0, contacts are rigid, no contact ever closes, or
        a number is out of its range.
    InvalidType
        If something has the wrong type.

    Notes
    -----
    Source: R. Cross, Am. J. Phys. 75, 1009 (2007), section II. The separation limit is exact: at
    that gap one contact closes at the moment when another contact of the same ball opens. Above
    it only the flights between collisions get longer. The limit is `inf` mostly where separate
    collisions are infinitely many: they follow each other faster than any contact can open.

    `separate` uses one restitution for each contact. The curves reach its values exactly if
    the restitutions do not depend on the speed and all gaps vary.

    A count that changes and changes back between two neighbouring gaps, of which there are at
    least 1025, is missed. Where two balls part with equal speeds or come to rest, the counts depend
    on round-off.

    Examples
    --------
    Two equal balls on equal springs. At the separation limit the lower ball leaves the floor, half
    a period after its touch, at the moment when the gap closes:

    >>> import stackbounce as sb
    >>> drop = sb.Drop([sb.Ball(1.0)] * 2, [sb.Spring(1.0)] * 2, impact_speed=1.0)
    >>> ds = sb.transition(drop)
    >>> round(ds.separate_from, 9)
    3.141592654
    >>> ds.rebound_ratio.isel(gap=[0, -1]).values.round(4)
    array([[0.7664, 1.1886],
           [1.    , 1.    ]])
    """
    run_options(drop, None, rtol, 1)
    _check(drop, only)
    length = measure_fall(drop, only, rtol)
    limit = find_separation_limit(drop, only, length, rtol)
    last = min(_BEYOND * limit, _NEVER * length) if math.isinf(limit) else _BEYOND * limit
    last = (last or length) if stop is None else positive("stop", stop, "metres")
    ds = _refined(drop, only, _first_gaps(last, limit), rtol)
    textbook = simulate(separate(replace_gaps(drop, only, last)))
    ds["textbook_ratio"] = ("ball", textbook.rebound_ratios)
    ds["textbook_collisions"] = ("contact", textbook.collisions)
    ds["textbook_energy"] = ((), textbook.energy_retained)
    new = (np.diff(ds.collisions.values, axis=0) != 0).any(axis=1)
    ds.attrs["separate_from"] = limit
    ds.attrs["changes"] = ds.gap.values[1:][new].tolist()
    return ds


def _check(drop: Drop, only: object) -> None:
    count = len(drop.gaps)
    if count == 0:
        raise InvalidValue("balls must be two or more for a gap, got 1")
    if only is not None:
        whole("only", only, 0, count - 1)
    if drop.rigid:
        raise InvalidValue(
            "contacts must be finite ones, such as Spring, got Rigid: such collisions are "
            "separate whatever the gap"
        )
    if drop.gravity > 0.0:
        raise InvalidValue(
            f"gravity must be 0, got {shown(drop.gravity)}: with it the outcome changes with every "
            "gap; sweep one instead"
        )


def _first_gaps(last: float, limit: float) -> NDArray[np.float64]:
    """Return the first gaps; the separation limit is one of them."""
    even, log = np.linspace(0.0, last, _EVEN), np.geomspace(_LOWEST * last, last, _LOG)
    return np.unique([*even, *log[:-1], min(limit, last)])


def _refined(drop: Drop, only: int | None, gaps: NDArray[np.float64], rtol: float) -> "xr.Dataset":
    """Sweep over gaps, refined until no curve bends and no count changes between neighbours."""
    ds = _swept(drop, only, gaps, rtol)
    while len(more := _between(ds)) and ds.sizes["gap"] < _MOST:
        ds = join_sweeps([ds, _swept(drop, only, more, rtol)], "gap")
    return ds


def _swept(drop: Drop, only: int | None, gaps: NDArray[np.float64], rtol: float) -> "xr.Dataset":
    import xarray as xr

    values = xr.DataArray(gaps, dims="gap")
    which = range(len(drop.gaps)) if only is None else [only]
    ds = sweep(drop, {f"gaps.{i}": values for i in which}, rtol=rtol)
    ds = ds.drop_vars([f"gaps.{i}" for i in which])
    return ds.assign_coords(gap=("gap", gaps, {"units": "m"}))


def _between(ds: "xr.Dataset") -> NDArray[np.float64]:
    """Return the gaps to add: midpoints where a curve bends or a count or status changes."""
    gap = ds.gap.values
    low, high = gap[:-1], gap[1:]
    width = high - low
    counts = np.column_stack([ds.collisions.values, ds.status.values])
    changes = (np.diff(counts, axis=0) != 0).any(axis=1)
    wanted = changes | _bent(gap, ds.rebound_ratio.values)
    wanted &= width > _EXACT * np.maximum(high, _EXACT * gap[-1])
    middle: NDArray[np.float64] = (0.5 * (low + high))[wanted]
    return middle


def _bent(gap: NDArray[np.float64], ratios: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Return which intervals have an end where a ratio is off the chord of its neighbours."""
    share = (gap[1:-1] - gap[:-2]) / (gap[2:] - gap[:-2])
    line = ratios[:-2] + share[:, None] * (ratios[2:] - ratios[:-2])
    off = (np.abs(ratios[1:-1] - line) > _STRAIGHT).any(axis=1)
    beside: NDArray[np.bool_] = np.append(off, False) | np.append(False, off)
    return beside
