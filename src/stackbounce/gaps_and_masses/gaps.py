"""One stack with gaps from touching to separate: the transition between the two models."""

import math
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from stackbounce.calibration import separate
from stackbounce.errors import InvalidValue, positive, shown, whole
from stackbounce.gaps_and_masses.batch import joined
from stackbounce.gaps_and_masses.separation_limit import distance, separate_from, with_gap
from stackbounce.model import Drop
from stackbounce.run.driver import simulate
from stackbounce.run.options import run_options
from stackbounce.sweeps import sweep

if TYPE_CHECKING:
    import xarray as xr

__all__ = ["transition"]

_EVEN, _LOG, _LOWEST = (
    1025,
    97,
    1e-4,
)  # gaps to begin with: in even steps, in even ratios from there
_BEYOND = 1.1  # of the gap from which on nothing changes
_NEVER = 20.0  # of the distance fallen during the touching impact, where it always changes
_STRAIGHT = 2e-3  # a curve may leave the line between the neighbours by so much
_EXACT = 1e-7  # relative, to which gaps are known where a count changes or a curve jumps
_MOST = 20_000  # gaps, where curves bend ever more


def transition(
    drop: Drop, only: int | None = None, *, stop: float | None = None, rtol: float = 1e-12
) -> "xr.Dataset":
    """Return what a stack does with gaps from touching to where the collisions are separate.

    Parameters
    ----------
    drop : Drop
        Two balls or more on finite contacts, without gravity. Its gaps do not count, unless `only`
        one of them varies.
    only : int, optional
        The gap that varies, all others as they are; by default all gaps, with the same value.
    stop : float, optional
        The largest gap in m; by default a little beyond the one at which the separate collisions
        begin, or, if there is none, 20 times the distance fallen during the touching impact.
    rtol : float, optional
        As in `simulate`.

    Returns
    -------
    xarray.Dataset
        With the dimension `gap`, in m, all that `sweep` returns: `rebound_ratio` (gap, ball);
        `collisions`, `first_touch` and `last_release` (gap, contact); `energy_retained`; `status`.
        The gaps lie as close as the curves need, and around each change of a count. Without the
        dimension: `textbook_ratio` (ball), `textbook_collisions` (contact) and `textbook_energy`,
        of `separate`. Attributes: `separate_from`, the gap in m from which on nothing changes
        (inf: there is none); `changes`, the gaps from which on a contact has another number of
        collisions, each one of the dimension.

    Raises
    ------
    InvalidValue
        If there is one ball only, gravity, rigid contacts, or no contact that closes, or a number
        is out of its range.
    InvalidType
        If something has the wrong type.

    Notes
    -----
    Source: R. Cross, Am. J. Phys. 75, 1009 (2007), section II. `separate_from` is exact: at that
    gap one contact closes just when another at the same ball has opened. Beyond it, all that grows
    are the flights. It is `inf` above all where the textbook has infinitely many collisions: these
    follow each other faster than any contact can open.

    The textbook has one restitution for each contact. It is met exactly where that does not depend
    on the speed, and all gaps vary.

    Counts that change there and back between two neighbouring gaps, of which there are at least
    1025, are not seen. Where balls part at one speed, or come to rest, but for round-off, so are
    the counts.

    Examples
    --------
    Two equal balls on equal springs. The ball below has left the floor, half a period after its
    touch, when the gap has been closed:

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
    length = distance(drop, only, rtol)
    limit = separate_from(drop, only, length, rtol)
    last = min(_BEYOND * limit, _NEVER * length) if math.isinf(limit) else _BEYOND * limit
    last = (last or length) if stop is None else positive("stop", stop, "metres")
    ds = _refined(drop, only, _first_gaps(last, limit), rtol)
    textbook = simulate(separate(with_gap(drop, only, last)))
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
    """Return the gaps to begin with, of which the limit is one."""
    even, log = np.linspace(0.0, last, _EVEN), np.geomspace(_LOWEST * last, last, _LOG)
    return np.unique([*even, *log[:-1], min(limit, last)])


def _refined(drop: Drop, only: int | None, gaps: NDArray[np.float64], rtol: float) -> "xr.Dataset":
    """Return the sweep over some gaps, and over more where it bends or a count changes."""
    ds = _swept(drop, only, gaps, rtol)
    while len(more := _between(ds)) and ds.sizes["gap"] < _MOST:
        ds = joined([ds, _swept(drop, only, more, rtol)], "gap")
    return ds


def _swept(drop: Drop, only: int | None, gaps: NDArray[np.float64], rtol: float) -> "xr.Dataset":
    import xarray as xr

    values = xr.DataArray(gaps, dims="gap")
    which = range(len(drop.gaps)) if only is None else [only]
    ds = sweep(drop, {f"gaps.{i}": values for i in which}, rtol=rtol)
    ds = ds.drop_vars([f"gaps.{i}" for i in which])
    return ds.assign_coords(gap=("gap", gaps, {"units": "m"}))


def _between(ds: "xr.Dataset") -> NDArray[np.float64]:
    """Return the gaps that are missing."""
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
    """Tell beside which inner points a ratio leaves the line between the point's neighbours."""
    share = (gap[1:-1] - gap[:-2]) / (gap[2:] - gap[:-2])
    line = ratios[:-2] + share[:, None] * (ratios[2:] - ratios[:-2])
    off = (np.abs(ratios[1:-1] - line) > _STRAIGHT).any(axis=1)
    beside: NDArray[np.bool_] = np.append(off, False) | np.append(False, off)
    return beside
