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
    known = setup.only("mass", "time_constant", "law", "exponent")
    force = waveform(data, impact_speed=setup.speed, **known)
    with suppress(InvalidValue):  # there is one channel, or the second is no sensor of balls
        return sensor_gap(data, **setup.only("impact_speed", "contact_time")), force
    return (force,)
