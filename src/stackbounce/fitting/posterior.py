"""Draws from what is known of the parameters after the data: emcee, many walkers at once."""

import functools
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from stackbounce.errors import InvalidValue, nearest, shown, whole

if TYPE_CHECKING:
    from uncertainties import UFloat

    from stackbounce.fitting.result import Fit

__all__ = ["Posterior", "sample"]

Array: TypeAlias = NDArray[np.float64]

_WALKERS = 32  # at least, four for each parameter, and so many that
_STEPS = 1000  # of each are enough
_BURNT = 0.25  # of all draws, thrown away
_SPREAD = 0.5  # standard deviations of the first places
_ENOUGH = 50  # autocorrelation times that a chain should have


@dataclass(frozen=True, eq=False)
class Posterior:
    """Draws from what is known of the parameters after the data; made by `Fit.sample`.

    Parameters
    ----------
    names : list of str
        What was varied.
    units : dict of str to str
        The SI unit of each.
    chain : ndarray
        (steps, walkers, parameters) values in SI units.
    log_probability : ndarray
        (steps, walkers) its logarithm, but for a constant.
    acceptance : float
        Which part of the steps was taken; 0.2 to 0.5 is usual.
    seed : int
        Of the random numbers.
    unsolved : int
        How many runs came to no end; where they should have been there are no draws.
    others : int
        How many other minima the fit knows.

    Notes
    -----
    Between the bounds every value is as probable beforehand, or every logarithm where the bounds
    are above 0 and more than a factor of 5 apart; where a prior is told, that alone. The walkers
    move by differences of others (differential evolution; ter Braak, Stat. Comput. 16, 239, 2006;
    emcee). They begin around the best values, and may not find another minimum.

    Examples
    --------
    >>> import stackbounce as sb
    >>> drop = sb.Drop([sb.Ball(0.0567)], [sb.Spring(1e4)], height=0.3)
    >>> found = sb.fit(drop, {"durations.0": "5.0 ± 0.1 ms"}, vary=["contacts.0.stiffness"])
    >>> posterior = found.sample(6400, seed=1)
    >>> 0.9 < posterior["contacts.0.stiffness"].std_dev / 900.0 < 1.1
    True
    """

    names: list[str]
    units: dict[str, str] = field(repr=False)
    chain: Array = field(repr=False)
    log_probability: Array = field(repr=False)
    acceptance: float
    seed: int
    unsolved: int = 0
    others: int = 0

    def __getitem__(self, name: str) -> "UFloat":
        """Mean and standard deviation of a parameter."""
        from uncertainties import ufloat

        draws = self.draws(name)
        return ufloat(float(np.mean(draws)), float(np.std(draws)))

    def draws(self, name: str) -> Array:
        """Return all draws of a parameter.

        Parameters
        ----------
        name : str
            What was varied.

        Returns
        -------
        ndarray
            (n,) in SI units.

        Raises
        ------
        InvalidValue
            If it was not varied.
        """
        if name not in self.names:
            raise InvalidValue(f"{shown(name)} was not varied; {nearest(name, self.names)}")
        return np.asarray(self.chain[:, :, self.names.index(name)].ravel())

    def quantiles(self, name: str, at: Any = (0.159, 0.5, 0.841)) -> Array:
        """Return quantiles of a parameter, by default one standard deviation and the middle.

        Parameters
        ----------
        name : str
            What was varied.
        at : array_like, optional
            (n,) from 0 to 1.

        Returns
        -------
        ndarray
            (n,) in SI units.
        """
        return np.asarray(np.quantile(self.draws(name), at))

    @functools.cached_property
    def autocorrelation(self) -> dict[str, float]:
        """Of each parameter after how many steps a walker has forgotten where it was."""
        from emcee.autocorr import integrated_time

        times = integrated_time(self.chain, quiet=True, tol=0)
        return dict(zip(self.names, times.tolist(), strict=True))

    @property
    def notes(self) -> tuple[str, ...]:
        """What should be known about it, a sentence each."""
        found = []
        steps, longest = len(self.chain), max(self.autocorrelation.values())
        if steps < _ENOUGH * longest:
            found.append(
                f"the chains are only {steps / longest:.0f} autocorrelation times long: draw "
                f"{_ENOUGH * longest / steps:.1f} times as many"
            )
        if not 0.1 < self.acceptance < 0.8:
            found.append(f"{self.acceptance:.0%} of the steps were taken, 20 to 50 % is usual")
        if self.unsolved:
            found.append(
                f"{self.unsolved} runs came to no end, and their places have no draws: tell "
                "narrower bounds"
            )
        if self.others:
            found.append("the fit has other minima, which the draws may leave out")
        return tuple(found)


