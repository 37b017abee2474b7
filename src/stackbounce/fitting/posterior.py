"""Draws from the posterior distribution of the parameters, by emcee."""

import functools
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from stackbounce.errors import one_of, shown, whole
from stackbounce.extras import need
from stackbounce.fitting.objective import Objective
from stackbounce.library_types import Dataset, UFloat
from stackbounce.run.options import check_room, seed_of
from stackbounce.run.paths import identifier
from stackbounce.run.quantities import Array
from stackbounce.shown import Shown, Table

if TYPE_CHECKING:
    from stackbounce.fitting.result import Fit

_WALKERS = 32  # walkers, at least; also at least four per parameter
_STEPS = 1000  # of a walker: more draws mean more walkers
_BURNT = 0.25  # share of the draws discarded as burn-in
_SPREAD = 0.5  # scatter of the walkers' first places, in standard deviations
_MOST_DRAWS = 10**15
_NUMBERS = 3  # that are kept of each parameter of a draw, at most at one time
_ENOUGH = 50  # length of a sufficient chain, in autocorrelation times


@dataclass(frozen=True, eq=False, repr=False)
class Posterior(Shown):
    """Draws from the posterior distribution of the parameters; made by `Fit.sample`.

    Parameters
    ----------
    names : list of str
        The parameters.
    units : dict of str to str
        The SI unit of each.
    chain : ndarray
        (steps, walkers, parameters) values in SI units.
    log_probability : ndarray
        (steps, walkers) logarithm of the posterior density, up to a constant.
    acceptance : float
        The acceptance fraction of the steps; 0.2 to 0.5 is usual.
    seed : int
        The seed of the random numbers, as given or as drawn from a Generator.
    unsolved : int
        The number of runs that did not finish; there are no draws at their places.
    others : int
        The number of other minima that the fit found.

    Notes
    -----
    The prior is uniform between the bounds, or log-uniform if the bounds are above 0 and more than
    a factor of 5 apart; a prior given for a parameter takes the place of both. The walkers move by
    differential evolution (ter Braak, Stat. Comput. 16, 239, 2006; emcee). They start around the
    best values and may not find another minimum.

    Examples
    --------
    >>> import stackbounce as sb
    >>> drop = sb.Drop([sb.Ball(0.0567)], [sb.Spring(1e4)], height=0.3)
    >>> found = sb.fit(drop, {"durations.0": "5.0 ± 0.1 ms"}, vary=["contacts.0.stiffness"])
    >>> posterior = found.sample(6400, rng=1)
    >>> 0.9 < posterior["contacts.0.stiffness"].std_dev / 900.0 < 1.1
    True
    """

    names: list[str]
    units: dict[str, str]
    chain: Array
    log_probability: Array
    acceptance: float
    seed: int
    unsolved: int = 0
    others: int = 0

    def _tables(self) -> Sequence[Table]:
        values = [(name, f"{self[name]:.2u}".replace("+/-", " ± ")) for name in self.names]
        rows = [(name, value, self.units[name]) for name, value in values]
        return (Table(f"Posterior, acceptance {self.acceptance:.2f}", ("", "", "unit"), rows),)

    def __getitem__(self, name: str) -> UFloat:
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
        one_of(name, self.names, f"{shown(name)} was not varied")
        return np.asarray(self.chain[:, :, self.names.index(name)].ravel())

    def to_dataset(self) -> Dataset:
        """Return the draws (chain, draw) of each parameter in SI units, and `lp`, as ArviZ reads.

        The path ``gaps.0`` becomes the name ``gaps_0``.
        ``arviz.convert_to_inference_data(posterior.to_dataset())`` has diagnostics and pictures.
        """
        import xarray as xr

        dims = ("chain", "draw")
        columns = {}
        for k, name in enumerate(self.names):
            attributes = {"units": self.units[name], "path": name}
            columns[identifier(name)] = dims, self.chain[:, :, k].T, attributes
        return xr.Dataset({**columns, "lp": (dims, self.log_probability.T)})

    def quantiles(self, name: str, at: Any = (0.159, 0.5, 0.841)) -> Array:
        """Return quantiles of a parameter, by default the median and one sigma on both sides.

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
        """The integrated autocorrelation time of each parameter, in steps of a walker."""
        from emcee.autocorr import integrated_time

        times = integrated_time(self.chain, quiet=True, tol=0)
        return dict(zip(self.names, times.tolist(), strict=True))

    @property
    def notes(self) -> tuple[str, ...]:
        """Warnings about the draws, a sentence each."""
        found = []
        steps, longest = len(self.chain), max(self.autocorrelation.values())
        if steps < _ENOUGH * longest:
            found.append(
                f"the chains are only {steps / longest:.0f} autocorrelation times long: draw "
                f"{_ENOUGH * longest / steps:.1f} times as many"
            )
        if not 0.1 < self.acceptance < 0.8:
            found.append(f"{self.acceptance:.0%} of the steps were accepted, 20 to 50 % is usual")
        if self.unsolved:
            found.append(
                f"{self.unsolved} runs did not finish, and there are no draws at their places: "
                "give narrower bounds"
            )
        if self.others:
            found.append("the fit has other minima, which the draws may not reach")
        return tuple(found)


def sample(fit: "Fit", draws: int, *, rng: Any = 0, progress: Any = None) -> Posterior:
    """Return draws from the posterior distribution of a fit's parameters; see `Fit.sample`."""
    need("a posterior", "emcee")
    import emcee

    objective, size = fit.objective, len(fit.names)
    least = max(_WALKERS, 4 * size)
    walkers = max(least, 2 * (whole("draws", draws, 20 * least, _MOST_DRAWS) // (2 * _STEPS)))
    steps = draws // walkers
    check_room(_NUMBERS * (size + 1) * draws, f"{draws} draws", "take fewer")
    seed = seed_of(rng)
    random = np.random.RandomState(seed)
    before = objective.unsolved.total()
    sampler = emcee.EnsembleSampler(
        walkers, size, _log_probability(objective), vectorize=True, moves=emcee.moves.DEMove()
    )
    sampler.random_state = random.get_state()
    first = _first_places(fit, walkers, random)
    for k, _ in enumerate(sampler.sample(first, iterations=steps)):
        if progress is not None:
            progress((k + 1) * walkers, steps * walkers)
    burnt = int(_BURNT * steps)
    inner = sampler.get_chain(discard=burnt)
    chain = [parameter.value(inner[:, :, k]) for k, parameter in enumerate(objective.parameters)]
    return Posterior(
        fit.names,
        fit.units,
        np.stack(chain, axis=2),
        sampler.get_log_prob(discard=burnt),
        float(np.mean(sampler.acceptance_fraction)),
        seed,
        objective.unsolved.total() - before,
        len(fit.minima) - 1,
    )


def _log_probability(objective: Objective) -> Any:
    spans = objective.spans
    # a prior is a density of the value; the density of its logarithm has the value as a factor
    known = [
        parameter.prior is not None and parameter.logarithmic for parameter in objective.parameters
    ]

    def evaluate(x: Array) -> Array:
        inside = np.all((x >= spans[:, 0]) & (x <= spans[:, 1]), axis=1)
        found = np.full(len(x), -np.inf)
        if np.any(inside):
            found[inside] = np.sum(x[inside][:, known], axis=1)
            found[inside] -= 0.5 * objective.chi_squared(x[inside])
        return found

    return evaluate


def _first_places(fit: "Fit", walkers: int, random: np.random.RandomState) -> Array:
    """Return (walkers, parameters) trials around the best one, reflected at the bounds."""
    objective, best = fit.objective, fit.x
    (low, high), widths = objective.spans.T, objective.widths
    spread = np.sqrt(np.diag(fit.covariance.values)) / np.abs(objective.value_slopes(best))
    spread = np.clip(spread, 1e-6 * widths, 0.2 * widths)
    places = best + _SPREAD * spread * random.standard_normal((walkers, len(best)))
    folded = np.where(places < low, 2.0 * low - places, places)
    folded = np.where(folded > high, 2.0 * high - folded, folded)
    return np.asarray(np.clip(folded, low, high))
