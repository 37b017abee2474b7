"""A dataset as a series: restitutions or contact times at several speeds, with a covariance.

Each kind of table has a `View`, which is chosen by the names of its columns.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from stackbounce.validation.fall import (
    DRAG_COEFFICIENT,
    DRAG_ERROR,
    GRAVITY,
    Array,
    Fall,
    through_air,
)

if TYPE_CHECKING:
    import xarray as xr

__all__ = ["CONTACT_TIME", "RESTITUTION", "Series", "make_series", "why_not"]

RESTITUTION, CONTACT_TIME = "restitution", "contact time"

_Points = tuple[Array, Array]  # speeds and values
_Transform = Callable[[Fall, dict[str, Array]], _Points]
_STEP = 1e-6  # relative, of a numerical derivative


@dataclass(frozen=True)
class Series:
    """A quantity of one ball as a function of its impact speed.

    Parameters
    ----------
    name, title, ball : str
        Of the dataset.
    quantity : str
        `RESTITUTION` or `CONTACT_TIME`.
    speeds, values : array
        Impact speeds in m/s and the values, (n,).
    published, assumed : array
        Covariances of the values, (n, n): from errors that the source gives or from the scatter of
        its readings, and from errors that are assumed, that of the drag among them.
    drag : float
        In 1/m, as in `Fall`; 0 if the air was left out.
    restitution : float, optional
        The restitution that goes with contact times.
    """

    name: str
    title: str
    ball: str
    quantity: str
    speeds: Array
    values: Array
    published: Array
    assumed: Array
    drag: float
    restitution: float | None = None

    def covariance(self, scale: float = 1.0) -> Array:
        """Return the covariance of the values.

        Parameters
        ----------
        scale : float, optional
            By which the assumed errors are multiplied.
        """
        return self.published + scale**2 * self.assumed

    @property
    def has_assumed_errors(self) -> bool:
        """Whether some of the errors are assumed."""
        return bool(np.any(self.assumed != 0.0))


@dataclass(frozen=True)
class _View:
    """How a table with some columns becomes a series."""

    columns: tuple[str, ...]
    quantity: str
    transform: _Transform


def why_not(data: "xr.Dataset") -> str:
    """Return why a dataset is no series; empty if it is one."""
    if data.attrs["kind"] == "rule":
        return "it has the limits of rules, no measurement"
    if data.sizes["row"] < 2:
        return "it has one value only"
    if _view_of(data) is not None or {"flight", "flight_time"} <= set(data):
        return ""
    return "it has no restitutions or contact times of one ball at known speeds"


def make_series(data: "xr.Dataset", *, air: bool = True) -> Series:
    """Return a dataset as a series.

    Parameters
    ----------
    data : xarray.Dataset
        As `stackbounce.datasets.load` returns it, with an empty `why_not`.
    air : bool, optional
        Whether to correct heights and flights for the drag of the air, where mass and diameter of
        the ball are known.

    Returns
    -------
    Series
    """
    fall = (through_air(data.attrs) if air else None) or Fall()
    speeds, values, published, assumed = _points(fall, data)
    if fall.drag:  # the drag is not known well, and changes all values together
        more = 1.0 + DRAG_ERROR / DRAG_COEFFICIENT
        shift = _points(Fall(more * fall.drag), data)[1] - values
        assumed = assumed + np.outer(shift, shift)
    view = _view_of(data)
    quantity = RESTITUTION if view is None else view.quantity
    kept = data.get("restitution") if quantity == CONTACT_TIME else None
    return Series(
        name=data.attrs["name"],
        title=data.attrs["title"],
        ball=data.attrs["ball"],
        quantity=quantity,
        speeds=speeds,
        values=values,
        published=published,
        assumed=assumed,
        drag=fall.drag if quantity == RESTITUTION else 0.0,
        restitution=None if kept is None else float(kept[0]),
    )


def _points(fall: Fall, data: "xr.Dataset") -> tuple[Array, Array, Array, Array]:
    """Return speeds, values and their covariances, from known and from assumed errors."""
    view = _view_of(data)
    if view is not None:
        return _propagated(view, fall, data)
    speeds, values, published = _flights(fall, data)
    return speeds, values, published, np.zeros_like(published)


def _rebounds(fall: Fall, given: dict[str, Array]) -> _Points:
    before = fall.landing_speed(given["drop_height"])
    return before, fall.leaving_speed(given["rebound_height"]) / before


def _ratios(fall: Fall, given: dict[str, Array]) -> _Points:
    """Take a published restitution for the root of a ratio of heights."""
    rebound = given["restitution"] ** 2 * given["drop_height"]
    return _rebounds(fall, given | {"rebound_height": rebound})


def _apexes(fall: Fall, given: dict[str, Array]) -> _Points:
    heights = given["apex_height"]
    return _rebounds(fall, {"drop_height": heights[:-1], "rebound_height": heights[1:]})


def _at_speeds(_: Fall, given: dict[str, Array]) -> _Points:
    return given["impact_speed"], given["restitution"]


def _knocks(fall: Fall, given: dict[str, Array]) -> _Points:
    leaving, landing = fall.flight(np.diff(given["knock_time"]))
    before = np.append(fall.landing_speed(given["drop_height"][:1]), landing[:-1])
    return before, leaving / before


def _blocks(_: Fall, given: dict[str, Array]) -> _Points:
    """Take the restitution of the slope of the mean flight, which is ``e - 1`` per unit of time."""
    flight = (given["end"] - given["start"]) / given["flights"]
    middle = 0.5 * (given["start"] + given["end"])
    speed = 0.25 * GRAVITY * (flight[1:] + flight[:-1])
    return speed, 1.0 + np.diff(flight) / np.diff(middle)


def _contacts(fall: Fall, given: dict[str, Array]) -> _Points:
    return fall.landing_speed(given["drop_height"]), given["contact_time"]


_VIEWS = (
    _View(("drop_height", "contact_time"), CONTACT_TIME, _contacts),
    _View(("drop_height", "rebound_height"), RESTITUTION, _rebounds),
    _View(("drop_height", "knock_time"), RESTITUTION, _knocks),
    _View(("drop_height", "restitution"), RESTITUTION, _ratios),
    _View(("impact_speed", "restitution"), RESTITUTION, _at_speeds),
    _View(("apex_height",), RESTITUTION, _apexes),
    _View(("start", "end", "flights"), RESTITUTION, _blocks),
)


def _view_of(data: "xr.Dataset") -> _View | None:
    return next((view for view in _VIEWS if set(view.columns) <= set(data)), None)


def _propagated(view: _View, fall: Fall, data: "xr.Dataset") -> tuple[Array, Array, Array, Array]:
    """Return speeds, values and their covariances, by the derivatives by each number given."""
    given: dict[str, Array] = {}
    variances: dict[str, tuple[Array, Array]] = {}
    for name in view.columns:
        given[name], *both = _mean(data, name)
        variances[name] = (both[0], both[1])
    speeds, values = view.transform(fall, given)
    published, assumed = np.zeros((2, values.size, values.size))
    for name, (known, supposed) in variances.items():
        for i in np.flatnonzero(known + supposed):
            slope = _slope(view.transform, fall, given, name, int(i))
            published += known[i] * np.outer(slope, slope)
            assumed += supposed[i] * np.outer(slope, slope)
    return speeds, values, published, assumed


def _slope(transform: _Transform, fall: Fall, given: dict[str, Array], name: str, i: int) -> Array:
    step = _STEP * max(abs(given[name][i]), _STEP)
    ends = []
    for sign in (1.0, -1.0):
        moved = given[name].copy()
        moved[i] += sign * step
        ends.append(transform(fall, given | {name: moved})[1])
    slope: Array = (ends[0] - ends[1]) / (2.0 * step)
    return slope


def _mean(data: "xr.Dataset", name: str) -> tuple[Array, Array, Array]:
    """Return the means of a column, and their variances: known, and assumed."""
    variable = data[name]
    values = np.asarray(variable.values, dtype=np.float64)
    known = np.zeros(values.shape[0])
    if values.ndim == 2:  # the scatter is the same in all rows: few readings tell it badly
        known += np.mean(np.var(values, axis=1, ddof=1)) / values.shape[1]
        values = np.mean(values, axis=1)
    if f"{name}_error" in data:
        known = known + np.asarray(data[f"{name}_error"].values) ** 2
    return values, known, np.full(known.shape, variable.attrs.get("assumed_error", 0.0) ** 2)


def _flights(fall: Fall, data: "xr.Dataset") -> tuple[Array, Array, Array]:
    """Return the restitutions of all bounces between two flights, averaged over the throws.

    Neighbouring bounces share a flight, so that their errors are correlated. Variance and
    covariance are those of the throws, taken together for all bounces.
    """
    number = np.asarray(data.flight.values, dtype=int)
    leaving, landing = fall.flight(np.asarray(data.flight_time.values, dtype=np.float64))
    after = np.flatnonzero(np.diff(number) == 1) + 1  # whose flight follows that of the row above
    ratios = leaving[after] / landing[after - 1]
    values = ratios.mean(axis=1)
    apart = ratios - values[:, None]
    throws = ratios.shape[1]
    variance = np.mean(apart**2) * throws / (throws - 1.0)
    next_too = np.flatnonzero(np.diff(after) == 1)
    shared = np.mean(apart[next_too] * apart[next_too + 1]) * throws / (throws - 1.0)
    covariance: Array = np.diag(np.full(values.size, variance))
    covariance[next_too, next_too + 1] = covariance[next_too + 1, next_too] = shared
    speeds: Array = landing[after - 1].mean(axis=1)
    result: Array = covariance / throws
    return speeds, values, result
