"""Force against time as a kind of measurement."""

from contextlib import suppress
from typing import Any

from stackbounce.errors import InvalidValue
from stackbounce.measure.finding import Finding
from stackbounce.measure.kinds.waveform.analysis import waveform
from stackbounce.measure.kinds.waveform.gap.delay import sensor_gap
from stackbounce.measure.kinds.waveform.gap.floor_gap import floor_gap
from stackbounce.measure.setup import Setup


def analyse(data: Any, setup: Setup) -> tuple[Finding, ...]:
    """Analyse a force, and the gap between two balls where there is a second channel or record."""
    known: Any = {
        "time_constant": setup.time_constant,
        "law": setup.law,
        "exponent": setup.exponent,
    }
    force = waveform(data, mass=setup.mass, impact_speed=setup.speed, **known)
    speed = setup.impact_speed
    found: tuple[Finding, ...] = (force,)
    with suppress(InvalidValue):  # there is one channel, or the second is no sensor of balls
        gap = sensor_gap(data, impact_speed=speed, contact_time=setup.contact_time)
        found = (gap, force)
    if setup.alone is None:
        return found
    alone = waveform(setup.alone, **known)
    gap_of_floor = floor_gap(
        force, alone, mass=setup.mass, impact_speed=speed, restitution=setup.restitution
    )
    return (*found, gap_of_floor)
