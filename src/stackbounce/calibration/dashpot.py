"""One ball on a dashpot, in closed form.

With ``ω0**2 = k/m`` and the damping ratio ``ζ = b/(2 m ω0)`` the compression is
``c = (v/ω) exp(-ζ ω0 t) sin(ω t)``, ``ω = ω0 sqrt(1 - ζ**2)``. The force is back at zero where
``tan(ω T) = -2 ζ ω0 ω/(ω**2 - ζ**2 ω0**2)``, that is ``ω T = 2 acos(ζ)``, and there ``ċ`` is
``-v exp(-ζ ω0 T)``. So

``ω0 T = 2 acos(ζ)/sqrt(1 - ζ**2)``,  ``e = exp(-2 ζ acos(ζ)/sqrt(1 - ζ**2))``,

which are analytic in ζ through the critical 1, where they are 2 and exp(-2), and go on with
``acosh(ζ)/sqrt(ζ**2 - 1)``: an overdamped ball leaves, too, at ``(2 ζ)**-2`` for large ζ.

Source: T. Schwager and T. Pöschel, Granular Matter 9, 465 (2007), with
``acos(ζ)`` for their arcs of tangents.
"""

import math

from stackbounce.calibration.roots import root

__all__ = ["damping_ratio", "duration", "restitution"]

_FAR = 2.0  # from here on 1 - x would lose digits


def duration(zeta: float) -> float:
    """Return ``ω0 T`` of the contact time T; 1/ω0 is C/v as well, see `elastic`.

    Parameters
    ----------
    zeta : float
        The damping ratio ζ, 0 or above.

    Returns
    -------
    float
        From π down to 0.

    Examples
    --------
    >>> [round(duration(zeta), 6) for zeta in (0.0, 0.1, 1.0)]
    [3.141593, 2.956075, 2.0]
    """
    if zeta > _FAR:
        return 2.0 * math.acosh(zeta) / (math.sqrt(zeta - 1.0) * math.sqrt(zeta + 1.0))
    # acos(ζ) = 2 atan(x) and sqrt(1 - ζ**2) = (1 + ζ) x, without loss where x is small
    x = math.sqrt(abs(1.0 - zeta) / (1.0 + zeta))
    arc = math.atan(x) if zeta < 1.0 else math.atanh(x)
    return 4.0 / (1.0 + zeta) * (arc / x if x > 0.0 else 1.0)


def restitution(zeta: float) -> float:
    """Return e at a damping ratio ζ of 0 or above.

    Examples
    --------
    >>> [round(restitution(zeta), 6) for zeta in (0.0, 0.1, 0.3)]
    [1.0, 0.744079, 0.450975]
    """
    return math.exp(-zeta * duration(zeta))


def damping_ratio(restitution: float) -> float:
    """Return ζ, 0 or above, at which e is `restitution`, from above 0 to 1.

    Examples
    --------
    >>> round(damping_ratio(0.744079), 6)
    0.1
    """
    loss = -math.log(restitution)
    if loss == 0.0:
        return 0.0
    # ζ acos(ζ)/sqrt(1 - ζ**2) is at most ζ π/2, and from ζ = 1 on at least acosh(ζ)
    low, high = loss / math.pi, math.cosh(0.5 * loss)
    return root(lambda zeta: zeta * duration(zeta) - loss, low, high)
