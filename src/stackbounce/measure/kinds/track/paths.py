"""A track's columns -> heights against time: which way is up, and the flights in them."""

import math
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from stackbounce.errors import InvalidType, InvalidValue
from stackbounce.measure.kinds.track.motion import accelerations, own_noise
from stackbounce.measure.kinds.track.parabolas import Flight, Parabolas, find_flights, unexplained
from stackbounce.measure.quantities import Array
from stackbounce.measure.samples import columns, resolution, spikes
from stackbounce.measure.statistics.ar_noise import difference_noise

_LEAST_MOTION = 0.03  # of the range of a track, within a window that tells an acceleration
_CLEAR_JUMP = 5.0  # standard errors of a velocity's jump that may be a bounce
_LEAST_JUMP = 0.1  # of the largest jump; smaller ones are caused by a hand
_ROUNDS = 4  # of cutting the track, each with the acceleration and error of the one before
_MOST_POINTS = 10_000  # of a track; of more, means of neighbours are taken
_FEWEST = 4  # points, of which none can be told to stand apart
_AT_ONCE = 4  # one in so many of the weakest jumps is taken out before the next fit
_WIDTHS = (3, 5, 7, 11, 17, 25)  # points of a window
_SEEN_FALL = 4.0  # errors of a point by which a ball has fallen where its flight begins
_LEAST_FALL = 5  # points that a fall keeps
_ALIKE = 0.05  # relative difference of two accelerations that are one guess
_DIFFER = 1.5  # scatter around one acceleration, over that around each flight's own
_BESIDE = 3  # points between two pieces of one flight, at most


Bounced: TypeAlias = tuple[Parabolas, list[int]]
"""The flights of a ball, and after which of them it bounces."""


class Columns(NamedTuple):
    """Times (N,) in s and, for each ball, its name and positions by axis, (N,) in m.

    Of a very long track each is the mean of `many` neighbours. So many points `apart` from their
    neighbours are missing.
    """

    times: Array
    names: list[str]
    positions: list[dict[str, Array]]
    many: int = 1
    apart: int = 0


class Upward(NamedTuple):
    """The vertical: the axis, its sign, and the angle by which it is off, in radians."""

    axis: str
    sign: float
    tilt: float = 0.0

    def heights(self, position: dict[str, Array]) -> Array:
        """Return heights from positions."""
        along = self.sign * position[self.axis]
        if not self.tilt:
            return along
        across = position["x" if self.axis == "y" else "y"]
        return math.cos(self.tilt) * along + math.sin(self.tilt) * across