def sample(fit: "Fit", draws: int, *, seed: int = 0, progress: Any = None) -> Posterior:
    """Return draws from what is known of the parameters of a fit after the data.

    Parameters
    ----------
    fit : Fit
        Where to begin, and what to sample.
    draws : int
        How many, of all walkers together, before the first quarter is thrown away.
    seed : int, optional
        Of the random numbers: the same seed gives the same draws.
    progress : callable, optional
        Called with how many draws are done, and with how many there will be.

    Returns
    -------
    Posterior

    Raises
    ------
    InvalidValue
        If the draws are too few.
    InvalidType
        If a number is no whole one.
    """
    import emcee

    problem, best = fit.problem, fit.x
    size = len(best)
    least = max(_WALKERS, 4 * size)
    walkers = max(least, 2 * (whole("draws", draws, 20 * least) // (2 * _STEPS)))
    steps = draws // walkers
    random = np.random.RandomState(whole("seed", seed, 0, 2**32 - 1))
    before = problem.unsolved.total()
    sampler = emcee.EnsembleSampler(
        walkers, size, _log_probability(problem), vectorize=True, moves=emcee.moves.DEMove()
    )
    sampler.random_state = random.get_state()
    first = _first(fit, walkers, random)
    for k, _ in enumerate(sampler.sample(first, iterations=steps)):
        if progress is not None:
            progress((k + 1) * walkers, steps * walkers)
    burnt = int(_BURNT * steps)
    inner = sampler.get_chain(discard=burnt)
    chain = np.stack(
        [one.value(inner[:, :, k]) for k, one in enumerate(problem.parameters)], axis=2
    )
    return Posterior(
        fit.names,
        fit.units,
        chain,
        sampler.get_log_prob(discard=burnt),
        float(np.mean(sampler.acceptance_fraction)),
        seed,
        problem.unsolved.total() - before,
        len(fit.minima) - 1,
    )


def _log_probability(problem: Any) -> Any:
    spans = problem.spans
    # what is told of a number is told of its value, not of its logarithm
    known = [one.prior is not None and one.logarithmic for one in problem.parameters]

    def at(x: Array) -> Array:
        inside = np.all((x >= spans[:, 0]) & (x <= spans[:, 1]), axis=1)
        found = np.full(len(x), -np.inf)
        if np.any(inside):
            found[inside] = np.sum(x[inside][:, known], axis=1)
            found[inside] -= 0.5 * problem.chi_squared(x[inside])
        return found

    return at


def _first(fit: "Fit", walkers: int, random: np.random.RandomState) -> Array:
    """Return where the walkers begin: around the best values, inside the bounds."""
    problem, best = fit.problem, fit.x
    spans = problem.spans
    wide = spans[:, 1] - spans[:, 0]
    slope = np.array([one.slope(x) for one, x in zip(problem.parameters, best, strict=True)])
    spread = np.sqrt(np.diag(fit.covariance.values)) / np.abs(slope)
    spread = np.clip(spread, 1e-6 * wide, 0.2 * wide)
    places = best + _SPREAD * spread * random.standard_normal((walkers, len(best)))
    folded = np.where(places < spans[:, 0], 2.0 * spans[:, 0] - places, places)
    folded = np.where(folded > spans[:, 1], 2.0 * spans[:, 1] - folded, folded)
    return np.asarray(np.clip(folded, spans[:, 0], spans[:, 1]))
