"""``compare``: several models of the same data, side by side."""

import functools
import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from stackbounce.errors import InvalidType, InvalidValue, shown
from stackbounce.fitting.model import Model
from stackbounce.fitting.question import TooFewData
from stackbounce.fitting.result import Fit
from stackbounce.fitting.search_run import fit
from stackbounce.version import __version__

if TYPE_CHECKING:
    import xarray as xr

__all__ = ["Comparison", "Score", "compare"]

Array: TypeAlias = NDArray[np.float64]

_DRAWS = 256  # of the parameters behind a prediction
_FOLLOWED = 3  # trials, besides the best with all data, where some are left out


class Score(NamedTuple):
    """How one model does; `weight` is its share of the evidence among those compared."""

    model: str
    parameters: int
    chi_squared: float
    degrees_of_freedom: int
    probability: float
    aicc: float
    bic: float
    weight: float


class Prediction(NamedTuple):
    """A number that was left out, beside what the rest of the data predicts for it."""

    drop: str
    name: str
    measured: float
    error: float
    predicted: float
    predicted_error: float

    @property
    def pull(self) -> float:
        """Their difference, in the errors of both."""
        return (self.predicted - self.measured) / math.hypot(self.error, self.predicted_error)


@dataclass(frozen=True, eq=False)
class Comparison:
    """Several models of the same data; made by `compare`.

    Parameters
    ----------
    fits : dict of str to Fit
        Of each model that could be fitted.
    refused : dict of str to str
        Why a model could not.

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
        from stackbounce.errors import nearest

        if name not in self.fits:
            raise InvalidValue(f"{shown(name)} is no model here; {nearest(name, self.fits)}")
        return self.fits[name]

    @property
    def criterion(self) -> str:
        """``aicc``, or ``bic`` where data are too few for it."""
        return "aicc" if all(one.aicc < math.inf for one in self.fits.values()) else "bic"

    @functools.cached_property
    def scores(self) -> list[Score]:
        """A row per model, the best by `criterion` first."""
        known = {name: getattr(found, self.criterion) for name, found in self.fits.items()}
        rows = sorted(self.fits.items(), key=lambda one: known[one[0]])
        raw = [math.exp(-0.5 * (known[name] - known[rows[0][0]])) for name, _ in rows]
        return [
            Score(
                name,
                found.free,
                found.chi_squared,
                found.degrees_of_freedom,
                found.probability,
                found.aicc,
                found.bic,
                weight / sum(raw),
            )
            for (name, found), weight in zip(rows, raw, strict=True)
        ]

    @functools.cached_property
    def pulls(self) -> "xr.DataArray":
        """(model, datum) fitted less measured value, in errors."""
        import xarray as xr

        names = {
            name: {f"{one.drop}.{one.name}".lstrip("."): one.pull for one in found.residuals}
            for name, found in self.fits.items()
        }
        data = list(dict.fromkeys(datum for own in names.values() for datum in own))
        table = [[own.get(datum, math.nan) for datum in data] for own in names.values()]
        where = {"model": list(names), "datum": data}
        return xr.DataArray(table, where, ("model", "datum"), attrs={"stackbounce": __version__})

    @functools.cached_property
    def left_out(self) -> dict[str, list[Prediction]]:
        """What each model predicts for each drop from all others (with one drop: for each datum).

        The spread of the parameters behind a prediction is in its error; those that only the drop
        itself would tell lie where their priors have them, or anywhere between their bounds.
        """
        return {name: _predictions(found) for name, found in self.fits.items()}

    def predictive(self, name: str) -> float:
        """Return the logarithm of how probable a model held what was left out; more is better.

        Parameters
        ----------
        name : str
            The model.
        """
        return sum(
            -0.5 * one.pull**2 - math.log(math.hypot(one.error, one.predicted_error) / one.error)
            for one in self.left_out[name]
        )

    def as_dict(self) -> dict[str, Any]:
        """Return the comparison as plain values, for machines."""
        return {
            "stackbounce": __version__,
            "scores": [one._asdict() for one in self.scores],
            "refused": self.refused,
            "fits": {name: found.as_dict() for name, found in self.fits.items()},
        }


def compare(models: Mapping[str, Model], data: Any, **options: Any) -> Comparison:
    """Fit several models to the same data and lay them side by side.

    Parameters
    ----------
    models : mapping of str to Model
        By their names; `standard_models` makes the usual ones.
    data : mapping
        What was measured, as `fit` takes it.
    **options
        Those of `fit`: `starts`, `seed`, `rtol`.

    Returns
    -------
    Comparison
        `scores` (chi squared, AICc, BIC), `pulls` per datum, `left_out` predictions, and each
        model's `Fit`. A model with more numbers than data is listed in `refused`.

    Raises
    ------
    InvalidValue
        If a model or the data make no sense, or no model can be fitted.
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
        if not isinstance(name, str) or not isinstance(model, Model):
            raise InvalidType(f"models must map names to Models, got {shown(name)}: {shown(model)}")
        try:
            fits[name] = fit(model.drop, data, model.vary, tie=model.tie, **options)
        except TooFewData as error:
            refused[name] = str(error)
        except (InvalidValue, InvalidType) as error:
            raise type(error)(f"{name}: {error}") from error
    if not fits:
        name, reason = next(iter(refused.items()))
        raise InvalidValue(f"no model can be fitted: {name}: {reason}")
    return Comparison(fits, refused)


def _predictions(found: Fit) -> list[Prediction]:
    """Return what a model predicts for what is left out, one drop or datum after the other."""
    from stackbounce.fitting.search import search

    problem = found.problem
    several = len(problem.drops) > 1
    parts = [
        (key, None if several else datum.name)
        for key, measured in problem.measured.items()
        for datum in (measured.data[:1] if several else measured.data)
    ]
    rows: list[Prediction] = []
    for key, name in parts:
        rest = problem.without(key, name)
        minima = search(rest, found.x[None], follow=_FOLLOWED) if rest.size else found.minima
        numbers = problem.predicted(key, _draws(Fit(rest, minima)))
        for datum, drawn in zip(problem.measured[key].data, numbers.T, strict=True):
            if name in (None, datum.name):
                there = drawn[np.isfinite(drawn)]
                mean = float(np.mean(there)) if len(there) else math.nan
                spread = float(np.std(there)) if len(there) else math.nan
                rows.append(Prediction(key, datum.name, datum.value, datum.error, mean, spread))
    return rows


def _draws(found: Fit) -> Array:
    """Return (n, parameters) trials that a fit leaves open, were chi squared a parabola."""
    random = np.random.default_rng(0)
    spans = found.problem.spans
    wide = spans[:, 1] - spans[:, 0]
    sizes, directions = found.directions
    known = sizes > 1.0
    middle = (found.x - spans[:, 0]) / wide
    along = directions @ middle
    along = np.where(known, along, directions @ np.full(len(wide), 0.5))
    normal = random.standard_normal((_DRAWS, len(wide))) / np.maximum(sizes, 1.0)
    anywhere = random.uniform(-0.5, 0.5, (_DRAWS, len(wide)))
    places = (along + np.where(known, normal, anywhere)) @ directions
    return np.asarray(spans[:, 0] + np.clip(places, 0.0, 1.0) * wide)
