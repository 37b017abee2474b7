"""One drop: from a `Drop` to a `Result`.

The parameters of the drop (`columns.drop_numbers`) are written to an empty stack
(`Engine.prepare`), and its first events are scheduled (`Engine.begin`). The engine then goes from
event to event and logs them (`Engine.advance`). The log, in SI units, becomes a `Result`.
"""

import functools
import itertools
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

from stackbounce.engine import codes
from stackbounce.engine.compiler import compile_kernel
from stackbounce.engine.slots import LAST_CHECK, LAST_EVENT, LOG_ROWS, RECORDS_PEAKS
from stackbounce.engine.stack import Samples, as_arrays, new_samples
from stackbounce.errors import InvalidType, shown
from stackbounce.model import Drop
from stackbounce.run.columns import drop_numbers
from stackbounce.run.engines import OUT_OF_RANGE, Engine, Kernel, Mode, choose_engine, choose_mode
from stackbounce.run.options import Options, run_options
from stackbounce.run.result import Result, Status

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

__all__ = ["forces_at", "simulate"]

LOG_ROWS_AT_ONCE = 512  # after so many events the log is emptied


def simulate(
    drop: Drop,
    *,
    until: float | None = None,
    rtol: float = 1e-12,
    event_limit: int = 1_000_000,
    compiled: bool | None = None,
) -> Result:
    """Run a drop from the lowest ball's first touch of the floor; return the result.

    Parameters
    ----------
    drop : Drop
        The stack and its impact speed. All contacts `Rigid`: a sequence of collisions
        (eqs 1 to 4). None of them: simultaneous contacts (eqs 5, 6 and section V).
    until : float, optional
        A time in s at which to stop; by default the run ends once all contacts are open and none
        approaches, or all is at rest.
    rtol : float, optional
        From 1e-14 to 1e-3: the relative error to aim at for nonlinear contacts. Springs, dashpots
        and rigid balls are exact to round-off whatever it is.
    event_limit : int, optional
        Events (touches, releases, and changes of the force between them), or steps between two
        events, after which to stop with the status EVENT_LIMIT and the results so far.
    compiled : bool, optional
        Whether to run compiled code rather than plain Python; by default if the stack is tall or
        the run long, see `stackbounce.run.engines`. Both give the same bits.

    Returns
    -------
    Result

    Raises
    ------
    InvalidValue
        If `until`, `rtol` or `event_limit` is out of its range, or there are more than 2000 balls.
    InvalidType
        If one of them has the wrong type.

    Notes
    -----
    Source: R. Cross, Am. J. Phys. 75, 1009 (2007).

    Examples
    --------
    Equal masses on equal springs (section II): the upper ball leaves at 1.19, the lower at 0.77.

    >>> import stackbounce as sb
    >>> balls = [sb.Ball(mass=1.0), sb.Ball(mass=1.0)]
    >>> springs = [sb.Spring(1.0), sb.Spring(1.0)]
    >>> sb.simulate(sb.Drop(balls, springs, impact_speed=1.0)).rebound_ratios.round(4)
    array([0.7664, 1.1886])
    """
    options = run_options(drop, until, rtol, event_limit)
    if compiled is not None and not isinstance(compiled, bool):
        raise InvalidType(f"compiled must be True, False or None, got {shown(compiled)}")
    run = _run(drop, options, compiled, ())
    sample = functools.partial(_sample, drop, options, compiled)
    return Result(drop, Status(run.status), run.time, run.velocities, run.log, run.infinite, sample)


def forces_at(
    drop: Drop, times: "NDArray[np.float64]", rtol: float
) -> tuple[Status, "NDArray[np.float64]"]:
    """Return a run's status, and its forces in N, (contacts, times), at ascending times in s."""
    import numpy as np

    run = _run(drop, run_options(drop, None, rtol, 1_000_000), True, times.tolist())
    forces = np.reshape(np.asarray(run.samples.force, dtype=float), (-1, len(drop.balls))).T
    return Status(run.status), forces


def _sample(drop: Drop, options: Options, compiled: bool | None, times: Sequence[float]) -> Samples:
    """Repeat a run and return its samples at times in ascending order."""
    return _run(drop, options, compiled, times).samples


class _Run(NamedTuple):
    """The raw results of one run in SI units: the contents of a `Result`, and the samples."""

    status: int
    time: float  # of the end, s
    velocities: list[float]  # then, m/s
    log: list[float]
    infinite: list[int]
    samples: Samples


