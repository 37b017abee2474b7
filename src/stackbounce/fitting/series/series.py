"""A dataset as a series: restitutions at several speeds, with a covariance.

Each kind of table has a formula, which is chosen by the names of its columns.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from stackbounce.errors import InvalidValue
from stackbounce.library_types import Dataset
from stackbounce.model import drag as in_air
from stackbounce.model.drop import STANDARD_GRAVITY
from stackbounce.run.quantities import Array

_AIR_DENSITY = 1.2  # kg/m**3
DRAG_COEFFICIENT, _DRAG_ERROR = 0.45, 0.05
"""Of a sphere, at the Reynolds numbers of falling balls, about 10**3 to 10**5: 0.4 to 0.5."""

Scatter = tuple[Array, float]  # a covariance from the scatter of readings, degrees of freedom

_Points = tuple[Array, Array]  # speeds and values
_Transform = Callable[[float, dict[str, Array]], _Points]  # of a drag in 1/m and columns
_STEP = 1e-6  # relative, of a numerical derivative


@dataclass(frozen=True)
class Series:
    """The restitution of one ball as a function of its impact speed.

    Parameters
    ----------
    name, title, ball : str
        Of the dataset.
    speeds, values : array
        Impact speeds in m/s and the values, (n,).
    published, assumed : array
        Covariances of the values, (n, n): from errors that the source gives or from the scatter of
        its readings, and from errors that are assumed, that of the drag among them.
    drag : float
        k of `stackbounce.model.drag` in 1/m; 0 if the air was left out.
    scatters : tuple of (array, float), optional
        The parts of `published` that are estimated from the scatter of readings, (n, n), each with
        its degrees of freedom.
    from_heights : bool, optional
        Whether the speeds follow from heights of falls.
    """

    name: str
    title: str
    ball: str
    speeds: Array
    values: Array
    published: Array
    assumed: Array
    drag: float
    scatters: tuple[Scatter, ...] = ()
    from_heights: bool = False

    @property
    def heights(self) -> Array:
        """The heights of the falls in m that have the impact speeds, (n,)."""
        return self.heights_of(self.speeds)

    def heights_of(self, speeds: Array) -> Array:
        """Return the heights of falls that end with some speeds.

        Parameters
        ----------
        speeds : ndarray
            In m/s.

        Returns
        -------
        ndarray
            In m.
        """
        return _each(in_air.fall_height, self.drag, speeds)

    def covariance(self, scale: float = 1.0) -> Array:
        """Return the covariance of the values.

        Parameters
        ----------
        scale : float, optional
            By which the assumed errors are multiplied.
        """
        return self.published + scale**2 * self.assumed

    def freedom(self, scale: float = 1.0) -> float:
        """Return the degrees of freedom of the covariance; infinite if no scatter is part of it.

        They are the effective ones of Satterthwaite (Biometrics Bull. 2, 110, 1946): of each part,
        its share of the covariance squared, over its degrees of freedom, adds to one over them.

        Parameters
        ----------
        scale : float, optional
            By which the assumed errors are multiplied.
        """
        whole = self.covariance(scale)
        inverse = 0.0
        for part, freedom in self.scatters:
            inverse += (np.trace(np.linalg.solve(whole, part)) / len(part)) ** 2 / freedom
        return float(1.0 / inverse) if inverse else math.inf

    @property
    def has_assumed_errors(self) -> bool:
        """Return whether some of the errors are assumed."""
        return bool(np.any(self.assumed != 0.0))


def why_not(data: Dataset) -> str:
    """Return why a dataset is no series; empty if it is one."""
    if data.attrs.get("kind") == "rule":
        return "it has the limits of rules, no measurement"
    if data.sizes["row"] < 2:
        return "it has one value only"
    if _columns_of(data) or {"flight", "flight_time"} <= set(data):
        return ""
    return "it has no restitutions of one ball at known speeds"


def make_series(data: Dataset, *, air: bool = True) -> Series:
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
    drag = _drag_of_ball(data) if air else 0.0
    found = _points(drag, data)
    if drag:  # it is not known well, and changes all values together
        more = 1.0 + _DRAG_ERROR / DRAG_COEFFICIENT
        shift = _points(more * drag, data).values - found.values
        found = found._replace(assumed=found.assumed + np.outer(shift, shift))
    about = {key: data.attrs[key] for key in ("name", "title", "ball")}
    if found.values.max() >= 1.0:
        raise InvalidValue("a restitution is 1 or more, which no law with a loss gives")
    heights = not {"drop_height", "apex_height"}.isdisjoint(data)
    return Series(**about, **found._asdict(), drag=drag, from_heights=heights)


class _Measured(NamedTuple):
    """Speeds, values, and the covariances of these, as those of a `Series`."""

    speeds: Array
    values: Array
    published: Array
    assumed: Array
    scatters: tuple[Scatter, ...]


def _points(drag: float, data: Dataset) -> _Measured:
    columns = _columns_of(data)
    return _propagated(columns, drag, data) if columns else _flights(drag, data)


def _drag_of_ball(data: Dataset) -> float:
    """Return the drag of a dataset's ball in 1/m; 0 if its mass or its diameter is not known."""
    if not {"mass", "diameter"} <= set(data.attrs):
        return 0.0
    sphere = in_air.sphere_drag(_AIR_DENSITY, DRAG_COEFFICIENT, data.attrs["diameter"])
    return sphere / float(data.attrs["mass"])


