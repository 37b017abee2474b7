"""The corner plot of a posterior: the distribution of each parameter and of each pair."""

from typing import TYPE_CHECKING, Any

import numpy as np

from stackbounce.plots.style import COLORS, styled_figure
from stackbounce.units import handy, rounded

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_OWN_STYLE = {"axes.grid": False, "figure.constrained_layout.use": False, "lines.linewidth": 1.2}
_SIDE = 2.5  # inches of a panel
_MOST = 20_000  # draws; more are thinned evenly
_WITHIN = (0.393, 0.865)  # of the draws of two: one and two standard deviations of a Gaussian


def corner(posterior: Any) -> "Figure":
    """Draw the posterior distribution of each parameter and of each pair.

    Parameters
    ----------
    posterior : Posterior
        From `Fit.sample`.

    Returns
    -------
    matplotlib.figure.Figure
        Not shown and not saved. The title of each column gives the median and the limits of the
        central 68 % of the draws. The contours contain 39 % and 86 % of the draws, as the contours
        of one and two standard deviations of a two-dimensional Gaussian do.

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
    import corner as library

    draws, labels = [], []
    for name in posterior.names:
        own = posterior.draws(name)
        unit, factor = handy(float(np.median(np.abs(own))), posterior.units[name])
        draws.append(factor * own[:: max(1, len(own) // _MOST)])
        labels.append(f"{name} ({unit})".replace("**", "^") if unit else name)
    count = len(labels)
    side = _SIDE * max(count, 1.6)
    with styled_figure(side, side, _OWN_STYLE) as figure:
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
            range=_extents(draws),
        )
        for k, own in enumerate(draws):
            _title(figure.axes[k * (count + 1)], own)
    return figure


def _extents(draws: list[Any]) -> list[tuple[float, float]]:
    """Return the range of each axis: the central 99.8 % of the draws and a margin.

    If all draws are equal, the range is centred on their value.
    """
    found = []
    for own in draws:
        low, high = np.quantile(own, (0.001, 0.999))
        wide = 0.02 * (high - low) or abs(low) or 1.0
        found.append((float(low - wide), float(high + wide)))
    return found


def _title(axes: Any, own: Any) -> None:
    low, middle, high = np.quantile(own, (0.159, 0.5, 0.841))
    texts = rounded((middle, high - middle, middle - low), min(high - middle, middle - low))
    axes.set_title("${}^{{+{}}}_{{-{}}}$".format(*texts), fontsize=10)
