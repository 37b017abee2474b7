"""The result of one run, and the quantities derived from it."""

import dataclasses
import enum
import functools
import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from stackbounce.engine import codes
from stackbounce.engine.ratios import energy_kept
from stackbounce.errors import InvalidValue, no_attribute
from stackbounce.files import shipped_table
from stackbounce.library_types import Dataset
from stackbounce.model import STANDARD_GRAVITY, Drop
from stackbounce.model.drawing import meetings, names_of
from stackbounce.run.conditioning import amplification, known_until
from stackbounce.run.paths import Array
from stackbounce.run.sideways import leave_sideways
from stackbounce.shown import Shown, Table
from stackbounce.units import numbers_in
from stackbounce.version import __version__

_COLUMNS = {  # of the log, by the field of an interval
    "start": codes.START,
    "end": codes.TIME,
    "peak_force": codes.PEAK_FORCE,
    "peak_compression": codes.PEAK_COMPRESSION,
    "impulse": codes.IMPULSE,
    "peak_time": codes.PEAK_TIME,
}
INTERVAL = np.dtype([("contact", "i8"), *((name, "f8") for name in _COLUMNS)])
_VELOCITIES = [(name, "f8") for name in ("lower_velocity", "upper_velocity")]
EVENT = np.dtype([("time", "f8"), ("contact", "i8"), ("kind", "U9"), *_VELOCITIES])
APEX = np.dtype([("ball", "i8"), ("time", "f8"), ("height", "f8")])
_PER_BALL = ("rebound_speed", "rebound_ratio", "rebound_height")
_PER_CONTACT = ("collisions", "first_touch", "last_release")
_SAMPLED = (  # of `Result.sample`: name, dimensions, unit
    ("position", ("ball", "time"), "m"),
    ("velocity", ("ball", "time"), "m/s"),
    ("force", ("contact", "time"), "N"),
    ("compression", ("contact", "time"), "m"),
    ("energy", ("time",), "J"),
)
ROUND_OFF = 1e-15
"""Relative error that a step without a tolerance adds to a speed."""

_KINDS = {codes.TOUCH: "touch", codes.RELEASE: "release", codes.COLLISION: "collision"}


@functools.cache
def _advice() -> Any:
    return shipped_table(__package__, "advice.toml")


class _Ending(enum.IntEnum):
    """How or why a run ended, by the engine's number."""

    @property
    def advice(self) -> str:
        """What it means and what can be done about it, in one line."""
        return str(_advice()[self.name])


class Status(_Ending):
    """How a run ended; `advice` says what to do about it.

    Examples
    --------
    >>> Status.TIME_REACHED.advice
    'the time asked for was reached first: raise until to see more'
    """

    FINISHED = codes.FINISHED
    SETTLED = codes.SETTLED
    COLLAPSED = codes.COLLAPSED
    TIME_REACHED = codes.TIME_REACHED
    EVENT_LIMIT = codes.EVENT_LIMIT
    INVALID = codes.INVALID


STOPPED = (Status.TIME_REACHED, Status.EVENT_LIMIT, Status.INVALID)
"""The statuses of runs that were stopped: at the time asked for, at a limit, or by an error."""


class Cause(_Ending):
    """Why a run met a limit; `advice` says what to do about it."""

    ENDLESS = codes.ENDLESS
    STIFF = codes.STIFF
    EXTREME = codes.EXTREME


