"""Restitution and contact time of a contact law, the inverse, and separate collisions."""

from stackbounce.calibration.collision import contact_time, restitution
from stackbounce.calibration.inverse import calibrate
from stackbounce.calibration.pairs import between
from stackbounce.calibration.separate_collisions import separate

__all__ = ["between", "calibrate", "contact_time", "restitution", "separate"]
