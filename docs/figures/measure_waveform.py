"""The pictures of `measure-waveform.md`: force records made from the simulator, and analysed."""

from shown import show

import stackbounce as sb
from stackbounce.measure.kinds.waveform.analysis import waveform
from stackbounce.plots.measurements.waveform import draw
from synthetic.waveform import waveform as record_of

FLOOR, BETWEEN = sb.Hysteretic(56e3, restitution=0.78), sb.Spring(16e3)
PAIR = sb.Drop([sb.Ball(0.101), sb.Ball(0.0248)], [FLOOR, BETWEEN], gaps=[0.001], height=0.2)
SCOPE = {"rate": 1e5, "noise": 0.006, "bits": 10, "full_scale": 2.0, "sensitivity": 0.01}
RECORD = record_of(PAIR, contacts=[0, 1], offset=0.1, seed=1, **SCOPE)
SMALL_BELOW = sb.Drop(
    [sb.Ball(0.0085), sb.Ball(0.101)], [sb.Spring(23e3), sb.Spring(14e3)], gaps=[0.012], height=0.2
)


def _draw(record):
    show(draw, record, waveform(record))


def floor():
    """The floor's force under B1 with B2 on it."""
    _draw(RECORD[["voltage"]])


def balls():
    """The force between the two."""
    _draw(RECORD[["voltage_2"]])


def collisions():
    """The floor's force under B3 with B1 on it: one collision after another."""
    _draw(record_of(SMALL_BELOW, rate=1e5, noise=0.5, before=0.01, duration=0.04, seed=1))
