"""The plot of a force record, and of the contacts, flanks and peaks found in it."""

from typing import Any

from stackbounce.library_types import Axes, Figure
from stackbounce.plots.style import COLORS, WIDTH, annotate, file_of, panels

_RECORD, _SHADE, _FLANK, _PEAK = "#4d4d4d", COLORS[0], COLORS[1], COLORS[2]
_LABELS = {"N": "force (N)", "V": "signal (V)"}  # labels, by the unit of the record
_TINY = 0.03  # of the whole extent: a contact too narrow to be seen
_MOST = 6  # contacts that are labelled one by one
_BESIDE = 0.6  # of all contacts' extent, shown on each side
_DOTS = 160  # samples within the picture, up to which each gets a dot
_MANY = 5000  # beyond, the line is drawn in pixels, also in a vector graphic


def draw(data: Any, found: Any, axes: Any = None) -> Figure:
    """Draw a force record, its baseline, its contacts with their flanks, and its peaks.

    Parameters
    ----------
    data : xarray.Dataset or (array_like, array_like)
        The record, as given to `waveform`; the name of its file is in the title.
    found : Waveform
        The result of the analysis.
    axes : matplotlib.axes.Axes or sequence of them, optional
        Where to draw; by default in a new figure.

    Returns
    -------
    matplotlib.figure.Figure
        Not shown and not saved. The time axis extends a little beyond the contacts. Forces are
        drawn as analysed: contacts upward, baseline subtracted, sensor droop corrected.

    Examples
    --------
    >>> import numpy as np
    >>> import xarray as xr
    >>> from stackbounce.measure.kinds.waveform.analysis import waveform
    >>> times = np.arange(-2e-3, 6e-3, 1e-5)  # s
    >>> force = 155.0 * np.sin(np.pi * np.clip(times / 4e-3, 0.0, 1.0))
    >>> noise = np.random.default_rng(1).normal(0.0, 1.0, len(times))
    >>> record = xr.Dataset({"force": ("time", force + noise, {"units": "N"})}, {"time": times})
    >>> draw(record, waveform(record)).axes[0].get_ylabel()
    'force (N)'
    """
    low, high = _extent(found, found.contacts)
    first = next((contact for contact in found.contacts if contact.time is not None), None)
    tiny = first is not None and first.time.nominal_value < _TINY * (high - low)
    size, ratios = (WIDTH, 6.4 if tiny else 4.2), [1.0] * (1 + tiny)
    with panels(size, axes, ratios, sharex=False) as (figure, own):
        _draw_panel(own[0], found, found.contacts, (low, high), named=not tiny)
        if tiny:
            own[1].set_title("the first contact", loc="left", fontsize=10)
            _draw_panel(own[1], found, [first], _extent(found, [first]), named=True)
        count, source = len(found.contacts), file_of(data)
        words = f"{count or 'no'} contact{'s' * (count != 1)}"
        own[0].set_title(f"{source}: {words}" if source else words, loc="left", fontsize=10)
        names = [panel.get_legend_handles_labels() for panel in own]
        known = {label: mark for marks in names for mark, label in zip(*marks, strict=True)}
        place: Any = {"loc": "lower right", "bbox_to_anchor": (1.0, 1.0), "ncols": 4}
        look: Any = {"frameon": False, "borderpad": 0.0, "handlelength": 1.4, "fontsize": 9}
        own[-1].legend(known.values(), known.keys(), columnspacing=1.2, **place, **look)
    return figure


