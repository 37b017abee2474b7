"""The plot of a sound recording, its detected knocks, and those that were rejected."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from stackbounce.library_types import Axes, Figure
from stackbounce.plots.style import COLORS, WIDTH, panels

_MARGIN = 0.06
_WORDS = {"echo": "echoes", "second sound of one impact": "second sounds of one impact"}
_BLUE, _RED = COLORS[:2]


def draw(data: Any, found: Any, axes: Any = None) -> Figure:
    """Draw a recording with its knocks, and the flights between them.

    Parameters
    ----------
    data : Dataset or array_like
        The recording, as given to `knocks`.
    found : Knocks
        The result of the analysis.
    axes : matplotlib.axes.Axes or sequence of them, optional
        Where to draw; by default in a new figure.

    Returns
    -------
    matplotlib.figure.Figure
        Not shown and not saved.
    """
    with panels((WIDTH, 5.2), axes, [3, 2]) as (figure, (above, below)):
        times = np.array([time.nominal_value for time in found.times])
        _draw_sound(above, data, found, times)
        _draw_flights(below, found, times)
        pad = _MARGIN * max(float(np.ptp(times)), 0.1)
        below.set(xlim=(times[0] - 2.0 * pad, times[-1] + 2.0 * pad), xlabel="time (s)")
    return figure


def _draw_sound(axes: Axes, data: Any, found: Any, times: NDArray[np.float64]) -> None:
    samples, origin = _samples(data)
    pad = 2.0 * _MARGIN * max(float(np.ptp(times)), 0.1)
    first = max(0, int((times[0] - pad - origin) * found.rate))
    last = min(len(samples), int((times[-1] + pad - origin) * found.rate) + 1)
    part = samples[first:last]
    at = origin + np.arange(first, last) / found.rate
    axes.plot(at, part, color="#9a9a9a", linewidth=0.4, rasterized=True)
    top = 1.12 * float(np.abs(part).max() or 1.0)
    above = np.full(len(times), top)
    label = f"{len(times)} knock{'s' * (len(times) != 1)}"
    axes.plot(times, above, "v", color=_BLUE, markersize=6, label=label, clip_on=False)
    axes.vlines(times, -top, top, color=_BLUE, linewidth=0.7, alpha=0.55)
    left = np.array([sound.time for sound in found.dropped])
    left = left[(left > times[0] - pad) & (left < times[-1] + pad)]
    if len(left):
        label = f"{len(left)} left out ({_words(found)})"
        cross: Any = {"color": _RED, "markersize": 5, "markeredgewidth": 1.4, "clip_on": False}
        axes.plot(left, np.full(len(left), top), "x", label=label, **cross)
    axes.set(ylim=(-top, top), ylabel="sound (full scale 1)")
    axes.legend(loc="lower right", frameon=True, framealpha=0.9, edgecolor="none", ncols=2)


def _samples(data: Any) -> tuple[NDArray[np.float64], float]:
    """Return samples, (N,), and the time of the first one."""
    if not hasattr(data, "data_vars"):
        return np.nan_to_num(np.asarray(data, dtype=np.float64)), 0.0
    origin = float(data["time"][0]) if "time" in data.coords else 0.0
    return np.nan_to_num(data["sound"].values.astype(np.float64)), origin


def _words(found: Any) -> str:
    whys = sorted({sound.why for sound in found.dropped})
    return _WORDS.get(whys[0], whys[0]) if len(whys) == 1 else "echoes and other sounds"


def _draw_flights(axes: Axes, found: Any, times: NDArray[np.float64]) -> None:
    flights = np.diff(times)
    missed = np.array(found.missed, dtype=bool)
    middle = 0.5 * (times[1:] + times[:-1])
    for own, color, label in ((~missed, _BLUE, None), (missed, _RED, "a bounce is missing")):
        lengths = 1e3 * flights[own]
        axes.hlines(lengths, times[:-1][own], times[1:][own], color=color, linewidth=2.2)
        axes.plot(middle[own], lengths, "o", color=color, markersize=5, label=label)
    axes.set_ylabel("flight (ms)")
    axes.set_ylim(bottom=0.0)
    if missed.any():
        axes.legend(loc="upper right", frameon=False)
