"""One collision of one ball with the floor: restitution and contact time by simulation."""

import math
from collections.abc import Sequence

from stackbounce.engine import codes, native
from stackbounce.engine.memory import FINITE, OUT_OF_RANGE, memory
from stackbounce.engine.records import AFTER, BEGIN, CONTINUE, Drops
from stackbounce.engine.work import WORK_LIMIT

_TOLERANCE = 1e-12
_EVENTS = 1_000  # events or steps: a collision that can be followed takes some hundred


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
    room = memory(FINITE, 1, native.available())
    law = ([number] for number in numbers)
    room.put(Drops._make([[mass], *law, [0.0], [-speed], 0.0]))
    room.put_pieces([pieces])
    log: list[float] = []
    stage, status = BEGIN, codes.RUNNING
    try:
        while status == codes.RUNNING:
            status = room.run(stage, math.inf, _TOLERANCE, _EVENTS, WORK_LIMIT)
            log += room.take_log()
            stage = CONTINUE
    except OUT_OF_RANGE:
        status = codes.INVALID
    if status != codes.FINISHED:
        raise ArithmeticError
    rows = [log[at : at + codes.LOG_COLUMNS] for at in range(0, len(log), codes.LOG_COLUMNS)]
    ends = [row[codes.TIME] for row in rows if row[codes.KIND] == codes.RELEASE]
    return room.numbers(room.space.after)[AFTER] / speed, max(ends, default=0.0)
