"""``fit``: measured drops -> parameters with errors."""

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from stackbounce.errors import between, whole
from stackbounce.fitting.parameters import current, places
from stackbounce.fitting.problem import Problem
from stackbounce.fitting.question import read_problem
from stackbounce.fitting.result import Fit
from stackbounce.fitting.search import search
from stackbounce.model import Drop

__all__ = ["fit"]

_MOST_STARTS = 1_000_000


def fit(
    drop: Drop | Mapping[str, Drop],
    data: Any,
    vary: Any,
    *,
    tie: Any = None,
    starts: int | None = None,
    seed: int = 0,
    rtol: float = 1e-9,
) -> Fit:
    """Return the numbers of a drop, or of several, that describe what was measured best.

    Parameters
    ----------
    drop : Drop, or mapping of str to Drop
        What was dropped, with all that is known. Several have names, such as ``B2_on_B1``.
    data : mapping
        What was measured, by name: ``rebound_ratios.1``, ``rebound_speeds`` (m/s),
        ``rebound_heights`` (m), ``first_touch.1`` (s, the delay), ``last_release``, ``durations``
        (s), ``energy_retained``, ``force.0`` (a waveform), each with its error: ``"1.64 ± 0.02"``;
        ``collisions`` are compared, not fitted. Of several drops: by the drop's name.
    vary : mapping or sequence of str
        What may change, by the paths that `sweep` has: ``{"contacts.1.stiffness": (1e3, 1e6)}``,
        ``{"gaps.0": "0 mm : 5 mm"}``, ``{"gaps.0": "1.3 ± 0.9 mm"}`` for what is known beforehand,
        `Range` for both, None or a plain list of names for bounds around the drop's own numbers.
        With several drops a path is shared by all that have it; ``B2_on_B1.gaps.0`` is of one. A
        name that is no path can be varied if a tie uses it.
    tie : mapping, optional
        Numbers that follow from others: ``{"contacts.1.stiffness": "0.5 * contacts.0.stiffness"}``,
        a formula of what is varied and of numbers of the same drop, or a function of Python, which
        takes a mapping of them to arrays.
    starts : int, optional
        How many trials to look at before the best of them are followed; default 128 for each
        parameter, 1024 at most.
    seed : int, optional
        Of where they lie.
    rtol : float, optional
        To which each drop is solved where its laws are not linear.

    Returns
    -------
    Fit
        Best values with errors and correlations, chi squared, residuals, and what the data cannot
        determine; `Fit.intervals` for confidence intervals, `Fit.sample` for the posterior.

    Raises
    ------
    InvalidValue
        If a name is unknown, a number has no error, bounds do not fit, or there is more to vary
        than was measured.
    InvalidType
        If something has the wrong type.

    Notes
    -----
    Least squares with known errors. The surface has kinks where contacts appear: trials spread
    over all of the bounds are screened at once, the best are followed down by lmfit (trust region,
    then Nelder and Mead's simplex where a kink is in the way), and other minima are told.

    Examples
    --------
    The tennis ball on a basketball of R. Cross, Am. J. Phys. 75, 1009 (2007): which stiffness
    between the balls throws it up at 1.64 v0, if nothing is lost?

    >>> import stackbounce as sb
    >>> balls, contacts = [sb.Ball(0.150), sb.Ball(0.057)], [sb.Spring(2500.0), sb.Spring(1000.0)]
    >>> drop = sb.Drop(balls, contacts, impact_speed=3.53)
    >>> data = {"rebound_ratios.1": "1.64 ± 0.02"}
    >>> found = sb.fit(drop, data, {"contacts.1.stiffness": "0.7 kN/m : 2.5 kN/m"})
    >>> print(f"{found['contacts.1.stiffness']:.1u} N/m")
    (1.48+/-0.06)e+03 N/m
    """
    limit = between("rtol", rtol, 1e-14, 1e-3)
    problem = read_problem(drop, data, vary, tie, limit)
    count = None if starts is None else whole("starts", starts, 1, _MOST_STARTS)
    minima = search(problem, _own(problem), count, whole("seed", seed, 0))
    return Fit(problem, minima, dict(problem.unsolved))


def _own(problem: Problem) -> NDArray[np.float64]:
    """Return the trial (1, parameters) of the drops' own numbers, where they lie in the bounds."""
    found = []
    for one in problem.parameters:
        at = places(problem.drops, one.name)
        value = current(problem.drops[at[0][0]], at[0][1]) if at else np.nan
        inside = one.low <= value <= one.high
        found.append(one.coordinate(value) if inside else 0.5 * sum(one.span))
    return np.array([found])
