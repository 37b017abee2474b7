"""Parameters of a single ball's contact law, calibrated for many restitutions at once.

By dimensional analysis, a law that is calibrated to mass m, contact time T and impact speed v has
the stiffness ``κ m/T**2 (v T)**(1 - p)`` and a loss that scales with T or v. κ and the scaled loss
are smooth functions of restitution and exponent. They are interpolated with Chebyshev polynomials
through results of `stackbounce.calibrate`.
"""

import functools
from collections.abc import Callable
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.polynomial import chebyshev
from numpy.typing import NDArray

from stackbounce.calibration import calibrate
from stackbounce.cross2007.study.inputs import Solo
from stackbounce.model import ContactLaw

__all__ = ["LOWEST", "Numbers", "calibrate_numbers", "loss_unit"]

Array: TypeAlias = NDArray[np.float64]

LOWEST = 0.5
"""The smallest restitution of the interpolation."""
_STEEPEST = 2.0  # the largest exponent
_TERMS, _POWERS = 16, 8  # of the polynomials, in restitution and exponent


class Numbers(NamedTuple):
    """Stiffness in N/m**exponent and the loss parameter, each of (n,) trials."""

    stiffness: Array
    loss: Array


def calibrate_numbers(
    law: Any, ball: Solo, speed: float, restitution: Any, exponent: Any
) -> Numbers:
    """Return the parameters of a ball's law, calibrated to its contact time and restitution.

    Parameters
    ----------
    law : type
        `HuntCrossley`, `Viscoelastic` or `Hysteretic`.
    ball : Solo
        Mass and contact time.
    speed : float
        Of the impact, in m/s.
    restitution, exponent : float or ndarray
        (n,), from 0.5 to 1 and from 1 to 2; a restitution of 1 is no loss.

    Returns
    -------
    Numbers

    Examples
    --------
    >>> from stackbounce.model import HuntCrossley
    >>> ball = Solo(0.105, 4.3e-3)
    >>> law = calibrate(HuntCrossley, mass=0.105, contact_time=4.3e-3, restitution=0.88,
    ...                 impact_speed=2.0, exponent=1.5)
    >>> loss = float(calibrate_numbers(HuntCrossley, ball, 2.0, 0.88, 1.5).loss)
    >>> abs(loss / law.dissipation - 1.0) < 1e-9
    True
    """
    p = np.asarray(exponent, dtype=float)
    unit, loss = _at(law, np.asarray(restitution, dtype=float), p)
    mass, time = ball
    stiffness = unit * mass / time**2 * (speed * time) ** (1.0 - p)
    match loss_unit(law):
        case "s/m":
            loss = loss / speed
        case "s":
            loss = loss * time
    return Numbers(stiffness, loss)


def loss_unit(law: type[ContactLaw]) -> str:
    """Return the SI unit of a law's loss parameter.

    Examples
    --------
    >>> from stackbounce.model import HuntCrossley
    >>> loss_unit(HuntCrossley)
    's/m'
    """
    return law.quantities()[law.loss].symbol


def _at(law: Any, restitution: Array, exponent: Array) -> tuple[Array, Array]:
    """Return κ and the scaled loss: stiffness and loss for 1 kg, 1 s and 1 m/s."""
    x = 2.0 * (restitution - LOWEST) / (1.0 - LOWEST) - 1.0
    if exponent.ndim == 0:
        table = _of_restitution(law, float(exponent))
        found = [chebyshev.chebval(x, one) for one in table]
    else:
        y = 2.0 * (exponent - 1.0) / (_STEEPEST - 1.0) - 1.0
        found = [chebyshev.chebval2d(x, y, one) for one in _of_both(law)]
    # round-off must not make a lossless contact gain energy
    top = 1.0 if law.loss == "restitution" else np.inf
    return np.exp(found[0]), np.clip(found[1], 0.0, top)


def _law(law: Any, restitution: float, exponent: float) -> tuple[float, float]:
    options = {"exponent": exponent} if law.fixed_exponent() is None else {}
    made: Any = calibrate(
        law, mass=1.0, contact_time=1.0, restitution=restitution, impact_speed=1.0, **options
    )
    return float(np.log(made.stiffness)), float(getattr(made, law.loss))


@functools.cache
def _of_restitution(law: Any, exponent: float) -> Array:
    """Return (2, terms) coefficients of the stiffness's logarithm and the loss."""
    return _interpolated(lambda e: _law(law, e, exponent), LOWEST, 1.0, _TERMS)


@functools.cache
def _of_both(law: Any) -> Array:
    """Return (2, terms, powers) coefficients in restitution and exponent."""
    inner = _interpolated(
        lambda p: _of_restitution(law, p).ravel(), 1.0, _STEEPEST, _POWERS
    )  # (2 terms, powers)
    return inner.reshape(2, _TERMS, _POWERS)


def _interpolated(function: Callable[[float], Any], low: float, high: float, count: int) -> Array:
    """Return (numbers, count) Chebyshev coefficients of a function of one number."""
    nodes = chebyshev.chebpts1(count)
    values = [function(float(low + 0.5 * (x + 1.0) * (high - low))) for x in nodes]
    return np.asarray(chebyshev.chebfit(nodes, np.array(values), count - 1).T)
