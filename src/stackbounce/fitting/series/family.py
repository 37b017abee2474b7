"""The laws of one class that a calibration gives: one for each value at one speed."""

from dataclasses import dataclass, replace

import numpy as np

from stackbounce.errors import StackbounceError
from stackbounce.fitting.series.series import Series
from stackbounce.model.laws import ContactLaw
from stackbounce.run.calibration import calibrate
from stackbounce.run.collision import restitution
from stackbounce.run.quantities import Array

_MASS, _TIME = 0.1, 5e-3  # kg, s: they do not change how a calibrated law depends on the speed
_SAME = 1e-3  # relative, of curves that should not depend on how a law was calibrated


@dataclass(frozen=True)
class Family:
    """The laws of one class that a calibration at one speed gives.

    Parameters
    ----------
    law_class : type
        The class.
    speed : float
        The speed of the calibration in m/s.
    """

    law_class: type[ContactLaw]
    speed: float

    def law(self, value: float) -> ContactLaw:
        """Return the law that has a value at the speed of the calibration.

        Raises
        ------
        InvalidValue
            If no law of the class has it.
        """
        known = {"mass": _MASS, "contact_time": _TIME, "impact_speed": self.speed}
        return calibrate(self.law_class, **known, restitution=value)

    def at(self, value: float, speeds: Array) -> Array:
        """Return what the law with a value at the speed of the calibration gives at some speeds."""
        return restitutions(self.law(value), speeds)


def restitutions(law: ContactLaw, speeds: Array) -> Array:
    """Return the restitutions of a law at some speeds."""
    if "impact_speed" not in law.loss_depends_on:
        return np.full(speeds.shape, restitution(law, _MASS, float(speeds[0])))
    return np.array([restitution(law, _MASS, float(speed)) for speed in speeds])


def reason_to_skip(family: Family, series: Series) -> str:
    """Return why a family says nothing about a series; empty if it does.

    A law is asked only if one value at one speed tells how it depends on the speed.
    """
    start = float(series.values[np.argmax(series.speeds)])
    if not family.law_class.loss:
        return "it loses nothing"
    try:
        law, speed = family.law(start), float(series.speeds.min())
        again = replace(family, speed=speed).at(restitution(law, _MASS, speed), series.speeds)
        if not np.allclose(again, restitutions(law, series.speeds), rtol=_SAME):
            return "what it gives depends on the speed at which it is calibrated"
    except StackbounceError as error:
        return str(error)
    return ""
