"""Trial values of the varied numbers -> residuals, for many trials at once."""

import contextlib
import math
from collections import Counter
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from stackbounce.engine.work import WORK_LIMIT
from stackbounce.errors import InvalidType, InvalidValue
from stackbounce.fitting.measurements import Measured
from stackbounce.fitting.parameters import Drops, Parameter, find_numbers
from stackbounce.fitting.ties import Tie, evaluate_ties
from stackbounce.fitting.waveforms import Waveform
from stackbounce.model import Drop
from stackbounce.prediction.draws import Progress
from stackbounce.run.driver import forces_at
from stackbounce.run.options import Options
from stackbounce.run.paths import Number, Rows, check, drop_at, numbers_of, value_in
from stackbounce.run.quantities import Array, solve_quantities
from stackbounce.run.result import STOPPED, Status

ABSENT = 1e4
"""The residual, in errors, of a number that a trial does not have, such as a missing touch."""

_STEP = 1e-5  # of the width of the bounds: the step of a numerical derivative
_EVENTS = 10_000  # limit for one trial; no measurement has so many
_WORK, _FEW = WORK_LIMIT // 100, 10  # what it may cost for each ball, and at least as for so many


@dataclass
class Course:
    """The trials so far: their number, and the best one with its chi squared."""

    trials: int = 0
    best: Array | None = None
    chi_squared: float = math.inf
    progress: Progress | None = None
    expected: int = 0

    def add(self, x: Array, chi_squared: Array) -> None:
        """Count trials (n, parameters), whose chi squared (n,) is known now."""
        least = int(np.argmin(chi_squared))
        if chi_squared[least] < self.chi_squared:
            self.best, self.chi_squared = x[least].copy(), float(chi_squared[least])
        self.trials += len(x)
        if self.progress is not None:
            self.progress(self.trials, max(self.trials, self.expected))

    @contextlib.contextmanager
    def reported(self, progress: Progress | None, expected: int) -> Iterator[None]:
        """Report the progress of about so many trials that follow."""
        self.progress, self.expected = progress, self.trials + expected
        try:
            yield
            if progress is not None:
                progress(self.trials, self.trials)
        finally:
            self.progress = None


