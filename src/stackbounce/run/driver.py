"""One drop: from a `Drop` to a `Result`.

The parameters of the drop (`paths.drop_numbers`) are written to this thread's `memory`. The
kernel `engine.batch.run_drop` goes from event to event until the drop ends or the log is full, in
one call for a stack of few balls. The log, in SI units, becomes a `Result`.
"""

import functools
from collections.abc import Sequence
from typing import Any, NamedTuple, Never

from stackbounce.engine import codes
from stackbounce.engine.memory import RIGID, memory
from stackbounce.engine.records import AFTER, BEGIN_WITH_PEAKS, END
from stackbounce.engine.slots import CAUSE, NONLINEAR, WORK
from stackbounce.engine.stack import Samples
from stackbounce.errors import InvalidType, nearest
from stackbounce.model import LAWS, Ball, Drop
from stackbounce.run.conditioning import disturbed
from stackbounce.run.engines import choose_compiled, choose_engine
from stackbounce.run.options import Options, run_options
from stackbounce.run.paths import Array, drop_numbers, drop_pieces
from stackbounce.run.result import ROUND_OFF, Cause, Result, Status

_KINDS: list[Any] = [Drop, Ball, *LAWS.values()]
_ARGUMENTS = ("drop", "until", "rtol", "event_limit", "compiled")


def simulate(
    drop: Drop,
    *,
    until: float | None = None,
    rtol: float = 1e-12,
    event_limit: int = 1_000_000,
    compiled: bool | None = None,
    **misplaced: Never,
) -> Result:
    """Run a drop from the lowest ball's first touch of the floor; return the result.

    Parameters
    ----------
    drop : Drop
        The stack and its impact speed. All contacts rigid: a sequence of collisions
        (eqs 1 to 4). None of them: simultaneous contacts (eqs 5, 6 and section V).
    until : float, optional
        A time in s at which to stop; by default the run ends once all contacts are open and none
        approaches, or all is at rest.
    rtol : float, optional
        From 1e-14 to 1e-3: the relative error to aim at for nonlinear contacts. Springs, dashpots
        and rigid balls are exact to round-off whatever it is.
    event_limit : int, optional
        Events (touches, releases, and changes of the force between them), or steps between two
        events, after which to stop with the status EVENT_LIMIT and the results so far. A run also
        stops when it has cost as much as takes up to five seconds; its steps are counted, not
        timed, each by the number of contacts that it moves together and the order of their power
        series. A limit above a million allows more in proportion. `Result.advice` says why a limit
        was met.
    compiled : bool, optional
        Whether to run compiled code rather than plain Python; by default wherever there is some for
        this machine. Both give the same bits.
    **misplaced
        None is taken: the numbers of a drop are its own.

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
    for name in misplaced:
        fits = [kind.__name__ for kind in _KINDS if {name, f"{name}s"} & {*kind.__match_args__}]
        right = f"give it to {fits[0]}(…), or see Drop.replace" if fits else ""
        right = right or nearest(name, _ARGUMENTS)
        raise InvalidType(f"{name} is no argument of simulate; {right}")
    return solve_one(drop, run_options(drop, until, rtol, event_limit), compiled)


def solve_one(drop: Drop, options: Options, compiled: bool | None = None) -> Result:
    """Run a drop with options that have been validated; see `simulate`."""
    chosen = choose_compiled(compiled)
    run = _run(drop, options, chosen, ())
    again = functools.partial(_run, drop, options, chosen)
    precision = max(options.rtol, ROUND_OFF) if run.nonlinear else ROUND_OFF
    return Result(
        drop,
        Status(run.status),
        run.time,
        run.velocities,
        run.log,
        run.infinite,
        precision,
        again,
        run.work,
        Cause(run.cause) if run.status == codes.EVENT_LIMIT else None,
    )


def forces_at(drop: Drop, times: Array, rtol: float) -> tuple[Status, Array]:
    """Return a run's status, and its forces in N, (contacts, times), at ascending times in s."""
    import numpy as np

    options = run_options(drop, None, rtol, 1_000_000)
    run = _run(drop, options, choose_compiled(None), times.tolist())
    forces = np.reshape(np.asarray(run.samples.force, dtype=float), (-1, len(drop.balls))).T
    return Status(run.status), forces


class _Run(NamedTuple):
    """The results of one run in SI units: the contents of a `Result`, and the samples."""

    status: int
    time: float  # of the end, s
    velocities: list[float]  # then, m/s
    log: list[float]
    infinite: list[int]
    samples: Samples
    nonlinear: bool  # whether rtol sets the error of a step
    work: int
    cause: int


def _run(
    drop: Drop,
    options: Options,
    compiled: bool,
    times: Sequence[float],
    error: float = 0.0,
    seed: int = 0,
) -> _Run:
    """Run a drop, with samples at times in ascending order, and with errors of its numbers."""
    engine, balls = choose_engine(drop), len(drop.balls)
    room = memory(engine, balls, compiled)
    numbers = drop_numbers(drop)
    if error > 0.0:
        numbers = disturbed(numbers, error, seed)
    room.put(numbers)
    room.put_pieces(drop_pieces(drop))
    samples, run = room.sampled(times)
    status, log = room.follow(run, BEGIN_WITH_PEAKS, options)
    after = room.numbers(room.space.after)
    rigid = engine is RIGID
    infinite = room.numbers(room.stack.infinite) if rigid else [0] * balls
    nonlinear = not rigid and room.stack.counter[NONLINEAR] == 1
    work, cause = (int(room.stack.counter[slot]) for slot in (WORK, CAUSE))
    return _Run(status, after[END], after[AFTER:], log, infinite, samples, nonlinear, work, cause)
