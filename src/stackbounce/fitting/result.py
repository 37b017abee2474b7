"""What a fit found: best values with errors, how good they are, and what the data leave open."""

import functools
import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from stackbounce.errors import InvalidValue, nearest, shown
from stackbounce.fitting.problem import Problem, clock
from stackbounce.fitting.residuals import Record, Residual
from stackbounce.fitting.search import Minimum, directions
from stackbounce.model import Drop
from stackbounce.version import __version__

if TYPE_CHECKING:
    import xarray as xr
    from uncertainties import UFloat

    from stackbounce.fitting.posterior import Posterior
    from stackbounce.fitting.profile import Interval

__all__ = ["Fit"]

Array: TypeAlias = NDArray[np.float64]


_ANYWHERE = 12.0**-0.5  # of the bounds' distance: standard deviation where any value is as good


@dataclass(frozen=True, eq=False)
class Fit:
    """What a fit found; made by `stackbounce.fit`.

    Parameters
    ----------
    problem : Problem
        What was fitted to what.
    minima : list of Minimum
        All minima found, the best first.
    unsolved : mapping of str to int
        How many runs of the search came to no end, by the name of their `Status`.

    Examples
    --------
    >>> import stackbounce as sb
    >>> drop = sb.Drop([sb.Ball(0.0567)], [sb.Spring(1e4)], height=0.3)
    >>> found = sb.fit(drop, {"durations.0": "5.0 ± 0.1 ms"}, vary=["contacts.0.stiffness"])
    >>> print(f"{found['contacts.0.stiffness']:.2u} N/m")
    (2.238+/-0.090)e+04 N/m
    """

    problem: Problem = field(repr=False)
    minima: list[Minimum] = field(repr=False)
    unsolved: Mapping[str, int] = field(repr=False, default_factory=dict)

    def __getitem__(self, name: str) -> "UFloat":
        """The best value of what was varied, with its error, in SI units."""
        if name not in self.values:
            raise InvalidValue(f"{shown(name)} was not varied; {nearest(name, self.values)}")
        return self.values[name]

    @property
    def names(self) -> list[str]:
        """What was varied, in order."""
        return [one.name for one in self.problem.parameters]

    @property
    def units(self) -> dict[str, str]:
        """The SI unit of each; empty for a pure number."""
        return {one.name: one.unit for one in self.problem.parameters}

    @property
    def best(self) -> dict[str, float]:
        """The best value of each, in SI units."""
        return {name: float(array[0]) for name, array in self.problem.values(self.x[None]).items()}

    @functools.cached_property
    def values(self) -> "dict[str, UFloat]":
        """The best value of each with its error, correlated as the data have it."""
        from uncertainties import correlated_values

        numbers = correlated_values(list(self.best.values()), self.covariance.values)
        return dict(zip(self.names, numbers, strict=True))

    @functools.cached_property
    def covariance(self) -> "xr.DataArray":
        """(parameter, other) covariances at the best values, in the products of their units.

        What the data hardly determine lies anywhere between its bounds: in no direction is a
        standard deviation larger than that of a number of which these are all that is known.
        """
        import xarray as xr

        slope = np.array(
            [one.slope(x) for one, x in zip(self.problem.parameters, self.x, strict=True)]
        )
        sizes, along = self.directions
        wide = self.problem.spans[:, 1] - self.problem.spans[:, 0]
        spread = 1.0 / np.maximum(sizes, 1.0 / _ANYWHERE)
        inner = (along.T * spread**2) @ along
        matrix = inner * np.outer(wide * slope, wide * slope)
        where = {"parameter": self.names, "other": self.names}
        return xr.DataArray(matrix, where, ("parameter", "other"), attrs=self._provenance)

    @functools.cached_property
    def directions(self) -> tuple[Array, Array]:
        """(k,) root of chi squared's change from bound to bound, and (k, parameters) along what.

        The directions are orthogonal in coordinates that run from 0 to 1 between the bounds.
        """
        return directions(self.problem, self.slopes)

    @property
    def correlations(self) -> "xr.DataArray":
        """(parameter, other) correlations, from -1 to 1."""
        spread = np.sqrt(np.diag(self.covariance.values))
        with np.errstate(all="ignore"):
            return self.covariance / spread[:, None] / spread

    @property
    def drops(self) -> dict[str, Drop]:
        """All drops with the best values in place, by their names."""
        return {key: self.problem.drop(key, self.x) for key in self.problem.drops}

    @property
    def drop(self) -> Drop:
        """The drop with the best values in place.

        Raises
        ------
        InvalidValue
            If there are several.
        """
        if len(self.problem.drops) > 1:
            raise InvalidValue(f"there are several drops: take drops[{next(iter(self.drops))!r}]")
        return next(iter(self.drops.values()))

    @property
    def chi_squared(self) -> float:
        """Sum of squares of all residuals, in errors, priors among them."""
        return self.minima[0].chi_squared

    @property
    def degrees_of_freedom(self) -> int:
        """How many data and priors there are more than what is fitted."""
        return self.problem.size - self.free

    @property
    def probability(self) -> float:
        """How often data scatter so far from a true model; nan without degrees of freedom."""
        from scipy.stats import chi2

        if not self.degrees_of_freedom:
            return math.nan
        return float(chi2.sf(self.chi_squared, self.degrees_of_freedom))

    @property
    def aicc(self) -> float:
        """Akaike's criterion, corrected for few data; infinite where these are too few for it."""
        left = self.problem.size - self.free - 1
        more = math.inf if left <= 0 else 2.0 * self.free * (self.free + 1) / left
        return self.chi_squared + 2.0 * self.free + more

    @property
    def bic(self) -> float:
        """Schwarz's criterion."""
        return self.chi_squared + self.free * math.log(self.problem.size)

    @functools.cached_property
    def residuals(self) -> list[Residual]:
        """Each number that was measured beside the fitted one; force records are in `records`."""
        found = []
        for key, measured in self.problem.measured.items():
            fitted = self.problem.predicted(key, self.x[None])[0] if measured.data else []
            for datum, value in zip(measured.data, fitted, strict=True):
                pull = (value - datum.value) / datum.error
                row = (datum.value, datum.error, float(value), float(pull), datum.unit)
                found.append(Residual(key, datum.name, *row))
        for one in self.problem.priors:
            mean, error = one.prior or (0.0, 1.0)
            value = self.best[one.name]
            row = (mean, error, value, (value - mean) / error, one.unit)
            found.append(Residual("", f"{one.name} (known)", *row))
        return found

    @functools.cached_property
    def records(self) -> list[Record]:
        """Each force record beside the fitted one."""
        found = []
        for key in self.problem.records:
            touch, forces = self.best[clock(key)], self.problem.forces(key, self.x)
            for wave, force in zip(self.problem.measured[key].waveforms, forces, strict=True):
                curves = (wave.times - touch, wave.force, wave.curve(force))
                unit = "" if wave.scaled else "N"
                found.append(Record(key, wave.name, *curves, wave.error, unit))
        return found

    @functools.cached_property
    def notes(self) -> tuple[str, ...]:
        """What should be known about the fit, a sentence each."""
        from stackbounce.fitting.notes import notes

        return notes(self)

    @functools.cached_property
    def undetermined(self) -> tuple[str, ...]:
        """What the data cannot determine, a sentence each; empty where they determine all."""
        from stackbounce.fitting.notes import undetermined

        return undetermined(self)

    def intervals(self, *, sigma: float = 1.0) -> "dict[str, Interval]":
        """Return how far each parameter may lie, whatever the others then are.

        A limit is where chi squared, all other parameters fitted anew, is `sigma` squared above its
        least: for one standard deviation these hold 68.3 % without the assumption that chi squared
        is a parabola, which `values` make.

        Parameters
        ----------
        sigma : float, optional
            In standard deviations, above 0.

        Returns
        -------
        dict of str to Interval
            By name: `low` and `high` in SI units, and whether each is a bound of the search.

        Raises
        ------
        InvalidValue
            If `sigma` is not above 0.
        """
        from stackbounce.fitting.profile import intervals

        return intervals(self, sigma)

    def profile(self, name: str, values: Any) -> Array:
        """Return chi squared where one parameter has other values and all others are fitted anew.

        Parameters
        ----------
        name : str
            What was varied.
        values : array_like
            (n,) in SI units, between its bounds.

        Returns
        -------
        ndarray
            (n,)

        Raises
        ------
        InvalidValue
            If it was not varied, or a value lies outside the bounds.
        """
        from stackbounce.fitting.profile import along

        if name not in self.names:
            raise InvalidValue(f"{shown(name)} was not varied; {nearest(name, self.names)}")
        return along(self, self.names.index(name), np.asarray(values, dtype=float))

    def sample(self, draws: int = 16_000, **options: Any) -> "Posterior":
        """Return draws from what is known of the parameters after the data.

        Parameters
        ----------
        draws : int, optional
            How many, of all walkers together, before the first quarter is thrown away.
        **options
            ``seed``, and ``progress``, which is called with how many are done and will be.

        Returns
        -------
        Posterior

        Raises
        ------
        InvalidValue
            If the draws are too few.
        """
        from stackbounce.fitting.posterior import sample

        return sample(self, draws, **options)

    def as_dict(self) -> dict[str, Any]:
        """Return what was found as plain values, for machines."""
        return {
            **self._provenance,
            "values": {
                name: {
                    "value": one.nominal_value,
                    "error": one.std_dev,
                    "unit": self.units[name],
                }
                for name, one in self.values.items()
            },
            "chi_squared": self.chi_squared,
            "degrees_of_freedom": self.degrees_of_freedom,
            "probability": self.probability,
            "aicc": self.aicc,
            "bic": self.bic,
            "correlations": self.correlations.values.tolist(),
            "residuals": [one._asdict() for one in self.residuals],
            "notes": list(self.notes),
            "drops": {key: drop.to_toml() for key, drop in self.drops.items()},
        }

    @property
    def x(self) -> Array:
        """(parameters,) the best trial, in the coordinates that are searched."""
        return self.minima[0].x

    @property
    def free(self) -> int:
        """How many numbers are fitted, with the scales and baselines of records."""
        return len(self.problem.parameters) + self.problem.linear

    @functools.cached_property
    def slopes(self) -> Array:
        """(residuals, parameters) derivatives at the best trial."""
        return self.problem.expanded(self.x)[1]

    @property
    def _provenance(self) -> dict[str, Any]:
        return {"stackbounce": __version__, "rtol": self.problem.rtol}
