"""The minima of chi squared: many trials are screened, descents start at the best."""

import functools
import math
from collections.abc import Iterable
from operator import attrgetter
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from stackbounce.fitting.covariance import OPEN, find_directions
from stackbounce.fitting.objective import Objective
from stackbounce.run.quantities import Array

EQUAL = 1e-3
"""Minima whose chi squared differs by less are equally good."""

# Distances are in units of the width between the bounds.
_SCREENED, _MOST_SCREENED = 128, 1024  # screened trials per parameter, and at most
_SCREENED_RECORDS = 48  # screened trials with force records, where each trial takes long
_SHARED, _OWN = 32, 64  # screened trials per shared parameter, and per parameter of one drop
_FOLLOWED, _FOLLOWED_RECORDS = 8, 3  # descents besides those from given trials; with records
_APART = 0.05  # distance between the starts of two descents, at least
_SAME = 1e-3  # distance below which two ends are the same minimum
_BARRIER, _LOOKS = 1.0, 9  # rise of chi squared between two minima; trials on the line between
_STEPS = 60  # evaluations of one descent, at most
_LINEARISED = 100  # evaluations with derivatives of a whole search, about
_EXACT, _ROUGH = 1e-10, 1e-4  # relative gain in chi squared at which a descent, a first one stops
_NEAR, _HOPE = 0.01, 20.0  # rough ends that are followed further: distance, chi squared above best
_FLAT = 1e-3  # gain in chi squared that a linear step may promise at a smooth minimum
_SHORT = 60  # evaluations per parameter of the simplex at a kink


_chi_squared = attrgetter("chi_squared")


class Minimum(NamedTuple):
    """The end of a descent: trial (parameters,), chi squared, and whether it converged."""

    x: Array
    chi_squared: float
    converged: bool


def find_minima(
    objective: Objective, first: Array, count: int | None = None, seed: int = 0
) -> list[Minimum]:
    """Return the minima of chi squared, the best first, each once.

    Among equally good minima the nearest to the first trial comes first.

    Parameters
    ----------
    objective : Objective
        What is fitted.
    first : ndarray
        (n, parameters) trials from which descents start in any case.
    count : int, optional
        The number of screened trials.
    seed : int, optional
        The seed of their places.

    Returns
    -------
    list of Minimum

    Examples
    --------
    >>> import stackbounce as sb
    >>> from stackbounce.fitting import FitProblem
    >>> drop = sb.Drop([sb.Ball(1.0)], [sb.Spring(1.0)], height=1.0)
    >>> vary = {"contacts.0.stiffness": (0.1, 10.0)}
    >>> objective = FitProblem(drop, {"durations.0": "1.0 ± 0.1 s"}, vary).objective
    >>> best = find_minima(objective, np.zeros((1, 1)))[0]
    >>> float(objective.values(best.x[None])["contacts.0.stiffness"][0].round(4))  # pi squared
    9.8696
    """
    trials = spread_trials(objective, count, seed)
    follow = _FOLLOWED_RECORDS if objective.records else _FOLLOWED
    screened = trials[np.argsort(objective.chi_squared(trials), kind="stable")]
    chosen = _apart(objective, list(first), screened, _APART, follow)
    rough = sorted((_descend_smooth(objective, x, None, _ROUGH) for x in chosen), key=_chi_squared)
    limit = rough[0].chi_squared + max(_HOPE, rough[0].chi_squared)
    low = [end.x for end in rough if end.chi_squared <= limit]
    promising = _apart(objective, [], low, _NEAR, len(low))
    ends = sorted((descend(objective, x) for x in promising), key=_chi_squared)
    good = [end for end in ends if end.chi_squared < ends[0].chi_squared + EQUAL]
    good.sort(key=lambda end: np.sum(((end.x - chosen[0]) / objective.widths) ** 2))
    found: list[Minimum] = []
    for end in good + ends[len(good) :]:
        if not any(_is_same(objective, end, other) for other in found):
            found.append(end)
    return found


def descend(objective: Objective, x: Array, fixed: int | None = None) -> Minimum:
    """Return the end of a descent from a trial; the parameter of index `fixed` is kept."""
    end = _descend_smooth(objective, x, fixed, _EXACT)
    if _is_smooth(objective, end.x, fixed):
        return end
    other = _descend_smooth(objective, _cross_kink(objective, end.x, fixed), fixed, _EXACT)
    return min(other, end, key=_chi_squared)


def expected_trials(objective: Objective, count: int | None) -> int:
    """Return about how many trials a search makes; `count` is the number of screened ones."""
    return (count or _screened(objective)) + _LINEARISED * (2 * len(objective.spans) + 1)


def _screened(objective: Objective) -> int:
    """Return the usual number of screened trials."""
    if objective.records:
        return _SCREENED_RECORDS
    return min(_SCREENED * len(objective.spans), _MOST_SCREENED)


