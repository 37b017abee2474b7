"""From laws to what is measured of them and back, and from a drop to its separate collisions."""

from stackbounce.calibrate.inverse import calibrate
from stackbounce.calibrate.measures import contact_time, restitution
from stackbounce.calibrate.pairs import between
from stackbounce.calibrate.textbook import separate

__all__ = ["between", "calibrate", "contact_time", "restitution", "separate"]
