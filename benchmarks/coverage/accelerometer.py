"""Coverage of what an accelerometer tells of its fall and its bounces."""

from collections.abc import Callable
from functools import cache, partial
from typing import Any

import stackbounce as sb
from stackbounce.measure.kinds.acceleration.analysis import accelerometer
from synthetic.accelerometer import accelerometer as record_of
from synthetic.falls import Falls, falls

__all__ = ["CASES"]

HEIGHT, KEPT = 0.8, 0.6


@cache
def _fall(height: float, contact_time: float) -> Falls:
    law = sb.calibrate(sb.Dashpot, mass=0.2, contact_time=contact_time, restitution=KEPT)
    return falls(height, law, mass=0.2, bounces=4)


def _trial(seed: int, contact_time: float, **how: Any) -> list[tuple[str, Any, float]]:
    """Analyse one record of many falls: in one alone, samples lie at few places of its pulses."""
    share = (seed % 97) / 97.0
    height, contact_time = HEIGHT * (1.0 + 0.3 * share), contact_time * (1.0 + 0.37 * share)
    found = accelerometer(record_of(_fall(height, contact_time), seed=seed, **how))
    rows = [("drop height", found.drop_height, height), ("restitution, mean", found.mean, KEPT)]
    rows += [("restitution of a bounce", one, KEPT) for one in found.restitutions]
    rows += [("contact time", one, contact_time) for one in found.contact_times if one is not None]
    return rows


CASES: dict[str, Callable[[int], list[tuple[str, Any, float]]]] = {
    "a phone, 200 Hz": partial(_trial, contact_time=0.012, rate=200.0),
    "a fast sensor, 2 kHz": partial(_trial, contact_time=0.012, rate=2000.0, noise=0.3),
}
"""Case name to a trial: seed to (quantity, estimate, truth)."""
