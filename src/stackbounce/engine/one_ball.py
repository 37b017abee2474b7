"""One collision of one ball with the floor: restitution and contact time by simulation."""

import math
from collections.abc import Sequence

from stackbounce.engine import codes
from stackbounce.engine.motion import velocity_at
from stackbounce.engine.preparation import prepare
from stackbounce.engine.records import Drops
from stackbounce.engine.simultaneous import advance_contacts, begin_contacts
from stackbounce.engine.slots import LAST_EVENT, LOG_ROWS
from stackbounce.engine.stack import new_samples, new_stack
from stackbounce.engine.work import WORK_LIMIT

_TOLERANCE = 1e-12
_EVENTS = 1_000  # events or steps: a collision that can be followed takes some hundred
_ROWS = 64  # of the log


def bounce(
    numbers: tuple[int, float, float, float, float],
    mass: float,
    speed: float,
    pieces: Sequence[float] = (),
) -> tuple[float, float]:
    """Return the restitution and the contact time in s of a ball on a floor, without gravity.

    Parameters
    ----------
    numbers : tuple
        A contact: the form of its force and four numbers, see `forces`.
    mass, speed : float
        In kg and m/s.
    pieces : sequence of float, optional
        The pieces of the curves of a contact that is a table.

    Raises
    ------
    ArithmeticError
        If the collision cannot be followed to its end.

    Examples
    --------
    >>> e, time = bounce((codes.POWER, 100.0, 1.0, 0.0, 0.0), 1.0, 2.0)
    >>> round(e, 9), round(time / math.pi, 9)
    (1.0, 0.1)
    """
    form, *four = numbers
    stack = new_stack(1)
    stack.pieces[: len(pieces)] = pieces
    log = [0.0] * (_ROWS * codes.LOG_COLUMNS)
    contact = [[[number]] for number in four]
    drops = Drops._make([[[mass]], [[form]], *contact, [[0.0]], [[-speed]], [0.0]])
    unit = prepare(stack, drops, 0, _TOLERANCE)
    begin_contacts(stack)
    status, none = codes.RUNNING, new_samples([], 1)
    while status == codes.RUNNING and stack.counter[LOG_ROWS] < _ROWS - 1:
        status = advance_contacts(stack, math.inf, _EVENTS, WORK_LIMIT, log, none)
    if status != codes.FINISHED:
        raise ArithmeticError
    rows = [log[at : at + codes.LOG_COLUMNS] for at in range(0, len(log), codes.LOG_COLUMNS)]
    ends = [row[codes.TIME] * unit for row in rows if row[codes.KIND] == codes.RELEASE]
    return velocity_at(stack, 0, stack.clock[LAST_EVENT]) / unit / speed, max(ends, default=0.0)
