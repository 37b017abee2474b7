"""Plots of a fit: pulls, force records, chi squared around its minimum, and its posterior."""

from functools import partial
from typing import Any

import numpy as np

from stackbounce.errors import InvalidValue
from stackbounce.extras import need
from stackbounce.library_types import Axes, Figure
from stackbounce.plots.by_number import draw_into, draw_panels, find_number
from stackbounce.plots.by_speed import restitutions
from stackbounce.plots.model_comparison import compared, draw_pulls
from stackbounce.plots.scales import Scale, label
from stackbounce.plots.style import COLORS, check_kind, into_axes, list_axes, styled_figure
from stackbounce.units import handy, rounded

_REACH = 4.0  # standard errors drawn on both sides
_WORTH = 9.0  # other minima are drawn if chi squared is less than this above the minimum
_STEPS = 61  # values of a profile
_TOP = 10.0  # upper end of a profile's axis
_CURVE, _BEST, _OTHER = COLORS[0], COLORS[1], "white"
_MEASURED, _FITTED = "#4d4d4d", COLORS[1]
_MOST_RECORDS = 4
_WIDE = 7.2  # inches
_BESIDE = 0.25  # of the contact's duration: drawn before and after it
_OWN_STYLE = {"axes.grid": False, "figure.constrained_layout.use": False, "lines.linewidth": 1.2}
_SIDE = 2.5  # inches of a panel
_SHOWN = 0.998  # central share of the draws within the axes
_WITHIN = (0.393, 0.865)  # of the draws of two: one and two standard deviations of a Gaussian


def draw_profile(axes: Axes, fit: Any, k: int) -> None:
    """Draw chi squared against a fitted parameter, with all others fitted anew, and its error."""
    parameter = fit.objective.parameters[k]
    values = parameter.value(np.linspace(*_extent(fit, k), _STEPS))
    for rise, text in ((1.0, "1 σ"), (4.0, "2 σ")):
        axes.axhline(rise, color="#404040", linestyle="--", linewidth=0.8)
        place: Any = {"transform": axes.get_yaxis_transform(), "ha": "right", "va": "bottom"}
        axes.text(0.995, rise, text, fontsize=8, **place)
    axes.plot(values, fit.profile(parameter.name, values) - fit.chi_squared, color=_CURVE)
    best = fit[parameter.name]
    for at in (best.nominal_value - best.std_dev, best.nominal_value + best.std_dev):
        axes.axvline(at, color=_BEST, linewidth=0.8)
    for j, minimum in enumerate(fit.minima):
        more = minimum.chi_squared - fit.chi_squared
        look: Any = {"color": _BEST if j == 0 else _OTHER, "markeredgecolor": "black"}
        axes.plot(parameter.value(minimum.x[k]), more, "o", zorder=4, clip_on=False, **look)
    axes.set(xlim=(values[0], values[-1]), ylim=(0.0, _TOP), ylabel="chi squared above its minimum")
    log = parameter.logarithmic and values[-1] > 3.0 * values[0]
    label(axes, "x", parameter.name, Scale(values, log, parameter.unit))


def _extent(fit: Any, k: int) -> tuple[float, float]:
    """Return the range of coordinates that is drawn: around the minima, within the bounds."""
    parameter = fit.objective.parameters[k]
    low, high = parameter.span
    slope = abs(parameter.slope(float(fit.x[k])))
    reach = _REACH * fit[parameter.name].std_dev / slope
    worth = fit.chi_squared + _WORTH
    near = [minimum.x[k] for minimum in fit.minima if minimum.chi_squared < worth]
    return max(low, min(near) - reach), min(high, max(near) + reach)


@into_axes
def fit(found: Any, *, axes: Any = None) -> Figure:
    """Draw what a fit found, as its kind asks: by `restitutions`, `fitted`, `compared` or `corner`.

    Parameters
    ----------
    found : SeriesFit, Fit, Comparison or Posterior
        From `stackbounce.fit_series`, `fit`, `compare` or `Fit.sample`.
    axes : matplotlib.axes.Axes or sequence of them, optional
        Where to draw, as that function takes them; by default in a new figure.

    Returns
    -------
    matplotlib.figure.Figure, or `axes` if given
        Not shown and not saved.

    Raises
    ------
    InvalidType
        If `found` is something else.

    Examples
    --------
    >>> import stackbounce as sb
    >>> from stackbounce import plots
    >>> found = sb.fit_series("dataset:golf-marble-heights", laws=["Rigid"])
    >>> plots.fit(found).axes[0].get_ylabel()
    'restitution'
    """
    draws = {"SeriesFit": restitutions, "Fit": fitted, "Comparison": compared, "Posterior": corner}
    check_kind(found, "found", *draws)
    return draws[type(found).__name__](found, axes=axes)


