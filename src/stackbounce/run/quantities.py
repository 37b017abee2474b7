"""What follows of a drop: speeds, heights, times and energy, for many drops at once."""

from collections.abc import Callable
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from stackbounce.engine.records import Outcomes
from stackbounce.model import Drop
from stackbounce.run.batch import solve
from stackbounce.run.options import Options
from stackbounce.run.paths import Rows, incidence
from stackbounce.run.result import Status, heights_of

Array: TypeAlias = NDArray[np.float64]


class Quantity(NamedTuple):
    """A quantity that can be measured.

    Parameters
    ----------
    part : str
        What has the quantity: ``ball``, ``contact``, or empty for the whole stack.
    unit : str
        The SI unit.
    example : str
        How a measured value is written, with its error.
    predict : callable
        Takes the outcomes of many drops, their impact speeds (drops,) in m/s and gravity (drops,)
        in m/s**2; returns the quantity (drops, part).
    """

    part: str
    unit: str
    example: str
    predict: Callable[[Outcomes, Array, Array], Any]


def _speeds(out: Outcomes, speed: Array, _: Array) -> Any:
    """Return the velocities after the impact, up-positive."""
    return out.rebound_ratio * speed[:, None]


def _heights(out: Outcomes, speed: Array, gravity: Array) -> Any:
    """Return how far each ball rises at its speed; with a minus sign if it moves down."""
    return heights_of(_speeds(out, speed, gravity), gravity[:, None])


QUANTITIES: dict[str, Quantity] = {
    "rebound_ratios": Quantity("ball", "", "1.64 ± 0.02", lambda out, *_: out.rebound_ratio),
    "rebound_speeds": Quantity("ball", "m/s", "5.8 ± 0.1 m/s", _speeds),
    "rebound_heights": Quantity("ball", "m", "1.72 ± 0.03 m", _heights),
    "first_touch": Quantity("contact", "s", "2.0 ± 0.5 ms", lambda out, *_: out.first_touch),
    "last_release": Quantity("contact", "s", "2.0 ± 0.5 ms", lambda out, *_: out.last_release),
    "durations": Quantity(
        "contact", "s", "2.0 ± 0.5 ms", lambda out, *_: out.last_release - out.first_touch
    ),
    "energy_retained": Quantity("", "", "0.64 ± 0.02", lambda out, *_: out.energy_retained),
    "collisions": Quantity("contact", "", "2", lambda out, *_: out.collisions),
}
"""By name, as in `Result`; that of one ball or contact is ``rebound_ratios.1``.

Collisions are compared, not fitted.
"""


class Solved(NamedTuple):
    """What came of some drops.

    Parameters
    ----------
    tables : dict of str to ndarray
        All quantities by the names of `QUANTITIES`, (count, parts) each, with one part for the
        whole stack. nan where a drop has no such number, and for all of a run that did not finish.
    status : ndarray
        (count,) numbers of `Status`.
    work : ndarray
        (count,) what the runs cost, in the unit of `stackbounce.engine.work`.
    """

    tables: dict[str, Array]
    status: NDArray[np.int64]
    work: NDArray[np.int64]


def solve_quantities(drop: Drop, rows: Rows, count: int, options: Options) -> Solved:
    """Run many drops; return all quantities, and how the runs ended.

    Parameters
    ----------
    drop : Drop
        The base drop.
    rows : mapping
        The numbers that vary, by `Number`, (count,) each.
    count : int
        The number of drops.
    options : Options
        Of each run.

    Returns
    -------
    Solved

    Examples
    --------
    >>> import stackbounce as sb
    >>> from stackbounce.run.options import run_options
    >>> drop = sb.Drop([sb.Ball(1.0)], [sb.Rigid(0.5)], impact_speed=2.0)
    >>> found = solve_quantities(drop, {}, 1, run_options(drop, None, 1e-12, 1000)).tables
    >>> found["rebound_speeds"], found["energy_retained"]
    (array([[1.]]), array([[0.25]]))
    """
    out = solve(drop, rows, (count,), options)
    speed, gravity = incidence(drop, rows, count)
    solved = (out.status != Status.EVENT_LIMIT) & (out.status != Status.INVALID)
    found = {}
    with np.errstate(all="ignore"):
        for name, quantity in QUANTITIES.items():
            table = np.reshape(quantity.predict(out, speed, gravity), (count, -1))
            if table.dtype.kind == "f":
                table = np.where(np.isfinite(table) & solved[:, None], table, np.nan)
            found[name] = table
    return Solved(found, out.status, out.work)
