"""How far an error of the numbers of a drop grows: the drop runs again with numbers that are off.

All masses, stiffnesses and gaps, the speed and gravity are multiplied by 1 + error z, with z from a
standard normal distribution. Balls that fall with one speed go on doing so. Numbers that are zero
stay so: balls that touch go on touching.
"""

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from stackbounce.engine.records import Drops

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from stackbounce.run.result import Result

__all__ = ["amplification", "disturbed", "known_until"]

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
        As `parameters.drop_numbers` gives them.
    error : float
        The standard deviation of the relative errors.
    seed : int
        Of the random numbers z.

    Examples
    --------
    >>> import stackbounce as sb
    >>> from stackbounce.run.parameters import drop_numbers
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


def amplification(result: "Result") -> "NDArray[np.float64]":
    """Return the standard deviation of the final speeds over that of the errors; see `Result`."""
    final = np.array(result.final_velocities)
    speed = result.drop.reference_speed
    factors = np.full(len(final), math.nan)
    for error in _ERRORS:
        ends = [result.rerun((), error, seed).velocities for seed in range(_RUNS)]
        with np.errstate(all="ignore"):  # speeds may be near the largest numbers, or none
            differences = np.abs(np.array(ends) - final) / speed
            differences[~np.isfinite(differences)] = math.inf
            factors = np.sqrt(np.mean(differences**2, axis=0)) / error
        if differences.max() <= _PROPORTIONAL:
            break
    return factors


def known_until(result: "Result") -> float:
    """Return the time in s up to which the speeds of all balls have a digit; see `Result`."""
    if not math.isfinite(result.end_time) or not np.isfinite(result.conditioning).all():
        return 0.0
    largest = result.conditioning.max()
    proportional = largest * _ERRORS[-1] <= _PROPORTIONAL  # else errors grow by more than that
    if proportional and result.precision * largest < _NO_DIGIT:
        return math.inf
    times = np.linspace(0.0, result.end_time, _MOMENTS + 1)
    shape = len(times), len(result.drop.balls)
    runs = [result.rerun(times.tolist(), 0.0, 0)]
    runs += [result.rerun(times.tolist(), result.precision, seed) for seed in range(_RUNS)]
    first, *others = (np.reshape(np.array(run.samples.velocity), shape) for run in runs)
    with np.errstate(all="ignore"):
        spread = np.max([np.abs(other - first).max(axis=1) for other in others], axis=0)
    unknown = np.flatnonzero(~(spread < _NO_DIGIT * result.drop.reference_speed))
    return float(times[unknown[0]]) if len(unknown) else math.inf
