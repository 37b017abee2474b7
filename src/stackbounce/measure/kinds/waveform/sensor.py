"""The calibration of a sensor by a bounce of a known ball."""

import math
from typing import TYPE_CHECKING, Any

from stackbounce.measure.kinds.waveform.result import Contact
from stackbounce.measure.quantities import measured
from stackbounce.model.drop import STANDARD_GRAVITY

if TYPE_CHECKING:
    from uncertainties import UFloat

__all__ = ["known", "sensitivity_of"]

_APART = 3.0  # contact times: the shortest flight between two bounces


def known(name: str, value: Any, of: str = "") -> "UFloat | None":
    """Return a positive number with its error, which may be 0; None stays None.

    Raises
    ------
    InvalidType
        If it is no number.
    InvalidValue
        If it is not positive and finite, or its error is not finite.

    Examples
    --------
    >>> known("mass", 0.057)
    0.057+/-0
    """
    return None if value is None else measured(name, value, of)


def sensitivity_of(
    contacts: tuple[Contact, ...],
    unit: str,
    mass: "UFloat | float | None",
    speed: "UFloat | float | None",
) -> "tuple[UFloat | None, list[str]]":
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
    second = contacts[1] if len(contacts) > 1 else None
    if second is not None and second.start is not None and first.end is not None:
        flight = second.start - first.end
        e = STANDARD_GRAVITY * flight / (2.0 * speed)
        long = flight.nominal_value > _APART * first.time.nominal_value
        if long and e.nominal_value <= 1.0 + 3.0 * e.std_dev:
            weight = mass * STANDARD_GRAVITY * first.time
            note = f"calibrated by the first bounce, with restitution {e:.2u}"
            return first.impulse / (mass * speed * (1.0 + e) + weight), [note]
    e = ufloat(0.5, 1.0 / math.sqrt(12.0))
    note = "calibrated by the first bounce alone: its restitution, from 0 to 1, is not known"
    return first.impulse / (mass * speed * (1.0 + e)), [note]
