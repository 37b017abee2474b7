"""How restitution falls with speed: two laws, fitted to values with correlated errors."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np

from stackbounce.errors import InvalidValue
from stackbounce.measure.quantities import Number, nominal
from stackbounce.measure.statistics.regression import Fit, covariance_of, fit_with_excess_scatter

_MOST_SCATTER = 0.3  # excess scatter of restitutions that the fits allow for
_STEEPEST = 30.0  # logarithm of a power law's restitution at 1 m/s: beyond, all speeds are far off
_ALIKE = 1e-5  # of a speed: a line through closer ones is singular in double precision


@dataclass(frozen=True)
class RestitutionLaw:
    """How restitution falls with speed: ``e = coefficient - slope v`` or ``coefficient v**-slope``.

    Attributes
    ----------
    form : {"linear", "power law"}
        Which of the two.
    coefficient : ufloat
        The restitution at no speed (linear), or at 1 m/s (power law).
    slope : ufloat
        In s/m (linear), or the exponent (power law); above 0 where the restitution falls. The
        errors of the two are correlated, as `uncertainties` knows.
    chi_squared : float
        Of the fit, with `freedom` degrees of freedom.
    freedom : int
        Bounces less 2.
    """

    form: Literal["linear", "power law"]
    coefficient: Number
    slope: Number
    chi_squared: float
    freedom: int

    def at(self, speed: float | Number) -> Number:
        """Return the restitution at an impact speed in m/s."""
        if self.form == "linear":
            return self.coefficient - self.slope * speed
        return self.coefficient * speed ** (-self.slope)


def fit_line(
    speeds: Sequence[Any], kept: Sequence[Any], degree: int, most: float, power: bool = False
) -> tuple[Fit, float]:
    """Fit a straight line to restitution over speed; return it and the excess scatter about it.

    With `degree` 0 it is a constant; with `power` the line is fitted to the logarithms of both.
    The speeds have errors too, correlated with those of the restitutions: the covariance is that of
    the residuals. `most` is the largest excess scatter of single bounces, 0 for none.
    """
    from uncertainties import umath

    known = [nominal(speed) for speed in speeds]
    if degree and max(known) - min(known) < _ALIKE * max(known):  # no line has a slope
        raise InvalidValue(f"impact speeds must differ, got {len(known)} of {known[0]:.4g} m/s")
    x = [umath.log(speed) for speed in speeds] if power else list(speeds)
    y = [umath.log(restitution) for restitution in kept] if power else list(kept)
    design = np.vander([nominal(speed) for speed in x], degree + 1, increasing=True)
    values = np.array([value.nominal_value for value in y])
    slope = 0.0
    if degree:
        rough = covariance_of(y)
        slope = float(fit_with_excess_scatter(design, values, rough, most)[0].values[1])
    residuals = [b - slope * a for a, b in zip(x, y, strict=True)]
    return fit_with_excess_scatter(design, values, covariance_of(residuals), most)


def laws_of(
    speeds: Sequence[Any], kept: Sequence[Any], most: float = _MOST_SCATTER
) -> tuple[Number, tuple[RestitutionLaw, ...], float]:
    """Return the mean restitution, its laws, and the scatter about the linear one."""
    from uncertainties import correlated_values, umath

    if any(np.isnan(restitution.std_dev) for restitution in kept):
        return sum(kept) / len(kept), (), 0.0
    laws: list[RestitutionLaw] = []
    scatter = 0.0
    if len(kept) > 2:
        for form, power in (("linear", False), ("power law", True)):
            fit, more = fit_line(speeds, kept, 1, most, power)
            first, second = correlated_values(fit.values, fit.covariance)
            if not power:
                scatter = more
            elif abs(first.nominal_value) > _STEEPEST:
                continue
            coefficient = umath.exp(first) if power else first
            laws.append(
                RestitutionLaw(form, coefficient, -second, fit.chi_squared, fit.freedom)  # type: ignore[arg-type]
            )
    fit, _ = fit_line(speeds, kept, 0, most)
    (mean,) = correlated_values(fit.values, fit.covariance)
    return mean, tuple(laws), scatter
