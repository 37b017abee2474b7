"""A camera's turn and sway: what flights across, and the floor's levels at the bounces, tell."""

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from stackbounce.measure.kinds.track.parabolas import Parabolas
from stackbounce.measure.quantities import Array, nominal
from stackbounce.measure.statistics.regression import covariance_of, least_squares, widening

_LEAST_TILT = math.radians(0.5)  # that is corrected
_CLEAR = 3.0  # standard errors, by which two angles differ
_UNEVEN_BELOW = 5e-4  # p-value of levels that differ
_LOW = np.linspace(0.0, 0.5, 6)  # of the longest contact, by which a ball is seen low
_SWIFTER = 1.35  # speed of a sway over that from bounce to bounce, at 0.3 to 0.5 of its period


class Turn(NamedTuple):
    """The angle in radians from an axis to the vertical, another that may be, and why it is so."""

    angle: float
    other: float
    words: str


def acceleration_angle(fit: Parabolas, across: Array) -> tuple[float, float]:
    """Return the angle in radians between an axis and the vertical, and its error.

    The parabolas are those along the axis, and the positions those across it.
    """
    known = np.isfinite(across)
    kept = [flight for flight in fit.flights if known[slice(*flight)].all()]
    if not kept:
        return 0.0, math.inf
    along, sideways = (Parabolas(fit.times, axis, kept) for axis in (fit.heights, across))
    fall, drift = along.fall, sideways.fall
    error = math.sqrt(max(sideways.covariance[0, 0], 0.0)) / max(abs(fall), 1e-300)
    return math.atan2(drift, fall), error


def turn_of(
    slow: tuple[float, float], floor: tuple[float, float], across: float, axis: str
) -> Turn | None:
    """Return the turn of a camera, or None where none is seen.

    A turned camera sees an acceleration across, and a level floor as a slope. A ball that the air
    or its spin slows down across has the first without the second. Where the floor does not tell,
    there may be no turn, unless so much air would let no ball fall as fast as this one.

    Parameters
    ----------
    slow, floor : (float, float)
        The angle by which the acceleration, and the floor, are off, in radians, and its error.
    across : float
        The velocity across, on the whole, over that of the first impact.
    axis : str
        The one that is up.

    Examples
    --------
    >>> [turn_of((0.03, 1e-3), (floor, 2e-3), 1.0, "y").angle for floor in (0.001, 0.031)]
    [0.001, 0.03]
    """
    (angle, error), (slope, known) = slow, floor
    if abs(angle) <= max(_LEAST_TILT, _CLEAR * error):
        return None
    both = _CLEAR * math.hypot(error, known)
    off = f"the {axis} axis {{}} {math.degrees(abs(angle)):.1f} degrees off the vertical"
    slowed = abs(across) > abs(angle)
    if slowed and abs(angle) > both and (angle - slope) * math.copysign(1.0, across) > both:
        words = (
            f"Its flights slow down across, as if {off.format('were')}, but the floor is off by "
            f"{math.degrees(abs(slope)):.1f} degrees only: air or spin; heights are counted from it"
        )
        return Turn(slope, slope + known, words)
    words = (
        f"{off.format('is').capitalize()}, as the flights show; heights are counted along the "
        "vertical"
    )
    if not slowed or (abs(angle) > both and abs(angle - slope) <= both):
        return Turn(angle, angle + error, words)
    return Turn(angle, 0.0, f"{words}; or air slows it down across, and the errors allow for that")


def floor_angle(levels: Sequence[Any], across: Array) -> tuple[float, float]:
    """Return the angle of the floor to the axis across, from where a ball bounces, and its error.

    Examples
    --------
    >>> from uncertainties import ufloat
    >>> angle, error = floor_angle([ufloat(0.01, 1e-3), ufloat(0.0, 1e-3)], np.array([0.0, 1.0]))
    >>> f"{angle:.3f} +- {error:.3f}"
    '0.010 +- 0.001'
    """
    if len(levels) < 2 or not np.ptp(across) > 0.0:
        return 0.0, math.inf
    design = np.column_stack([np.ones(len(levels)), across - across.mean()])
    seen = np.array([nominal(level) for level in levels])
    fit = least_squares(design, seen, covariance_of(levels))
    error = math.sqrt(fit.covariance[1, 1])
    if fit.freedom:
        error *= widening(fit.freedom) * math.sqrt(max(fit.chi_squared / fit.freedom, 1.0))
    return -math.atan(fit.values[1]), error


def sway_of(
    moments: Sequence[Any], levels: Sequence[Any], impacts: Sequence[Any], longest: float
) -> tuple[float, float]:
    """Return how far levels of bounces are off each other, and the speed of a camera that sways so.

    Both are 0 where the levels may be one. A ball that is long on the floor is seen the lower, the
    faster it comes, by its speed times half the time of contact, which lasts the `longest` at most.

    Examples
    --------
    >>> from uncertainties import ufloat
    >>> numbers = [ufloat(level, 3e-4) for level in (0.037, 0.024, 0.031)]
    >>> moments, impacts = [0.3, 0.8, 1.2], [3.0, 2.4, 1.9]
    >>> [round(value, 3) for value in sway_of(moments, numbers, impacts, 1 / 60)]
    [0.005, 0.041]
    """
    from scipy.special import chdtrc

    times, speeds = (np.array([nominal(value) for value in some]) for some in (moments, impacts))
    seen, covariance = np.array([nominal(level) for level in levels]), covariance_of(levels)
    if len(seen) < 2:
        return 0.0, 0.0
    ones = np.ones((len(seen), 1))
    fits = [least_squares(ones, seen + low * speeds, covariance) for low in longest * _LOW]
    best = int(np.argmin([fit.chi_squared for fit in fits]))
    if chdtrc(fits[best].freedom, fits[best].chi_squared) > _UNEVEN_BELOW:
        return 0.0, 0.0
    level = seen + longest * _LOW[best] * speeds
    off = np.diff(level)
    noise = float(np.diag(covariance)[1:].sum() + np.diag(covariance)[:-1].sum())
    speed = math.sqrt(max(float(off @ off) - noise, 0.0) / float((np.diff(times) ** 2).sum()))
    return float(np.std(level)), _SWIFTER * widening(len(off)) * speed
