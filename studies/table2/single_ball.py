"""Parameters of a single ball's contact law, calibrated for many restitutions at once.

By dimensional analysis, a law that is calibrated to mass m, contact time T and impact speed v has
the stiffness ``κ m/T**2 (v T)**(1 - p)`` and a loss that scales with T or v. κ and the scaled loss
are smooth functions of restitution and exponent, or of restitution and relaxation time. They are
interpolated with Chebyshev polynomials through results of `stackbounce.calibrate`.
"""

import functools
import math
from collections.abc import Callable
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.polynomial import chebyshev
from numpy.typing import NDArray

from stackbounce import calibrate
from stackbounce.model import ContactLaw
from studies.table2.inputs import Solo

Array: TypeAlias = NDArray[np.float64]

LOWEST = 0.5
"""The smallest restitution of the interpolation."""
RELAXATION = (0.02, 0.4)
"""The relaxation times of the interpolation, in contact times."""
_TERMS = 16  # of the polynomials in the restitution


class Numbers(NamedTuple):
    """Stiffness in N/m**exponent, the loss parameter and the relaxation time, of (n,) trials.

    The time is in s, and 0 for laws that have none.
    """

    stiffness: Array
    loss: Array
    relaxation: Array


class _Other(NamedTuple):
    """The second number of an interpolation: range, terms, and the option of `calibrate`."""

    low: float
    high: float
    terms: int
    option: Callable[[float], dict[str, float]]


_OTHER = {
    "exponent": _Other(1.0, 2.0, 8, lambda p: {"exponent": p}),
    "relaxation": _Other(
        math.log(RELAXATION[0]),
        math.log(RELAXATION[1]),
        20,
        lambda y: {"relaxation_time": math.exp(y)},
    ),
}


def calibrate_numbers(
    law: Any, ball: Solo, speed: float, restitution: Any, exponent: Any, relaxation: Any = None
) -> Numbers:
    """Return the parameters of a ball's law, calibrated to its contact time and restitution.

    Parameters
    ----------
    law : type
        `HuntCrossley`, `Viscoelastic`, `Hysteretic` or `StandardLinearSolid`.
    ball : Solo
        Mass and contact time.
    speed : float
        Of the impact, in m/s.
    restitution, exponent : float or ndarray
        (n,), from 0.5 to 1 and from 1 to 2; a restitution of 1 is no loss.
    relaxation : float or ndarray, optional
        (n,), the relaxation time of a `StandardLinearSolid` in contact times, in `RELAXATION`;
        without it the one that `stackbounce.calibrate` takes.

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
    e = np.asarray(restitution, dtype=float)
    if relaxation is None:
        unit, loss, relaxed = _at(law, e, "exponent", p)
    else:
        unit, loss, relaxed = _at(law, e, "relaxation", np.log(relaxation))
    mass, time = ball
    stiffness = unit * mass / time**2 * (speed * time) ** (1.0 - p)
    match loss_unit(law):
        case "s/m":
            loss = loss / speed
        case "s":
            loss = loss * time
    return Numbers(stiffness, loss, relaxed * time)


def loss_unit(law: type[ContactLaw]) -> str:
    """Return the SI unit of a law's loss parameter.

    Examples
    --------
    >>> from stackbounce.model import HuntCrossley
    >>> loss_unit(HuntCrossley)
    's/m'
    """
    return law.quantities()[law.loss].symbol


def _at(law: Any, restitution: Array, name: str, other: Array) -> tuple[Array, Array, Array]:
    """Return κ, the scaled loss and the relaxation time: those for 1 kg, 1 s and 1 m/s."""
    x = 2.0 * (restitution - LOWEST) / (1.0 - LOWEST) - 1.0
    if other.ndim == 0:
        table = _of_restitution(law, name, float(other))
        found = [chebyshev.chebval(x, row) for row in table]
    else:
        low, high, *_ = _OTHER[name]
        y = 2.0 * (other - low) / (high - low) - 1.0
        found = [chebyshev.chebval2d(x, y, grid) for grid in _of_both(law, name)]
    # round-off must not make a lossless contact gain energy
    top = 1.0 if law.loss == "restitution" else np.inf
    return np.exp(found[0]), np.clip(found[1], 0.0, top), found[2]


def _law(law: Any, restitution: float, options: dict[str, float]) -> tuple[float, float, float]:
    made: Any = calibrate(
        law, mass=1.0, contact_time=1.0, restitution=restitution, impact_speed=1.0, **options
    )
    relaxed = getattr(made, law.fourth_number) if law.fourth_number else 0.0
    return float(np.log(made.stiffness)), float(getattr(made, law.loss)), float(relaxed)


@functools.cache
def _of_restitution(law: Any, name: str, other: float) -> Array:
    """Return (3, terms) coefficients: the stiffness's logarithm, the loss, the relaxation time."""
    is_fixed = name == "exponent" and law.fixed_exponent() is not None
    options = {} if is_fixed else _OTHER[name].option(other)
    return _interpolated(lambda e: _law(law, e, options), LOWEST, 1.0, _TERMS)


@functools.cache
def _of_both(law: Any, name: str) -> Array:
    """Return (3, terms, others) coefficients in the restitution and the other number."""
    low, high, terms, _ = _OTHER[name]
    inner = _interpolated(
        lambda y: _of_restitution(law, name, y).ravel(), low, high, terms
    )  # (3 TERMS, terms)
    return inner.reshape(-1, _TERMS, terms)


def _interpolated(function: Callable[[float], Any], low: float, high: float, count: int) -> Array:
    """Return (numbers, count) Chebyshev coefficients of a function of one number."""
    nodes = chebyshev.chebpts1(count)
    values = [function(float(low + 0.5 * (x + 1.0) * (high - low))) for x in nodes]
    return np.asarray(chebyshev.chebfit(nodes, np.array(values), count - 1).T)
