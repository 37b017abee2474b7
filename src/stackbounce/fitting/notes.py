"""The notes of a fit: what is undetermined, bounds reached, other minima, misfits, an outlier."""

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

import numpy as np

from stackbounce.errors import counted
from stackbounce.fitting.covariance import OPEN, find_leverages
from stackbounce.fitting.least_squares import EQUAL
from stackbounce.fitting.objective import ABSENT
from stackbounce.run.quantities import Array

if TYPE_CHECKING:
    from stackbounce.fitting.result import Fit

_ROUND_OFF = 1e-9  # chi squared below it is none
_CLOSE = 4.0  # chi squared above the best up to which another minimum is worth a note
_UNLIKELY = 1e-3  # probability of chi squared below which the model is doubted
_BAD = 0.05  # probability of chi squared below which an outlier is looked for
_RARE = 0.01  # probability that one of all data is as far off by chance, for an outlier at most
_ALONE = 1e-6  # one less the leverage of a number that determines a parameter alone
_SHARE = 0.3  # of the largest part of an undetermined direction: parameters above it are named
_EDGE, _EDGES = 1e-3, 3.0  # of the width between the bounds, and errors: how near one is reached


def describe_goodness(fit: "Fit") -> str:
    """Return chi squared in words."""
    count = fit.degrees_of_freedom
    size = 0.0 if fit.chi_squared < _ROUND_OFF else fit.chi_squared
    words = f"Chi squared: {size:.4g} for {counted(count, 'degree of freedom')}"
    if not count:
        return f"{words}: too few data to tell whether the model is right."
    share = 100.0 * fit.probability
    digits = ".0f" if share >= 10.0 else ".2g"
    often = f"{share:{digits}} %" if share >= 0.01 else "less than 0.01 %"
    return f"{words}; were the model right, it would be larger in {often} of all cases."


def describe_undetermined(names: Sequence[str], sizes: Array, directions: Array) -> tuple[str, ...]:
    """Return what the data cannot determine, a sentence for each undetermined direction.

    In such a direction chi squared changes by less than 1 from one bound to the other, if it is as
    steep everywhere as at the best values.
    """
    parts = [np.abs(direction) / np.max(np.abs(direction)) for direction in directions]
    return tuple(
        _describe_direction(
            [name for name, share in zip(names, part, strict=True) if share > _SHARE]
        )
        for part, size in zip(parts, sizes, strict=True)
        if size <= OPEN
    )


def _describe_direction(names: list[str]) -> str:
    if len(names) == 1:
        return f"the data do not determine {names[0]}: near its best value it hardly matters"
    listed = f"{', '.join(names[:-1])} and {names[-1]}"
    return f"the data do not determine {listed} separately: they can change together without effect"


def list_notes(fit: "Fit") -> Iterator[str]:
    """Yield the warnings about a fit, a sentence each."""
    if not fit.minima[0].converged:
        yield "the search ended before it converged: give narrower bounds"
    for name, count in fit.unsolved.items():
        yield (
            f"{count} runs of the search did not finish ({name}) and were taken as far from all "
            "data: give narrower bounds"
        )
    for wave in fit.objective.waveforms:
        if wave.left_out:
            yield f"{wave.name} is clipped: {wave.left_out} samples at its top are left out"
    yield from fit.undetermined
    yield from _note_bounds(fit)
    if misfit := _describe_outlier(fit) or _describe_misfit(fit):
        yield misfit
    yield from _note_collisions(fit)
    for residual in fit.residuals:
        if not abs(residual.pull) < ABSENT:
            yield f"{residual.label}: the fitted drop has none"
    yield from _note_other_minima(fit)


def _note_bounds(fit: "Fit") -> Iterator[str]:
    for parameter, at in zip(fit.objective.parameters, fit.x, strict=True):
        (low, high), best = parameter.span, fit.values[parameter.name]
        for end, value in ((low, parameter.low), (high, parameter.high)):
            beyond = abs(best.nominal_value - value) > _EDGES * best.std_dev
            if abs(at - end) < _EDGE * (high - low) and not beyond:
                yield f"{parameter.name} lies at its bound, {value:g} {parameter.unit}".rstrip()


def _describe_outlier(fit: "Fit") -> str:
    """Return a note on the one number whose residual makes chi squared unlikely; empty if none is.

    Without a number whose pull is r, a linear fit has a chi squared that is smaller by
    ``r**2 / (1 - h)``, with its leverage h. This square follows that of a normal distribution.
    """
    from scipy.stats import chi2

    freedom, chance = fit.degrees_of_freedom, fit.probability
    if freedom < 2 or chance >= _BAD:  # with one degree of freedom none has a rival
        return ""
    pulls = np.array([residual.pull for residual in fit.residuals])
    leverages = find_leverages(fit.objective, fit.slopes, *fit.directions)[: len(pulls)]
    less = pulls**2 / np.maximum(1.0 - leverages, _ALONE)
    without = chi2.sf(fit.chi_squared - less, freedom - 1)
    rare = len(pulls) * chi2.sf(less, 1) < _RARE
    (found,) = np.nonzero((without >= _BAD) & rare & (np.abs(pulls) < ABSENT))
    if len(found) != 1:
        return ""
    label, pull, then = fit.residuals[found[0]].label, pulls[found[0]], without[found[0]]
    return (
        f"one number makes chi squared improbable: {label} is {abs(pull):.1f} errors off, and "
        f"without it p is {then:.2g} instead of {chance:.1g}; check how it was measured, or try "
        "another law"
    )


def _describe_misfit(fit: "Fit") -> str:
    from scipy.stats import chi2

    # chi squared has no distribution with 0 degrees of freedom: 1 is taken instead
    if chi2.sf(fit.chi_squared, max(1, fit.degrees_of_freedom)) >= _UNLIKELY:
        return ""
    freedom = counted(fit.degrees_of_freedom, "degree of freedom")
    bad = f"chi squared is {fit.chi_squared:.4g} for {freedom}"
    return f"the model does not describe the data: {bad}; its parameters' errors mean little"


def _note_collisions(fit: "Fit") -> Iterator[str]:
    for key, measured in fit.objective.measured.items():
        if measured.counts:
            fitted = fit.objective.solve([key], fit.x[None])[key]["collisions"][0]
            for count in measured.counts:
                if fitted[count.index] != count.seen:
                    name = f"{key}.{count.name}" if key else count.name
                    yield f"{name}: {count.seen} seen, {fitted[count.index]} in the fit"


def _note_other_minima(fit: "Fit") -> Iterator[str]:
    for minimum in fit.minima[1:]:
        more = minimum.chi_squared - fit.chi_squared
        if more < _CLOSE:
            values = fit.objective.values(minimum.x[None])
            where = ", ".join(f"{name} = {array[0]:.4g}" for name, array in values.items())
            how = f"has chi squared only {more:.2g} higher" if more > EQUAL else "is as good"
            yield f"another minimum {how}: {where}"
