"""The one place that chooses how drops are run: the engine, and plain Python or compiled code.

============= ==========================================================================
engine        solves
============= ==========================================================================
`RIGID`       sequences of instantaneous collisions (eqs 1 to 4)
`FINITE`      simultaneous contacts of finite duration (eqs 5, 6 and section V)
two springs   batches of two balls on springs, many at a time (`engine.two_springs`); drops
              near the limits of its accuracy are passed on to `FINITE`
============= ==========================================================================

All modes give the same bits; they differ in speed only. Loading compiled code takes about as long
as plain Python takes up to the thresholds below.

============== ===== =====================================================================
threshold      value meaning
============== ===== =====================================================================
`PLAIN_DROPS`  24    drops in a batch up to which it is run as plain Python
`PLAIN_BALLS`  20    balls in a stack up to which it is run as plain Python
`PLAIN_EVENTS` 2000  events, or checks between two of them, after which compiled code takes
                     over
============== ===== =====================================================================
"""

import enum
import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any, TypeAlias

from stackbounce.engine.batch import run_batch, run_rigid_batch
from stackbounce.engine.codes import POWER
from stackbounce.engine.motion import velocity_at
from stackbounce.engine.preparation import prepare, prepare_rigid
from stackbounce.engine.rigid import begin_collisions, collide_all, rigid_velocity
from stackbounce.engine.simultaneous import advance_contacts, begin_contacts, log_unfinished
from stackbounce.engine.stack import new_rigid_stack, new_stack
from stackbounce.model import Drop
from stackbounce.model.laws import contact_numbers
from stackbounce.run.options import Options
from stackbounce.run.paths import Number

__all__ = [
    "FINITE",
    "OUT_OF_RANGE",
    "RIGID",
    "TWO_SPRINGS_EVENTS",
    "Engine",
    "Mode",
    "choose_engine",
    "choose_mode",
    "suits_two_springs",
]

PLAIN_DROPS = 24
PLAIN_BALLS = 20
PLAIN_EVENTS = 2000
TWO_SPRINGS_EVENTS = 10_000
"""An event limit that two springs never reach where their own engine gives an answer."""

OUT_OF_RANGE = (OverflowError, ZeroDivisionError, ValueError)
"""What plain Python raises where compiled code goes on with inf or nan.

``1e300**2``, ``1.0 / 0.0``, ``math.sqrt(-1.0)``, ``math.cos(math.inf)`` and ``round(math.nan)`` are
all there are. Any other exception in a kernel is a programming error and is not caught.
"""

Kernel: TypeAlias = Callable[..., Any]


@dataclass(frozen=True)
class Engine:
    """The kernels that solve stacks of one kind.

    Parameters
    ----------
    new_stack : callable
        Returns an empty stack for a number of balls.
    prepare : kernel
        Fills it with a drop's numbers; returns its unit of time in s.
    begin : kernel
        Schedules the first events.
    advance : kernel
        Goes from event to event; returns a status.
    velocity : kernel
        Returns a ball's velocity at a time.
    log_unfinished : kernel or None
        Logs the contact intervals that had not ended; None where intervals have no duration.
    run_batch : kernel
        Runs many drops one after the other.
    """

    new_stack: Callable[[int], Any]
    prepare: Kernel
    begin: Kernel
    advance: Kernel
    velocity: Kernel
    log_unfinished: Kernel | None
    run_batch: Kernel


FINITE = Engine(
    new_stack, prepare, begin_contacts, advance_contacts, velocity_at, log_unfinished, run_batch
)
RIGID = Engine(
    new_rigid_stack,
    prepare_rigid,
    begin_collisions,
    collide_all,
    rigid_velocity,
    None,
    run_rigid_batch,
)


class Mode(enum.Enum):
    """How kernels are run."""

    PLAIN = "plain Python"
    TRIAL = "plain Python, then compiled from PLAIN_EVENTS on"
    COMPILED = "compiled"

    def event_limit(self, limit: int) -> int:
        """Return the event limit of a first run, if ``limit`` is the limit that the user set.

        It is lower for TRIAL, where compiled code takes over at PLAIN_EVENTS.
        """
        return min(PLAIN_EVENTS, limit) if self is Mode.TRIAL else limit


def choose_mode(compiled: bool | None, drops: int, balls: int) -> Mode:
    """Choose between plain Python and compiled code for a batch of drops.

    Parameters
    ----------
    compiled : bool or None
        What the user asked for; None leaves the choice to the thresholds.
    drops, balls : int
        How many drops, and balls in each.

    Examples
    --------
    >>> choose_mode(None, drops=1, balls=2), choose_mode(None, drops=1000, balls=2)
    (<Mode.TRIAL: 'plain Python, then compiled from PLAIN_EVENTS on'>, <Mode.COMPILED: 'compiled'>)
    """
    if compiled is not None:
        return Mode.COMPILED if compiled else Mode.PLAIN
    return Mode.TRIAL if drops <= PLAIN_DROPS and balls <= PLAIN_BALLS else Mode.COMPILED


def choose_engine(drop: Drop) -> Engine:
    """Return the engine that solves a drop."""
    return RIGID if drop.rigid else FINITE


def suits_two_springs(drop: Drop, numbers: Iterable[Number], options: Options) -> bool:
    """Return whether the engine for two springs can solve a batch of drops.

    ``numbers`` are the parameters that differ between the drops. Their values are not considered,
    because the result of a drop must not depend on the other drops of the batch.
    """
    linear = all(contact_numbers(law)[::2] == (POWER, 1.0) for law in drop.contacts)
    together = len(set(drop.start_velocities)) == 1 and drop.start_velocities[0] < 0.0
    free = any(n.part == "velocities" or n.field in ("exponent", "gravity") for n in numbers)
    whole = options.until == math.inf and options.event_limit >= TWO_SPRINGS_EVENTS
    two = len(drop.balls) == 2 and drop.gravity == 0.0
    return two and linear and together and whole and not free