@into_axes
def fitted(fit: Any, *, axes: Any = None) -> Figure:
    """Draw what was measured with the fitted curves, and chi squared around the minimum.

    Parameters
    ----------
    fit : Fit
        From `stackbounce.fit`.
    axes : matplotlib.axes.Axes or sequence of them, optional
        Where to draw. If the drops differ in one number, what was measured against it, one or two
        for each measured quantity; else a new figure's panels in their order. By default in a new
        figure.

    Returns
    -------
    matplotlib.figure.Figure, or `axes` if given
        Not shown and not saved. If the drops differ in one number, such as the height: what was
        measured against it, the fitted curve with a band of one standard deviation, and the pulls,
        fitted minus measured numbers in standard errors; else the pulls alone. Force
        records with the fitted curves. Below, for one or two parameters, the profile of chi squared
        of each. With force records it is not drawn, because each trial takes long.

    Raises
    ------
    InvalidValue
        If `axes` are not as many.
    InvalidType
        If `fit` is no Fit.

    Examples
    --------
    >>> import stackbounce as sb
    >>> from stackbounce import plots
    >>> drop = sb.Drop([sb.Ball(0.0567)], [sb.Spring(1e4)], height=0.3)
    >>> found = sb.fit(drop, {"durations.0": "5.0 ± 0.1 ms"}, vary=["contacts.0.stiffness"])
    >>> plots.fitted(found).axes[-1].get_xlabel()
    'contacts.0.stiffness (N/m)'
    """
    check_kind(fit, "fit", "Fit")
    residuals, records, number = fit.residuals, fit.records[:_MOST_RECORDS], find_number(fit)
    count = len(fit.names) if len(fit.names) in (1, 2) and not records else 0
    draws: list[Any] = []
    if residuals and not number:
        pulls = {"": [residual.pull for residual in residuals]}
        labels = [residual.label for residual in residuals]
        draws.append(partial(draw_pulls, pulls=pulls, data=labels))
    draws += [partial(_draw_record, record=record) for record in records]
    draws += [partial(draw_profile, fit=fit, k=k) for k in range(count)]
    heights = [4.4 if number else 1.8] if residuals else []
    heights += [2.4] * len(records) + [3.0] * bool(count)
    with styled_figure(_WIDE, sum(heights) + 0.3) as figure:
        if axes is not None and number:
            return draw_into(axes, {"": fit}, number)
        if axes is not None:
            figure, given = list_axes(axes, len(draws))
            own = iter(given)
        else:
            figure.suptitle(fit.remarks[0], x=0.01, ha="left", fontsize=8.5, wrap=True)
            parts = figure.subfigures(len(heights), 1, height_ratios=heights, squeeze=False)[:, 0]
            if number:
                draw_panels(parts[0], {"": fit}, number)
                parts = parts[1:]
            across = [1] * (len(draws) - count) + [count] * bool(count)
            rows = zip(parts, across, strict=True)  # a colour bar comes before the next panel
            own = (axes for row, n in rows for axes in row.subplots(1, n, squeeze=False)[0])
        for draw, panel in zip(draws, own, strict=True):
            draw(panel)
    return figure


def _draw_record(axes: Axes, record: Any) -> None:
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
    axes.set(xlim=factor * times[[0, -1]], ylabel="force (N)" if record.unit else "signal")
    axes.set_xlabel(f"time since the first touch ({'ms' if factor > 1.0 else 's'})")
    name = f"{record.drop}  {record.name}".strip()
    text = f"{name}: the samples scatter by {record.scatter:.3g} of their error"
    axes.set_title(text, loc="left", fontsize=10)
    axes.legend(frameon=False, loc="upper right", borderpad=0.0, fontsize=9)


@into_axes
def corner(posterior: Any, *, axes: Any = None) -> Figure:
    """Draw the posterior distribution of each parameter and of each pair.

    Parameters
    ----------
    posterior : Posterior
        From `Fit.sample`.
    axes : sequence of matplotlib.axes.Axes, optional
        Where to draw: a row for each parameter, with as many columns, all that their figure has. By
        default in a new figure.

    Returns
    -------
    matplotlib.figure.Figure, or `axes` if given
        Not shown and not saved. The title of each column gives the median and the limits of the
        central 68 % of the draws. The contours contain 39 % and 86 % of the draws, as the contours
        of one and two standard deviations of a two-dimensional Gaussian do.

    Raises
    ------
    InvalidValue
        If `axes` are not as many, or not all that their figure has.
    InvalidType
        If `posterior` is no Posterior.

    Notes
    -----
    Drawn by the package ``corner`` (D. Foreman-Mackey, J. Open Source Softw. 1, 24, 2016).

    Examples
    --------
    >>> import stackbounce as sb
    >>> from stackbounce import plots
    >>> drop = sb.Drop([sb.Ball(0.0567)], [sb.Spring(1e4)], height=0.3)
    >>> found = sb.fit(drop, {"durations.0": "5.0 ± 0.1 ms"}, vary=["contacts.0.stiffness"])
    >>> len(plots.corner(found.sample(6400)).axes)
    1
    """
    need("a corner plot", "corner")
    import corner as library

    check_kind(posterior, "posterior", "Posterior")
    draws, labels = [], []
    for name in posterior.names:
        own = posterior.draws(name)
        unit, factor = handy(float(np.median(np.abs(own))), posterior.units[name])
        draws.append(factor * own)
        labels.append(f"{name} ({unit})".replace("**", "^") if unit else name)
    count = len(labels)
    side = _SIDE * max(count, 1.6)
    with styled_figure(side, side, _OWN_STYLE) as figure:
        if axes is not None:
            figure, own = list_axes(axes, count**2)
            if figure.axes != own:
                raise InvalidValue("axes must be all that their figure has, as of plt.subplots")
        library.corner(
            np.stack(draws, axis=1),
            fig=figure,
            labels=labels,
            color=COLORS[0],
            bins=40,
            levels=_WITHIN,
            smooth=1.0 if count > 1 else None,
            quantiles=(0.159, 0.5, 0.841),
            plot_datapoints=False,
            label_kwargs={"fontsize": 9},
            range=[_SHOWN] * count,
        )
        for k, values in enumerate(draws):
            low, middle, high = np.quantile(values, (0.159, 0.5, 0.841))
            apart = (high - middle, middle - low)
            title = "${}^{{+{}}}_{{-{}}}$".format(*rounded((middle, *apart), min(apart)))
            figure.axes[k * (count + 1)].set_title(title, fontsize=10)
    return figure
