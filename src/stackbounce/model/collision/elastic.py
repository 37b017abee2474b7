"""One ball on a lossless power law ``F = k c**p``: the units of length and time for all laws.

C is the compression at which the contact stores the whole kinetic energy of the collision. No
collision at the speed v reaches a larger compression. Contact times are given in units of C/v.
"""

import math
from collections.abc import Mapping


def duration(p: float) -> float:
    """Return the contact time on a lossless power law, in units of C/v: π for a linear spring.

    Parameters
    ----------
    p : float
        The exponent, 1 or above.

    Returns
    -------
    float
        ``2 sqrt(π) Γ(1 + 1/(p + 1)) / Γ(1/2 + 1/(p + 1))``.

    Notes
    -----
    Source, for p = 3/2: L. D. Landau and E. M. Lifshitz, Theory of Elasticity, section 9,
    problem 1.

    Examples
    --------
    >>> [round(duration(p), 6) for p in (1.0, 1.5, 2.0)]
    [3.141593, 2.943275, 2.804364]
    """
    share = 1.0 / (p + 1.0)
    return 2.0 * math.sqrt(math.pi) * math.gamma(1.0 + share) / math.gamma(0.5 + share)


def peak_compression(k: float, p: float, mass: float, speed: float) -> float:
    """Return C in m, where the contact stores the kinetic energy: ``k C**(p+1)/(p+1) = m v**2/2``.

    Examples
    --------
    >>> peak_compression(400.0, 1.0, 1.0, 2.0)
    0.1
    """
    share = 1.0 / (p + 1.0)
    return float((0.5 * (p + 1.0) * mass) ** share / k**share * speed ** (2.0 * share))


def measured_stiffness(given: Mapping[str, float], duration: float) -> float:
    """Return the stiffness k in N/m**p that gives a measured contact time.

    Parameters
    ----------
    given : mapping of str to float
        ``mass`` in kg, ``contact_time`` in s, ``impact_speed`` in m/s and ``exponent``.
    duration : float
        The contact time of the law in units of C/v.

    Raises
    ------
    ArithmeticError
        If k overflows.

    Examples
    --------
    >>> given = {"mass": 1.0, "contact_time": 0.1, "impact_speed": 2.0, "exponent": 1.0}
    >>> round(measured_stiffness(given, 2.0), 9)  # C is 0.1 m
    400.0
    """
    p, speed = given["exponent"], given["impact_speed"]
    peak = given["contact_time"] * speed / duration
    return float(0.5 * (p + 1.0) * given["mass"] * (speed / peak) ** 2 / peak ** (p - 1.0))
