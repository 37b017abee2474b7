"""The laws of one class that a calibration gives: one for each value at one speed."""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from stackbounce.errors import StackbounceError
from stackbounce.fitting.validation.series import CONTACT_TIME, RESTITUTION, Series
from stackbounce.model.laws import LAWS, ContactLaw
from stackbounce.run.calibration import calibrate
from stackbounce.run.collision import contact_time, restitution
from stackbounce.run.quantities import Array

_MASS = 0.1  # kg; on its own it does not change how a calibrated law depends on the speed
_TIMES = (5e-3, 0.5e-3)  # s: two contact times, where a source gives none
_SAME = 1e-3  # relative, of curves that should not depend on how a law was calibrated


@dataclass(frozen=True)
class Family:
    """The laws of one class that a calibration at one speed gives.

    Parameters
    ----------
    law_class : type
        The class.
    quantity : str
        What is calibrated and predicted, as in `Series`.
    speed : float
        The speed of the calibration in m/s.
    restitution : float or None
        The restitution at that speed, where the contact time is calibrated.
    time : float
        The contact time in s at that speed, where the restitution is calibrated.
    """

    law_class: type[ContactLaw]
    quantity: str
    speed: float
    restitution: float | None = None
    time: float = _TIMES[0]

    def law(self, value: float) -> ContactLaw:
        """Return the law that has a value at the speed of the calibration.

        Raises
        ------
        InvalidValue
            If no law of the class has it.
        """
        given: dict[str, float | None] = {"mass": _MASS, "impact_speed": self.speed}
        if self.quantity == RESTITUTION:
            given |= {"restitution": value, "contact_time": self.time}
        else:
            kept = self.restitution if self.law_class.loss else None
            given |= {"restitution": kept, "contact_time": value}
        return calibrate(self.law_class, **given)

    def at(self, value: float, speeds: Array) -> Array:
        """Return what the law with a value at the speed of the calibration gives at some speeds."""
        return predicted(self.law(value), self.quantity, speeds)


def predicted(law: ContactLaw, quantity: str, speeds: Array) -> Array:
    """Return the restitution or the contact time of a law at some speeds."""
    asked = restitution if quantity == RESTITUTION else contact_time
    depends = law.loss_depends_on if quantity == RESTITUTION else law.contact_time_depends_on
    if "impact_speed" not in depends:
        return np.full(speeds.shape, asked(law, _MASS, float(speeds[0])))
    return np.array([asked(law, _MASS, float(speed)) for speed in speeds])


def families(series: Series) -> Iterator[tuple[str, Family]]:
    """Yield the name and the family of each law, calibrated at the series' highest speed."""
    speed = float(series.speeds.max())
    for name, law_class in LAWS.items():
        yield name, Family(law_class, series.quantity, speed, series.restitution)


def reason_to_skip(family: Family, series: Series) -> str:
    """Return why a family says nothing about a series; empty if it does.

    A law is asked only if one value at one speed tells how it depends on the speed.
    """
    start = float(series.values[np.argmax(series.speeds)])
    if family.law_class.rigid and family.quantity != RESTITUTION:
        return "a rigid contact has no duration"
    if family.quantity == RESTITUTION and not family.law_class.loss:
        return "it loses nothing"
    try:
        law = family.law(start)
        found = predicted(law, family.quantity, series.speeds)
        if not _stays(family, law, series):
            return "what it gives depends on the speed at which it is calibrated"
    except StackbounceError as error:
        return str(error)
    if family.quantity == RESTITUTION:
        other = replace(family, time=_TIMES[1])
        if not np.allclose(other.at(start, series.speeds), found, rtol=_SAME):
            return "its restitution depends on the contact time, which the source does not give"
    return ""


def _stays(family: Family, law: ContactLaw, series: Series) -> bool:
    """Return whether a calibration with what a law gives at another speed predicts the same."""
    speed = float(series.speeds.min())
    there = {
        quantity: float(predicted(law, quantity, np.array([speed]))[0])
        for quantity in (RESTITUTION, CONTACT_TIME)
    }
    elsewhere = replace(
        family,
        speed=speed,
        restitution=there[RESTITUTION],
        time=there[CONTACT_TIME] or family.time,
    )
    again = elsewhere.at(there[family.quantity], series.speeds)
    return np.allclose(again, predicted(law, family.quantity, series.speeds), rtol=_SAME)