def spread_trials(objective: Objective, count: int | None, seed: int) -> Array:
    """Return (n, parameters) trials spread evenly between the bounds by a Sobol sequence.

    A parameter that only one of several drops has, such as its gap, is screened with the data of
    this drop: each trial of the shared parameters gets the value with the smallest chi squared.
    """
    spans = objective.spans
    own = {key: objective.own(key) for key in objective.measured if objective.own(key)}
    shared = [k for k in range(len(spans)) if not any(k in some for some in own.values())]
    if len(objective.measured) == 1 or not own or objective.records:
        return spread(spans, count or _screened(objective), seed)
    size = count or (_SHARED * len(shared) if shared else 1)
    trials = spread(spans, size, seed)
    for key, some in own.items():
        each = spread(spans[some], _OWN * len(some), seed)
        wide = np.repeat(trials, len(each), axis=0)
        wide[:, some] = np.tile(each, (size, 1))
        chi = objective.alone(key).chi_squared(wide).reshape(size, len(each))
        trials[:, some] = each[np.argmin(chi, axis=1)]
    return trials


def spread(spans: Array, count: int, seed: int) -> Array:
    """Return (count, parameters) trials spread evenly between bounds."""
    from scipy.stats import qmc

    drawn = qmc.Sobol(len(spans), rng=seed).random_base2(math.ceil(math.log2(count)))
    return np.asarray(spans[:, 0] + drawn[:count] * (spans[:, 1] - spans[:, 0]))


def _apart(
    objective: Objective, chosen: list[Array], others: Iterable[Array], distance: float, most: int
) -> list[Array]:
    """Return the chosen trials and the first of others, `most` of them, that lie apart from all."""
    found = list(chosen)
    for x in others:
        if len(found) == len(chosen) + most:
            break
        if all(np.max(np.abs(x - other) / objective.widths) > distance for other in found):
            found.append(x)
    return found


def _is_same(objective: Objective, end: Minimum, better: Minimum) -> bool:
    """Return whether two ends of descents are the same minimum: near, or without a barrier between.

    With an undetermined direction the valley may be bent: all equally good ends count as one.
    """
    widths = objective.widths
    if np.max(np.abs(end.x - better.x) / widths) < _SAME:
        return True
    way = np.linspace(better.x, end.x, _LOOKS + 2)[1:-1]
    if np.max(objective.chi_squared(way)) < max(end.chi_squared, better.chi_squared) + _BARRIER:
        return True
    equal = abs(end.chi_squared - better.chi_squared) < EQUAL
    return bool(equal and all(_is_undetermined(objective, x) for x in (end.x, better.x)))


def _is_undetermined(objective: Objective, x: Array) -> bool:
    """Return whether the data leave a direction undetermined at a trial."""
    return bool(find_directions(objective, objective.linearise(x)[1])[0][-1] <= OPEN)


def _descend_smooth(objective: Objective, x: Array, fixed: int | None, gain: float) -> Minimum:
    """Return the end of a descent by a trust region, which needs derivatives."""
    from scipy.optimize import least_squares

    free = np.arange(len(x)) != fixed
    if not free.any():
        return Minimum(x, float(objective.chi_squared(x[None])[0]), True)

    @functools.lru_cache(1)  # residuals and slopes are asked for in turn
    def linearised(*inner: float) -> tuple[Array, Array]:
        return objective.linearise(_moved(x, free, np.array(inner)))

    low, high = objective.spans[free].T
    found = least_squares(
        lambda inner: linearised(*inner)[0],
        np.clip(x[free], low, high),
        lambda inner: linearised(*inner)[1][:, free],
        bounds=(low, high),
        ftol=gain,
        xtol=10.0 * gain,
        max_nfev=_STEPS,
    )
    return Minimum(_moved(x, free, found.x), 2.0 * found.cost, bool(found.success))


def _cross_kink(objective: Objective, x: Array, fixed: int | None) -> Array:
    """Return a trial nearer to a minimum on a kink, by a simplex, which needs no derivatives."""
    from scipy.optimize import minimize

    free = np.arange(len(x)) != fixed
    low, widths = objective.spans[free, 0], objective.widths[free]

    def place(shares: Array) -> Array:
        return _moved(x, free, low + shares * widths)

    found = minimize(
        lambda shares: objective.chi_squared(place(shares)[None])[0],
        (x[free] - low) / widths,
        method="Nelder-Mead",
        bounds=[(0.0, 1.0)] * len(low),
        options={"maxfev": _SHORT * len(x)},
    )
    return place(found.x)


def _moved(x: Array, free: NDArray[np.bool_], inner: Array) -> Array:
    """Return a trial with other values of the free parameters."""
    trial = x.copy()
    trial[free] = inner
    return trial


def _is_smooth(objective: Objective, x: Array, fixed: int | None) -> bool:
    """Return whether a linear step would gain nothing at the end of a descent."""
    free = np.arange(len(x)) != fixed
    (low, high), longest = objective.spans[free].T, 0.1 * objective.widths[free]
    residuals, slopes = objective.linearise(x)
    step = -np.linalg.lstsq(slopes[:, free], residuals, rcond=1e-6)[0]
    step = np.clip(np.clip(x[free] + step, low, high) - x[free], -longest, longest)
    promised = np.sum(residuals**2) - np.sum((residuals + slopes[:, free] @ step) ** 2)
    return bool(promised < _FLAT)
