"""Plots of a fit: pulls, force records, and chi squared around its minimum."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from stackbounce.plots.chi_squared import draw_map, draw_profile
from stackbounce.plots.style import COLORS, styled_figure
from stackbounce.units import handy, rounded

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_MEASURED, _FITTED = "#4d4d4d", COLORS[1]
_MOST_PULLS, _MOST_RECORDS = 40, 4
_ROW = 0.26  # inches of a pull
_WIDE = 7.2  # inches
_BESIDE = 0.25  # of the contact's duration: drawn before and after it
_HELD = 5.0  # larger pulls are arrows at the edge


def fitted(fit: Any) -> "Figure":
    """Draw the pulls of a fit, its force records, and chi squared around the minimum.

    Parameters
    ----------
    fit : Fit
        From `stackbounce.fit`.

    Returns
    -------
    matplotlib.figure.Figure
        Not shown and not saved. The pulls: fitted minus measured numbers in standard errors. Force
        records with the fitted curves. Below, chi squared: a curve for one parameter, a map with
        the profile of each for two. Dotted lines are kinks, where the number of contact intervals
        changes. With force records chi squared is not drawn, because each trial takes long.

    Examples
    --------
    >>> import stackbounce as sb
    >>> from stackbounce import plots
    >>> drop = sb.Drop([sb.Ball(0.0567)], [sb.Spring(1e4)], height=0.3)
    >>> found = sb.fit(drop, {"durations.0": "5.0 ± 0.1 ms"}, vary=["contacts.0.stiffness"])
    >>> [axes.get_xlabel() for axes in plots.fitted(found).axes]
    ['fitted − measured (errors)', 'contacts.0.stiffness (N/m)']
    """
    residuals, records = fit.residuals[:_MOST_PULLS], fit.records[:_MOST_RECORDS]
    count = 0 if records else len(fit.names)
    heights = [0.9 + _ROW * len(residuals)] if residuals else []
    heights += [2.4] * len(records) + ([3.0] if count == 1 else [5.6] if count == 2 else [])
    with styled_figure(_WIDE, sum(heights) + 0.3) as figure:
        parts = figure.subfigures(len(heights), 1, height_ratios=heights, squeeze=False)[:, 0]
        figure.suptitle(_title(fit), x=0.01, ha="left", fontsize=10)
        if residuals:
            _draw_pulls(parts[0].subplots(), residuals, len(fit.residuals))
        for part, record in zip(parts[bool(residuals) :], records, strict=False):
            _draw_record(part.subplots(), record)
        if count == 1:
            draw_profile(parts[-1].subplots(), fit)
        elif count == 2:
            draw_map(parts[-1], fit)
    return figure


def _title(fit: Any) -> str:
    count = fit.degrees_of_freedom
    words = f"{count} degree{'' if count == 1 else 's'} of freedom"
    chi_squared = 0.0 if fit.chi_squared < 1e-9 else fit.chi_squared
    return f"chi squared {chi_squared:.3g} for {words}"


def _draw_pulls(axes: "Axes", residuals: Sequence[Any], count: int) -> None:
    """Draw the pull of each measured number as a dot, the first one on top."""
    places = np.arange(len(residuals))
    pulls = np.array([residual.pull for residual in residuals])
    wide = min(max(3.0, 1.15 * float(np.abs(pulls).max())), _HELD)
    for reach, shade in ((2.0, 0.08), (1.0, 0.14)):
        axes.axvspan(-reach, reach, color=COLORS[0], alpha=shade, linewidth=0)
    axes.axvline(0.0, color="#808080", linewidth=0.8)
    inside = np.abs(pulls) <= wide
    look: Any = {"color": _FITTED, "zorder": 3, "clip_on": False}
    axes.plot(pulls[inside], places[inside], "o", markersize=6, **look)
    for place, pull in zip(places[~inside], pulls[~inside], strict=True):
        side = np.sign(pull)
        axes.plot(side * wide, place, ">" if side > 0 else "<", markersize=8, **look)
    axes.set_xlim(-wide, wide)
    axes.set_ylim(len(residuals) - 0.4, -0.6)
    axes.set_yticks(places, [f"{residual.drop}  {residual.name}".strip() for residual in residuals])
    axes.grid(visible=False, axis="y")
    axes.tick_params(axis="y", length=0)
    axes.set_xlabel("fitted − measured (errors)")
    values = axes.secondary_yaxis("right")
    values.set_yticks(places, [_both(residual) for residual in residuals])
    values.tick_params(axis="y", length=0)
    values.spines["right"].set_visible(False)
    if count > len(residuals):
        axes.set_title(f"the first {len(residuals)} of {count}", loc="left", fontsize=9)


def _both(one: Any) -> str:
    """Return the label ``measured ± error, fitted value``, all with the same decimals."""
    unit, factor = handy(max(abs(one.measured), one.error), one.unit)
    numbers = [factor * value for value in (one.measured, one.error, one.fitted)]
    text = "{} ± {}, fitted {} ".format(*rounded(numbers, factor * one.error)) + unit
    return text.rstrip().replace("-", "−")


def _draw_record(axes: "Axes", record: Any) -> None:
    """Draw a force record and the fitted curve, from shortly before to shortly after contact."""
    force = np.abs(record.fitted - np.median(record.fitted))
    during = record.times[force > 0.02 * force.max()]
    low, high = float(min(during[0], 0.0)), float(during[-1])
    beside = _BESIDE * (high - low)
    shown = (record.times >= low - beside) & (record.times <= high + beside)
    times, factor = record.times[shown], 1e3 if high < 1.0 else 1.0
    look: Any = {"color": _MEASURED, "markersize": 2.4, "label": "measured"}
    axes.plot(factor * times, record.measured[shown], ".", **look)
    axes.plot(factor * times, record.fitted[shown], color=_FITTED, label="fitted")
    axes.set_xlim(factor * times[0], factor * times[-1])
    axes.set_xlabel(f"time since the first touch ({'ms' if factor > 1.0 else 's'})")
    axes.set_ylabel("force (N)" if record.unit else "signal")
    name = f"{record.drop}  {record.name}".strip()
    text = f"{name}: the samples scatter by {record.scatter:.3g} of their error"
    axes.set_title(text, loc="left", fontsize=10)
    axes.legend(frameon=False, loc="upper right", borderpad=0.0, fontsize=9)
