"""The result of a fit: best values with errors, goodness of fit, and what is undetermined."""

import functools
import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from stackbounce.errors import InvalidValue, instance, one_of, positive, shown
from stackbounce.fitting import notes, posterior
from stackbounce.fitting.covariance import estimate_covariance, find_directions
from stackbounce.fitting.least_squares import Minimum
from stackbounce.fitting.objective import Objective, differences
from stackbounce.fitting.posterior import Posterior
from stackbounce.fitting.profile import Interval, Profile
from stackbounce.fitting.residuals import Record, Residual, list_records, list_residuals
from stackbounce.library_types import DataArray, DataFrame, UFloat
from stackbounce.model import Drop
from stackbounce.prediction import Prediction, predict
from stackbounce.prediction.draws import Progress
from stackbounce.run.options import run_options
from stackbounce.run.paths import Number
from stackbounce.run.quantities import Array, solve_quantities
from stackbounce.shown import Shown
from stackbounce.units import handy, numbers_in, rounded
from stackbounce.version import __version__

_LINEARISED = 60  # evaluations with derivatives for an interval, about
_EVENTS = 10_000  # limit for one drop of `along`
_GOODNESS = ("chi_squared", "degrees_of_freedom", "probability", "aicc", "bic")


@dataclass(frozen=True, eq=False, repr=False)
class Fit(Shown):
    """The result of a fit; made by `stackbounce.fit` and `FitProblem.fit`.

    Parameters
    ----------
    objective : Objective
        What was minimised.
    minima : list of Minimum
        All minima found, the best first.
    unsolved : mapping of str to int
        The number of runs of the search that did not finish, by the name of their `Status`.

    Examples
    --------
    >>> import stackbounce as sb
    >>> drop = sb.Drop([sb.Ball(0.0567)], [sb.Spring(1e4)], height=0.3)
    >>> found = sb.fit(drop, {"durations.0": "5.0 ± 0.1 ms"}, vary=["contacts.0.stiffness"])
    >>> print(f"{found['contacts.0.stiffness']:.2u} N/m")
    (2.238+/-0.090)e+04 N/m
    """

    objective: Objective
    minima: list[Minimum]
    unsolved: Mapping[str, int] = field(default_factory=dict)

    def __getitem__(self, name: str) -> UFloat:
        """The best value of a parameter with its error, in SI units."""
        return self.values[self._known(name)]

    def _known(self, name: str) -> str:
        return one_of(name, self.names, f"{shown(name)} was not varied")

    @property
    def names(self) -> list[str]:
        """The parameters, in the order in which they were given."""
        return self.objective.names

    @property
    def units(self) -> dict[str, str]:
        """The SI unit of each parameter; empty for a pure number."""
        return self.objective.units

    @property
    def best(self) -> dict[str, float]:
        """The best value of each parameter, in SI units."""
        values = self.objective.values(self.x[None])
        return {name: float(array[0]) for name, array in values.items()}

    @functools.cached_property
    def values(self) -> dict[str, UFloat]:
        """The best value of each parameter with its error, correlated as in `covariance`."""
        from uncertainties import correlated_values

        numbers = correlated_values(list(self.best.values()), self.covariance.values)
        return dict(zip(self.names, numbers, strict=True))

    @functools.cached_property
    def covariance(self) -> DataArray:
        """(parameter, other) covariances at the best values, in the products of their units.

        What the data hardly determine may lie anywhere between its bounds: in each direction the
        standard deviation is at most that of a uniform distribution between them.
        """
        import xarray as xr

        matrix = estimate_covariance(self.objective, self.x, *self.directions)
        where = {"parameter": self.names, "other": self.names}
        return xr.DataArray(matrix, where, ("parameter", "other"), attrs=self._provenance)

    @functools.cached_property
    def directions(self) -> tuple[Array, Array]:
        """(k,) root of chi squared's change from bound to bound, and its (k, parameters) direction.

        The directions are orthogonal in coordinates that run from 0 to 1 between the bounds.
        """
        return find_directions(self.objective, self.slopes)

    @functools.cached_property
    def slopes(self) -> Array:
        """(residuals, parameters) derivatives of the residuals by the search coordinates."""
        return self.objective.linearise(self.x)[1]

    @property
    def correlations(self) -> DataArray:
        """(parameter, other) correlations, from -1 to 1."""
        spread = np.sqrt(np.diag(self.covariance.values))
        with np.errstate(all="ignore"):
            return self.covariance / spread[:, None] / spread

    @property
    def drops(self) -> dict[str, Drop]:
        """All drops with the best values, by name."""
        return {key: self.objective.drop(key, self.x) for key in self.objective.drops}

    @property
    def drop(self) -> Drop:
        """The drop with the best values.

        Raises
        ------
        InvalidValue
            If there are several.
        """
        if len(self.objective.drops) > 1:
            raise InvalidValue(f"there are several drops: take drops[{next(iter(self.drops))!r}]")
        return next(iter(self.drops.values()))

    @property
    def chi_squared(self) -> float:
        """The sum of squares of all residuals in errors, those of priors included."""
        return self.minima[0].chi_squared

    @property
    def degrees_of_freedom(self) -> int:
        """The number of data and priors less that of the fitted numbers."""
        return self.objective.size - self.free

    @property
    def probability(self) -> float:
        """The probability of so large a chi squared if the model is right; nan without freedom."""
        from scipy.stats import chi2

        if not self.degrees_of_freedom:
            return math.nan
        return float(chi2.sf(self.chi_squared, self.degrees_of_freedom))

    @property
    def aicc(self) -> float:
        """Akaike's information criterion, corrected for few data; infinite if these are too few."""
        left = self.objective.size - self.free - 1
        more = math.inf if left <= 0 else 2.0 * self.free * (self.free + 1) / left
        return self.chi_squared + 2.0 * self.free + more

    @property
    def bic(self) -> float:
        """The Bayesian (Schwarz's) information criterion."""
        return self.chi_squared + self.free * math.log(self.objective.size)

    def goodness(self) -> dict[str, Any]:
        """Return `chi_squared`, `degrees_of_freedom`, `probability`, `aicc` and `bic` by name."""
        return {name: getattr(self, name) for name in _GOODNESS}

    @functools.cached_property
    def residuals(self) -> list[Residual]:
        """Each measured number and prior beside the fitted one; `records` has force records."""
        return list_residuals(self.objective, self.x)

    @functools.cached_property
    def records(self) -> list[Record]:
        """Each force record beside the fitted one."""
        return list_records(self.objective, self.x)

    @functools.cached_property
    def notes(self) -> tuple[str, ...]:
        """Warnings about the fit, a sentence each."""
        return tuple(notes.list_notes(self))

    @functools.cached_property
    def undetermined(self) -> tuple[str, ...]:
        """What the data cannot determine, a sentence each; empty if they determine everything."""
        return notes.describe_undetermined(self.names, *self.directions)

    @property
    def table(self) -> DataFrame:
        """The best values with their errors, in handy units."""
        import pandas as pd

        rows = {}
        for name, own in self.values.items():
            unit, factor = handy(abs(own.nominal_value), self.units[name])
            both = (factor * own.nominal_value, factor * own.std_dev)
            rows[name] = [*rounded(both, both[1]), unit]
        return pd.DataFrame.from_dict(rows, orient="index", columns=["value", "error", "unit"])

    @property
    def remarks(self) -> tuple[str, ...]:
        """Chi squared in words, and the notes."""
        return (notes.describe_goodness(self), *(f"Note: {note}." for note in self.notes))

    def intervals(
        self, *, sigma: float = 1.0, progress: Progress | None = None
    ) -> dict[str, Interval]:
        """Return the confidence interval of each parameter from the profile of chi squared.

        At a limit chi squared, minimised over all other parameters, is `sigma` squared above its
        minimum. An interval of one standard deviation contains the true value with a probability of
        68.3 %. Unlike `values` it does not assume that chi squared is quadratic.

        Parameters
        ----------
        sigma : float, optional
            In standard deviations, above 0.
        progress : callable, optional
            Is called with the number of trials done and about the number of all.

        Returns
        -------
        dict of str to Interval
            By name: `low` and `high` in SI units, and whether each is a bound of the search.

        Raises
        ------
        InvalidValue
            If `sigma` is not above 0.
        """
        reach, count = positive("sigma", sigma), len(self.names)
        course, expected = self.objective.course, _LINEARISED * count * (2 * count + 1)
        with course.reported(progress, expected):
            return {name: Profile(self, k).interval(reach) for k, name in enumerate(self.names)}

    def profile(self, name: str, values: Any) -> Array:
        """Return chi squared at values of one parameter, with all others refitted at each.

        Parameters
        ----------
        name : str
            The parameter.
        values : array_like
            (n,) in SI units or with a unit, between its bounds.

        Returns
        -------
        ndarray
            (n,)

        Raises
        ------
        InvalidValue
            If it was not varied, or a value lies outside the bounds.
        """
        k = self.names.index(self._known(name))
        at = numbers_in(values, self.objective.parameters[k].unit, "values")
        return Profile(self, k).evaluate(at)

    def sample(self, draws: int = 16_000, **options: Any) -> Posterior:
        """Return draws from the posterior distribution of the parameters.

        Parameters
        ----------
        draws : int, optional
            The number of draws of all walkers; the first quarter is discarded as burn-in.
        **options
            ``rng``, as `numpy.random.default_rng` takes it: the same number gives the same draws,
            and a Generator others each time, which `Posterior.seed` repeats. ``progress``, a
            function that is called with the number of draws done and the number of all draws.

        Returns
        -------
        Posterior

        Raises
        ------
        InvalidValue
            If the draws are too few, or do not fit into memory.
        MissingExtra
            If emcee is not installed.
        """
        return posterior.sample(self, draws, **options)

    def predict(
        self, drop: str | None = None, *, posterior: Posterior | None = None, **options: Any
    ) -> Prediction:
        """Return what follows of a fitted drop, with the errors of the fit.

        Parameters
        ----------
        drop : str, optional
            Its name, if there are several.
        posterior : Posterior, optional
            Draws by `sample`, each of which is run; by default the errors are normal, with the
            covariance of the fit.
        **options
            As `stackbounce.predict` takes them.

        Returns
        -------
        Prediction

        Raises
        ------
        InvalidValue
            If there are several drops and none of this name, or the fit does not vary the drop.

        Examples
        --------
        >>> import stackbounce as sb
        >>> drop = sb.Drop([sb.Ball(0.0567)], [sb.Spring(1e4)], height=0.3)
        >>> found = sb.fit(drop, {"durations.0": "5.0 ± 0.1 ms"}, vary=["contacts.0.stiffness"])
        >>> str(found.predict()["durations.0"])
        '0.00500+/-0.00010'
        """
        key = self._key(drop)
        errors = self._numbers(key) if posterior is None else self.draws(posterior, key)
        if not errors:
            raise InvalidValue(f"drop {shown(key)} has no number that was varied")
        return predict(self.objective.drops[key], errors, **options)

    def draws(self, posterior: Posterior, drop: str | None = None) -> dict[str, Array]:
        """Return draws of the numbers of a drop, of those that were varied and those tied to them.

        Parameters
        ----------
        posterior : Posterior
            Draws by `sample`.
        drop : str, optional
            The name of the drop, if there are several.

        Returns
        -------
        dict of str to ndarray
            (n,) in SI units, by path: row by row they are one drop.

        Raises
        ------
        InvalidValue
            If there are several drops and none of this name.

        Examples
        --------
        >>> import stackbounce as sb
        >>> drop = sb.Drop([sb.Ball(0.0567)], [sb.Spring(1e4)], height=0.3)
        >>> found = sb.fit(drop, {"durations.0": "5.0 ± 0.1 ms"}, vary=["contacts.0.stiffness"])
        >>> drawn = found.draws(found.sample(6400, rng=1))
        >>> sb.sweep(drop, {path: ("draw", x) for path, x in drawn.items()}).sizes["draw"]
        4800
        """
        columns = []
        instance("posterior", posterior, Posterior)
        for parameter in self.objective.parameters:
            drawn = posterior.draws(parameter.name)
            columns.append(np.log(drawn) if parameter.logarithmic else drawn)
        rows = self.objective.rows(self._key(drop), np.stack(columns, axis=1))
        return {number.path: column for number, column in rows.items()}

    def along(
        self, number: Number, values: Array, drop: str | None = None
    ) -> tuple[dict[str, Array], dict[str, Array]]:
        """Return what the fit predicts of a drop at other values of one of its numbers.

        Parameters
        ----------
        number : Number
            From `stackbounce.run.paths.number_at`; it is not varied by the fit.
        values : ndarray
            (n,) in SI units.
        drop : str, optional
            The name of the drop; by default the first one.

        Returns
        -------
        best, deviations : dict of str to ndarray
            (n, parts) each quantity by name, and its standard deviation, by the derivatives by the
            parameters.
        """
        objective, count = self.objective, len(values)
        key = drop or next(iter(objective.drops))
        trials = objective.neighbours(self.x)
        given = objective.rows(key, trials).items()
        rows = {own: np.repeat(column, count) for own, column in given}
        rows[number] = np.tile(values, len(trials))
        options = run_options(objective.drops[key], None, objective.rtol, _EVENTS)
        solved = solve_quantities(objective.drops[key], rows, len(rows[number]), options).tables
        moved = np.diag(differences(np.array(list(objective.values(trials).values())).T))
        best, deviations = {}, {}
        for quantity, table in solved.items():
            of_trials = table.reshape(len(trials), count, -1)
            slopes = differences(of_trials) / moved[:, None, None]
            variance = np.einsum("i...,ij,j...->...", slopes, self.covariance.values, slopes)
            best[quantity], deviations[quantity] = of_trials[-1], np.sqrt(np.maximum(variance, 0.0))
        return best, deviations

    def _key(self, drop: str | None) -> str:
        """Return the name of a drop, None for the only one; raise if there is none of that name."""
        known = self.objective.drops
        key = next(iter(known)) if drop is None and len(known) == 1 else drop
        return one_of(key or "", known, f"drop must name one of the drops, got {shown(drop)}")

    def _numbers(self, key: str) -> dict[str, UFloat]:
        """Return the varied and tied numbers of a drop by path, correlated as in `covariance`."""
        trials = self.objective.neighbours(self.x)
        parameters = np.array(list(self.objective.values(trials).values()))
        moved = np.diag(differences(parameters.T))
        apart = [own - own.nominal_value for own in self.values.values()]
        return {
            number.path: float(column[-1]) + np.dot(differences(column) / moved, apart)
            for number, column in self.objective.rows(key, trials).items()
        }

    def as_dict(self) -> dict[str, Any]:
        """Return the result as plain values, for JSON."""
        return {
            **self._provenance,
            "values": {
                name: {"value": own.nominal_value, "error": own.std_dev, "unit": self.units[name]}
                for name, own in self.values.items()
            },
            **self.goodness(),
            "correlations": self.correlations.values.tolist(),
            "residuals": [residual._asdict() for residual in self.residuals],
            "notes": list(self.notes),
            "drops": {key: drop.to_toml() for key, drop in self.drops.items()},
        }

    @property
    def x(self) -> Array:
        """(parameters,) the best trial, in search coordinates."""
        return self.minima[0].x

    @property
    def free(self) -> int:
        """The number of fitted numbers, scales and baselines of force records included."""
        return self.objective.free

    @property
    def _provenance(self) -> dict[str, Any]:
        return {"stackbounce": __version__, "rtol": self.objective.rtol}
