"""From a Drop to a Result: picks the engine, in plain Python or compiled."""

import functools
import itertools
import math
from collections.abc import Callable, Iterable, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

from stackbounce.engine import codes, prepare
from stackbounce.engine.kernel import compiled as compile_kernel
from stackbounce.engine.motion import velocity_at
from stackbounce.engine.rigid import begin_collisions, collide_all, rigid_velocity
from stackbounce.engine.simultaneous import advance, start, write_unfinished
from stackbounce.engine.stack import (
    Samples,
    as_arrays,
    new_rigid_stack,
    new_samples,
    new_stack,
)
from stackbounce.errors import InvalidType, InvalidValue, between, positive, shown, whole
from stackbounce.model import Drop
from stackbounce.model.laws import contact_numbers
from stackbounce.run.result import Result, Status

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

__all__ = ["simulate"]

_MOST_BALLS = 2000  # their matrices are quadratic
_MOST_EVENTS = 10**18  # a compiled counter's range
_LOG_ROWS = 512
_PLAIN_BALLS = 20  # up to this size plain Python is done before compiled code has been loaded
_PLAIN_EVENTS = 2000  # after so many events, or steps without one, a run goes on compiled
_Kernel = Callable[..., Any]
_FINITE_ENGINE: tuple[_Kernel, _Kernel, _Kernel] = (start, advance, velocity_at)
_RIGID_ENGINE: tuple[_Kernel, _Kernel, _Kernel] = (begin_collisions, collide_all, rigid_velocity)


def simulate(
    drop: Drop,
    *,
    until: float | None = None,
    rtol: float = 1e-12,
    event_limit: int = 1_000_000,
    compiled: bool | None = None,
) -> Result:
    """Return what happens to a drop, from the lowest ball's first touch of the floor.

    Parameters
    ----------
    drop : Drop
        The stack and how fast it comes in. All contacts `Rigid`: a sequence of collisions
        (eqs 1 to 4). None of them: simultaneous contacts (eqs 5, 6 and section V).
    until : float, optional
        A time in s at which to stop; by default the run ends once all contacts are open and none
        approaches, or all is at rest.
    rtol : float, optional
        From 1e-14 to 1e-3: the relative error to aim at where a contact follows a law that is not
        linear. Springs and dashpots, and rigid balls, are exact to round-off whatever it is.
    event_limit : int, optional
        After how many events (touches, releases, and turns of the force in between), or steps
        between two of them, to give up, with the status EVENT_LIMIT and all that was reached.
    compiled : bool, optional
        Whether to run compiled by numba rather than as plain Python; by default where the stack is
        tall or the run long. Both give the same bits.

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
    status, time, velocities, log, infinite, _ = _run(drop, options, compiled, ())
    rerun = functools.partial(_samples, drop, options, compiled)
    return Result(drop, Status(status), time, velocities, log, infinite, rerun)


class Options(NamedTuple):
    """How to run a drop: until when (s), to which tolerance, for how many events."""

    until: float
    rtol: float
    event_limit: int


def run_options(drop: object, until: object, rtol: object, event_limit: object) -> Options:
    """Return the options of a run, checked; see `simulate`."""
    if not isinstance(drop, Drop):
        raise InvalidType(f"drop must be a Drop, got {shown(drop)}")
    if len(drop.balls) > _MOST_BALLS:
        raise InvalidValue(f"balls must be at most {_MOST_BALLS} for a run, got {len(drop.balls)}")
    return Options(
        until=math.inf if until is None else positive("until", until, "seconds"),
        rtol=between("rtol", rtol, 1e-14, 1e-3),
        event_limit=whole("event_limit", event_limit, 1, _MOST_EVENTS),
    )


_Run = tuple[int, float, list[float], list[float], list[int], Samples]


def _run(drop: Drop, options: Options, compiled: bool | None, times: Sequence[float]) -> _Run:
    """Run an engine; return status, time, velocities, log, infinite contacts and samples."""
    until, rtol, event_limit = options
    rigid = drop.rigid
    begin, go_on, speed = _RIGID_ENGINE if rigid else _FINITE_ENGINE
    stack, unit = _prepared(drop, rtol)
    samples = new_samples([time / unit for time in times], len(drop.balls))
    until /= unit
    rows = max(_LOG_ROWS, len(drop.balls))
    log: Any = [0.0] * (rows * codes.LOG_COLUMNS)
    handle, mode = stack, _as_it_is
    swift = bool(compiled) or (compiled is None and len(drop.balls) > _PLAIN_BALLS)
    entries: list[float] = []
    try:
        begin(stack)
        status = codes.RUNNING
        while status == codes.RUNNING:
            if swift and mode is _as_it_is:
                stack, samples, log, handle = _for_numba(stack, samples, rows)
                mode = compile_kernel
            stack.counter[0] = 0
            trial = compiled is None and not swift
            limit = min(_PLAIN_EVENTS, event_limit) if trial else event_limit
            status = int(mode(go_on)(handle, until, limit, log, samples))
            entries.extend(_entries(stack, log))
            if status == codes.EVENT_LIMIT and limit < event_limit:
                status, swift = codes.RUNNING, True
        time = float(stack.clock[0])
        if status != codes.FINISHED:
            time = until if status == codes.TIME_REACHED else float(max(stack.clock))
        if not rigid and status != codes.FINISHED:
            stack.counter[0] = 0
            mode(write_unfinished)(handle, time, log)
            entries.extend(_entries(stack, log))
        velocities = [float(mode(speed)(handle, b, time)) for b in range(len(drop.balls))]
    except (ArithmeticError, TypeError, ValueError):  # where compiled code has inf, nan or complex
        status, time = codes.INVALID, float(stack.clock[0])
        entries.extend(_entries(stack, log))
        velocities = [float(velocity) for velocity in stack.velocity]
    infinite = list(stack.infinite) if rigid else [0] * len(drop.balls)
    entries = _in_seconds(entries, _UNITS, unit)
    samples = samples._replace(
        velocity=_in_seconds(samples.velocity, ("m/s",), unit),
        force=_in_seconds(samples.force, ("N",), unit),
        stored=_in_seconds(samples.stored, ("N",), unit),
    )
    return status, time * unit, _in_seconds(velocities, ("m/s",), unit), entries, infinite, samples


# of the columns of a log; with kg and m fixed an impulse goes with a speed, an energy with a force
_UNITS = ("s", "", "", "m/s", "m/s", "s", "N", "", "m/s")


def _in_seconds(values: Iterable[float], units: Sequence[str], unit: float) -> list[float]:
    """Return values of rows with these units, measured with another unit of time, in SI."""
    factors = {"s": unit, "m/s": 1.0 / unit, "N": 1.0 / unit**2, "": 1.0}
    columns = itertools.cycle([factors[name] for name in units])
    return [value * factor for value, factor in zip(values, columns, strict=False)]


def _entries(stack: Any, log: Any) -> list[float]:
    """Return the log's entries as numbers of Python."""
    used = log[: stack.counter[0] * codes.LOG_COLUMNS]
    return used if isinstance(used, list) else used.tolist()


