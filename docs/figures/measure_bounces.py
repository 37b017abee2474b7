"""The pictures of `measure-sound.md` and `measure-track.md`, of records made by the simulator."""

from shown import show

import stackbounce as sb
from stackbounce.measure.bounces import bounces
from stackbounce.measure.heights import heights
from stackbounce.measure.sound import knocks
from stackbounce.measure.synthetic.falls import falls
from stackbounce.measure.synthetic.sound import sound as recorded
from stackbounce.measure.synthetic.track import track as tracked
from stackbounce.measure.track import track
from stackbounce.plots import measured_bounces, measured_heights, measured_sound, measured_track

FALL = falls(0.6, lambda speed: 0.86 - 0.025 * speed, bounces=14)
STACK = sb.Drop(
    [sb.Ball(0.6, diameter=0.24), sb.Ball(0.058, diameter=0.065)],
    [sb.Spring(60e3), sb.Spring(20e3)],
    height=0.8,
    gravity=9.80665,
)


def _recording():
    return recorded(FALL, noise=0.004, hum=0.02, echo=(0.07, 0.35), seed=1)


def sound():
    """A recording with hum and echoes, and its knocks."""
    data = _recording()
    show(measured_sound.draw, data, knocks(data))


def restitution():
    """Restitution of each bounce of that recording against impact speed."""
    found = knocks(_recording())
    show(measured_bounces.draw, found, bounces(found))


def ruler():
    """Heights that were read with a ruler."""
    found = heights(1.0, [0.62, 0.39, 0.25], height_error=0.005)
    show(measured_heights.draw, None, found)


def one_ball():
    """The track of one ball at 60 frames per second."""
    data = tracked(falls(1.0, 0.8), frame_rate=60.0, noise=0.002)
    show(measured_track.draw, data, track(data))


def two_balls():
    """A slow-motion video of two balls whose times were made with a wrong frame rate."""
    data = tracked(
        sb.simulate(STACK, until=0.45),
        frame_rate=240.0,
        read_as=60.0,
        noise=0.002,
        names=["basketball", "tennis ball"],
    )
    show(measured_track.draw, data, track(data))
