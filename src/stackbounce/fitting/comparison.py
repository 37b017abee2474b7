"""Several models fitted to the same data, side by side."""

import functools
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np

from stackbounce.errors import InvalidType, InvalidValue, one_of, shown
from stackbounce.fitting.problem import FitProblem, TooFewData
from stackbounce.fitting.result import Fit
from stackbounce.library_types import DataArray, DataFrame
from stackbounce.run.quantities import Array
from stackbounce.shown import Shown, Table, table_of
from stackbounce.version import __version__

_ALIKE = 0.01  # errors: models whose best fits differ by less in all data are one
_DIGITS = 6  # of a criterion, after the point: smaller differences are round-off of the search


class Score(NamedTuple):
    """The scores of one model, and of those that the data do not tell apart from it.

    `weight` is its Akaike (or BIC) weight among those compared. `same_as` are the models whose best
    fits differ from its own by less than 0.01 errors in all data.
    """

    model: str
    parameters: int
    chi_squared: float
    degrees_of_freedom: int
    probability: float
    aicc: float
    bic: float
    weight: float
    same_as: tuple[str, ...]

    @property
    def title(self) -> str:
        """The names of all its models, a line each."""
        return "\n= ".join([self.model, *self.same_as])


_SHORT = {"chi_squared": "χ²", "degrees_of_freedom": "degrees", "probability": "p"}


@dataclass(frozen=True, eq=False, repr=False)
class Comparison(Shown):
    """Several models of the same data; made by `compare`.

    Parameters
    ----------
    fits : dict of str to Fit
        The fit of each model that could be fitted.
    refused : dict of str to str
        The reason for each model that could not.

    Examples
    --------
    >>> import stackbounce as sb
    >>> balls = [sb.Ball(0.150), sb.Ball(0.057)]
    >>> rigid = sb.Drop(balls, [sb.Rigid(0.8), sb.Rigid(0.8)], impact_speed=3.53)
    >>> springs = sb.Drop(balls, [sb.Spring(2500.0), sb.Spring(1000.0)], impact_speed=3.53)
    >>> one = {"contacts.0.restitution": (0.1, 1.0)}
    >>> models = {
    ...     "separate": sb.Model(rigid, one, {"contacts.1.restitution": "contacts.0.restitution"}),
    ...     "springs": sb.Model(springs, ["contacts.1.stiffness"]),
    ... }
    >>> compared = sb.compare(models, {"rebound_ratios": ["0.18 ± 0.02", "1.64 ± 0.02"]})
    >>> [score.model for score in compared.scores]
    ['separate', 'springs']
    """

    fits: dict[str, Fit]
    refused: dict[str, str]

    def __getitem__(self, name: str) -> Fit:
        """The fit of one model."""
        return self.fits[one_of(name, self.fits, f"{shown(name)} is no model here")]

    @property
    def criterion(self) -> str:
        """``aicc``, or ``bic`` if the data are too few for it."""
        return "aicc" if all(fit.aicc < math.inf for fit in self.fits.values()) else "bic"

    @functools.cached_property
    def scores(self) -> list[Score]:
        """A row per model that the data tell apart from better ones, the best by `criterion` first.

        The weights are those of the rows, so that no prediction counts twice.
        """
        known = {name: getattr(found, self.criterion) for name, found in self.fits.items()}
        missed = {name: fit.objective.residuals(fit.x[None])[0] for name, fit in self.fits.items()}
        same: dict[str, list[str]] = {}
        for name in sorted(known, key=lambda name: round(known[name], _DIGITS)):
            alike = (best for best in same if _agree(missed[name], missed[best]))
            same.setdefault(next(alike, name), []).append(name)
        raw = {best: math.exp(0.5 * (min(known.values()) - known[best])) for best in same}
        return [
            Score(
                best,
                self.fits[best].free,
                **self.fits[best].goodness(),
                weight=raw[best] / sum(raw.values()),
                same_as=tuple(names[1:]),
            )
            for best, names in same.items()
        ]

    @property
    def table(self) -> DataFrame:
        """The scores, a row for each model."""
        import pandas as pd

        return pd.DataFrame(self.scores).set_index("model").drop(columns="same_as")

    def _tables(self) -> Sequence[Table]:
        return (table_of(self.table.rename(columns=_SHORT)),)

    @property
    def remarks(self) -> tuple[str, ...]:
        """Which models are not told apart, and which were not fitted."""
        same = [
            f"{score.model} has the same best fit as {', '.join(score.same_as)}."
            for score in self.scores
            if score.same_as
        ]
        refused: dict[str, list[str]] = {}
        for name, why in self.refused.items():
            refused.setdefault(why, []).append(name)
        others = (f"Not fitted: {', '.join(names)}: {why}." for why, names in refused.items())
        return (*same, *others)

    @functools.cached_property
    def pulls(self) -> DataArray:
        """(model, datum) fitted less measured value, in errors."""
        import xarray as xr

        names = {
            name: {residual.label: residual.pull for residual in found.residuals}
            for name, found in self.fits.items()
        }
        data = list(dict.fromkeys(datum for own in names.values() for datum in own))
        table = [[own.get(datum, math.nan) for datum in data] for own in names.values()]
        where = {"model": list(names), "datum": data}
        return xr.DataArray(table, where, ("model", "datum"), attrs={"stackbounce": __version__})

    def as_dict(self) -> dict[str, Any]:
        """Return the comparison as plain values, for JSON."""
        return {
            "stackbounce": __version__,
            "scores": [score._asdict() for score in self.scores],
            "refused": self.refused,
            "fits": {name: found.as_dict() for name, found in self.fits.items()},
        }