@dataclass(frozen=True, eq=False)
class Objective:
    """What a fit minimises: the residuals of trials, and chi squared, the sum of their squares.

    A trial is a row of search coordinates, one per parameter: its value, or the logarithm of it.

    Parameters
    ----------
    drops : mapping of str to Drop
        By name; a single drop has an empty name.
    measured : mapping of str to Measured
        The measurements of each drop.
    parameters : sequence of Parameter
        What is varied.
    ties : sequence of Tie
        What follows from it.
    rtol : float
        Relative tolerance of each trial's run.
    unsolved : Counter
        The number of runs so far that did not finish, by the name of their `Status`. All residuals
        of such a run are `ABSENT`.
    course : Course
        The trials so far, and the best one.

    Examples
    --------
    >>> import stackbounce as sb
    >>> from stackbounce.fitting import FitProblem
    >>> drop = sb.Drop([sb.Ball(1.0)], [sb.Spring(1.0)], height=1.0)
    >>> vary = {"contacts.0.stiffness": (0.1, 10.0)}
    >>> objective = FitProblem(drop, {"durations.0": "3.0 ± 0.1 s"}, vary).objective
    >>> objective.residuals(np.array([[0.0]])).round(3)  # pi seconds at 1 N/m
    array([[1.416]])
    """

    drops: Drops
    measured: Mapping[str, Measured]
    parameters: tuple[Parameter, ...]
    ties: tuple[Tie, ...]
    rtol: float
    unsolved: Counter[str] = field(default_factory=Counter, init=False)
    course: Course = field(default_factory=Course, init=False)

    @property
    def names(self) -> list[str]:
        """The names of the parameters."""
        return [parameter.name for parameter in self.parameters]

    @property
    def units(self) -> dict[str, str]:
        """The SI unit of each parameter; empty for a pure number."""
        return {parameter.name: parameter.unit for parameter in self.parameters}

    @cached_property
    def spans(self) -> Array:
        """(parameters, 2) bounds in search coordinates."""
        return np.array([parameter.span for parameter in self.parameters])

    @property
    def widths(self) -> Array:
        """(parameters,) distances between the bounds in search coordinates."""
        return np.asarray(self.spans[:, 1] - self.spans[:, 0])

    @property
    def priors(self) -> list[tuple[Parameter, float, float]]:
        """The parameters with a prior, each with its mean and standard deviation."""
        return [(parameter, *parameter.prior) for parameter in self.parameters if parameter.prior]

    @property
    def records(self) -> list[str]:
        """The names of the drops with force records; each has a touch time as a parameter."""
        return [key for key, measured in self.measured.items() if measured.waveforms]

    @property
    def size(self) -> int:
        """The number of residuals."""
        numbers = sum(len(measured.data) for measured in self.measured.values()) + len(self.priors)
        return numbers + sum(len(wave.times) for wave in self.waveforms)

    @property
    def free(self) -> int:
        """The number of fitted numbers: parameters, and baselines and scales of force records."""
        return len(self.parameters) + sum(1 + wave.scaled for wave in self.waveforms)

    @property
    def waveforms(self) -> list[Waveform]:
        """The force records of all drops."""
        return [wave for measured in self.measured.values() for wave in measured.waveforms]

    def values(self, x: Array) -> dict[str, Array]:
        """Return the parameters of trials (n, parameters) by name, (n,) numbers in SI units."""
        return {
            parameter.name: parameter.value(x[:, k]) for k, parameter in enumerate(self.parameters)
        }

    def value_slopes(self, x: Array) -> Array:
        """Return the derivatives (parameters,) of the values by the coordinates of a trial."""
        return np.array(
            [parameter.slope(at) for parameter, at in zip(self.parameters, x, strict=True)]
        )

    def _rows(self, key: str, x: Array) -> Rows:
        """Return the varied and tied numbers of one drop in trials (n, parameters)."""
        ties, values = [tie for tie in self.ties if tie.drop == key], self.values(x)
        named = {name: array for name, array in values.items() if self._owner[name] in (None, key)}
        found: dict[Number, Array] = {}
        for number, parameter in self._varied[key].items():
            found[number] = named[number.path] = named[parameter.name]
        if ties:
            follow = evaluate_ties(ties, self._given[key], named)
            found |= {tie.number: follow[tie.number.path] for tie in ties}
        return found

    def rows(self, key: str, x: Array) -> Rows:
        """Return the varied and tied numbers of one drop in trials (n, parameters), checked."""
        return self._checked([key], self._rows(key, x))

    def _rows_of_all(self, keys: Sequence[str], x: Array) -> Rows:
        """Return what varies in trials, or between drops of one kind, one drop after the other."""
        varied = {key: self._rows(key, x) for key in keys}
        numbers = dict.fromkeys(self._differ[self._kinds[keys[0]]])
        for own in varied.values():
            numbers |= dict.fromkeys(own)

        def of(key: str, number: Number) -> Array:
            alike = np.full(len(x), self._given[key][number.path])
            return varied[key].get(number, alike)

        found = {number: np.concatenate([of(key, number) for key in keys]) for number in numbers}
        return self._checked(keys, found)

    def _checked(self, keys: Sequence[str], rows: Rows) -> Rows:
        """Return the rows of drops of one kind; raise an error if ties make one that is no drop."""
        ties = {tie.number.path: tie.text for tie in self.ties if tie.drop in keys}
        try:
            if ties:
                check(self.drops[keys[0]], rows, lambda _: "")
        except (InvalidValue, InvalidType) as error:
            formulas = ", ".join(f"{path} = {text}" for path, text in ties.items())
            raise type(error)(f"tie: {formulas} gives no drop: {error}".rstrip()) from error
        return rows

    @cached_property
    def _given(self) -> dict[str, dict[str, float]]:
        """All numbers of each drop by path, as they are where they do not vary."""
        return {
            key: {path: value_in(drop, number) for path, number in numbers_of(drop).items()}
            for key, drop in self.drops.items()
        }

    @cached_property
    def _varied(self) -> dict[str, dict[Number, Parameter]]:
        """The varied numbers of each drop, which is checked with them at the bounds."""
        found: dict[str, dict[Number, Parameter]] = {key: {} for key in self.drops}
        for parameter in self.parameters:
            for key, number in find_numbers(self.drops, parameter.name):
                found[key][number] = parameter
        for key, varied in found.items():
            ends = {number: np.array([own.low, own.high]) for number, own in varied.items()}
            check(self.drops[key], ends, lambda _: "(at the bounds)")
        return found

    @cached_property
    def _owner(self) -> dict[str, str | None]:
        """The only drop that each parameter belongs to; None for a shared parameter.

        A tie that is a Python function may use every shared parameter and those of its own drop.
        """
        found: dict[str, str | None] = {touch_name(key): key for key in self.drops}
        for parameter in self.parameters:
            numbers = {key for key, _ in find_numbers(self.drops, parameter.name)}
            users = {tie.drop for tie in self.ties if tie.uses and parameter.name in tie.uses}
            keys = numbers | users
            found.setdefault(parameter.name, keys.pop() if numbers and len(keys) == 1 else None)
        return found

    def own(self, key: str) -> list[int]:
        """Return the indices of the parameters that belong to one drop only."""
        return [
            k for k, parameter in enumerate(self.parameters) if self._owner[parameter.name] == key
        ]

    def alone(self, key: str) -> "Objective":
        """Return the objective with all parameters but the data of one drop only."""
        return replace(self, measured={key: self.measured[key]})

    def drop(self, key: str, x: Array) -> Drop:
        """Return one drop with the numbers of one trial (parameters,)."""
        rows = self.rows(key, x[None])
        return drop_at(self.drops[key], {number: float(array[0]) for number, array in rows.items()})

    @cached_property
    def _kinds(self) -> dict[str, str]:
        """For each drop, the first with the same contacts, number of balls, and kind of start."""
        found, firsts = {}, dict[str, str]()
        for key, drop in self.drops.items():
            laws = [law and law.to_mapping() for law in drop.contacts]
            found[key] = firsts.setdefault(repr((list(numbers_of(drop)), laws)), key)
        return found

    @cached_property
    def _differ(self) -> dict[str, list[Number]]:
        """The numbers that are not the same in all drops of a kind, by the first one's name."""
        found = {}
        for first in dict.fromkeys(self._kinds.values()):
            given = [self._given[key] for key, other in self._kinds.items() if other == first]
            numbers = numbers_of(self.drops[first]).items()
            # nan is a ball's size or material that is not given, which does not affect a run
            rows = [(number, {own[path] for own in given}) for path, number in numbers]
            found[first] = [
                number for number, row in rows if len(row) > 1 and not np.isnan([*row]).any()
            ]
        return found

    def solve(self, keys: Collection[str], x: Array) -> dict[str, dict[str, Array]]:
        """Return all quantities of some drops in trials (n, parameters), (n, parts) each.

        Drops of one kind (`_kinds`) are solved together.
        """
        kinds: dict[str, list[str]] = {}
        for key in keys:
            kinds.setdefault(self._kinds[key], []).append(key)
        found = {}
        for first, same in kinds.items():
            drop, count = self.drops[first], len(same) * len(x)
            options = Options(math.inf, self.rtol, _EVENTS, _WORK * max(_FEW, len(drop.balls)))
            solved = solve_quantities(drop, self._rows_of_all(same, x), count, options)
            ended = solved.status.tolist()
            self.unsolved.update(Status(code).name for code in ended if code in STOPPED)
            for k, key in enumerate(same):
                own = slice(k * len(x), (k + 1) * len(x))
                found[key] = {name: table[own] for name, table in solved.tables.items()}
        return {key: found[key] for key in keys}

    def predict(self, keys: Collection[str], x: Array) -> dict[str, Array]:
        """Return what trials (n, parameters) predict for drops' data: (n, data) in SI units."""
        found = {}
        for key, tables in self.solve(keys, x).items():
            data = self.measured[key].data
            columns = [tables[datum.quantity][:, datum.index] for datum in data]
            found[key] = np.stack(columns, axis=1)
        return found

    def forces(self, key: str, x: Array) -> list[Array]:
        """Return the forces (n,) in N at the samples of each record of a drop, in one trial."""
        drop, start = self.drop(key, x), float(self.values(x[None])[touch_name(key)][0])
        waves = self.measured[key].waveforms
        stamps = np.unique(np.concatenate([wave.times for wave in waves]))
        times = stamps - start
        forces = np.zeros((len(drop.balls), len(times)))
        status, forces[:, times >= 0.0] = forces_at(drop, times[times >= 0.0], self.rtol)
        if status in STOPPED:
            self.unsolved[status.name] += 1
            forces[:] = np.nan
        return [forces[wave.index, np.searchsorted(stamps, wave.times)] for wave in waves]

    def residuals(self, x: Array) -> Array:
        """Return the residuals (n, size) of trials (n, parameters), in standard errors.

        First come the data of each drop, then the priors, then the force records.
        """
        parts = [np.empty((len(x), 0))]
        predicted = self.predict([key for key, own in self.measured.items() if own.data], x)
        for key, measured in self.measured.items():
            if measured.data:
                value = np.array([datum.value for datum in measured.data])
                error = np.array([datum.error for datum in measured.data])
                parts.append((predicted[key] - value) / error)
        values = self.values(x)
        for parameter, mean, known_to in self.priors:
            parts.append(((values[parameter.name] - mean) / known_to)[:, None])
        parts += [np.stack([self._of_records(key, trial) for trial in x]) for key in self.records]
        whole = np.concatenate(parts, axis=1)
        found = np.where(np.isfinite(whole), np.clip(whole, -ABSENT, ABSENT), ABSENT)
        self.course.add(x, np.sum(found**2, axis=1))
        return found

    def _of_records(self, key: str, x: Array) -> Array:
        pairs = zip(self.measured[key].waveforms, self.forces(key, x), strict=True)
        return np.concatenate([wave.linear(force) for wave, force in pairs])

    def chi_squared(self, x: Array) -> Array:
        """Return the sums of squared residuals (n,) of trials (n, parameters)."""
        return np.asarray(np.sum(self.residuals(x) ** 2, axis=1))

    def linearise(self, x: Array) -> tuple[Array, Array]:
        """Return the residuals (size,) of one trial and their derivatives (size, parameters).

        The derivatives are central differences; all their trials are solved together.
        """
        trials = self.neighbours(x)
        found = self.residuals(trials)
        slopes = differences(found) / np.diag(differences(trials))[:, None]
        return np.asarray(found[-1]), np.asarray(slopes.T)

    def neighbours(self, x: Array) -> Array:
        """Return the trials of central differences at one trial (n,): (2 n + 1, n).

        First each coordinate is a step larger, then each a step smaller; the trial is the last.
        """
        step, count = _STEP * self.widths, len(x)
        trials = np.tile(x, (2 * count + 1, 1))
        each = np.arange(count)
        trials[each, each] = np.minimum(x + step, self.spans[:, 1])
        trials[count + each, each] = np.maximum(x - step, self.spans[:, 0])
        return trials


def differences(rows: Array) -> Array:
    """Return the differences (n, ...) of what follows of `Objective.neighbours`, (2 n + 1, ...)."""
    count = len(rows) // 2
    return np.asarray(rows[:count] - rows[count:-1])


def touch_name(key: str) -> str:
    """Return the name of the parameter for the time of first touch in a drop's force records."""
    return f"{key}.touch" if key else "touch"
