"""The curves of the paper's figures as arrays, computed by the library's solver."""

import numpy as np

from stackbounce.cross2007.bench import Bench
from stackbounce.cross2007.drops import Array, after_meeting, rigid_pair, spring_pair
from stackbounce.model.drop import Drop
from stackbounce.run.result import Result


def after_collision(bench: Bench, ratios: Array, restitution: float, count: int) -> Array:
    """Return both velocities right after the balls' `count`-th separate collision, over v0.

    Parameters
    ----------
    bench : Bench
        Simulates the drops.
    ratios : ndarray
        (R,) mass ratios m1/m2.
    restitution : float
        Of both contacts.
    count : int
        1 for v1 and v2 (eqs 1 and 2), 2 for v3 and v4 (eqs 3 and 4).

    Returns
    -------
    ndarray
        (2, R), lower and upper ball; nan where they do not collide that often.
    """
    results = [bench.simulate(rigid_pair((ratio, 1.0), restitution)) for ratio in ratios.tolist()]
    return np.array([after_meeting(result, count) for result in results]).T


def rebound_by_mass(bench: Bench, ratios: Array, stiffness_ratio: float) -> Array:
    """Return both rebound ratios of a drop on springs for mass ratios m1/m2, (2, R)."""
    drops = [spring_pair((ratio, 1.0), (stiffness_ratio, 1.0)) for ratio in ratios.tolist()]
    return np.array([bench.simulate(drop).rebound_ratios for drop in drops]).T


def rebound_by_stiffness(bench: Bench, mass_ratio: float, ratios: Array) -> Array:
    """Return both rebound ratios of a drop on springs for stiffness ratios k1/k2, (2, R)."""
    drops = [spring_pair((mass_ratio, 1.0), (ratio, 1.0)) for ratio in ratios.tolist()]
    return np.array([bench.simulate(drop).rebound_ratios for drop in drops]).T


def sample_forces(bench: Bench, drop: Drop, times: Array) -> tuple[Array, Result]:
    """Return the forces at floor and between the balls in N, (2, T), and the drop's result."""
    result = bench.simulate(drop)
    return np.asarray(result.sample(times)["force"].values), result
