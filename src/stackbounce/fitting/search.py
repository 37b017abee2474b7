"""The best trial: many screened at once, the best of them followed down by lmfit."""

import math
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from stackbounce.fitting.problem import Problem

__all__ = ["EQUAL", "OPEN", "Minimum", "descend", "directions", "search"]

Array: TypeAlias = NDArray[np.float64]

_SCREENED, _MOST_SCREENED = 128, 1024  # trials for each parameter, and for all
_SLOW = 48  # trials in all where each has a record to be computed
_SHARED, _OWN = 32, 64  # the same where drops have parameters of their own; and trials of these
_FOLLOWED, _SLOWLY = 8, 3  # of them, besides the drop as it is; with records
_APART = 0.05  # of the bounds' distance: nearer ones are one start
_SAME = 1e-3  # of the bounds' distance: one minimum
_BARRIER, _LOOKS = 1.0, 9  # of chi squared between two minima, and trials on the way
EQUAL = 1e-3
"""Of chi squared: minima that are as good."""

OPEN = 1.0
"""Root of chi squared's change from bound to bound below which a direction is left open."""

_STEPS = 60  # of one descent
_EXACT, _ROUGH = 1e-10, 1e-4  # of chi squared: the last step's gain, and that of a first descent
_NEAR, _HOPE = 0.01, 20.0  # of the bounds' distance, and of chi squared: rough ends worth following
_FLAT = 1e-3  # how much of chi squared a gradient step may promise at an end that is no kink
_SHORT = 60  # evaluations for each parameter where a kink is in the way


class Minimum(NamedTuple):
    """The end of a descent: coordinates (parameters,), chi squared, and whether it converged."""

    x: Array
    chi_squared: float
    converged: bool


def search(
    problem: Problem,
    first: Array,
    count: int | None = None,
    seed: int = 0,
    follow: int | None = None,
) -> list[Minimum]:
    """Return the minima that were found, the best first, each once.

    Of minima that are as good the nearest to the first trial comes first.

    Parameters
    ----------
    problem : Problem
        What to fit.
    first : ndarray
        (n, parameters) trials to follow whatever comes of the screening.
    count : int, optional
        How many trials to screen.
    seed : int, optional
        Of their places.
    follow : int, optional
        How many of them to follow.

    Examples
    --------
    >>> import stackbounce as sb
    >>> from stackbounce.fitting.question import read_problem
    >>> drop = sb.Drop([sb.Ball(1.0)], [sb.Spring(1.0)], height=1.0)
    >>> vary = {"contacts.0.stiffness": (0.1, 10.0)}
    >>> problem = read_problem(drop, {"durations.0": "1.0 ± 0.1 s"}, vary, None, 1e-9)
    >>> best = search(problem, np.zeros((1, 1)))[0]
    >>> float(problem.values(best.x[None])["contacts.0.stiffness"][0].round(4))  # pi squared
    9.8696
    """
    trials = starts(problem, count, seed)
    if follow is None:
        follow = _SLOWLY if problem.records else _FOLLOWED
    chosen = _apart(problem, first, trials, follow)
    near = sorted((_by_slopes(problem, x, None, _ROUGH) for x in chosen), key=_chi_squared)
    ends = sorted((descend(problem, one.x) for one in _worth(problem, near)), key=_chi_squared)
    wide = problem.spans[:, 1] - problem.spans[:, 0]
    good = [one for one in ends if one.chi_squared < ends[0].chi_squared + EQUAL]
    nearest = sorted(good, key=lambda one: np.sum(((one.x - chosen[0]) / wide) ** 2))
    return _distinct(problem, nearest + ends[len(good) :])


def _chi_squared(one: Minimum) -> float:
    return one.chi_squared


def _worth(problem: Problem, near: list[Minimum]) -> list[Minimum]:
    """Return those of some rough ends, the best first, that may lead to minima of their own."""
    wide = problem.spans[:, 1] - problem.spans[:, 0]
    limit = near[0].chi_squared + max(_HOPE, near[0].chi_squared)
    found: list[Minimum] = []
    for one in near:
        apart = all(np.max(np.abs(one.x - other.x) / wide) > _NEAR for other in found)
        if apart and one.chi_squared <= limit:
            found.append(one)
    return found


def descend(problem: Problem, x: Array, fixed: int | None = None) -> Minimum:
    """Return the end of the descent from a trial, with one parameter kept if so told."""
    end = _by_slopes(problem, x, fixed, _EXACT)
    if _smooth(problem, end.x, fixed):
        return end
    other = _by_slopes(problem, _without_slopes(problem, end.x, fixed), fixed, _EXACT)
    return min(other, end, key=lambda one: one.chi_squared)


def starts(problem: Problem, count: int | None, seed: int) -> Array:
    """Return (n, parameters) trials spread evenly between the bounds.

    What concerns one of several drops alone, such as its gap, is looked at for that drop alone: of
    many values the best for each trial of what is shared.
    """
    spans = problem.spans
    own = {key: problem.own(key) for key in problem.measured if problem.own(key)}
    shared = [k for k in range(len(spans)) if not any(k in some for some in own.values())]
    if len(problem.measured) == 1 or not own or problem.records:
        usual = _SLOW if problem.records else min(_SCREENED * len(spans), _MOST_SCREENED)
        return _spread(spans, count or usual, seed)
    size = count or (_SHARED * len(shared) if shared else 1)
    trials = _spread(spans, size, seed)
    for key, some in own.items():
        each = _spread(spans[some], _OWN * len(some), seed)
        wide = np.repeat(trials, len(each), axis=0)
        wide[:, some] = np.tile(each, (size, 1))
        chi = problem.alone(key).chi_squared(wide).reshape(size, len(each))
        trials[:, some] = each[np.argmin(chi, axis=1)]
    return trials


