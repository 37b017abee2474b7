"""How well each law follows a series, fitted to all speeds."""

import math
from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from stackbounce.errors import StackbounceError
from stackbounce.fitting.series.family import Family, reason_to_skip
from stackbounce.fitting.series.series import Series
from stackbounce.library_types import DataFrame
from stackbounce.measure.statistics.regression import least_squares
from stackbounce.model.laws import LAWS
from stackbounce.run.quantities import Array
from stackbounce.shown import Shown, Table, table_of

AGREES, DOUBTFUL, REFUTED = "agrees", "doubtful", "refuted"
REFUTED_BELOW, _AGREES_FROM = 0.01, 0.05  # the p values of the verdicts

_SIGMA = 0.6827  # the probability of one standard deviation of a normal distribution

_NODES = 9  # at which a family is computed, for the fit
_WIDER = 1.5  # logarithm by which the fit may leave the measured values
_STEP = 1e-5  # of a numerical derivative
_ALIKE = 1e-6  # relative, of curves that are one and the same


@dataclass(frozen=True)
class Outcome:
    """How well some laws, which give the same curve, follow a series.

    Parameters
    ----------
    laws : tuple of str
        Their names.
    value, error : float
        Best value at the highest speed of the series, and its standard deviation.
    chi_squared : float
        Of the best fit.
    freedom : int
        Its degrees of freedom.
    p : float
        The probability of a larger χ² if the law holds.
    p_half, p_twice : float or None
        p with half and with twice the assumed errors; None if none is assumed.
    p_without_air : float or None
        p if the drag of the air is left out; None if it was not corrected.
    freedom_of_error : float
        Degrees of freedom of the errors of the series, from which `error` follows.
    """

    laws: tuple[str, ...]
    value: float
    error: float
    chi_squared: float
    freedom: int
    p: float
    p_half: float | None = None
    p_twice: float | None = None
    p_without_air: float | None = None
    freedom_of_error: float = math.inf

    def interval(self, level: float = _SIGMA) -> tuple[float, float]:
        """Return the limits of the value with some probability, by Student's t.

        Parameters
        ----------
        level : float, optional
            The probability; by default that of one standard deviation, 0.683.
        """
        from scipy.special import stdtrit

        reach = float(stdtrit(self.freedom_of_error, 0.5 + 0.5 * level)) * self.error
        return self.value - reach, self.value + reach

    @property
    def short_name(self) -> str:
        """The first law, with an ellipsis if there are more."""
        return self.laws[0] + (" …" if len(self.laws) > 1 else "")

    @property
    def verdict(self) -> str:
        """What p says."""
        return verdict(self.p)

    @property
    def steady(self) -> bool:
        """Return whether half and twice the assumed errors leave the verdict as it is."""
        given = [p for p in (self.p_half, self.p_twice) if p is not None]
        return all(verdict(p) == self.verdict for p in given)

    def as_dict(self) -> dict[str, Any]:
        """Return the numbers and what they say as plain values, without the names of the laws."""
        numbers = {key: value for key, value in vars(self).items() if key != "laws"}
        said = {"verdict": self.verdict, "steady": self.steady, "interval": self.interval()}
        return numbers | said


