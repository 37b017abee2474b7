"""Sound as a kind of measurement."""

from dataclasses import replace
from itertools import pairwise
from typing import Any

from stackbounce.measure.finding import Finding
from stackbounce.measure.kinds.bounces.analysis import bounces
from stackbounce.measure.kinds.sound.analysis import knocks
from stackbounce.measure.kinds.sound.few_bounces import few_bounces
from stackbounce.measure.quantities import nominal
from stackbounce.measure.setup import Setup

_HIGHEST = 5.0  # m from which a ball falls at most, if it is not told to be dropped from higher
_OVER_TOLD = 1.2  # times the drop height that is told, which is known roughly


def analyse(data: Any, setup: Setup) -> tuple[Finding, ...]:
    """Return the restitutions, or else the flights, that a sound tells, and its knocks."""
    given = setup.only("drop_height", "gravity", "drag")
    height, gravity, drag = given.values()
    highest = max(_OVER_TOLD * nominal(height or 0.0), _HIGHEST)
    heard = knocks(data, longest_flight=(8.0 * highest / gravity) ** 0.5)
    if heard.against:
        return (heard,)
    # A restitution needs two known flights in a row; the drop is one if its height is known.
    known = [height is not None, *(not lost for lost in heard.missed)]
    if any(before and after for before, after in pairwise(known)):
        told = bounces(heard, contact_time=setup.contact_time, **given)
        return told, replace(heard, times=told.times)  # whose errors the restitutions may correct
    return few_bounces(heard, gravity=gravity, drag=drag), heard
