"""The picture of `measure-acceleration.md`, of a record made by the simulator, and analysed."""

from shown import show

import stackbounce as sb
from stackbounce.measure.kinds.acceleration.analysis import accelerometer
from stackbounce.plots.measurements.acceleration import draw as draw_acceleration
from synthetic.accelerometer import accelerometer as record_of
from synthetic.falls import falls


def fall():
    """A phone that falls and bounces, at 200 samples per second."""
    law = sb.calibrate(sb.Dashpot, mass=0.2, contact_time=0.012, restitution=0.6)
    record = record_of(falls(0.8, law, mass=0.2, bounces=4), rate=200.0, seed=3)
    show(draw_acceleration, record, accelerometer(record))
