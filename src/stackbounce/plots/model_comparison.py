"""The plot of a model comparison: information criterion and pulls of each model."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from stackbounce.library_types import Axes, Figure
from stackbounce.plots.by_number import draw_into, draw_panels, find_number, list_quantities
from stackbounce.plots.style import COLORS, check_kind, into_axes, list_axes, styled_figure

_NAMES = {"aicc": "AICc", "bic": "BIC"}
_MOST = 4.0  # errors: the strongest colour of a pull
_FEW = 4  # models whose curves are drawn
_SCORES, _PANEL = 5.8, 4.6  # inches: the width of the scores, and of a measured quantity
_WIDEST = 40  # for more data, the pulls are not written into the cells


@into_axes
def compared(comparison: Any, *, axes: Any = None) -> Figure:
    """Draw the information criterion and the pulls of each model, the best model on top.

    Parameters
    ----------
    comparison : Comparison
        What `stackbounce.compare` returned.
    axes : matplotlib.axes.Axes or sequence of them, optional
        Where to draw. If the drops differ in one number, what was measured and the curves alone, as
        `fitted` takes them; else two, the criterion and the pulls. By default in a new figure.

    Returns
    -------
    matplotlib.figure.Figure, or `axes` if given
        Not shown and not saved. On the left the AICc or BIC of each model minus that of the best
        one. On the right what was measured with the curves of the best models, if the drops differ
        in one number, as `fitted` draws it; else the pulls: fitted minus measured value of each
        datum, in standard errors.

    Raises
    ------
    InvalidValue
        If `axes` are not as many.
    InvalidType
        If `comparison` is no Comparison.

    Examples
    --------
    >>> import stackbounce as sb
    >>> springs = [sb.Spring(2500.0), sb.Spring(1000.0)]
    >>> drop = sb.Drop([sb.Ball(0.150), sb.Ball(0.057)], springs, impact_speed=3.53)
    >>> data = {"rebound_ratios": ["0.18 ± 0.02", "1.64 ± 0.02"]}
    >>> len(compared(sb.compare(sb.standard_models(drop), data)).axes)
    3
    """
    check_kind(comparison, "comparison", "Comparison")
    names = [score.model for score in comparison.scores]
    lines = sum(1 + len(score.same_as) for score in comparison.scores)
    best = {name: comparison[name] for name in names[:_FEW]}
    number = find_number(comparison[names[0]])
    pulls = comparison.pulls.sel(model=names)
    wide = 5.0 + 0.55 * min(pulls.sizes["datum"], _WIDEST)
    if number:
        wide = _SCORES + _PANEL * len(list_quantities(comparison[names[0]]))
    with styled_figure(max(8.0, wide), max(4.4 if number else 0.0, 1.9 + 0.42 * lines)) as figure:
        if axes is not None and number:
            return draw_into(axes, best, number)
        if number:
            ratios: Any = {"width_ratios": (_SCORES, wide - _SCORES)}
            beside, others = np.ravel(figure.subfigures(1, 2, **ratios))
            left = beside.subplots()
            draw_panels(others, best, number)
        else:
            if axes is None:
                axes = figure.subplots(1, 2, sharey=True, width_ratios=(2.2, wide - 3.0))
            figure, (left, right) = list_axes(axes, 2)
            rows = dict(zip(names, pulls.values, strict=True))
            draw_pulls(right, rows, pulls.datum.values.tolist())
        _draw_scores(left, comparison)
        left.set_yticks(np.arange(len(names)), [score.title for score in comparison.scores])
        left.set_ylim(len(names) - 0.5, -0.5)
    return figure


def _draw_scores(axes: Axes, comparison: Any) -> None:
    """Draw the criterion of each model minus that of the best model."""
    values = np.array([getattr(score, comparison.criterion) for score in comparison.scores])
    more = values - values[0]
    axes.barh(np.arange(len(more)), more, color=COLORS[0], height=0.6)
    largest = max(float(more.max()), 1.0)
    logarithmic = largest > 100.0
    beside: Any = {"xytext": (4, 0), "textcoords": "offset points", "va": "center", "fontsize": 8}
    for k, (one, score) in enumerate(zip(more, comparison.scores, strict=True)):
        words = f"{one:.3g}" if k else f"best: χ² = {score.chi_squared:.1f}"
        axes.annotate(words, (one, k), **beside)
    if logarithmic:
        axes.set_xscale("symlog", linthresh=10.0)
        axes.set_xticks([0.0, *(10.0**k for k in range(1, 1 + int(np.log10(largest))))])
    axes.set_xlim(0.0, largest ** (1.35 if logarithmic else 1.0) * 1.35)
    axes.set_xlabel(f"{_NAMES[comparison.criterion]} above the best")
    axes.grid(visible=False, axis="y")
    axes.tick_params(axis="y", length=0)


def draw_pulls(axes: Axes, pulls: Mapping[str, Sequence[float]], data: Sequence[str]) -> None:
    """Draw pulls, a row for each model, as a colored table with the numbers in its cells."""
    table = np.array(list(pulls.values()))
    shown = axes.imshow(table, cmap="RdBu_r", vmin=-_MOST, vmax=_MOST, aspect="auto")
    look: Any = {"ha": "center", "va": "center", "fontsize": 7.5}
    for (row, column), pull in np.ndenumerate(table if len(data) <= _WIDEST else table[:, :0]):
        color = "white" if abs(pull) > 0.6 * _MOST else "black"
        axes.annotate(_written(float(pull)), (column, row), color=color, **look)
    axes.set_xticks(np.arange(len(data)), data, rotation=40, ha="right")
    axes.set_yticks(np.arange(len(table)), list(pulls))
    axes.tick_params(axis="x", labelsize=8)
    axes.grid(visible=False)
    bar = axes.figure.colorbar(shown, ax=axes, extend="both", pad=0.015, fraction=0.05)
    bar.set_label("off by\n(errors)" if len(table) < 3 else "fitted − measured,\nin errors")


def _written(pull: float) -> str:
    """Return a pull as text of at most five characters."""
    if not np.isfinite(pull):
        return "–"
    written = f"{pull:+.1f}" if abs(pull) < 99.5 else f"{pull:+.0f}"
    return "0.0" if written in ("+0.0", "-0.0") else written