def _spread(spans: Array, count: int, seed: int) -> Array:
    from scipy.stats import qmc

    drawn = qmc.Sobol(len(spans), rng=seed).random_base2(math.ceil(math.log2(count)))
    return np.asarray(spans[:, 0] + drawn[:count] * (spans[:, 1] - spans[:, 0]))


def _apart(problem: Problem, first: Array, trials: Array, count: int) -> list[Array]:
    """Return some trials, and the best of others that are not near them or each other."""
    wide = problem.spans[:, 1] - problem.spans[:, 0]
    chosen = list(first)
    for k in np.argsort(problem.chi_squared(trials), kind="stable"):
        if len(chosen) >= len(first) + count:
            break
        if all(np.max(np.abs(trials[k] - one) / wide) > _APART for one in chosen):
            chosen.append(trials[k])
    return chosen


def _distinct(problem: Problem, ends: list[Minimum]) -> list[Minimum]:
    """Return the ends of descents without those that lie in the valley of a better one."""
    found: list[Minimum] = []
    for end in ends:
        if not any(_together(problem, end, one) for one in found):
            found.append(end)
    return found


def _together(problem: Problem, end: Minimum, better: Minimum) -> bool:
    """Tell whether two ends of descents are one minimum: near, or with no barrier between them.

    Where data leave a direction open the valley may be bent: all that is as good is one.
    """
    wide = problem.spans[:, 1] - problem.spans[:, 0]
    if np.max(np.abs(end.x - better.x) / wide) < _SAME:
        return True
    way = np.linspace(better.x, end.x, _LOOKS + 2)[1:-1]
    if np.max(problem.chi_squared(way)) < max(end.chi_squared, better.chi_squared) + _BARRIER:
        return True
    equal = abs(end.chi_squared - better.chi_squared) < EQUAL
    return bool(equal and all(_open(problem, one.x) for one in (end, better)))


def _open(problem: Problem, x: Array) -> bool:
    """Tell whether a direction is left open at a trial."""
    return bool(directions(problem, problem.expanded(x)[1])[0][-1] <= OPEN)


def directions(problem: Problem, slopes: Array) -> tuple[Array, Array]:
    """Return in which directions, and how well, data determine parameters; see `Fit.directions`."""
    spans = problem.spans
    _, sizes, found = np.linalg.svd(slopes * (spans[:, 1] - spans[:, 0]))
    return np.pad(sizes, (0, len(found) - len(sizes))), found


def _parameters(problem: Problem, x: Array, fixed: int | None) -> Any:
    """Return lmfit's parameters for a trial; its own names, x0, x1 and so on, stay in here."""
    import lmfit

    parameters = lmfit.Parameters()
    for k, (low, high) in enumerate(problem.spans):
        start = float(np.clip(x[k], low, high))
        parameters.add(f"x{k}", value=start, min=low, max=high, vary=k != fixed)
    return parameters


def _trial(parameters: Any) -> Array:
    return np.array([one.value for one in parameters.values()])


def _by_slopes(problem: Problem, x: Array, fixed: int | None, gain: float) -> Minimum:
    """Return the end of lmfit's trust region; residuals and slopes of a trial come together."""
    import lmfit

    if len(x) == 1 and fixed == 0:
        return Minimum(x, float(problem.chi_squared(x[None])[0]), True)
    free = [k for k in range(len(x)) if k != fixed]
    kept: dict[bytes, tuple[Array, Array]] = {}

    def expanded(parameters: Any) -> tuple[Array, Array]:
        trial = _trial(parameters)
        if trial.tobytes() not in kept:
            kept[trial.tobytes()] = problem.expanded(trial)
        return kept[trial.tobytes()]

    minimizer = lmfit.Minimizer(
        lambda now: expanded(now)[0], _parameters(problem, x, fixed), calc_covar=False
    )
    options = {"max_nfev": _STEPS, "xtol": 10.0 * gain, "ftol": gain}
    with np.errstate(all="ignore"):  # lmfit's own errors where data determine nothing
        found = minimizer.least_squares(Dfun=lambda now: expanded(now)[1][:, free], **options)
    end = _trial(found.params)
    return Minimum(end, float(np.sum(expanded(found.params)[0] ** 2)), bool(found.success))


def _without_slopes(problem: Problem, x: Array, fixed: int | None) -> Array:
    """Return a trial nearer to a minimum that lies on a kink, where slopes lead nowhere."""
    import lmfit

    minimizer = lmfit.Minimizer(
        lambda now: problem.residuals(_trial(now)[None])[0],
        _parameters(problem, x, fixed),
        calc_covar=False,
    )
    return _trial(minimizer.minimize(method="nelder", max_nfev=_SHORT * len(x)).params)


def _smooth(problem: Problem, x: Array, fixed: int | None) -> bool:
    """Tell whether a step along the slopes would gain nothing at the end of a descent."""
    free = [k for k in range(len(x)) if k != fixed]
    if not free:
        return True
    spans, (residuals, slopes) = problem.spans[free], problem.expanded(x)
    slopes = slopes[:, free]
    step = -np.linalg.lstsq(slopes, residuals, rcond=1e-6)[0]
    wide = spans[:, 1] - spans[:, 0]
    inside = np.clip(x[free] + step, spans[:, 0], spans[:, 1]) - x[free]
    step = np.clip(inside, -0.1 * wide, 0.1 * wide)
    promised = np.sum(residuals**2) - np.sum((residuals + slopes @ step) ** 2)
    return bool(promised < _FLAT)
