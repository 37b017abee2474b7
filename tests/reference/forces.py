"""The contact laws in double precision, compiled, written straight from the table of the laws.

What the elements of a hysteretic contact remember is a row of pairs (l, H), see `laws`, of which
`depth` are in use; H = inf on the loading curve.
"""

import numpy as np
from numba import njit

NONE, POWER, DASHPOT, VISCOELASTIC, HUNT_CROSSLEY, HYSTERETIC = range(6)
OPEN, LOADING, UNLOADING, CLIPPED = range(4)
MOST_PAIRS = 50


def numbers_of(
    law: str,
    stiffness: float,
    exponent: float = 1.0,
    damping: float = 0.0,
    dissipative_time: float = 0.0,
    dissipation: float = 0.0,
    restitution: float | None = None,
    unloading_exponent: float | None = None,
) -> tuple[float, ...]:
    """Return code, stiffness, loading and unloading exponent, and the damping of a law."""
    if law == "Hysteretic":
        if restitution is not None:
            unloading_exponent = (exponent + 1.0) / restitution**2 - 1.0
        return HYSTERETIC, stiffness, exponent, unloading_exponent, 0.0
    code, p, b = {
        "Spring": (POWER, 1.0, 0.0),
        "Hertz": (POWER, 1.5, 0.0),
        "PowerLaw": (POWER, exponent, 0.0),
        "Dashpot": (DASHPOT, 1.0, damping),
        "Viscoelastic": (VISCOELASTIC, 1.5, dissipative_time),
        "HuntCrossley": (HUNT_CROSSLEY, exponent, dissipation),
    }[law]
    return code, stiffness, p, p, b


@njit
def power(x, p):
    if p == 1.0:
        return x
    if x <= 0.0:
        return 0.0
    return x * np.sqrt(x) if p == 1.5 else x**p


@njit
def hysteretic_force(law, pairs, depth, c):
    total, k, p, fade = 0.0, law[1], law[2], law[3] - law[2]
    for j in range(depth):
        low, peak = pairs[j]
        high = pairs[j + 1, 0] if j + 1 < depth else c
        share = 1.0 if peak == np.inf else power(c / peak, fade)
        total += share * k * (power(high, p) - power(low, p))
    return total


@njit
def force_of(law, c, rate):
    """Return the force of the formula, which may pull."""
    code, k, p, b = law[0], law[1], law[2], law[4]
    if code == POWER:
        return k * power(c, p)
    if code == DASHPOT:
        return k * c + b * rate
    if code == VISCOELASTIC:
        return k * np.sqrt(max(c, 0.0)) * (c + 1.5 * b * rate)
    return k * power(c, p) * (1.0 + b * rate)


@njit
def accelerate(mass, laws, phase, pairs, depth, gravity, c, rates, force, a):
    """Write the forces and the second derivatives of the compressions."""
    size = len(mass)
    for i in range(size):
        force[i] = 0.0
        if laws[i, 0] == HYSTERETIC:
            force[i] = hysteretic_force(laws[i], pairs[i], depth[i], c[i])
        elif phase[i] == LOADING or phase[i] == UNLOADING:
            force[i] = force_of(laws[i], c[i], rates[i])
    below = 0.0  # the acceleration of the ball below; the floor has none
    for i in range(size):
        above = force[i + 1] if i + 1 < size else 0.0
        own = (force[i] - above) / mass[i] - gravity
        a[i] = (
            below - own
            if i == 0
            else (-force[i] + force[i - 1]) / mass[i - 1] - (force[i] - above) / mass[i]
        )
    return a


@njit
def turning_lengths(mass, laws, speed):
    """Return the compression of every contact at which its lighter ball would turn."""
    found = np.full(len(mass), np.inf)
    for i in range(len(mass)):
        if laws[i, 0] != NONE:
            m = mass[i] if i == 0 else min(mass[i], mass[i - 1])
            p = laws[i, 2]
            found[i] = ((p + 1.0) * m * speed**2 / (2.0 * laws[i, 1])) ** (1.0 / (p + 1.0))
    return found