def compare(models: Mapping[str, FitProblem], data: Any, **options: Any) -> Comparison:
    """Fit several models to the same data and compare them.

    Parameters
    ----------
    models : mapping of str to FitProblem
        By name, without data, as `Model` makes them; `standard_models` makes the usual ones.
    data : mapping
        What was measured, as `fit` takes it.
    **options
        The options of `fit`: `starts`, `rng`, `rtol`, `progress`.

    Returns
    -------
    Comparison
        `scores` (chi squared, AICc, BIC; models that the data do not tell apart share a row),
        `pulls` per datum, and each model's `Fit`. A model with more numbers than data is listed in
        `refused`.

    Raises
    ------
    InvalidValue
        If a model or the data are wrong, or no model can be fitted.
    InvalidType
        If something has the wrong type.

    Examples
    --------
    >>> import stackbounce as sb
    >>> springs = [sb.Spring(2500.0), sb.Spring(1000.0)]
    >>> drop = sb.Drop([sb.Ball(0.150), sb.Ball(0.057)], springs, impact_speed=3.53)
    >>> data = {"rebound_ratios": ["0.18 ± 0.02", "1.64 ± 0.02"]}
    >>> sb.compare(sb.standard_models(drop), data).refused["Viscoelastic"]
    'vary has 3 numbers for 2 measured numbers: fix some, or say what is known of them ...'
    """
    if not isinstance(models, Mapping) or not models:
        raise InvalidType(f"models must map names to Models, got {shown(models)}")
    fits: dict[str, Fit] = {}
    refused: dict[str, str] = {}
    for name, model in models.items():
        if not isinstance(name, str) or not isinstance(model, FitProblem):
            raise InvalidType(f"models must map names to Models, got {shown(name)}: {shown(model)}")
        try:
            fits[name] = replace(model, data=data).fit(**options)
        except TooFewData as error:
            refused[name] = str(error)
        except (InvalidValue, InvalidType) as error:
            raise type(error)(f"{name}: {error}") from error
    if not fits:
        name, reason = next(iter(refused.items()))
        raise InvalidValue(f"no model can be fitted: {name}: {reason}")
    return Comparison(fits, refused)


def _agree(residuals: Array, others: Array) -> bool:
    """Return whether two models differ by a small part of the errors only."""
    return residuals.shape == others.shape and bool(np.max(np.abs(residuals - others)) < _ALIKE)
