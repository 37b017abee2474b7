"""The plot of restitutions at several heights or speeds, with the curves of contact laws."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from stackbounce.errors import InvalidValue
from stackbounce.plots.style import COLORS, two_panels, written

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_POINTS = 60  # of a curve
_BEYOND = 0.04  # of the range of speeds: a curve goes on beyond the points
_STYLES = ("-", "--", "-.", ":")
_MARKERS = ("o", "s", "^", "D", "v", "P")
_MOST = 1.0 - 1e-6  # restitution of a law
_ROOM = 0.35  # of the range of the points, left above and below them
_LEAST = 0.0001  # p that is written
_FEW = 6  # laws in a picture, the best ones


def restitutions(fit: Any, axes: "Axes | Sequence[Axes] | None" = None) -> "Figure":
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
    matplotlib.figure.Figure
        Not shown and not saved. Bars are standard errors, the band is that of the best law. Below:
        the restitutions less those of the best law, and the other laws less it.

    Raises
    ------
    InvalidValue
        If no ball has restitutions at several speeds.

    Examples
    --------
    >>> from stackbounce import plots
    >>> from stackbounce.fitting.series import fit_series
    >>> found = fit_series("dataset:golf-marble-heights", laws=["Rigid", "Viscoelastic"])
    >>> [axes.get_ylabel() for axes in plots.restitutions(found).axes]
    ['restitution', 'less the best law']
    """
    if not fit.comparisons:
        raise InvalidValue("nothing is to be drawn: no ball has restitutions at several speeds")
    if axes is not None:
        above, *others = np.atleast_1d(np.asarray(axes, dtype=object)).tolist()
        _draw(above, others[0] if others else None, fit.comparisons)
        drawn: Figure = above.figure
        return drawn
    with two_panels(5.2, (3, 1.25)) as (figure, above, below):
        _draw(above, below, fit.comparisons)
    return figure


def _draw(above: "Axes", below: "Axes | None", comparisons: Sequence[Any]) -> None:
    heights = all(found.series.from_heights for found in comparisons)
    several = len(comparisons) > 1
    for k, found in enumerate(comparisons):
        best, *others = found.outcomes[:_FEW]
        color = COLORS[k % len(COLORS)] if several else "black"
        _draw_points(above, found, None, color, _MARKERS[k % len(_MARKERS)], heights)
        of = (
            {"color": color, "before": f"{found.series.ball}, "}
            if several
            else {"color": COLORS[0]}
        )
        _draw_curve(above, found, best, None, heights, **of)
        if below is not None:
            below.axhline(0.0, color="#808080" if several else COLORS[0], linewidth=1.0)
            _draw_points(below, found, best, color, _MARKERS[k % len(_MARKERS)], heights)
        for i, outcome in enumerate(() if several else others, 1):
            look = {"color": COLORS[i % len(COLORS)], "style": _STYLES[i % len(_STYLES)]}
            _draw_curve(above, found, outcome, None, heights, **look)
            if below is not None:
                _draw_curve(below, found, outcome, best, heights, **look)
    _hold(above, [band for found in comparisons for band in _reach(found)])
    lowest = above if below is None else below
    lowest.set_xlabel("height of fall (m)" if heights else "impact speed (m/s)")
    above.set_ylabel("restitution")
    above.legend(frameon=False, fontsize=8.5, loc="best")
    if below is not None:
        below.set_ylabel("less the best law")
        left = [(_left(found, found.outcomes[0]), _errors(found)) for found in comparisons]
        _hold(below, [side for values, error in left for side in (values - error, values + error)])


def _hold(axes: "Axes", places: Sequence[Any]) -> None:
    """Let the points, not a bad law, set the range of an axis."""
    low, high = (float(reach(np.concatenate(places))) for reach in (np.min, np.max))
    axes.set_ylim(low - _ROOM * (high - low), high + _ROOM * (high - low))


def _reach(found: Any) -> tuple[Any, Any]:
    """Return the lower and the upper ends of the error bars."""
    return found.series.values - _errors(found), found.series.values + _errors(found)


def _errors(found: Any) -> Any:
    return np.sqrt(found.series.covariance().diagonal())


def _left(found: Any, outcome: Any) -> Any:
    """Return the restitutions less those of a law."""
    series = found.series
    return series.values - found.curves[outcome.laws[0]].at(outcome.value, series.speeds)


def _draw_points(
    axes: "Axes", found: Any, less: Any, color: str, marker: str, heights: bool
) -> None:
    """Draw the restitutions, or what is left of them, with their errors."""
    series = found.series
    places = series.heights if heights else series.speeds
    values = series.values if less is None else _left(found, less)
    look: Any = {"color": color, "markersize": 4.5, "elinewidth": 1.0, "capsize": 2.0, "zorder": 4}
    axes.errorbar(places, values, _errors(found), fmt=marker, **look)


def _draw_curve(
    axes: "Axes",
    found: Any,
    outcome: Any,
    less: Any,
    heights: bool,
    color: str,
    style: str = "-",
    before: str = "",
) -> None:
    """Draw the curve of a law, of the best one with its band, or its difference from the best."""
    series, family = found.series, found.curves[outcome.laws[0]]
    low, high = float(series.speeds.min()), float(series.speeds.max())
    speeds = np.linspace(low - _BEYOND * (high - low), high + _BEYOND * (high - low), _POINTS)
    places = series.heights_of(speeds) if heights else speeds
    values = family.at(outcome.value, speeds)
    if less is not None:
        values = values - found.curves[less.laws[0]].at(less.value, speeds)
    elif outcome is found.outcomes[0]:
        low, high = outcome.interval()
        band = [family.at(min(limit, _MOST), speeds) for limit in (max(low, 1.0 - _MOST), high)]
        axes.fill_between(places, *band, color=color, alpha=0.18, linewidth=0)
    law = (
        f"{outcome.short_name}: p = {outcome.p:.2g}"
        if outcome.p >= _LEAST
        else (f"{outcome.short_name}: p < {_LEAST}")
    )
    axes.plot(places, values, style, color=color, label=written(before + law), linewidth=1.6)
