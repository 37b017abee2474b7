"""One collision of one ball with the floor: restitution and contact time by simulation."""

import math
from collections.abc import Sequence

from stackbounce.engine import codes, native
from stackbounce.engine.memory import FINITE, memory
from stackbounce.engine.records import AFTER, BEGIN, Drops
from stackbounce.engine.work import WORK_LIMIT

_TOLERANCE = 1e-12
_EVENTS = 100_000  # events or steps: most collisions take some hundred, stiff ones more


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
    status, log = room.follow(room.run, BEGIN, (math.inf, _TOLERANCE, _EVENTS, WORK_LIMIT))
    if status != codes.FINISHED:
        raise ArithmeticError
    rows = [log[at : at + codes.LOG_COLUMNS] for at in range(0, len(log), codes.LOG_COLUMNS)]
    ends = [row[codes.TIME] for row in rows if row[codes.KIND] == codes.RELEASE]
    return room.numbers(room.space.after)[AFTER] / speed, max(ends, default=0.0)