@dataclass(frozen=True, repr=False)
class Comparison(Shown):
    """A series and all laws.

    Parameters
    ----------
    series : Series
        The measurements.
    outcomes : tuple of Outcome
        The best first.
    skipped : dict of str to str
        The laws that say nothing about the series, and why.
    exponent, exponent_error : float
        q and its standard deviation, if the loss ``1 - e`` grows as ``v**q``.
    p_power : float or None
        p of that power; None of two points, which have one exactly.
    curves : dict of str to Family
        The family of the first law of each outcome.
    """

    series: Series
    outcomes: tuple[Outcome, ...]
    skipped: dict[str, str]
    exponent: float
    exponent_error: float
    p_power: float | None
    curves: dict[str, Family]

    @property
    def table(self) -> DataFrame:
        """The laws, the best first: restitution at the highest speed with its interval, χ², p."""
        import pandas as pd

        rows = [
            (law.value, *law.interval(), law.chi_squared, law.freedom, law.p, law.verdict)
            for law in self.outcomes
        ]
        names = pd.Index([", ".join(law.laws) for law in self.outcomes], name="law")
        columns = ["restitution", "from", "to", "χ²", "degrees", "p", "verdict"]
        return pd.DataFrame(rows, names, columns)

    def _tables(self) -> Sequence[Table]:
        narrow = table_of(self.table.drop(columns="degrees"))
        return (narrow._replace(caption=self.series.title),)

    @property
    def tells_apart(self) -> bool:
        """Return whether one law agrees and another one is refuted."""
        return {AGREES, REFUTED} <= {outcome.verdict for outcome in self.outcomes}

    @property
    def steady(self) -> bool:
        """Return whether half and twice the assumed errors leave all verdicts as they are."""
        return all(outcome.steady for outcome in self.outcomes)

    @property
    def summary(self) -> str:
        """What the series says of the laws, and what that owes to the correction for the air."""
        names = {
            kind: [name for law in self.outcomes if law.verdict == kind for name in law.laws]
            for kind in (AGREES, DOUBTFUL, REFUTED)
        }
        if not names[AGREES] and not names[DOUBTFUL]:
            return f"No law follows it within the errors.{self._without_air}"
        parts = [f"{', '.join(names[AGREES])} agree" if names[AGREES] else "No law agrees"]
        if names[DOUBTFUL]:
            parts.append(f"{', '.join(names[DOUBTFUL])} doubtful")
        refuted = f"{', '.join(names[REFUTED])} refuted" if names[REFUTED] else "none is refuted"
        return f"{'; '.join([*parts, refuted])}.{self._without_air}"

    @property
    def _without_air(self) -> str:
        """The laws whose verdict changes if the drag of the air is left out; empty for none."""
        found = [
            f"{law.short_name} {verdict(law.p_without_air)} (p: {format_p(law.p_without_air)})"
            for law in self.outcomes
            if law.p_without_air is not None and verdict(law.p_without_air) != law.verdict
        ]
        return f" Without the drag of the air: {'; '.join(found)}." if found else ""


def verdict(p: float) -> str:
    """Return what a p value says: below 0.01 refuted, from 0.05 on agrees, doubtful between.

    Examples
    --------
    >>> verdict(0.3), verdict(0.001)
    ('agrees', 'refuted')
    """
    if p < REFUTED_BELOW:
        return REFUTED
    return AGREES if p >= _AGREES_FROM else DOUBTFUL


def format_p(value: float) -> str:
    """Return a p value with two digits.

    Examples
    --------
    >>> format_p(0.0234), format_p(0.5)
    ('0.023', '0.5')
    """
    return f"{value:.2g}" if value >= 1e-4 else "<\N{NO-BREAK SPACE}0.0001"


def compare_laws(
    series: Series, without_air: Series | None = None, laws: Collection[str] = LAWS
) -> Comparison:
    """Return how well laws follow a series.

    Parameters
    ----------
    series : Series
        The measurements.
    without_air : Series, optional
        The same without a correction for the drag, to see what that changes.
    laws : collection of str, optional
        The names of the laws; by default all.
    """
    skipped: dict[str, str] = {}
    found: list[tuple[Array, Outcome]] = []
    curves: dict[str, Family] = {}
    speed = float(series.speeds.max())
    for name in (name for name in LAWS if name in laws):
        family = Family(LAWS[name], speed)
        reason = reason_to_skip(family, series)
        if reason:
            skipped[name] = reason
            continue
        try:
            curve, outcome = _outcome(name, family, series, without_air)
        except StackbounceError as failure:
            skipped[name] = f"it cannot be fitted: {failure}"
            continue
        for i, (other, same) in enumerate(found):
            if np.allclose(curve, other, rtol=_ALIKE, atol=0.0):
                found[i] = other, replace(same, laws=(*same.laws, name))
                break
        else:
            found.append((curve, outcome))
            curves[name] = family
    exponent, error, p_power = _power(series)
    ranked = sorted((outcome for _, outcome in found), key=lambda outcome: outcome.chi_squared)
    return Comparison(series, tuple(ranked), skipped, exponent, error, p_power, curves)


