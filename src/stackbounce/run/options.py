"""The options of a run, validated, and whether its results fit into memory."""

import math
import os
from numbers import Integral
from typing import Any, NamedTuple

import numpy as np

from stackbounce.engine.work import EVENT_LIMIT, WORK_LIMIT
from stackbounce.errors import InvalidType, InvalidValue, between, instance, positive, shown, whole
from stackbounce.model import Drop
from stackbounce.units import checked

_SEEDS = 2**32
_MOST_BALLS = 2000  # the arrays for normal modes and queues grow with the number of balls
_MOST_EVENTS = 10**18  # the range of a 64-bit counter
_USUAL = 16 * 10**9  # bytes of memory, where it is not known


class Options(NamedTuple):
    """The options of a run: end time in s, relative tolerance, limits of events and of work."""

    until: float
    rtol: float
    event_limit: int
    work_limit: int = WORK_LIMIT


def run_options(drop: object, until: object, rtol: object, event_limit: object) -> Options:
    """Validate the options of a run and return them; see `simulate`."""
    drop = instance("drop", drop, Drop)
    if len(drop.balls) > _MOST_BALLS:
        raise InvalidValue(f"balls must be at most {_MOST_BALLS} for a run, got {len(drop.balls)}")
    events = whole("event_limit", event_limit, 1, _MOST_EVENTS)
    return Options(
        until=math.inf if until is None else checked(positive, "until", until, "seconds"),
        rtol=between("rtol", rtol, 1e-14, 1e-3),
        event_limit=events,
        work_limit=min(WORK_LIMIT * max(events, EVENT_LIMIT) // EVENT_LIMIT, _MOST_EVENTS),
    )


def seed_of(rng: Any) -> int:
    """Return a whole number itself, and the seed that is drawn from any other source of numbers.

    Parameters
    ----------
    rng : int, numpy.random.Generator, or what `numpy.random.default_rng` takes
        A Generator gives another seed each time; None one that nobody can foretell.

    Raises
    ------
    InvalidValue
        If a seed has more than 32 bits, or is negative.
    InvalidType
        If it is no source of random numbers.

    Examples
    --------
    >>> seed_of(3), seed_of(np.random.default_rng(3))
    (3, 3485385464)
    """
    if isinstance(rng, Integral):
        return whole("the seed", rng, 0, _SEEDS - 1)
    try:
        return int(np.random.default_rng(rng).integers(_SEEDS))
    except (TypeError, ValueError) as error:
        message = f"rng must be a whole number or a Generator of numpy, got {shown(rng)}"
        raise InvalidType(message) from error


def check_room(numbers: int, what: str, way: str) -> None:
    """Refuse what has more numbers of 64 bits than this machine has memory for.

    Parameters
    ----------
    numbers : int
        How many.
    what, way : str
        What has them, and how to do without.

    Raises
    ------
    InvalidValue
        If they do not fit.

    Examples
    --------
    >>> check_room(10**15, "a million drops", "take fewer")
    Traceback (most recent call last):
    stackbounce.errors.InvalidValue: a million drops would take 8e+06 GB of memory, and ...
    """
    try:
        most = os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")
    except (AttributeError, ValueError):  # Windows
        most = _USUAL
    if 8 * numbers > most:
        needed, there = 8e-9 * numbers, 1e-9 * most
        raise InvalidValue(
            f"{what} would take {needed:.3g} GB of memory, and this machine has {there:.3g}: {way}"
        )
