"""The plot of restitutions at several heights or speeds, with the curves of contact laws."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from stackbounce.errors import InvalidValue
from stackbounce.library_types import Axes, Figure
from stackbounce.plots.fitted_curves import Curve, Points, draw_fitted, spread_over
from stackbounce.plots.style import WIDTH, check_kind, into_axes, list_axes, panels

_LEAST, _MOST = 1e-6, 1.0 - 1e-6  # restitution of a law
_CHANCE = 0.0001  # p that is written
_FEW = 6  # laws in a picture, the best ones


@into_axes
def restitutions(fit: Any, *, axes: Axes | Sequence[Axes] | None = None) -> Figure:
    """Draw restitutions with their errors, the curves of the laws, and what is left over.

    Parameters
    ----------
    fit : SeriesFit
        From `stackbounce.fitting.series.fit_series`. Of one ball, the best laws are drawn; of
        several, the best law of each.
    axes : matplotlib.axes.Axes or pair of them, optional
        Where to draw: the restitutions, and what is left over. By default a new figure has both.

    Returns
    -------
    matplotlib.figure.Figure, or `axes` if given
        Not shown and not saved. Bars are standard errors, the band is that of the best law. Below:
        fitted less measured restitutions, in errors.

    Raises
    ------
    InvalidValue
        If no ball has restitutions at several speeds, or `axes` are not one or two.
    InvalidType
        If `fit` is no SeriesFit.

    Examples
    --------
    >>> from stackbounce import plots
    >>> from stackbounce.fitting.series import fit_series
    >>> found = fit_series("dataset:golf-marble-heights", laws=["Rigid", "Viscoelastic"])
    >>> plots.restitutions(found).axes[1].get_xlabel()
    'height of fall (m)'
    """
    check_kind(fit, "fit", "SeriesFit")
    if not fit.comparisons:
        raise InvalidValue("nothing is to be drawn: no ball has restitutions at several speeds")
    ratios = (3, 1.25) if axes is None else (3, 1.25)[: len(list_axes(axes, 1, 2)[1])]
    with panels((WIDTH, 5.2), axes, ratios) as (figure, (above, *below)):
        _draw(above, below[0] if below else None, fit.comparisons)
    return figure


def _draw(above: Axes, below: Axes | None, comparisons: Sequence[Any]) -> None:
    heights = all(found.series.from_heights for found in comparisons)
    few = 1 if len(comparisons) > 1 else _FEW
    groups = []
    for found in comparisons:
        series, best = found.series, found.outcomes[:few]
        speeds, errors = spread_over(series.speeds), np.sqrt(series.covariance().diagonal())
        at, curve_at = series.speeds, speeds
        if heights:
            at, curve_at = series.heights, series.heights_of(speeds)
        curves: list[Curve] = []
        pulls = []
        for outcome in best:
            family = found.curves[outcome.laws[0]]
            limits = outcome.interval() if not curves else ()
            band = [family.at(min(max(limit, _LEAST), _MOST), speeds) for limit in limits]
            chance = f"p = {outcome.p:.2g}" if outcome.p >= _CHANCE else f"p < {_CHANCE}"
            ball = f"{series.ball}, " if few == 1 else ""
            name = f"{ball}{outcome.short_name}: {chance}"
            values = family.at(outcome.value, speeds)
            curves.append(Curve(name, curve_at, values, tuple(band) or None))
            pulls.append((family.at(outcome.value, series.speeds) - series.values) / errors)
        name = series.ball if few == 1 else "measured"
        groups.append((Points(name, at, series.values, errors, pulls), curves))
    draw_fitted(above, below, groups)
    (below or above).set_xlabel("height of fall (m)" if heights else "impact speed (m/s)")
    above.set_ylabel("restitution")