def positions_of(data: Any) -> Columns:
    """Return times and positions of a Dataset or plain arrays."""
    if hasattr(data, "data_vars"):
        found = _from_dataset(data)
    else:
        axes = ("x", "y") if hasattr(data, "__len__") and len(data) == 3 else ("y",)
        times, *own = columns(data, ("time", *axes))
        found = Columns(times, ["ball"], [dict(zip(axes, own, strict=True))])
    good = np.isfinite(found.times)
    times = found.times[good]
    if len(times) < 4 or (np.diff(times) <= 0.0).any():
        raise InvalidValue(
            f"times must ascend and be at least 4, got {len(times)}"
            + " that do not ascend" * (len(times) > 3)
        )
    if not found.positions:
        raise InvalidValue("data must hold the track of a ball, got none")
    apart = sum(map(_leave_out, found.positions))
    many = -(-len(times) // _MOST_POINTS)
    kept = np.flatnonzero(good)[: len(times) // many * many].reshape(-1, many)
    # means of neighbours on a parabola lie on one, too
    positions = [
        {axis: values[kept].mean(axis=1) for axis, values in own.items()} for own in found.positions
    ]
    return Columns(found.times[kept].mean(axis=1), found.names, positions, many, apart)


def _leave_out(position: dict[str, Array]) -> int:
    """Make points that stand apart from both neighbours missing; return how many."""
    apart = set[int]()
    for values in position.values():
        known = np.flatnonzero(np.isfinite(values))
        if known.size > _FEWEST:
            apart.update(known[spikes(values[known])].tolist())
    for axis, values in position.items():
        position[axis] = values.copy()
        position[axis][list(apart)] = np.nan
    return len(apart)


def _from_dataset(data: Any) -> Columns:
    axes = [axis for axis in ("x", "y") if axis in data.data_vars]
    if not axes:
        held = ", ".join(map(str, data.data_vars)) or "none"
        raise InvalidType(f"data must hold variables x and y of a track, got {held}")
    times = np.asarray(data["time"].values, dtype=np.float64)
    if "track" not in data[axes[0]].dims:
        data = data[axes].expand_dims(track=["ball"])
    positions = [
        {axis: data[axis].isel(track=k).values.astype(float) for axis in axes}
        for k in range(data.sizes["track"])
    ]
    return Columns(times, [str(name) for name in data["track"].values], positions)


def upward(found: Columns, gravity: float) -> Upward:
    """Return the upward direction: the one in which constant downward acceleration fits best."""
    gains: dict[Upward, float] = {}
    for name in sorted(found.positions[0], reverse=True):  # y first, where nothing falls
        each = [_gains(found.times, position[name], gravity) for position in found.positions]
        up, down = map(sum, zip(*each, strict=True))
        gains |= {Upward(name, 1.0): up, Upward(name, -1.0): down}
    return max(gains, key=gains.__getitem__)


def _gains(times: Array, heights: Array, gravity: float) -> tuple[float, float]:
    """Return by how much flights explain a track better than none, upward and downward."""
    good = np.isfinite(heights)
    if good.sum() < 5 or np.ptp(heights[good]) == 0.0:
        return 0.0, 0.0
    times, heights = times[good], heights[good]
    falls = _guesses(times, heights, gravity)
    both = np.concatenate([[0.0], falls, -_guesses(times, -heights, gravity)])
    none, *costs = unexplained(times, heights, noise_of(heights), both).tolist()
    return none - min(costs[: len(falls)]), none - min(costs[len(falls) :])


def _guesses(times: Array, heights: Array, gravity: float) -> Array:
    """Return accelerations to try: gravity, gravity/16 (fourfold slow motion), those of windows."""
    guesses = [gravity, gravity / 16.0]
    for wide in _WIDTHS:
        falls = -accelerations(times, heights, wide, _LEAST_MOTION * float(np.ptp(heights)))
        usual = float(np.median(falls)) if len(falls) else 0.0
        if usual > 0.0 and all(abs(usual / other - 1.0) > _ALIKE for other in guesses):
            guesses.append(usual)
    return np.array(guesses)


def flights_of(times: Array, heights: Array, gravity: float) -> Bounced | None:
    """Return the flights of a ball, and after which of them it bounces, None where it never does.

    The acceleration is fitted, as the frame rate and the scale of the track may be wrong.
    """
    sigma = noise_of(heights)
    guesses = _guesses(times, heights, gravity)
    acceleration = float(guesses[np.argmin(unexplained(times, heights, sigma, guesses))])
    found: Bounced | None = None
    for _ in range(_ROUNDS):
        found = _joined(times, heights, find_flights(times, heights, sigma, acceleration))
        if found is None:
            return None
        new, wider = found[0].fall, max(_noise_floor(heights), _spread(found[0]))
        steady = abs(new / acceleration - 1.0) < 1e-3 and abs(wider / sigma - 1.0) < 0.05
        if steady:
            break
        acceleration, sigma = new, wider
    return found and (Parabolas(times, heights, _released(*found)), found[1])


def _spread(fitted: Parabolas) -> float:
    """Return the error of a point; where flights differ in acceleration, that beside their own."""
    own = own_noise(fitted.times, fitted.heights, fitted.flights)
    return own if fitted.sigma > _DIFFER * own else fitted.sigma


def _released(fitted: Parabolas, bounces: list[int]) -> list[Flight]:
    """Return the flights, less the first points of a fall that follows a rest.

    Just after its release a ball has moved by less than the error of a point. Such a point may
    belong to the rest or to the flight, and choosing by the fit would bias the parabola.
    """
    flights = list(fitted.flights)
    fall = float(fitted.values[0])
    for j in bounces:
        first, last = flights[j]
        if j - 1 in bounces or first == 0:
            continue
        apex = fitted.origins[j] + fitted.values[2 + 2 * j] / fall
        after = apex + math.sqrt(2.0 * _SEEN_FALL * fitted.sigma / fall)
        start = max(first, int(np.searchsorted(fitted.times, after)))
        if last - start >= _LEAST_FALL:
            flights[j] = Flight(start, last)
    return flights


def noise_of(heights: Array) -> float:
    """Return the error of a point from third differences, most of which lie within one flight."""
    return max(difference_noise(heights, 3), _noise_floor(heights))


def _noise_floor(heights: Array) -> float:
    """Return the least error of a point, that of rounding to pixels or digits."""
    return max(resolution(heights) / math.sqrt(12.0), 1e-5 * float(np.ptp(heights)), 1e-12)


def _joined(times: Array, heights: Array, flights: list[Flight]) -> Bounced | None:
    """Return the fit of the flights, joined where no bounce separates them, and the bounces."""
    while flights:
        fitted = Parabolas(times, heights, flights)
        if fitted.freedom < 1 or fitted.fall <= 0.0:
            return None
        jumps, errors, before = fitted.jumps()
        size = np.abs(jumps)
        weak = np.flatnonzero(size < _CLEAR_JUMP * errors)
        if not weak.size:
            weak = _small(fitted, jumps)
        if weak.size:
            flights = _united(flights, weak[np.argsort(size[weak])])
            continue
        bouncing = (before < 0.0) & (before + jumps > 0.0)
        bounces = np.flatnonzero(bouncing & (jumps > _LEAST_JUMP * jumps.max(initial=0.0))).tolist()
        used = sorted({j for b in bounces for j in (b, b + 1)})
        if not used:
            return None
        if len(used) == len(flights):
            return fitted, bounces
        flights = [flights[j] for j in used]
    return None


def _small(fitted: Parabolas, jumps: Array) -> NDArray[np.intp]:
    """Return the jumps within a flight that a scale which changes makes.

    A lens, or a distance to the camera that changes, gives the pieces of one flight accelerations
    of their own. The pieces of a hand are shorter, or apart.
    """
    first, last = fitted.firsts, fitted.lasts
    count = last - first
    beside = (first[1:] - last[:-1] <= _BESIDE) & (np.minimum(count[:-1], count[1:]) > _LEAST_FALL)
    return np.flatnonzero(beside & (np.abs(jumps) < _LEAST_JUMP * jumps.max(initial=0.0)))


def _united(flights: list[Flight], weakest: NDArray[np.intp]) -> list[Flight]:
    """Return the flights, the first of the weakest jumps taken out; none beside another."""
    taken: set[int] = set()
    for j in weakest[: max(1, len(weakest) // _AT_ONCE)].tolist():
        if j - 1 not in taken and j + 1 not in taken:
            taken.add(j)
    rest = [flight for j, flight in enumerate(flights) if j not in taken and j - 1 not in taken]
    return sorted([*rest, *(Flight(flights[j].first, flights[j + 1].last) for j in taken)])
