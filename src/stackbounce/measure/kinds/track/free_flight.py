"""Whether a track holds a ball that flies freely and bounces, and what it shows instead.

A ball that rolls, swings, jumps or is held moves up and down as well, and parabolas can be fitted
to that. It is no bounce unless the flights have the acceleration of a fall, the shape of parabolas,
and a short contact between them.
"""

import math
from collections.abc import Sequence

import numpy as np

from stackbounce.measure.kinds.track.motion import accelerations, shape_of
from stackbounce.measure.kinds.track.parabolas import Flight, Parabolas
from stackbounce.measure.kinds.track.paths import noise_of
from stackbounce.measure.kinds.track.time_base import is_usual
from stackbounce.measure.messages import Message, OptionHint
from stackbounce.measure.quantities import Array

_GRAVITY_RATIO = (0.6, 1.6)  # of the flights' acceleration to gravity, by a wrong scale or clock
_UNSCALED = 30.0  # the same ratio, from which on only another unit of length explains it
_KNOWN_WITHIN = 0.05  # relative error of an acceleration that tells a slow motion
_SEEN_WITHIN = 0.25  # relative error of an acceleration that is one at all
_LARGEST_CHANGE = 0.4  # of the acceleration within a flight, relative
_CLEAR_CHANGE = 4.0  # standard errors of that change
_LONGEST_SHARE = 0.5  # of the flights beside it, that a contact may last, where no clock is known
_LONGEST_FRAMES = 4  # that a contact may last, where no clock is known
_LONGEST_CONTACT = 0.12  # s; longer ones are those of legs or hands
_MOST_BOUNCES = 100  # of a ball
_CLOSE = 3  # frames between two pieces of one flight, at most
_ONE_PARABOLA = 0.03  # of the range: a track is one parabola if it is nearer to it
_STILL = 8.0  # errors of a point, within which nothing moves
_WINDOWS = (5, 7, 11, 17, 25, 51, 101, 201, 401)  # points that tell an acceleration


def no_flight(fit: Parabolas, bounces: list[int], axis: str, gravity: float | None) -> str:
    """Return why flights and bounces are none, or nothing where they are.

    Parameters
    ----------
    fit : Parabolas
        The parabolas.
    bounces : list of int
        After which flights it bounces.
    axis : str
        The one that is up.
    gravity : float or None
        In m/s², to compare with; None where the scale or the clock is not known.
    """
    if len(bounces) > _MOST_BOUNCES:
        more = f"more than a ball has ({_MOST_BOUNCES}): an oscillation, or noise?"
        return f"{len(bounces)} bounces, {more}"
    fall, error = float(fit.values[0]), math.sqrt(max(float(fit.covariance[0, 0]), 0.0))
    if error > _SEEN_WITHIN * fall:
        return "no free flight: the pieces have no common acceleration"
    rate = 1.0 / max(float(np.median(np.diff(fit.times))), 1e-300)
    if gravity is not None and not _falls(fall, error, gravity, rate):
        return _other(fall, gravity, axis)
    shape = shape_of(fit.times, fit.heights, _arcs(fit.flights, bounces))
    if abs(shape.change) > max(_LARGEST_CHANGE, _CLEAR_CHANGE * shape.change_error):
        return (
            f"no free flight: within a flight the acceleration changes by {shape.change:+.0%} from "
            "the middle to the ends, where that of a fall stays; a ball that swings, or an "
            "oscillation?"
        )
    return _lasting(fit, bounces, None if gravity is None else fall / gravity)


