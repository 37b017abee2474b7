"""Acceleration as a kind of measurement."""

from typing import Any

from stackbounce.measure.kinds.acceleration.analysis import Accelerometer, accelerometer
from stackbounce.measure.setup import Setup


def analyse(data: Any, setup: Setup) -> Accelerometer:
    """Return the flights and bounces of a falling sensor."""
    return accelerometer(data, gravity=setup.gravity)
