"""How far an error of the numbers of a drop grows: the drop runs again with numbers that are off.

All masses, stiffnesses and gaps, the speed and gravity are multiplied by 1 + error z, with z from a
standard normal distribution. Balls that fall with one speed go on doing so. Numbers that are zero
stay so: balls that touch go on touching.
"""

import math
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from stackbounce.engine.records import Drops
from stackbounce.run.paths import Array

_RUNS = 20  # the standard deviation of so many is known to a sixth
_ERRORS = (1e-10, 1e-13)  # the second one where the first one grows too far
_PROPORTIONAL = 1e-3  # of the reference speed: smaller differences are proportional to the error
_NO_DIGIT = 0.1  # of the reference speed
_MOMENTS = 1000  # at which speeds are compared


def disturbed(numbers: Drops, error: float, seed: int) -> Drops:
    """Return the parameters of a drop, multiplied by 1 + error z.

    Parameters
    ----------
    numbers : Drops
        As `paths.drop_numbers` gives them.
    error : float
        The standard deviation of the relative errors.
    seed : int
        Of the random numbers z.

    Examples
    --------
    >>> import stackbounce as sb
    >>> from stackbounce.run.paths import drop_numbers
    >>> one = drop_numbers(sb.Drop([sb.Ball(1.0)], [sb.Spring(1.0)], impact_speed=1.0))
    >>> disturbed(one, 1e-3, 0).mass
    [1.0001257302210933]
    """
    random = np.random.default_rng(seed)

    def off(values: Sequence[float]) -> list[float]:
        return [x * (1.0 + error * float(random.standard_normal())) for x in values]

    velocity, together = numbers.velocity, len(set(numbers.velocity)) == 1
    return numbers._replace(
        mass=off(numbers.mass),
        first=off(numbers.first),
        gap=off(numbers.gap),
        velocity=off(velocity[:1]) * len(velocity) if together else off(velocity),
        gravity=off([numbers.gravity])[0],
    )


def amplification(rerun: Callable[..., Any], final: Sequence[float], speed: float) -> Array:
    """Return the standard deviation of the final speeds over that of the errors; see `Result`.

    Parameters
    ----------
    rerun : callable
        Repeats the run, see `Result`.
    final : sequence of float
        The final velocities of its balls in m/s.
    speed : float
        The reference speed in m/s.
    """
    factors = np.full(len(final), math.nan)
    for error in _ERRORS:
        ends = [rerun((), error, seed).velocities for seed in range(_RUNS)]
        with np.errstate(all="ignore"):  # speeds may be near the largest numbers, or none
            differences = np.abs(np.array(ends) - np.array(final)) / speed
            differences[~np.isfinite(differences)] = math.inf
            factors = np.sqrt(np.mean(differences**2, axis=0)) / error
        if differences.max() <= _PROPORTIONAL:
            break
    return factors


def known_until(
    rerun: Callable[..., Any], end: float, speed: float, conditioning: Array, precision: float
) -> float:
    """Return the time in s up to which the speeds of all balls have a digit; see `Result`.

    Parameters
    ----------
    rerun, speed
        As of `amplification`.
    end : float
        The end of the run in s.
    conditioning : ndarray
        What `amplification` returned.
    precision : float
        The relative error of each step.
    """
    if not math.isfinite(end) or not np.isfinite(conditioning).all():
        return 0.0
    largest = conditioning.max()
    proportional = largest * _ERRORS[-1] <= _PROPORTIONAL  # else errors grow by more than that
    if proportional and precision * largest < _NO_DIGIT:
        return math.inf
    times = np.linspace(0.0, end, _MOMENTS + 1)
    shape = len(times), len(conditioning)
    runs = [rerun(times.tolist(), 0.0, 0)]
    runs += [rerun(times.tolist(), precision, seed) for seed in range(_RUNS)]
    first, *others = (np.reshape(np.array(run.samples.velocity), shape) for run in runs)
    with np.errstate(all="ignore"):
        spread = np.max([np.abs(other - first).max(axis=1) for other in others], axis=0)
    unknown = np.flatnonzero(~(spread < _NO_DIGIT * speed))
    return float(times[unknown[0]]) if len(unknown) else math.inf