class _Workspace:
    """A stack with its log and samples: lists in plain Python, arrays in compiled code."""

    def __init__(self, engine: Engine, drop: Drop, rtol: float, times: Sequence[float]) -> None:
        size = len(drop.balls)
        self.stack: Any = engine.new_stack(size)
        if engine.log_unfinished is not None:
            self.stack.setting[RECORDS_PEAKS] = 1
        self.unit = float(engine.prepare(self.stack, *drop_numbers(drop), rtol))
        self.samples = new_samples([time / self.unit for time in times], size)
        self.log: Any = [0.0] * (max(LOG_ROWS_AT_ONCE, size) * codes.LOG_COLUMNS)
        self.compiled = False
        self._handle = self.stack

    def compile(self) -> None:
        """Convert the lists to arrays; `call` uses compiled kernels from now on."""
        import numpy as np

        from stackbounce.engine.structure import Structure

        self.stack, self.samples = as_arrays(self.stack), as_arrays(self.samples)
        self.log, self._handle = np.array(self.log), Structure(self.stack)
        self.compiled = True

    def call(self, kernel: Kernel, *arguments: Any) -> Any:
        """Call a kernel with the stack and other arguments."""
        return (compile_kernel(kernel) if self.compiled else kernel)(self._handle, *arguments)

    def take_log(self) -> list[float]:
        """Return the log's rows in a flat list, and empty the log."""
        used: Any = self.log[: self.stack.counter[LOG_ROWS] * codes.LOG_COLUMNS]
        self.stack.counter[LOG_ROWS] = 0
        return list(used.tolist() if self.compiled else used)


def _run(drop: Drop, options: Options, compiled: bool | None, times: Sequence[float]) -> _Run:
    """Run a drop, with samples at times in ascending order."""
    engine, balls = choose_engine(drop), range(len(drop.balls))
    mode = choose_mode(compiled, drops=1, balls=len(balls))
    space = _Workspace(engine, drop, options.rtol, times)
    until, log = options.until / space.unit, []
    try:
        space.call(engine.begin)
        status = codes.RUNNING
        while status == codes.RUNNING:
            if mode is Mode.COMPILED and not space.compiled:
                space.compile()
            limit = mode.event_limit(options.event_limit)
            status = int(space.call(engine.advance, until, limit, space.log, space.samples))
            log += space.take_log()
            if status == codes.EVENT_LIMIT and limit < options.event_limit:
                status, mode = codes.RUNNING, Mode.COMPILED
        clock = space.stack.clock
        time = float(clock[LAST_EVENT])
        if status == codes.TIME_REACHED:
            time = until
        elif status != codes.FINISHED:
            time = max(time, float(clock[LAST_CHECK]))
        if engine.log_unfinished is not None and status != codes.FINISHED:
            space.call(engine.log_unfinished, time, space.log)
            log += space.take_log()
        velocities = [float(space.call(engine.velocity, b, time)) for b in balls]
    except OUT_OF_RANGE:
        status, time = codes.INVALID, float(space.stack.clock[LAST_EVENT])
        log += space.take_log()
        velocities = [float(velocity) for velocity in space.stack.velocity]
    infinite = list(space.stack.infinite) if drop.rigid else [0] * len(balls)
    return _in_si(_Run(status, time, velocities, log, infinite, space.samples), space.unit)


# of the columns of a log; with kg and m fixed an impulse goes with a speed, an energy with a force
_UNITS = ("s", "", "", "m/s", "m/s", "s", "N", "", "m/s")


def _in_si(run: _Run, unit: float) -> _Run:
    """Convert a run from the engine's unit of time, given in s, to SI units."""
    factors = {"s": unit, "m/s": 1.0 / unit, "N": 1.0 / unit**2, "": 1.0}

    def converted(values: Iterable[float], *units: str) -> list[float]:
        columns = itertools.cycle([factors[name] for name in units])
        return [value * factor for value, factor in zip(values, columns, strict=False)]

    samples = run.samples._replace(
        velocity=converted(run.samples.velocity, "m/s"),
        force=converted(run.samples.force, "N"),
        stored=converted(run.samples.stored, "N"),
    )
    return run._replace(
        time=run.time * unit,
        velocities=converted(run.velocities, "m/s"),
        log=converted(run.log, *_UNITS),
        samples=samples,
    )