def _outcome(
    name: str, family: Family, series: Series, without_air: Series | None
) -> tuple[Array, Outcome]:
    """Return the best curve of a family, and how well it follows the series."""
    freedom = series.values.size - 1
    curve = _interpolated(family, series)
    value, error, _ = _fitted(curve, series)
    best = family.at(value, series.speeds)
    apart = series.values - best
    squares = float(apart @ np.linalg.solve(series.covariance(), apart))
    supposed: dict[str, float | None] = {}
    if series.has_assumed_errors:
        for key, scale in (("p_half", 0.5), ("p_twice", 2.0)):
            supposed[key] = _probability(_fitted(curve, series, scale)[2], freedom, series, scale)
    if without_air is not None:
        again = replace(family, speed=float(without_air.speeds.max()))
        least = _fitted(_interpolated(again, without_air), without_air)[2]
        supposed["p_without_air"] = _probability(least, freedom, without_air)
    return best, Outcome(
        laws=(name,),
        value=value,
        error=error,
        chi_squared=squares,
        freedom=freedom,
        p=_probability(squares, freedom, series),
        freedom_of_error=series.freedom(),
        **supposed,
    )


def _probability(squares: float, freedom: int, series: Series, scale: float = 1.0) -> float:
    """Return the probability of a larger χ² if the law holds.

    With errors from the scatter of readings χ² over its degrees of freedom has an F distribution.
    """
    from scipy.special import chdtrc, fdtrc

    errors = series.freedom(scale)
    if math.isinf(errors):
        return float(chdtrc(freedom, squares))
    return float(fdtrc(freedom, errors, squares / freedom))


def _scaled(values: Array) -> Array:
    """Return what is nearly linear in its start: log(-log e)."""
    return np.asarray(np.log(-np.log(values)))


def _unscaled(scaled: Array | float) -> Array:
    return np.asarray(np.exp(-np.exp(scaled)))


def _reach(series: Series) -> tuple[float, float]:
    """Return the bounds of the scaled value in a fit."""
    scaled = _scaled(series.values)
    return float(scaled.min()) - _WIDER, float(scaled.max()) + _WIDER


def _interpolated(family: Family, series: Series) -> Callable[[float], Array]:
    """Return the curve of a family by the scaled value at its speed: from some exact curves."""
    if family.law_class.rigid:  # in closed form, and with a corner where the restitution is 1
        return lambda start: family.at(float(_unscaled(start)), series.speeds)
    from scipy.interpolate import KroghInterpolator

    low, high = _reach(series)
    nodes = 0.5 * (low + high + (high - low) * np.polynomial.chebyshev.chebpts1(_NODES))
    through = [_scaled(family.at(start, series.speeds)) for start in _unscaled(nodes).tolist()]
    scaled = KroghInterpolator(nodes, through)
    return lambda start: _unscaled(scaled(start))


def _fitted(
    curve: Callable[[float], Array], series: Series, scale: float = 1.0
) -> tuple[float, float, float]:
    """Return the best value at the family's speed, its standard deviation, and the least χ²."""
    from scipy.optimize import minimize_scalar

    weight = np.linalg.inv(series.covariance(scale))

    def squares(start: float) -> float:
        apart = series.values - curve(start)
        return float(apart @ weight @ apart)

    bounds, exactly = _reach(series), {"xatol": 1e-9}
    best = minimize_scalar(squares, bounds=bounds, method="bounded", options=exactly)
    start = float(best.x)
    slope = (curve(start + _STEP) - curve(start - _STEP)) / (2.0 * _STEP)
    value = float(_unscaled(start))
    by_value = -value * np.log(value)
    return value, float(by_value / np.sqrt(slope @ weight @ slope)), float(best.fun)


def _power(series: Series) -> tuple[float, float, float | None]:
    """Return the exponent of the loss in the speed, its error, and p."""
    losses = 1.0 - series.values
    change = np.diag(1.0 / losses)
    design = np.column_stack([np.ones(losses.size), np.log(series.speeds)])
    line = least_squares(design, np.log(losses), change @ series.covariance() @ change)
    p = _probability(line.chi_squared, line.freedom, series) if line.freedom else None
    return float(line.values[1]), float(np.sqrt(line.covariance[1, 1])), p
