"""What should be known about a fit: what data leave open, bounds, other minima, misfits."""

from typing import TYPE_CHECKING

import numpy as np

from stackbounce.fitting.problem import ABSENT
from stackbounce.fitting.search import EQUAL, OPEN

if TYPE_CHECKING:
    from stackbounce.fitting.result import Fit

__all__ = ["notes", "undetermined"]

_CLOSE = 4.0  # more of chi squared than the best: a minimum that is worth telling
_UNLIKELY = 1e-3
_SHARE = 0.3  # of a direction that is left open, from which on a parameter is named
_EDGE = 1e-3  # of the bounds' distance


def notes(fit: "Fit") -> tuple[str, ...]:
    """Return what should be known about a fit, a sentence each."""
    return (
        *_unsettled(fit),
        *_unsolved(fit),
        *fit.undetermined,
        *_at_bounds(fit),
        *_unlikely(fit),
        *_other_counts(fit),
        *_absent(fit),
        *_other_minima(fit),
    )


def undetermined(fit: "Fit") -> tuple[str, ...]:
    """Return what the data cannot determine, a sentence each.

    In a direction in which chi squared would change by less than 1 from one bound to the other,
    were it as steep everywhere, every value is as good.
    """
    found = []
    for size, direction in zip(*fit.directions, strict=True):
        if size > OPEN:
            continue
        part = np.abs(direction) / np.max(np.abs(direction))
        names = [name for name, one in zip(fit.names, part, strict=True) if one > _SHARE]
        found.append(_open(names))
    return tuple(found)


def _unsettled(fit: "Fit") -> list[str]:
    if fit.minima[0].converged:
        return []
    return ["the search ended before it had settled: tell narrower bounds"]


def _unsolved(fit: "Fit") -> list[str]:
    return [
        f"{count} runs of the search came to no end ({name}) and were taken for far from all data: "
        "tell narrower bounds"
        for name, count in fit.unsolved.items()
    ]


def _at_bounds(fit: "Fit") -> list[str]:
    found = []
    for one, x in zip(fit.problem.parameters, fit.x, strict=True):
        low, high = one.span
        for end, value in ((low, one.low), (high, one.high)):
            if abs(x - end) < _EDGE * (high - low):
                found.append(f"{one.name} lies at its bound, {value:g} {one.unit}".rstrip())
    return found


def _unlikely(fit: "Fit") -> list[str]:
    from scipy.stats import chi2

    free = max(1, fit.degrees_of_freedom)  # without any, a model that can follow has no misfit
    if chi2.sf(fit.chi_squared, free) >= _UNLIKELY:
        return []
    count = fit.degrees_of_freedom
    freedom = f"{count} degree{'' if count == 1 else 's'} of freedom"
    bad = f"chi squared is {fit.chi_squared:.4g} for {freedom}"
    return [f"the model does not describe the data: {bad}; its parameters' errors mean little"]


def _other_counts(fit: "Fit") -> list[str]:
    found = []
    for key, measured in fit.problem.measured.items():
        if not measured.counts:
            continue
        fitted = fit.problem.counts(key, fit.x)
        for count in measured.counts:
            if fitted[count.index] != count.seen:
                name = f"{key}.{count.name}" if key else count.name
                found.append(f"{name}: {count.seen} seen, {fitted[count.index]} in the fit")
    return found


def _absent(fit: "Fit") -> list[str]:
    return [
        f"{one.drop}{'.' if one.drop else ''}{one.name}: the fitted drop has none"
        for one in fit.residuals
        if not abs(one.pull) < ABSENT
    ]


def _other_minima(fit: "Fit") -> list[str]:
    found = []
    for one in fit.minima[1:]:
        more = one.chi_squared - fit.chi_squared
        if more < _CLOSE:
            values = fit.problem.values(one.x[None])
            where = ", ".join(f"{name} = {array[0]:.4g}" for name, array in values.items())
            how = f"has chi squared only {more:.2g} higher" if more > EQUAL else "is as good"
            found.append(f"another minimum {how}: {where}")
    return found


def _open(names: list[str]) -> str:
    if len(names) == 1:
        return f"the data do not determine {names[0]}: nothing changes within its bounds"
    listed = f"{', '.join(names[:-1])} and {names[-1]}"
    return f"the data do not determine {listed} one by one: they can change together unseen"
