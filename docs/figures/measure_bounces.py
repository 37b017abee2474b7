"""The pictures of `measure-sound.md` and `measure-track.md`, of records made by the simulator."""

from shown import show

import stackbounce as sb
from stackbounce.measure.kinds.bounces.analysis import bounces
from stackbounce.measure.kinds.heights.analysis import heights
from stackbounce.measure.kinds.sound.analysis import knocks
from stackbounce.measure.kinds.track.analysis import track
from stackbounce.plots.measurements.bounces import draw as draw_bounces
from stackbounce.plots.measurements.heights import draw as draw_heights
from stackbounce.plots.measurements.sound import draw as draw_sound
from stackbounce.plots.measurements.track import draw as draw_track
from synthetic.falls import falls
from synthetic.sound import sound as recorded
from synthetic.track import track as tracked

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
    show(draw_sound, data, knocks(data))


def restitution():
    """Restitution of each bounce of that recording against impact speed."""
    found = knocks(_recording())
    show(draw_bounces, found, bounces(found))


def ruler():
    """Heights that were read with a ruler."""
    found = heights(1.0, [0.62, 0.39, 0.25], height_error=0.005)
    show(draw_heights, None, found)


def one_ball():
    """The track of one ball at 60 frames per second."""
    data = tracked(falls(1.0, 0.8), frame_rate=60.0, noise=0.002)
    show(draw_track, data, track(data))


def two_balls():
    """A slow-motion video of two balls whose times were made with a wrong frame rate."""
    data = tracked(
        sb.simulate(STACK, until=0.45),
        frame_rate=240.0,
        read_as=60.0,
        noise=0.002,
        names=["basketball", "tennis ball"],
    )
    show(draw_track, data, track(data))