def what_is_seen(times: Array, heights: Array, axis: str, gravity: float | None) -> str:
    """Return what a track without a bounce shows."""
    extent = float(np.ptp(heights)) if len(heights) else 0.0
    noise = float(np.median(np.abs(np.diff(heights, 2)))) if len(heights) > 3 else 0.0
    if len(heights) < 5 or extent <= _STILL * noise:
        return f"nothing that moves along {axis} by more than the errors of its points"
    whole = Parabolas(times, heights, [Flight(0, len(times))])
    fall, left = float(whole.values[0]), float(np.nanstd(whole.residuals))
    flies = gravity is None or _GRAVITY_RATIO[0] < fall / gravity < _GRAVITY_RATIO[1]
    if left < _ONE_PARABOLA * extent and fall > 0.0 and flies:
        clock, unit = (" s", " m/s^2") if gravity is not None else ("", "")
        return (
            f"one flight of {times[-1] - times[0]:.2g}{clock} with an acceleration of "
            f"{fall:.3g}{unit} and no bounce: a throw, or a fall that ends before the floor?"
        )
    usual = _usual_acceleration(times, heights)
    if gravity is not None and not _GRAVITY_RATIO[0] < usual / gravity < _GRAVITY_RATIO[1]:
        return _other(usual, gravity, axis)
    return (
        "no free flights that meet at a floor: is the axis right, and the frame rate high enough?"
    )


def _falls(fall: float, error: float, gravity: float, rate: float) -> bool:
    """Return whether an acceleration is that of a fall, perhaps in slow motion or in pixels."""
    ratio = fall / gravity
    if _GRAVITY_RATIO[0] < ratio < _GRAVITY_RATIO[1]:
        return True
    return error < _KNOWN_WITHIN * fall and (ratio > _UNSCALED or is_usual(ratio, rate))


def _other(fall: float, gravity: float, axis: str) -> str:
    """Return what accelerations along an axis mean that are not those of a fall."""
    seen = (
        f"no free flight: accelerations along {axis} are {fall:.2g} m/s^2 where a fall has "
        f"{gravity:.3g}; "
    )
    if fall > _GRAVITY_RATIO[1] * gravity:
        unit = OptionHint({"units": {axis: "cm"}})
        return Message(f"{seen}are its lengths in another unit (", unit, "), or in pixels?")
    doubt = (
        "a ball that rolls, swings or is held? (if it does fall, but on an incline or with a wrong "
    )
    return Message(f"{seen}{doubt}scale, ", OptionHint({"gravity": None}), " tells how fast)")


def _arcs(flights: Sequence[Flight], bounces: Sequence[int]) -> list[Flight]:
    """Return the flights; pieces of one between two bounces are put together."""
    arcs: list[Flight] = []
    for j, flight in enumerate(flights):
        whole = arcs and j - 1 not in bounces and flight.first - arcs[-1].last <= _CLOSE
        arcs[len(arcs) - bool(whole) :] = [Flight(arcs[-1].first, flight.last) if whole else flight]
    return arcs


def _lasting(fit: Parabolas, bounces: list[int], ratio: float | None) -> str:
    """Return why contacts are too long; `ratio` of the acceleration to gravity tells the clock."""
    step = float(np.median(np.diff(fit.times)))
    ends = fit.times[fit.lasts - 1]
    lasts = (fit.times[fit.firsts[1:]] - ends[:-1] - step)[bounces]
    last = float(np.median(lasts))
    if ratio is None:
        flights = ends - fit.times[fit.firsts]
        beside = np.minimum(flights[:-1], flights[1:])[bounces]
        if last > _LONGEST_FRAMES * step and np.median(lasts / beside) > _LONGEST_SHARE:
            return "no bounce: the contacts last for more than half of the flights beside them"
    elif last * math.sqrt(ratio) > _LONGEST_CONTACT:
        return (
            f"no bounce: between the flights it is on the floor for {last * math.sqrt(ratio):.2g} s"
            "; legs or a trampoline? A ball's contact takes some hundredths of a second"
        )
    return ""


def _usual_acceleration(times: Array, heights: Array) -> float:
    """Return the typical size of the accelerations, in windows that are long enough to tell it."""
    noise, step = noise_of(heights), float(np.median(np.diff(times)))
    found = 0.0
    for wide in _WINDOWS:
        if wide > len(heights):
            break
        found = float(np.median(np.abs(accelerations(times, heights, wide))))
        if noise * math.sqrt(720.0 / wide**5) / step**2 < 0.03 * found:
            break
    return found