@dataclasses.dataclass(frozen=True, eq=False, repr=False)
class Result(Shown):
    """The result of a run; made by `simulate`.

    It holds the log of events, not the motion between them: `sample`, and `apexes` by it, repeat
    the run. To sample at many times, pass them all in one call.

    Parameters
    ----------
    drop : Drop
        The drop that was run.
    status : Status
        How the run ended.
    end_time : float
        Time in s of the last event, or of the stop.
    final_velocities : sequence of float
        (N,) velocity of each ball, or of the centre of its body, in m/s at `end_time`, up-positive;
        nan if INVALID.
    log : sequence of float
        The engine's log, a row of `stackbounce.engine.codes.LOG_COLUMNS` numbers per event.
    infinite : sequence of int
        (N,) 1 for each contact that collided infinitely often.
    precision : float
        Relative error of each step of the run: `rtol` where a contact is nonlinear, else round-off.
    rerun : callable
        Repeats the run, with samples at the times given in s, and where they are given, with the
        standard deviation of relative errors of all numbers and the seed of these.
    work : int
        What the run cost, in the unit of `stackbounce.engine.work`.
    cause : Cause or None
        Why a limit was met, if one was.

    Examples
    --------
    >>> import stackbounce as sb
    >>> drop = sb.Drop([sb.Ball(0.057)], [sb.Spring(22500.0)], impact_speed=3.5)
    >>> result = sb.simulate(drop)
    >>> result.status.name, result.rebound_speeds.round(12), result.collisions
    ('FINISHED', array([3.5]), array([1]))
    """

    drop: Drop
    status: Status
    end_time: float
    final_velocities: Sequence[float]
    log: Sequence[float]
    infinite: Sequence[int]
    precision: float
    rerun: Callable[..., Any]
    work: int = 0
    cause: Cause | None = None

    if not TYPE_CHECKING:  # checkers know which attributes there are

        def __getattr__(self, name: str) -> Any:
            raise no_attribute(Result, name)

    def __getstate__(self) -> dict[str, Any]:
        """Return the fields only. Cached arrays are left out: unpickled ones would be writeable."""
        return {field.name: getattr(self, field.name) for field in dataclasses.fields(self)}

    @property
    def advice(self) -> str:
        """What the status means, why a limit was met, and what can be done about it, in one line.

        Examples
        --------
        >>> import stackbounce as sb
        >>> drop = sb.Drop([sb.Ball(1e-12), sb.Ball(1.0)], [sb.Spring(1.0)] * 2, impact_speed=1.0)
        >>> sb.simulate(drop, event_limit=100).advice[:76]
        'a limit was met, because masses or stiffnesses are of very different sizes, '
        """
        return self.cause.advice if self.cause else self.status.advice

    def _tables(self) -> Sequence[Table]:
        drop, speed = self.drop, self.rebound_speeds
        numbers = (drop.start_velocities, speed, self.rebound_ratios, self.rebound_heights)
        times_ms = (1e3 * self.first_touch, 1e3 * self.last_release)
        balls = [
            (name, *map(_short, own))
            for name, *own in zip(names_of(drop.balls), *numbers, strict=True)
        ]
        counts = ("∞" if count < 0 else str(count) for count in self.collisions)
        contacts = [
            (name, count, *map(_short, own))
            for name, count, *own in zip(meetings(drop.balls), counts, *times_ms, strict=True)
        ]
        speeds = ("upward speeds", "before m/s", "after m/s", "after/v0", "height m")
        times = ("contact", "collisions", "first touch ms", "last release ms")
        stopped = "" if self.status is Status.FINISHED else f", after {self.end_time:.4g} s"
        first = Table(f"Result of a drop {drop.incidence}{stopped}", speeds, balls[::-1])
        return first, Table("", times, contacts[::-1])

    def _drawing(self) -> str:
        return self.drop._drawing()

    @property
    def remarks(self) -> tuple[str, ...]:
        """The share of the energy that is left, and what the status means unless all is well."""
        kept = f"kinetic energy retained: {100.0 * self.energy_retained:.4g} %"
        well = self.status is Status.FINISHED
        return (kept,) if well else (kept, f"{self.status.name}: {self.advice}")

    @functools.cached_property
    def rebound_speeds(self) -> Array:
        """(N,) velocity of each ball after the impact, m/s, up-positive; nan if INVALID.

        That of a ball with a `Bond` is the velocity of the centre of its body.
        """
        return _frozen(np.array(self.final_velocities, dtype=float))

    @functools.cached_property
    def rebound_ratios(self) -> Array:
        """(N,) rebound speed of each ball over the impact speed v0."""
        speed = self.drop.reference_speed
        return _frozen(np.array([after / speed for after in self.final_velocities], dtype=float))

    @functools.cached_property
    def rebound_heights(self) -> Array:
        """(N,) how far each ball rises in m, without air; with a minus sign if it moves down.

        It is v²/(2 g) at the gravity of the drop, or 9.80665 m/s**2 if that is 0.

        Examples
        --------
        >>> import stackbounce as sb
        >>> sb.simulate(sb.stack("basketball", "tennis", height="1 m")).rebound_heights.round(3)
        array([0.144, 3.252])
        """
        return _frozen(heights_of(self.rebound_speeds, self.drop.gravity))

    @functools.cached_property
    def collisions(self) -> NDArray[np.int64]:
        """(N,) contact intervals that each contact had; -1 where infinitely many."""
        counts = np.bincount(self.intervals["contact"], minlength=len(self.drop.balls))
        return _frozen(np.where(np.array(self.infinite, dtype=bool), -1, counts).astype(np.int64))

    @functools.cached_property
    def intervals(self) -> NDArray[Any]:
        """A row per contact interval by its start: contact, start, end, peaks and impulse.

        Times are in s, `peak_force` in N, `peak_compression` in m, `impulse` in N s; `peak_time` is
        that of the peak force. A rigid collision has end = start and an infinite peak force; of
        infinitely many the first ones are listed. An interval that had not ended when the run
        stopped has an infinite end.
        """
        rows = self._rows[np.isin(self._rows[:, codes.KIND], (codes.RELEASE, codes.COLLISION))]
        out = np.empty(len(rows), dtype=INTERVAL)
        out["contact"] = rows[:, codes.CONTACT]
        for name, column in _COLUMNS.items():
            out[name] = rows[:, column]
        return _frozen(out[np.lexsort((out["contact"], out["start"]))])

    @functools.cached_property
    def events(self) -> NDArray[Any]:
        """A row per event in order: time (s), contact, kind, velocities (m/s) right after it.

        `kind` is ``"collision"`` for rigid stacks, ``"touch"`` or ``"release"`` for finite ones.
        `lower_velocity` is that of the ball below the contact (0 for the floor), `upper_velocity`
        that of the ball above it; all other balls keep theirs in a collision, so that every
        intermediate velocity of a sequence is here.
        """
        known = np.isin(self._rows[:, codes.KIND], list(_KINDS))
        rows = self._rows[known & np.isfinite(self._rows[:, codes.TIME])]
        out = np.empty(len(rows), dtype=EVENT)
        out["time"] = rows[:, codes.TIME]
        out["contact"] = rows[:, codes.CONTACT]
        out["kind"] = [_KINDS[int(kind)] for kind in rows[:, codes.KIND]]
        out["lower_velocity"] = rows[:, codes.LOWER_VELOCITY]
        out["upper_velocity"] = rows[:, codes.UPPER_VELOCITY]
        return _frozen(out)

    @functools.cached_property
    def first_touch(self) -> Array:
        """(N,) time in s of each contact's first touch; nan where it never touched."""
        return self._per_contact("start", np.fmin)

    @functools.cached_property
    def last_release(self) -> Array:
        """(N,) time in s at which each contact opened last; nan where it never touched."""
        return self._per_contact("end", np.fmax)

    @functools.cached_property
    def energy_retained(self) -> float:
        """Kinetic energy of all balls at the end over that at the start."""
        mass = [ball.mass for ball in self.drop.balls]
        return energy_kept(mass, list(self.drop.start_velocities), list(self.final_velocities))

    @functools.cached_property
    def conditioning(self) -> Array:
        """(N,) how many times an error of the drop's numbers is as large in each final speed.

        The standard deviation of the speed over the reference speed, divided by that of independent
        relative errors of all masses, stiffnesses and gaps, of the speed and of gravity. It is
        found by 20 more runs, at the first use. Exponents have no error here, nor has the
        restitution of `Rigid`; that of `RigidBySpeed` has one.

        An error that arises within the run, as `rtol` allows, can grow more than those of the
        numbers: where balls meet late and gently under gravity, an error of their slow approach
        shifts the time of the touch, and gravity makes another speed of that.

        Examples
        --------
        Balls that go on bouncing on each other multiply an error:

        >>> import stackbounce as sb
        >>> law = sb.HuntCrossley(1e6, 1.5, 0.2)
        >>> balls = [sb.Ball(0.1), sb.Ball(0.05), sb.Ball(0.02)]
        >>> drop = sb.Drop(balls, [law] * 3, gaps=[0.0, 1e-3], height=0.3, gravity=9.81)
        >>> [sb.simulate(drop, until=end).conditioning.round() for end in (0.3, 1.5)]
        [array([2., 2., 2.]), array([993.,  94., 225.])]
        """
        return _frozen(amplification(self.rerun, self.final_velocities, self.drop.reference_speed))

    @functools.cached_property
    def known_until(self) -> float:
        """Time in s up to which all speeds are known to a digit at least; infinite if to the end.

        From then on runs whose numbers differ by `precision` have speeds that differ by more than a
        tenth of the reference speed. It is found by further runs, to a thousandth of their time.

        Examples
        --------
        >>> import stackbounce as sb
        >>> balls = [sb.Ball(0.6), sb.Ball(0.06)]
        >>> sb.simulate(sb.Drop(balls, [sb.Spring(1e4)] * 2, impact_speed=1.0)).known_until
        inf
        """
        speed = self.drop.reference_speed
        return known_until(self.rerun, self.end_time, speed, self.conditioning, self.precision)

    @functools.cached_property
    def apexes(self) -> NDArray[Any]:
        """A row per highest point of a flight, in order: ball, time (s), height (m).

        The height is the ball's position, that of the centre for balls with bonds. Only gravity
        makes an apex; one that a run stopped before is not listed.
        """
        gravity = self.drop.gravity
        if gravity == 0.0:
            return _frozen(np.empty(0, dtype=APEX))
        last = self.end_time if self.status in STOPPED else math.inf
        flights, rows = [flight for flight in self._flights() if flight[1] <= last], []
        begun = self.sampled([start for _, start, _, _ in flights])
        masses = np.array([ball.mass for ball in self.drop.balls])
        for flight, (ball, start, velocity, end) in enumerate(flights):
            own, position = self._bodies == self._bodies[ball], begun["position"][ball, flight]
            if own.sum() > 1:
                position, velocity = (
                    np.average(begun[name][own, flight], weights=masses[own])
                    for name in ("position", "velocity")
                )
            top = start + velocity / gravity
            if velocity > 0.0 and top < end and top <= last:
                rows.append((ball, top, position + 0.5 * velocity**2 / gravity))
        rows.sort(key=lambda row: (row[1], row[0]))
        return _frozen(np.array(rows, dtype=APEX))

    def sideways(
        self, offsets: Mapping[int, Any] | None = None, speeds: Mapping[int, Any] | None = None
    ) -> Dataset:
        """Return how balls leave sideways that do not stand exactly above each other.

        To first order in the offsets, without friction, and without a run: the vertical motion is
        that of this run.

        Parameters
        ----------
        offsets : mapping, optional
            From balls to their offsets at the start in m, or texts with a unit; 0 for all others.
        speeds : mapping, optional
            From balls to their sideways speeds at the start in m/s, likewise.

        Returns
        -------
        xarray.Dataset
            By ball: `sideways_speed` (m/s), `angle` (rad, off the vertical) and `offset` (m) at the
            end of the run; `offset_at_top` and `landing` (m) where it flies on to its highest point
            and comes down to its height in a stack without gaps, nan where it does not. The
            attribute `remark` says where first order ends, and `error` estimates that of the
            sideways speeds, over the largest: a run of hundreds of contacts may have one above
            1e-9. Without arguments by (ball, moved):
            `transfer` (1/s), the sideways speed per offset of the ball that was moved, and
            `amplification`, the offset. ``np.linalg.svd(found.transfer)`` has the worst combination
            of offsets.

        Raises
        ------
        InvalidValue
            If a ball has no diameter, a contact is a `Bond`, or a number makes no sense; if the run
            is INVALID, met a limit, came to rest or had infinitely many collisions; if a
            compression exceeds the sum of two radii; if the sideways motion grows too fast to be
            followed.
        InvalidType
            If an argument has the wrong type.

        Examples
        --------
        A tennis ball that lies 1 mm off the middle of a basketball leaves at 1.7 degrees:

        >>> import stackbounce as sb
        >>> result = sb.simulate(sb.stack("basketball", "tennis", height="63 cm"))
        >>> np.degrees(result.sideways({1: "1 mm"}).angle[1]).round(2).item()
        1.65
        """
        return leave_sideways(self, offsets, speeds)

    def to_dataset(self) -> Dataset:
        """Return all numbers of the result as a Dataset, with units and names in attributes.

        Returns
        -------
        xarray.Dataset
            `rebound_speed`, `rebound_ratio` and `rebound_height` by ball; `collisions`,
            `first_touch` and `last_release` by contact; `energy_retained` and `status`. The rows of
            `intervals`, `events` and `apexes` have dimensions of their own, as in
            `interval_contact`, `interval_start` and `event_kind`. Those of `ball` alone are a table
            by ``ds[["rebound_speed", "rebound_height"]].to_dataframe()``.

        Examples
        --------
        >>> import stackbounce as sb
        >>> ds = sb.simulate(sb.stack("basketball", "tennis", height="1 m")).to_dataset()
        >>> ds[["rebound_speed", "rebound_height"]].to_dataframe().round(2)
              rebound_speed  rebound_height        name
        ball
        0              1.68            0.14  basketball
        1              7.99            3.25      tennis
        >>> ds.interval_peak_force.attrs
        {'long_name': 'interval peak force', 'units': 'N'}
        """
        import xarray as xr

        columns: dict[Any, Any] = {("ball", name): getattr(self, f"{name}s") for name in _PER_BALL}
        columns |= {("contact", name): getattr(self, name) for name in _PER_CONTACT}
        columns |= {("", "energy_retained"): self.energy_retained, ("", "status"): self.status}
        parts = {"interval": self.intervals, "event": self.events, "apex": self.apexes}
        for dim, rows in parts.items():
            columns |= {(dim, f"{dim}_{name}"): rows[name] for name in rows.dtype.names or ()}
        known = shipped_table(__package__, "units.toml")
        units = {name: unit for unit, names in known.items() for name in names.split()}
        variables = {}
        for (dim, name), values in columns.items():
            unit = units.get(name) or units.get(name.removeprefix(f"{dim}_"))
            attrs = {"long_name": name.replace("_", " ")} | ({"units": unit} if unit else {})
            variables[name] = (dim or (), values, attrs)
        places = np.arange(len(self.drop.balls))
        names = ("ball", [ball.name or "" for ball in self.drop.balls])
        coords: Any = {"ball": places, "contact": places, "name": names}
        attrs = {"stackbounce": __version__, "drop": self.drop.to_toml()}
        return xr.Dataset(variables, coords, attrs)

    def to_mapping(self) -> dict[str, Any]:
        """Return the result as a dict: status, speeds, ratios, collisions, energy.

        Examples
        --------
        >>> import stackbounce as sb
        >>> drop = sb.Drop([sb.Ball(0.057)], [sb.Spring(22500.0)], impact_speed=3.5)
        >>> sb.simulate(drop).to_mapping()["status"]
        'FINISHED'
        """
        arrays = ("rebound_speeds", "rebound_ratios", "collisions", "first_touch", "last_release")
        names = ("advice", *arrays, "energy_retained", "end_time")
        return {"status": self.status.name} | {name: getattr(self, name) for name in names}

    def sample(self, times: ArrayLike) -> Dataset:
        """Return positions, velocities, forces and energy at given times, by repeating the run.

        Parameters
        ----------
        times : array_like
            (T,) real numbers of seconds from 0 (the lowest ball's first touch), in any order.
            Beyond the end of the run the balls fly on.

        Returns
        -------
        xarray.Dataset
            `position` (m, up-positive, from where everything just touches) and `velocity` (m/s) by
            (ball, time); `force` (N) and `compression` (m, minus the gap while open) by
            (contact, time); `energy` (J) by time: kinetic, potential, and what the contacts would
            give back if they were unloaded now.

        Raises
        ------
        InvalidValue
            If a time is negative, not finite, masked, or beyond a run that was stopped.
        InvalidType
            If one is no real number.

        Examples
        --------
        >>> import stackbounce as sb
        >>> drop = sb.Drop([sb.Ball(1.0)], [sb.Spring(1.0)], impact_speed=2.0)
        >>> float(sb.simulate(drop).sample([0.5]).compression[0, 0].round(6))
        0.958851
        """
        import xarray as xr

        table = self.sampled(times)
        columns = {name: (dims, table[name], {"units": unit}) for name, dims, unit in _SAMPLED}
        part = np.arange(len(self.drop.balls))
        time = ("time", table["time"], {"units": "s"})
        coords: Any = {"time": time, "ball": part, "contact": part}
        attrs = {"stackbounce": __version__, "drop": self.drop.to_toml()}
        return xr.Dataset(columns, coords, attrs)

    def sampled(self, times: ArrayLike) -> dict[str, Array]:
        """Return what `sample` returns, in plain arrays, with the energy `stored` in each contact.

        Parameters
        ----------
        times : array_like
            As of `sample`, which also says what is raised.

        Returns
        -------
        dict of str to ndarray
            By the names of `sample`, and `stored` (contact, time) in J.

        Examples
        --------
        >>> import stackbounce as sb
        >>> drop = sb.Drop([sb.Ball(1.0)], [sb.Spring(1.0)], impact_speed=2.0)
        >>> sb.simulate(drop).sampled([0.5])["stored"].round(6)
        array([[0.459698]])
        """
        wanted = self._times(times)
        order = np.argsort(wanted, kind="stable")
        run = self.rerun(wanted[order].tolist())
        if len(wanted) and run.status == Status.EVENT_LIMIT and run.time < wanted.max():
            raise InvalidValue(
                f"times must be seconds up to {run.time:g}, got {wanted.max():g}: what vibrates on "
                "is followed from swing to swing, and the run met its limit of events"
            )
        samples = run.samples
        balls = len(self.drop.balls)
        tables = {"time": wanted}
        for name in ("position", "velocity", "compression", "force", "stored"):
            table = np.empty((balls, len(wanted)))
            table[:, order] = np.reshape(getattr(samples, name), (-1, balls)).T
            tables[name] = table
        mass = np.array([ball.mass for ball in self.drop.balls])[:, None]
        kinetic = 0.5 * mass * tables["velocity"] ** 2
        potential = mass * self.drop.gravity * tables["position"]
        tables["energy"] = np.sum(kinetic + potential + tables["stored"], axis=0)
        return tables

    @functools.cached_property
    def _rows(self) -> Array:
        rows = np.reshape(np.array(self.log, dtype=float), (-1, codes.LOG_COLUMNS))
        # the end of a clipped contact's interval is logged late, once its compression is gone
        return rows[np.argsort(rows[:, codes.TIME], kind="stable")]

    def _per_contact(self, field: str, choose: np.ufunc) -> Array:
        out = np.full(len(self.drop.balls), math.nan)
        choose.at(out, self.intervals["contact"], self.intervals[field])
        return _frozen(out)

    def _times(self, times: ArrayLike) -> Array:
        wanted: Array = numbers_in(times, "s", "times")
        stopped = self.status in STOPPED
        last = self.end_time if stopped else math.inf
        bad = wanted[~(np.isfinite(wanted) & (wanted >= 0.0) & (wanted <= last))]
        if len(bad):
            end = f" to the {last:g} s that the run reached" if stopped else ""
            raise InvalidValue(f"times must be seconds from 0{end}, got {bad[0]:g}")
        return wanted

    @functools.cached_property
    def _bodies(self) -> NDArray[np.intp]:
        """Return the body of each ball, by its lowest ball: bonds join balls to bodies."""
        bonds = [law is not None and law.pulls for law in self.drop.contacts]
        return np.maximum.accumulate(np.where(bonds, 0, np.arange(len(bonds))))

    def _flights(self) -> Iterator[tuple[int, float, float, float]]:
        """Yield the flights of all balls: ball, start, velocity of one of its body then, end.

        A body is in flight while all its contacts are open; one that is bonded to the floor never.
        """
        count = len(self.drop.balls)
        bodies = self._bodies.tolist()
        members = [[ball for ball in range(count) if bodies[ball] == body] for body in bodies]
        closed: list[set[int]] = [set() for _ in range(count)]
        if (floor := self.drop.contacts[0]) is not None and floor.pulls:
            closed[0].add(0)
        under_way = [(0.0, velocity) for velocity in self.drop.start_velocities]
        for row in self._rows[np.isfinite(self._rows[:, codes.TIME])].tolist():
            time, contact, kind = row[codes.TIME], int(row[codes.CONTACT]), row[codes.KIND]
            lower, upper = row[codes.LOWER_VELOCITY], row[codes.UPPER_VELOCITY]
            sides = [(contact - 1, lower), (contact, upper)]
            if kind == codes.JOINED:
                sides = [(b, upper) for b in range(contact - 1, int(row[codes.START]) + 1)]
            for ball, velocity in sides:
                if ball < 0:
                    continue
                body = bodies[ball]
                if not closed[body]:
                    yield from ((member, *under_way[body], time) for member in members[body])
                if kind == codes.TOUCH:
                    closed[body].add(contact)
                    continue
                closed[body].discard(contact)
                under_way[body] = (time, velocity)
        for ball, body in enumerate(bodies):
            if not closed[body]:
                yield (ball, *under_way[body], math.inf)


def heights_of(velocities: Any, gravity: Any) -> Array:
    """Return how far in m balls rise at velocities in m/s; with a minus sign if they move down.

    Where gravity in m/s**2 is 0, it is 9.80665 m/s**2.

    Examples
    --------
    >>> heights_of(np.array([2.0, -2.0]), np.array([10.0, 0.0])).round(3)
    array([ 0.2  , -0.204])
    """
    pull = np.where(np.greater(gravity, 0.0), gravity, STANDARD_GRAVITY)
    with np.errstate(all="ignore"):
        return np.asarray(velocities * np.abs(velocities) / (2.0 * pull))


def _frozen(array: NDArray[Any]) -> NDArray[Any]:
    array.flags.writeable = False
    return array


def _short(number: float) -> str:
    return "–" if math.isnan(number) else f"{number:.4g}".replace("inf", "∞")
