"""The options of a run, validated."""

import math
from typing import NamedTuple

from stackbounce.engine.work import EVENT_LIMIT, WORK_LIMIT
from stackbounce.errors import InvalidType, InvalidValue, between, positive, shown, whole
from stackbounce.model import Drop

__all__ = ["Options", "run_options"]

_MOST_BALLS = 2000  # the arrays for normal modes and queues grow with the number of balls
_MOST_EVENTS = 10**18  # the range of a 64-bit counter


class Options(NamedTuple):
    """The options of a run: end time in s, relative tolerance, limits of events and of work."""

    until: float
    rtol: float
    event_limit: int
    work_limit: int = WORK_LIMIT


def run_options(drop: object, until: object, rtol: object, event_limit: object) -> Options:
    """Validate the options of a run and return them; see `simulate`."""
    if not isinstance(drop, Drop):
        raise InvalidType(f"drop must be a Drop, got {shown(drop)}")
    if len(drop.balls) > _MOST_BALLS:
        raise InvalidValue(f"balls must be at most {_MOST_BALLS} for a run, got {len(drop.balls)}")
    events = whole("event_limit", event_limit, 1, _MOST_EVENTS)
    return Options(
        until=math.inf if until is None else positive("until", until, "seconds"),
        rtol=between("rtol", rtol, 1e-14, 1e-3),
        event_limit=events,
        work_limit=min(WORK_LIMIT * max(events, EVENT_LIMIT) // EVENT_LIMIT, _MOST_EVENTS),
    )