def _draw_panel(
    axes: Axes, found: Any, contacts: Any, extent: tuple[float, float], *, named: bool
) -> None:
    """Draw a stretch of the record and the contacts in it."""
    low, high = extent
    factor, unit = (1e3, "ms") if high - low < 1.0 else (1.0, "s")
    _draw_record(axes, found, low, high, factor)
    for contact in contacts:
        _draw_contact(axes, found, contact, factor, flanks=named)
    top = max((contact.peak_force.nominal_value for contact in contacts), default=0.0)
    if top > 0.0:
        inside = (found.times >= low) & (found.times <= high)
        least = min(float(found.force[inside].min()), -0.04 * top)
        few = len(contacts) <= _MOST
        axes.set_ylim(1.15 * least, (1.22 if few else 1.08) * top)
        if few:
            _label_contacts(axes, contacts, factor)
    axes.set(xlim=(factor * low, factor * high), xlabel=f"time ({unit})")
    axes.set_ylabel(_LABELS.get(found.unit, "signal") + ("" if found.sign > 0 else ", turned over"))


def _extent(found: Any, contacts: Any) -> tuple[float, float]:
    """Return the range of the time axis in s: the contacts with a margin on both sides."""
    first, last = float(found.times[0]), float(found.times[-1])
    if not contacts:
        return first, last
    start, end = contacts[0].start, contacts[-1].end
    low = first if start is None else start.nominal_value
    high = last if end is None else end.nominal_value
    beside = _BESIDE * (high - low) / (1 + len(contacts) // 2)
    return max(first, low - beside), min(last, high + beside)


def _draw_record(axes: Axes, found: Any, low: float, high: float, factor: float) -> None:
    """Draw the samples: as dots if they are few, else as a line, of pixels if they are many."""
    inside = (found.times >= low) & (found.times <= high)
    times, force = factor * found.times[inside], found.force[inside]
    noise: Any = {"color": "#bdbdbd", "alpha": 0.45, "lw": 0, "label": "baseline ± noise"}
    axes.axhspan(-found.noise, found.noise, **noise)
    axes.axhline(0.0, color="#808080", linewidth=0.8)
    look: Any = {"color": _RECORD, "label": "record", "markersize": 3.2, "linewidth": 0.9}
    style = "o" if len(times) <= _DOTS else "-"
    axes.plot(times, force, style, rasterized=len(times) > _MANY, **look)


def _draw_contact(axes: Axes, found: Any, contact: Any, factor: float, *, flanks: bool) -> None:
    """Shade a contact, draw the fits of its flanks, mark its peaks."""
    start = found.times[0] if contact.start is None else contact.start.nominal_value
    end = found.times[-1] if contact.end is None else contact.end.nominal_value
    axes.axvspan(factor * start, factor * end, color=_SHADE, alpha=0.10, linewidth=0)
    for edge in (contact.start, contact.end):
        if edge is not None:
            axes.axvline(factor * edge.nominal_value, color=_SHADE, linewidth=0.8, alpha=0.7)
    for flank in contact.flanks if flanks else ():
        if flank is not None:
            look: Any = {"color": _FLANK, "linewidth": 2.4, "label": "flanks, fitted"}
            axes.plot(factor * flank.times, flank.force, **look)
    times = [factor * time.nominal_value for time, _ in contact.peaks]
    heights = [force.nominal_value for _, force in contact.peaks]
    mark: Any = {"color": _PEAK, "markersize": 7, "markeredgecolor": "white", "zorder": 4}
    axes.plot(times, heights, "v", label="peaks", **mark)


def _label_contacts(axes: Axes, contacts: Any, factor: float) -> None:
    """Write the contact time above each contact, on two lines in turn."""
    whole = [contact for contact in contacts if contact.time is not None]
    for k, contact in enumerate(whole):
        middle = factor * 0.5 * (contact.start.nominal_value + contact.end.nominal_value)
        box: Any = {"facecolor": "white", "alpha": 0.7, "edgecolor": "none", "pad": 0.5}
        place: Any = {"xytext": (0, -4 - 12 * (k % 2)), "textcoords": "offset points"}
        top: Any = {"xycoords": axes.get_xaxis_transform(), "ha": "center", "va": "top"}
        text = f"{contact.time * 1e3:.1uS} ms"
        annotate(axes, text, (middle, 1.0), _SHADE, bbox=box, **place, **top)
