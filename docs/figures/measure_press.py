"""The pictures of `measure-press.md`."""

from shown import show

import stackbounce as sb
from stackbounce.measure import press
from stackbounce.plots.measurements.press import draw
from synthetic.press import press_record

BALL = sb.Hysteretic(4e4, exponent=1.3, restitution=0.78)
"""The law that the page's ball follows."""


def record():
    """Return the record that the page reads."""
    return press_record(BALL, peak=5e-3, slack=1e-3, noise=0.4, seed=3)


def curve():
    """Force against compression of a ball in a press, and what was found in it."""
    data = record()
    show(draw, data, press(data))
