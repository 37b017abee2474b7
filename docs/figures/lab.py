"""The pictures of `lab.md`: what its commands draw."""

from shown import DOCS, show

import stackbounce as sb
from stackbounce import plots
from stackbounce.measure import analyse


def _draw(name, **known):
    data = sb.read(DOCS / "lab" / name)
    show(plots.measured, data, analyse(data, **known))


def sound():
    """The knocks of the tennis ball."""
    _draw("tennis.wav", height=1.0)


def force():
    """The force of the tennis ball on the sensor."""
    _draw("tennis-force.csv", mass=0.057)


def press():
    """The basketball between two plates."""
    _draw("basketball-press.csv")


def video():
    """Both balls, one on the other."""
    _draw("stack-video.txt")
