"""What is varied and what was measured -> residuals, for many trials at once."""

import math
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from stackbounce.engine.batch import Outcomes
from stackbounce.errors import InvalidType, InvalidValue
from stackbounce.fitting.measured import Measured
from stackbounce.fitting.parameters import Parameter, current, places
from stackbounce.fitting.quantities import QUANTITIES
from stackbounce.fitting.ties import Tie, tied
from stackbounce.model import Drop
from stackbounce.run.batch import solve
from stackbounce.run.columns import Rows, base_rows, check, fill
from stackbounce.run.driver import forces_at
from stackbounce.run.options import Options
from stackbounce.run.paths import Number, drop_at, numbers_of
from stackbounce.run.result import Status

__all__ = ["ABSENT", "Problem", "clock"]

Array: TypeAlias = NDArray[np.float64]

ABSENT = 1e4
"""The residual, in errors, of what a trial does not have: a touch that does not come."""

_EVENTS = 10_000  # of one trial: no measurement has so many
_DONE = (Status.FINISHED, Status.SETTLED, Status.COLLAPSED)


@dataclass(frozen=True, eq=False)
class Problem:
    """A fit to be made: drops, what was measured of each, what may vary.

    Parameters
    ----------
    drops : mapping of str to Drop
        By their names; one alone has an empty one.
    measured : mapping of str to Measured
        Of each drop.
    parameters : sequence of Parameter
        What is varied.
    ties : sequence of Tie
        What follows.
    rtol : float
        To which each trial is solved.
    unsolved : Counter
        How many runs came to no end so far, by the name of their `Status`: their residuals are
        those of what a trial does not have.

    Examples
    --------
    >>> import stackbounce as sb
    >>> from stackbounce.fitting.question import read_problem
    >>> drop = sb.Drop([sb.Ball(1.0)], [sb.Spring(1.0)], height=1.0)
    >>> vary = {"contacts.0.stiffness": (0.1, 10.0)}
    >>> problem = read_problem(drop, {"durations.0": "3.0 ± 0.1 s"}, vary, None, 1e-9)
    >>> problem.residuals(np.array([[0.0]])).round(3)  # pi seconds at 1 N/m
    array([[1.416]])
    """

    drops: Mapping[str, Drop]
    measured: Mapping[str, Measured]
    parameters: tuple[Parameter, ...]
    ties: tuple[Tie, ...]
    rtol: float
    unsolved: Counter[str] = field(default_factory=Counter, init=False)

    @property
    def spans(self) -> Array:
        """(parameters, 2) bounds in the coordinates that are searched."""
        return np.array([one.span for one in self.parameters])

    @property
    def priors(self) -> list[Parameter]:
        """The parameters of which something is known beforehand."""
        return [one for one in self.parameters if one.prior is not None]

    @property
    def records(self) -> list[str]:
        """The names of drops that have waveforms, each with a clock of its own."""
        return [key for key, measured in self.measured.items() if measured.waveforms]

    @property
    def size(self) -> int:
        """How many residuals there are."""
        numbers = sum(len(one.data) for one in self.measured.values()) + len(self.priors)
        waves = [wave for one in self.measured.values() for wave in one.waveforms]
        return numbers + sum(len(wave.times) for wave in waves)

    @property
    def linear(self) -> int:
        """How many baselines and scales of records are fitted besides the parameters."""
        waves = [wave for one in self.measured.values() for wave in one.waveforms]
        return sum(1 + wave.scaled for wave in waves)

    def values(self, x: Array) -> dict[str, Array]:
        """Return what trials vary, by name: (n, parameters) coordinates to (n,) numbers each."""
        return {one.name: one.value(x[:, k]) for k, one in enumerate(self.parameters)}

    def rows(self, key: str, x: Array) -> Rows:
        """Return the numbers of one drop in trials (n, parameters), checked to make drops."""
        layout, values = self._layouts[key], self.values(x)
        named = {name: array for name, array in values.items() if self._owner[name] in (None, key)}
        found: dict[Number, Array] = {}
        for name, number in layout.varied:
            found[number] = named[number.path] = named[name]
        follow = tied(layout.ties, layout.numbers, named)
        for tie in layout.ties:
            found[tie.number] = follow[tie.number.path]
        if layout.ties:
            try:
                check(self.drops[key], found, lambda _: "")
            except (InvalidValue, InvalidType) as error:
                formulas = ", ".join(f"{tie.number.path} = {tie.text}" for tie in layout.ties)
                raise type(error)(f"tie: {formulas} gives no drop: {error}".rstrip()) from error
        return found

    @cached_property
    def _owner(self) -> dict[str, str | None]:
        """The only drop that each parameter concerns; None where it is shared.

        A function of Python is not asked which it uses: it is given those of its own drop, and
        those that are shared.
        """
        found: dict[str, str | None] = {clock(key): key for key in self.drops}
        for one in self.parameters:
            at = {key for key, _ in places(self.drops, one.name)}
            at |= {tie.drop for tie in self.ties if tie.uses and one.name in tie.uses}
            numbers = bool(places(self.drops, one.name))
            found.setdefault(one.name, at.pop() if numbers and len(at) == 1 else None)
        return found

    def own(self, key: str) -> list[int]:
        """Return which parameters concern one drop alone."""
        return [k for k, one in enumerate(self.parameters) if self._owner[one.name] == key]

    def alone(self, key: str) -> "Problem":
        """Return the problem of one drop's data, with all parameters."""
        return replace(self, measured={key: self.measured[key]})

    @cached_property
    def _layouts(self) -> dict[str, "_Layout"]:
        return {key: _layout(self, key) for key in self.drops}

    def drop(self, key: str, x: Array) -> Drop:
        """Return one drop with the numbers of one trial (parameters,) in place."""
        rows = self.rows(key, x[None])
        return drop_at(self.drops[key], {number: float(array[0]) for number, array in rows.items()})

    def outcomes(self, key: str, x: Array) -> tuple[Outcomes, Array, Array]:
        """Return what comes of one drop in trials (n, parameters), impact speeds, gravity (n,)."""
        drop, rows = self.drops[key], self.rows(key, x)
        options = Options(math.inf, self.rtol, _EVENTS)
        out = solve(drop, rows, (len(x),), options, compiled=True)
        bad = ~np.isin(out.status, _DONE)
        if np.any(bad):
            self.unsolved.update(Status(code).name for code in out.status[bad])
            for array in (
                out.rebound_ratio,
                out.first_touch,
                out.last_release,
                out.energy_retained,
            ):
                array[bad] = np.nan
        drops = base_rows(drop, len(x))
        fill(drops, drop, rows)
        return out, np.max(np.abs(drops.velocity), axis=1), drops.gravity

    def predicted(self, key: str, x: Array) -> Array:
        """Return the numbers (n, data) that trials (n, parameters) of one drop give."""
        given, columns = self.outcomes(key, x), []
        for datum in self.measured[key].data:
            table = np.asarray(QUANTITIES[datum.quantity].predict(*given))
            columns.append(table if table.ndim == 1 else table[:, datum.index])
        return np.stack(columns, axis=1) if columns else np.empty((len(x), 0))

    def counts(self, key: str, x: Array) -> NDArray[np.int64]:
        """Return the contact intervals (contacts,) of one drop in one trial (parameters,)."""
        return np.asarray(self.outcomes(key, x[None])[0].collisions[0])

    def forces(self, key: str, x: Array) -> list[Array]:
        """Return the force (n,) in N at the times of each record of a drop, in one trial."""
        drop, start = self.drop(key, x), float(self.values(x[None])[clock(key)][0])
        waves = self.measured[key].waveforms
        stamps, where = np.unique(
            np.concatenate([wave.times for wave in waves]), return_inverse=True
        )
        times = stamps - start
        forces = np.zeros((len(drop.balls), len(times)))
        status, forces[:, times >= 0.0] = forces_at(drop, times[times >= 0.0], self.rtol)
        if status not in _DONE:
            self.unsolved[status.name] += 1
            forces[:] = np.nan
        ends = np.cumsum([len(wave.times) for wave in waves])[:-1]
        places = np.split(where, ends)
        return [forces[wave.index, at] for wave, at in zip(waves, places, strict=True)]

    def without(self, key: str, name: str | None) -> "Problem":
        """Return the problem without what was measured of a drop, or without one number of it."""
        measured = dict(self.measured)
        own = measured.pop(key)
        if name is not None:
            left = tuple(datum for datum in own.data if datum.name != name)
            measured[key] = replace(own, data=left)
        return replace(self, measured=measured)

    def residuals(self, x: Array) -> Array:
        """Return residuals (n, size), in errors, of trials (n, parameters).

        They are those of each drop's numbers, of priors, then of records.
        """
        parts = [np.empty((len(x), 0))]
        for key, measured in self.measured.items():
            if measured.data:
                value = np.array([datum.value for datum in measured.data])
                error = np.array([datum.error for datum in measured.data])
                parts.append((self.predicted(key, x) - value) / error)
        values = self.values(x)
        for one in self.priors:
            mean, known_to = one.prior or (0.0, 1.0)
            parts.append(((values[one.name] - mean) / known_to)[:, None])
        parts += [np.stack([self._of_records(key, trial) for trial in x]) for key in self.records]
        whole = np.concatenate(parts, axis=1)
        return np.where(np.isfinite(whole), np.clip(whole, -ABSENT, ABSENT), ABSENT)

    def _of_records(self, key: str, x: Array) -> Array:
        waves = self.measured[key].waveforms
        forces = self.forces(key, x)
        return np.concatenate(
            [wave.linear(force) for wave, force in zip(waves, forces, strict=True)]
        )

    def chi_squared(self, x: Array) -> Array:
        """Return the sums of squares (n,) of trials (n, parameters)."""
        return np.asarray(np.sum(self.residuals(x) ** 2, axis=1))

    def expanded(self, x: Array) -> tuple[Array, Array]:
        """Return the residuals (size,) of one trial, and their derivatives (size, parameters).

        The derivatives are differences, all trials of which are solved together.
        """
        spans = self.spans
        step = _STEP * (spans[:, 1] - spans[:, 0])
        high, low = np.minimum(x + step, spans[:, 1]), np.maximum(x - step, spans[:, 0])
        count = len(x)
        trials = np.tile(x, (2 * count + 1, 1))
        each = np.arange(count)
        trials[each, each], trials[count + each, each] = high, low
        found = self.residuals(trials)
        slopes = (found[:count] - found[count:-1]) / (high - low)[:, None]
        return np.asarray(found[-1]), np.asarray(slopes.T)


class _Layout(NamedTuple):
    """Where in one drop the varied numbers lie, its ties, and all its numbers by path."""

    varied: list[tuple[str, Number]]
    ties: list[Tie]
    numbers: dict[str, float]


def _layout(problem: Problem, key: str) -> _Layout:
    drop = problem.drops[key]
    varied = [
        (one.name, number)
        for one in problem.parameters
        for own, number in places(problem.drops, one.name)
        if own == key
    ]
    numbers = {path: current(drop, number) for path, number in numbers_of(drop).items()}
    ties = [tie for tie in problem.ties if tie.drop == key]
    ends = {one.name: np.array([one.low, one.high]) for one in problem.parameters}
    check(drop, {number: ends[name] for name, number in varied}, lambda _: "(at the bounds)")
    return _Layout(varied, ties, numbers)


_STEP = 1e-5  # of the bounds' distance


def clock(key: str) -> str:
    """Return the name of the time at which a drop's record has the first touch of the floor."""
    return f"{key}.touch" if key else "touch"