def _for_numba(stack: Any, samples: Samples, rows: int) -> tuple[Any, Samples, Any, Any]:
    """Return stack, samples and a log as arrays, and what compiled kernels take for the stack."""
    import numpy as np

    from stackbounce.engine.structure import Structure

    arrays = as_arrays(stack)
    return arrays, as_arrays(samples), np.zeros(rows * codes.LOG_COLUMNS), Structure(arrays)


def _samples(
    drop: Drop, options: Options, compiled: bool | None, times: Sequence[float]
) -> Samples:
    """Run an engine once more and return its samples at times in ascending order."""
    return _run(drop, options, compiled, times)[-1]


def forces_at(
    drop: Drop, times: "NDArray[np.float64]", rtol: float
) -> tuple[Status, "NDArray[np.float64]"]:
    """Return how a run ends, and the forces (contacts, times) in N at ascending times in s."""
    import numpy as np

    options = run_options(drop, None, rtol, 1_000_000)
    status, *_, samples = _run(drop, options, True, times.tolist())
    forces = np.reshape(np.asarray(samples.force, dtype=float), (-1, len(drop.balls))).T
    return Status(status), forces


def _as_it_is(kernel: _Kernel) -> _Kernel:
    return kernel


def _prepared(drop: Drop, rtol: float) -> tuple[Any, float]:
    """Return a drop's stack at t = 0, of lists, and its unit of time in s."""
    size = len(drop.balls)
    mass = [ball.mass for ball in drop.balls]
    rows = zip(*map(contact_numbers, drop.contacts), strict=True)
    kind, stiffness, exponent, extra = map(list, rows)
    gap = [0.0, *drop.gaps]
    velocity = list(drop.start_velocities)
    if drop.rigid:
        rigid = new_rigid_stack(size)
        prepare.prepare_rigid(rigid, mass, kind, extra, gap, velocity, drop.gravity)
        return rigid, 1.0
    stack = new_stack(size)
    stack.setting[2] = 1
    numbers = (mass, kind, stiffness, exponent, extra, gap, velocity, drop.gravity, rtol)
    return stack, prepare.prepare(stack, *numbers)
