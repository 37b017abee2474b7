"""What the scatter of restitutions means: errors of the times, or the floor and spin."""

import math
from collections.abc import Sequence
from typing import Any, Literal, NamedTuple

import numpy as np

from stackbounce.measure.quantities import Array, nominal
from stackbounce.measure.statistics.regression import covariance_of, least_squares, widening

# Set by hand on the drops of `tests/synthetic/falls.py` with errors of the times or uneven floors.
_FEWEST = 6  # restitutions that tell a cause
_CLEAR = 2.0  # standard deviations, or log-likelihood, by which a cause is told
_EXPLAINED = 1.5  # times their errors: then the times may be the only cause
_NOTABLE = 2e-3  # scatter of restitutions that is worth a note
_SCATTERS = np.geomspace(1e-6, 1.0, 60)  # of restitutions, that are tried


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
    bounce by itself, which gives about 0. The cause is timing if the autocorrelation is two
    standard deviations below that of independent scatter, or if errors of the times explain the
    scatter clearly better. It is the floor or spin if these explain it clearly better. Few bounces
    leave it unknown, and fewer than six always do.

    Parameters
    ----------
    speeds, kept : sequence of ufloat
        Impact speeds and restitutions of three and more successive bounces, as functions of the
        same times.

    Returns
    -------
    Scatter

    Notes
    -----
    The moments of an autocorrelation of residuals are those of J. Durbin and G. S. Watson,
    Biometrika 37, 409 (1950).

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
    count = len(kept)
    values = np.array([restitution.nominal_value for restitution in kept])
    x = np.array([nominal(speed) for speed in speeds])
    design = np.stack([np.ones(count), x], axis=1)
    covariance = covariance_of(kept)
    plain = np.eye(count) - design @ np.linalg.pinv(design)
    size = math.sqrt(max((plain @ values) @ values, 0.0) / (count - 2))
    # Timing makes the last restitutions scatter most, the floor all alike: weights in between.
    residual = plain * np.diag(covariance)[:, None] ** -0.25
    off = residual @ values
    lag_one = float(off[1:] @ off[:-1]) / max(float(off @ off), 1e-300)
    mean, deviation = _expected(residual @ residual.T)
    timing, factor = _best_factor(design, values, covariance)
    alone, _ = _best_factor(design, values, np.eye(count))
    if factor > _EXPLAINED:  # the errors are there, too
        totals = (covariance + q**2 * np.eye(count) for q in _SCATTERS)
        alone = max(_likelihood(design, values, total) for total in totals)
    cause: Literal["timing", "floor or spin", "unknown"] = "unknown"
    if count >= _FEWEST:
        if lag_one < mean - _CLEAR * deviation or (lag_one < mean and timing > alone + _CLEAR):
            cause = "timing"
        elif alone > timing + _CLEAR:
            cause = "floor or spin"
    if cause == "unknown":
        factor *= widening(count - 2)
    return Scatter(size, lag_one, cause, factor)


def _best_factor(design: Array, values: Array, covariance: Array) -> tuple[float, float]:
    """Return the likelihood of errors of the times that are larger by a factor, and the factor."""
    fit = least_squares(design, values, covariance)
    factor = math.sqrt(fit.chi_squared / fit.freedom)
    return _likelihood(design, values, max(factor**2, 1e-12) * covariance), factor


def _likelihood(design: Array, values: Array, covariance: Array) -> float:
    """Return the restricted log-likelihood of values about a line."""
    fit = least_squares(design, values, covariance)
    volume = np.linalg.slogdet(covariance)[1] - np.linalg.slogdet(fit.covariance)[1]
    return -0.5 * float(fit.chi_squared + volume)


def _expected(covariance: Array) -> tuple[float, float]:
    """Return the lag-1 autocorrelation of residuals with a covariance, and its deviation."""
    count = len(covariance)
    lag = 0.5 * (np.eye(count, k=1) + np.eye(count, k=-1))
    total = float(np.trace(covariance))
    mean = float(np.trace(covariance @ lag)) / total
    about = covariance @ (lag - mean * np.eye(count))
    return mean, math.sqrt(max(2.0 * np.trace(about @ about), 0.0)) / total


def meaning_of(excess: float, found: Scatter) -> list[str]:
    """Return a note on what the scatter of restitutions means, or none where it means nothing.

    `excess` is the part of it that the errors of the times do not explain.

    Examples
    --------
    >>> print(*meaning_of(0.012, Scatter(0.012, 0.1, "floor or spin", 3.0)))
    Restitution differs by 0.012 from bounce to bounce, more than the errors of the times, and \
does not alternate (lag-1 autocorrelation 0.10): an uneven floor or a spinning ball; the mean and \
the fits allow for it.
    >>> print(*meaning_of(0.0, Scatter(0.012, -0.62, "timing", 1.1)))
    Restitution differs by 0.012 from bounce to bounce and alternates (lag-1 autocorrelation \
-0.62): timing.
    >>> meaning_of(0.0, Scatter(0.012, -0.2, "unknown", 1.2))
    []
    """
    if found.cause == "unknown":
        note = (
            f"Restitution differs by {excess:.2g} from bounce to bounce, more than the errors of "
            "the times: an uneven floor or a spinning ball, or the timing, which these bounces do "
            f"not tell apart; these errors are taken to be {found.factor:.2g} times larger, as if "
            "it were the timing, and the mean and the fits allow for either."
        )
        return [note] if excess else []
    lag = f"(lag-1 autocorrelation {found.lag_one:.2f})"
    timing = found.cause == "timing"
    cause = f"alternates {lag}: timing"
    if not timing:
        cause = f"does not alternate {lag}: an uneven floor or a spinning ball"
    if excess:
        differs = f"{excess:.2g} from bounce to bounce, more than the errors of the times,"
        larger = f"these errors are taken to be {found.factor:.2g} times larger"
        cause += f"; {larger if timing else 'the mean and the fits allow for it'}"
    elif found.size < _NOTABLE:
        return []
    else:
        differs = f"{found.size:.2g} from bounce to bounce"
        cause += "" if timing else " rather than errors of the times"
    return [f"Restitution differs by {differs} and {cause}."]
