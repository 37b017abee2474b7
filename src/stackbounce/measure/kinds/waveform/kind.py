"""Force against time as a kind of measurement."""

from contextlib import suppress
from typing import Any

from stackbounce.errors import InvalidValue
from stackbounce.measure.finding import Finding
from stackbounce.measure.kinds.waveform.analysis import waveform
from stackbounce.measure.kinds.waveform.gap import sensor_gap
from stackbounce.measure.setup import Setup


def analyse(data: Any, setup: Setup) -> tuple[Finding, ...]:
    """Analyse a force, and the gap between two balls where there is a second channel."""
    force = waveform(
        data,
        mass=setup.mass,
        impact_speed=setup.speed,
        time_constant=setup.time_constant,
        law=setup.law,
        exponent=setup.exponent,
    )
    with suppress(InvalidValue):  # there is one channel, or the second is no sensor of balls
        speed, time = setup.impact_speed, setup.contact_time
        return sensor_gap(data, impact_speed=speed, contact_time=time), force
    return (force,)
