"""The calibration of a sensor by a bounce of a known ball."""

import math

from stackbounce.measure.kinds.waveform.result import Contact, Waveform
from stackbounce.measure.quantities import Number
from stackbounce.model.drop import STANDARD_GRAVITY

_SHORTEST_FLIGHT = 3.0  # contact times, between two bounces


def restitution_of(contacts: tuple[Contact, ...], speed: Number) -> Number | None:
    """Return the restitution of a ball's first bounce, from the flight to its second one.

    None where the record does not hold both, or they belong to no ball that bounces on.
    """
    if len(contacts) < 2 or contacts[0].time is None or contacts[1].start is None:
        return None
    flight = contacts[1].start - contacts[0].end
    e = STANDARD_GRAVITY * flight / (2.0 * speed)
    long = flight.nominal_value > _SHORTEST_FLIGHT * contacts[0].time.nominal_value
    return e if long and e.nominal_value <= 1.0 + 3.0 * e.std_dev else None


def sensitivity_of(found: Waveform) -> tuple[Number | None, list[str]]:
    """Return a sensor's volts per newton from a ball's first bounce, and notes about it.

    It is None where mass or speed are missing, or the record is not in V.
    """
    from uncertainties import ufloat

    mass, speed = found.mass, found.impact_speed
    if found.unit != "V" or mass is None or speed is None or not found.contacts:
        return None, []
    first = found.contacts[0]
    if first.time is None or first.clipped:
        return None, ["the first contact is not whole: the sensor cannot be calibrated by it"]
    e = restitution_of(found.contacts, speed)
    if e is not None:
        weight = mass * STANDARD_GRAVITY * first.time
        note = f"calibrated by the first bounce, with restitution {e:.2u}"
        return first.impulse / (mass * speed * (1.0 + e) + weight), [note]
    e = ufloat(0.5, 1.0 / math.sqrt(12.0))
    note = "calibrated by the first bounce alone: its restitution, from 0 to 1, is not known"
    return first.impulse / (mass * speed * (1.0 + e)), [note]
