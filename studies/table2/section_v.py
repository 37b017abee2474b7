"""Section V's two fits repeated with its model, and with confidence intervals."""

from dataclasses import replace
from typing import NamedTuple

from stackbounce.cross2007 import PAPER
from stackbounce.cross2007.datasets import load_dataset
from stackbounce.fitting import Interval, fit
from studies.table2 import inputs

_FITS = {"B2_on_B1": ("B1-B2", "fig13"), "B3_on_B1": ("B1-B3", "B3_fit")}
_NAMES = {
    "contacts.0.stiffness": "floor_stiffness",
    "contacts.1.stiffness": "ball_stiffness",
    "gaps.0": "gap",
}
_RTOL = 1e-8


class Number(NamedTuple):
    """One fitted number beside the printed one, all in SI units."""

    name: str
    printed: str
    printed_value: float
    fitted: float
    interval: Interval


class Refit(NamedTuple):
    """One of the two fits; `ratios` are its e1 and e2, `printed` those of section V."""

    pair: str
    numbers: list[Number]
    ratios: tuple[float, float]
    printed: tuple[float, float]
    measured: tuple[float, float]
    chi_squared: float
    degrees_of_freedom: int
    data: list[str]


def refit_section_v() -> list[Refit]:
    """Fit stiffnesses and gap of both pairs to Table II's rows and the times of the records.

    B1 has 105 g, from Table II's mass ratios.
    """
    return [_refit(pair, *names) for pair, names in _FITS.items()]


def _refit(pair: str, name: str, key: str) -> Refit:
    own = load_dataset(name)
    found = fit(replace(own.drop, balls=inputs.make_balls(pair)), own.data, own.vary, rtol=_RTOL)
    intervals = found.intervals()
    numbers = []
    for path, short in _NAMES.items():
        shown = PAPER[f"{key}.{short}"]
        numbers.append(Number(path, shown.printed, shown.value, found.best[path], intervals[path]))
    lower, upper = (residual.fitted for residual in found.residuals[:2])
    return Refit(
        pair,
        numbers,
        (lower, upper),
        _PRINTED[pair],
        inputs.read_ratios(pair),
        found.chi_squared,
        found.degrees_of_freedom,
        [residual.name for residual in found.residuals],
    )


_PRINTED = {"B2_on_B1": (0.24, 1.83), "B3_on_B1": (0.56, 2.16)}
"""Section V's e1 and e2."""