def _each(formula: Callable[[float, float, float], float], drag: float, values: Array) -> Array:
    try:
        return np.asarray(np.vectorize(formula, otypes=[float])(drag, values, STANDARD_GRAVITY))
    except ArithmeticError as error:
        raise InvalidValue(
            "mass and diameter must be those of a ball that can fly so far, got "
            f"{drag:.3g} 1/m of drag: its speed would be out of all range"
        ) from error


def _speeds_of_flight(drag: float, time: Array) -> tuple[Array, Array]:
    """Return the speeds in m/s at the start and at the end of flights of some times in s."""
    leaving = _each(in_air.flight_speed, drag, time)
    return leaving, _each(in_air.landing_speed, drag, leaving)


def _rebounds(drag: float, given: dict[str, Array]) -> _Points:
    before = _each(in_air.fallen_speed, drag, given["drop_height"])
    return before, _each(in_air.launch_speed, drag, given["rebound_height"]) / before


def _ratios(drag: float, given: dict[str, Array]) -> _Points:
    """Take a published restitution for the root of a ratio of heights."""
    rebound = given["restitution"] ** 2 * given["drop_height"]
    return _rebounds(drag, given | {"rebound_height": rebound})


def _drops(drag: float, given: dict[str, Array]) -> _Points:
    """Take the heights after several bounces of each drop: a ball falls from where it rose to."""
    begins = np.append(True, np.diff(np.rint(1e6 * given["drop"])) != 0.0)
    before = np.where(begins, given["drop_height"], np.roll(given["rebound_height"], 1))
    return _rebounds(drag, {"drop_height": before, "rebound_height": given["rebound_height"]})


def _apexes(drag: float, given: dict[str, Array]) -> _Points:
    heights = given["apex_height"]
    return _rebounds(drag, {"drop_height": heights[:-1], "rebound_height": heights[1:]})


def _speed_ratios(_: float, given: dict[str, Array]) -> _Points:
    return given["impact_speed"], given["rebound_speed"] / given["impact_speed"]


def _knocks(drag: float, given: dict[str, Array]) -> _Points:
    leaving, landing = _speeds_of_flight(drag, np.diff(given["knock_time"]))
    before = np.append(_each(in_air.fallen_speed, drag, given["drop_height"][:1]), landing[:-1])
    return before, leaving / before


def _blocks(_: float, given: dict[str, Array]) -> _Points:
    """Take the restitution of the slope of the mean flight, which is ``e - 1`` per unit of time."""
    flight = (given["end"] - given["start"]) / given["flights"]
    middle = 0.5 * (given["start"] + given["end"])
    speed = 0.25 * STANDARD_GRAVITY * (flight[1:] + flight[:-1])
    return speed, 1.0 + np.diff(flight) / np.diff(middle)


_FORMULAS: dict[tuple[str, ...], _Transform] = {
    ("drop", "drop_height", "rebound_height"): _drops,
    ("drop_height", "rebound_height"): _rebounds,
    ("drop_height", "knock_time"): _knocks,
    ("drop_height", "restitution"): _ratios,
    ("impact_speed", "restitution"): lambda _, given: (given["impact_speed"], given["restitution"]),
    ("impact_speed", "rebound_speed"): _speed_ratios,
    ("apex_height",): _apexes,
    ("start", "end", "flights"): _blocks,
}


def _columns_of(data: Dataset) -> tuple[str, ...]:
    """Return the columns that a formula takes; empty if none does."""
    return next((columns for columns in _FORMULAS if set(columns) <= set(data)), ())


