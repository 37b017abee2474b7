"""What the scatter of restitutions means: errors of the times, or the floor and spin."""

import math
from collections.abc import Sequence
from typing import Any, Literal, NamedTuple

import numpy as np

from stackbounce.measure.quantities import Array, nominal
from stackbounce.measure.statistics.regression import covariance_of, least_squares, widening

# Set by hand on the drops of `tests/synthetic/falls.py` with errors of the times or uneven floors.
_CLEAR = 2.0  # of the log-likelihood, by which a cause is told
_NOTABLE = 2e-3  # scatter of restitutions that is worth a note
_ALTERNATES = -0.2  # the largest lag-1 autocorrelation that errors of the times leave, of 97 %


class Scatter(NamedTuple):
    """The scatter of restitutions about a straight line over the speed.

    `size` is its standard deviation and `lag_one` its autocorrelation from bounce to bounce.
    `cause` is what it means. `factor` is by how much the errors of the times would have to be
    larger to be the cause; where that is unknown, it includes the error of the scatter itself.
    """

    size: float
    lag_one: float
    cause: Literal["timing", "floor or spin", "unknown"]
    factor: float


def scatter_of(speeds: Sequence[Any], kept: Sequence[Any]) -> Scatter:
    """Return the scatter of restitutions and its cause.

    The error of a time makes one flight longer and the next one shorter. The restitutions then
    alternate: their lag-1 autocorrelation is about -2/3. An uneven floor or spin changes each
    bounce by itself, which gives about 0. The cause is the one that explains the scatter clearly
    better. Few bounces leave it unknown.

    Parameters
    ----------
    speeds, kept : sequence of ufloat
        Impact speeds and restitutions of three and more successive bounces, as functions of the
        same times.

    Returns
    -------
    Scatter

    Examples
    --------
    >>> from uncertainties import ufloat
    >>> noise = 1e-3 * np.random.default_rng(1).standard_normal(16)
    >>> times = [ufloat(time, 1e-4) for time in np.cumsum(0.9 ** np.arange(16)) + noise]
    >>> flights = np.diff(times)
    >>> found = scatter_of(list(4.9 * flights[:-1]), list(flights[1:] / flights[:-1]))
    >>> found.cause, bool(found.lag_one < -0.4), 5.0 < found.factor < 20.0
    ('timing', True, True)
    """
    values = np.array([restitution.nominal_value for restitution in kept])
    design = np.vander([nominal(speed) for speed in speeds], 2, increasing=True)
    covariance = covariance_of(kept)
    timing, factor = _explained(design, values, covariance)
    alone, size = _explained(design, values, np.eye(len(kept)))
    # Timing makes the last restitutions scatter most, the floor all alike: weights in between.
    off = values - design @ np.linalg.lstsq(design, values, rcond=None)[0]
    off /= np.diag(covariance) ** 0.25
    lag_one = float(off[1:] @ off[:-1]) / max(float(off @ off), 1e-300)
    if timing > alone + _CLEAR and lag_one < _ALTERNATES:
        return Scatter(size, lag_one, "timing", factor)
    if alone > timing + _CLEAR:
        return Scatter(size, lag_one, "floor or spin", factor)
    return Scatter(size, lag_one, "unknown", factor * widening(len(kept) - 2))


def _explained(design: Array, values: Array, covariance: Array) -> tuple[float, float]:
    """Return how well errors of a covariance explain values about a line, and by which factor.

    It is the restricted log-likelihood, the factor of the errors being the most likely one.
    """
    fit = least_squares(design, values, covariance)
    variance = max(fit.chi_squared / fit.freedom, 1e-12)
    volume = np.linalg.slogdet(covariance)[1] - np.linalg.slogdet(fit.covariance)[1]
    return -0.5 * (fit.freedom * math.log(variance) + float(volume)), math.sqrt(variance)


def meaning_of(excess: float, found: Scatter) -> list[str]:
    """Return a note on what the scatter of restitutions means, or none where it means nothing.

    `excess` is the part of it that the errors of the times do not explain.

    Examples
    --------
    >>> print(*meaning_of(0.012, Scatter(0.012, 0.1, "floor or spin", 3.0)))
    Restitution differs by 0.012 from bounce to bounce, more than the errors of the times. It does \
not alternate (lag-1 autocorrelation 0.10): an uneven floor or a spinning ball; the mean and the \
fits allow for it.
    >>> print(*meaning_of(0.0, Scatter(0.012, -0.62, "timing", 1.1)))
    Restitution differs by 0.012 from bounce to bounce. It alternates (lag-1 autocorrelation \
-0.62): timing.
    >>> meaning_of(0.0, Scatter(0.012, -0.2, "unknown", 1.2))
    []
    """
    if not excess and (found.cause == "unknown" or found.size < _NOTABLE):
        return []
    more = ", more than the errors of the times" if excess else ""
    lag = f"(lag-1 autocorrelation {found.lag_one:.2f})"
    larger = f"these errors are taken to be {found.factor:.2g} times larger"
    if found.cause == "timing":
        why, taken = f"It alternates {lag}: timing", larger
    elif found.cause == "floor or spin":
        why = f"It does not alternate {lag}: an uneven floor or a spinning ball"
        taken = "the mean and the fits allow for it"
    else:
        why = "These bounces do not tell apart the timing and an uneven floor or a spinning ball"
        taken = f"{larger}, as if it were the timing, and the mean and the fits allow for each"
    differs = f"Restitution differs by {excess or found.size:.2g} from bounce to bounce{more}."
    return [f"{differs} {why}" + (f"; {taken}." if excess else ".")]
