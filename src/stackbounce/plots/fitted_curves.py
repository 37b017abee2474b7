"""Measured points with the curves of fits above, and how far they are apart below."""

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from stackbounce.library_types import Axes
from stackbounce.plots.style import COLORS, written
from stackbounce.run.quantities import Array

_POINTS = 80  # of a curve
_BEYOND = 0.04  # of the range of the points: a curve goes on beyond them
_ROOM = 0.25  # of the range of points and bands, left above and below them
_MARKERS = ("o", "s", "^", "D", "v", "P")
_STYLES = ("-", "--", "-.", ":")


class Points(NamedTuple):
    """Points of one thing that was measured, and their pulls from each curve, in errors."""

    name: str
    places: Array
    values: Array
    errors: Array
    pulls: list[Array]


class Curve(NamedTuple):
    """What a fit predicts of one thing, with a band of one standard deviation or without."""

    name: str
    places: Array
    values: Array
    band: tuple[Array, Array] | None = None


def spread_over(places: Array) -> Array:
    """Return the places of a curve, which goes a little beyond those of points.

    Examples
    --------
    >>> spread_over(np.array([1.0, 2.0]))[[0, -1]]
    array([0.96, 2.04])
    """
    beyond = _BEYOND * np.ptp(places)
    return np.linspace(max(0.0, places.min() - beyond), places.max() + beyond, _POINTS)


def draw_fitted(
    above: Axes, below: Axes | None, groups: Sequence[tuple[Points, Sequence[Curve]]]
) -> None:
    """Draw groups of points with the curves of each, the best one first.

    Curves have their own colors if they are several of a group, else those of the groups. A name
    is written in the legend once. Points and bands set the range, not a bad curve.
    """
    several = any(len(curves) > 1 for _, curves in groups)
    seen: set[str] = set()
    places: list[Any] = []
    for k, (points, curves) in enumerate(groups):
        color, marker = COLORS[k % len(COLORS)], _MARKERS[k % len(_MARKERS)]
        look: Any = {"color": "black" if several else color, "markersize": 4.5, "zorder": 4}
        look |= {"capsize": 2.0, "label": _once(points.name, seen)}
        above.errorbar(points.places, points.values, points.errors, fmt=marker, **look)
        places += [points.values - points.errors, points.values + points.errors]
        for j, (curve, pulls) in enumerate(zip(curves, points.pulls, strict=True)):
            own: Any = {"color": COLORS[j % len(COLORS)] if several else color}
            name, style = _once(curve.name, seen), _STYLES[j % len(_STYLES)]
            above.plot(curve.places, curve.values, style, label=name, **own)
            if curve.band is not None:
                above.fill_between(curve.places, *curve.band, alpha=0.18, linewidth=0, **own)
                places += curve.band
            if below is not None:
                below.plot(points.places, pulls, marker, markersize=4.5, **own)
    ends = np.concatenate(places)
    low, high = float(np.min(ends)), float(np.max(ends))
    above.set_ylim(low - _ROOM * (high - low), high + _ROOM * (high - low))
    if len(seen) > 1:
        above.legend(frameon=False, fontsize=8.5, loc="best")
    if below is not None:
        below.axhspan(-1.0, 1.0, color=COLORS[0], alpha=0.12, linewidth=0)
        below.axhline(0.0, color="#808080", linewidth=0.8)
        below.set_ylabel("fitted − measured\n(errors)")


def _once(name: str, seen: set[str]) -> str:
    """Return a name for the legend; empty if it is there already."""
    if name in seen:
        return ""
    seen.add(name)
    return written(name)