def _propagated(names: tuple[str, ...], drag: float, data: Dataset) -> _Measured:
    """Return speeds, values and their covariances, by the derivatives by each number given."""
    transform, columns = _FORMULAS[names], {name: _read(data, name) for name in names}
    given = {name: column.means for name, column in columns.items()}
    speeds, values = transform(drag, given)
    published, assumed = np.zeros((2, values.size, values.size))
    scatters: list[Scatter] = []
    for name, column in columns.items():
        slopes = _slopes(transform, drag, given, name)
        published += (slopes * column.variances) @ slopes.T
        assumed += column.assumed**2 * slopes @ slopes.T
        if column.freedom:
            scatters.append(((slopes * column.scatter) @ slopes.T, column.freedom))
    published += sum(part for part, _ in scatters)
    return _Measured(speeds, values, published, assumed, tuple(scatters))


def _slopes(transform: _Transform, drag: float, given: dict[str, Array], name: str) -> Array:
    """Return the derivatives (values, rows) of the values by the numbers of a column."""
    sizes = np.abs(given[name])
    steps = _STEP * np.where(sizes > 0.0, sizes, _STEP)
    rows = given[name] + np.concatenate([np.diag(steps), np.diag(-steps)])
    values = np.array([transform(drag, given | {name: row})[1] for row in rows])
    larger, smaller = np.split(values, 2)
    return np.asarray((larger - smaller).T / (2.0 * steps))


class _Column(NamedTuple):
    """The means of a column, and their variances: as given, of the scatter, and assumed.

    The scatter of one reading is the same in all rows: few readings tell it badly. `freedom` are
    its degrees of freedom.
    """

    means: Array
    variances: Array
    scatter: Array
    freedom: float
    assumed: float


def pooled_variance(values: Array) -> tuple[float, int]:
    """Return the variance of repeated readings about the means of their rows, and its freedom.

    Rows with fewer readings than others end with NaN.

    Examples
    --------
    >>> pooled_variance(np.array([[1.0, 3.0], [2.0, np.nan]]))
    (2.0, 1)
    """
    apart = values - np.nanmean(values, axis=1, keepdims=True)
    freedom = int(np.isfinite(values).sum()) - len(values)
    return float(np.nansum(apart**2)) / freedom, freedom


def _read(data: Dataset, name: str) -> _Column:
    variable = data[name]
    values = np.asarray(variable.values, dtype=np.float64)
    scatter, freedom = np.zeros(len(values)), 0.0
    if values.ndim == 2:
        variance, freedom = pooled_variance(values)
        scatter = variance / np.isfinite(values).sum(axis=1)
        values = np.nanmean(values, axis=1)
    errors = data[f"{name}_error"].values if f"{name}_error" in data else np.zeros(values.size)
    assumed = variable.attrs.get("assumed_error", 0.0)
    return _Column(values, np.asarray(errors) ** 2, scatter, freedom, assumed)


def _flights(drag: float, data: Dataset) -> _Measured:
    """Return the restitutions of all bounces between two flights, averaged over the throws.

    Neighbouring bounces share a flight, so that their errors are correlated. Variance and
    covariance are those of the throws, taken together for all bounces. Correlated errors tell the
    variance worse: n of them as n / (1 + 2 r**2) others, with the correlation r of neighbours.
    """
    leaving, landing = _speeds_of_flight(drag, data.flight_time.values)
    # the rows whose flight follows that of the row above
    after = np.flatnonzero(np.diff(data.flight.values) == 1) + 1
    ratios = leaving[after] / landing[after - 1]
    values = ratios.mean(axis=1)
    apart = ratios - values[:, None]
    bounces, throws = ratios.shape
    variance = np.mean(apart**2) * throws / (throws - 1.0)
    next_too = np.flatnonzero(np.diff(after) == 1)
    shared = np.mean(apart[next_too] * apart[next_too + 1]) * throws / (throws - 1.0)
    covariance = np.diag(np.full(bounces, variance))
    covariance[next_too, next_too + 1] = covariance[next_too + 1, next_too] = shared
    covariance /= throws
    freedom = bounces * (throws - 1.0) / (1.0 + 2.0 * float(shared / variance) ** 2)
    speeds, scatters = landing[after - 1].mean(axis=1), ((covariance, freedom),)
    return _Measured(speeds, values, covariance, np.zeros_like(covariance), scatters)
