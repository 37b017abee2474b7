"""What was measured of several drops, with fitted curves, against the number they differ in."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from stackbounce.library_types import Axes, Figure, SubFigure
from stackbounce.plots.fitted_curves import Curve, Points, draw_fitted, spread_over
from stackbounce.plots.scales import Scale, label, show_in_handy_unit
from stackbounce.plots.style import list_axes, written
from stackbounce.run.paths import Number, numbers_of, value_in
from stackbounce.run.quantities import QUANTITIES, Array

_RATIOS = (3.0, 1.3)  # the heights of the two panels of a quantity


def find_number(fit: Any) -> Number | None:
    """Return the one number in which the drops of a fit differ, besides what it varies; or None.

    Examples
    --------
    >>> import stackbounce as sb
    >>> drops = {name: sb.Drop([sb.Ball(1.0)], [sb.Rigid(0.8)], height=height)
    ...     for name, height in (("low", 0.5), ("high", 1.0))}
    >>> data = {name: {"rebound_ratios.0": "0.8 ± 0.1"} for name in drops}
    >>> find_number(sb.fit(drops, data, ["contacts.0.restitution"])).path
    'height'
    """
    objective = fit.objective
    drops = [fit.drops[key] for key in objective.measured]
    known = [numbers_of(drop) for drop in drops]
    if any(own.keys() != known[0].keys() for own in known) or fit.records:
        return None
    values = {number: {value_in(drop, number) for drop in drops} for number in known[0].values()}
    differ = [number for number, different in values.items() if len(different) > 1]
    own = any(objective.own(key) for key in objective.drops)
    return differ[0] if len(differ) == 1 and not own else None


def list_quantities(fit: Any) -> list[str]:
    """Return the names of the measured quantities of a fit, each once.

    Examples
    --------
    >>> import stackbounce as sb
    >>> drop = sb.Drop([sb.Ball(1.0)], [sb.Rigid(0.8)], height=1.0)
    >>> data = {"rebound_ratios.0": "0.8 ± 0.1"}
    >>> list_quantities(sb.fit(drop, data, ["contacts.0.restitution"]))
    ['rebound_ratios']
    """
    data = (datum for own in fit.objective.measured.values() for datum in own.data)
    return list(dict.fromkeys(datum.quantity for datum in data))


def draw_panels(figure: Figure | SubFigure, fits: Mapping[str, Any], number: Number) -> None:
    """Draw fits as `draw_by_number` does into panels of a figure, a pair for each quantity."""
    count = len(list_quantities(next(iter(fits.values()))))
    look: Any = {"sharex": "col", "height_ratios": _RATIOS, "squeeze": False}
    draw_by_number(figure.subplots(2, count, **look).T.tolist(), fits, number)


def draw_into(axes: Any, fits: Mapping[str, Any], number: Number) -> Figure:
    """Draw fits as `draw_by_number` does into one's own axes, and return their figure.

    Raises
    ------
    InvalidValue
        If there are not one or two axes for each measured quantity.
    """
    count = len(list_quantities(next(iter(fits.values()))))
    figure, own = list_axes(axes, count, 2 * count)
    draw_by_number([own[k::count] for k in range(count)], fits, number)
    return figure


def draw_by_number(
    panels: Sequence[Sequence[Axes]], fits: Mapping[str, Any], number: Number
) -> None:
    """Draw each measured quantity in a pair of panels: the data with curves, and the pulls.

    Parameters
    ----------
    panels : sequence of pairs of matplotlib.axes.Axes
        A pair for each of `list_quantities`; of a pair with one axes only the data are drawn.
    fits : mapping of str to Fit
        By the names of their models, the best first. The band is one standard deviation of the
        first.
    number : Number
        The number in which the drops differ.
    """
    first = next(iter(fits.values()))
    drops = (first.drops[key] for key in first.objective.measured)
    values = spread_over(np.array([value_in(drop, number) for drop in drops]))
    curves = {name: fit.along(number, values) for name, fit in fits.items()}
    for quantity, (above, *below) in zip(list_quantities(first), panels, strict=True):
        measured = [_data(fit, quantity, number) for fit in fits.values()]
        groups = []
        for part, (at, data, errors, _) in measured[0].items():
            name = _part_name(first, quantity, part)
            own: list[Curve] = []
            for model, (tables, deviations) in curves.items():
                curve, band = tables[quantity][:, part], deviations[quantity][:, part]
                sides = None if own else (curve - band, curve + band)
                own.append(Curve(model or name, values, curve, sides))
            pulls = [other[part][3] for other in measured]
            groups.append((Points(name, at, data, errors, pulls), own))
        draw_fitted(above, below[0] if below else None, groups)
        words = quantity.replace("_", " ").removesuffix("s")
        unit, _ = show_in_handy_unit(above.yaxis, above.get_yticks(), QUANTITIES[quantity].unit)
        above.set_ylabel(f"{words} ({unit})" if unit else words)
        name = {"": number.words, "gaps": "gap"}.get(number.part, number.path)
        label((above, *below)[-1], "x", name, Scale(values, False, number.unit))


def _data(fit: Any, quantity: str, number: Number) -> dict[int, Array]:
    """Return (4, n) numbers of each ball or contact: place, measured value, its error, and pull."""
    found: dict[int, list[tuple[float, ...]]] = {}
    rows = iter(fit.residuals)
    for key, measured in fit.objective.measured.items():
        at = value_in(fit.drops[key], number)
        for datum, row in zip(measured.data, rows, strict=False):
            if datum.quantity == quantity:
                found.setdefault(datum.index, []).append((at, row.measured, row.error, row.pull))
    return {part: np.array(own).T for part, own in sorted(found.items())}


def _part_name(fit: Any, quantity: str, index: int) -> str:
    """Return the name of a ball, counted from 1 if it has none, or of the contact below it."""
    drop = next(iter(fit.drops.values()))
    if QUANTITIES[quantity].part == "contact":
        return f"contact {index + 1}"
    return written(drop.balls[index].name or f"ball {index + 1}")
