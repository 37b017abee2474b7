"""The calibration of a sensor by a bounce of a known ball."""

import math

from stackbounce.measure.kinds.waveform.result import Contact
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


def sensitivity_of(
    contacts: tuple[Contact, ...],
    unit: str,
    mass: Number | float | None,
    speed: Number | float | None,
) -> tuple[Number | None, list[str]]:
    """Return a sensor's volts per newton from a ball's first bounce, and notes about it.

    Parameters
    ----------
    contacts : tuple of Contact
        Of the record, in order.
    unit : str
        Only a record in V is calibrated.
    mass, speed : UFloat, float or None
        Of the ball, in kg and m/s.

    Returns
    -------
    UFloat or None
        In V/N; None where something is missing.
    list of str
        Notes, a sentence each.
    """
    from uncertainties import ufloat

    if unit != "V" or mass is None or speed is None or not contacts:
        return None, []
    first = contacts[0]
    if first.time is None or first.clipped:
        return None, ["the first contact is not whole: the sensor cannot be calibrated by it"]
    e = restitution_of(contacts, speed)
    if e is not None:
        weight = mass * STANDARD_GRAVITY * first.time
        note = f"calibrated by the first bounce, with restitution {e:.2u}"
        return first.impulse / (mass * speed * (1.0 + e) + weight), [note]
    e = ufloat(0.5, 1.0 / math.sqrt(12.0))
    note = "calibrated by the first bounce alone: its restitution, from 0 to 1, is not known"
    return first.impulse / (mass * speed * (1.0 + e)), [note]
