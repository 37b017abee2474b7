"""The plot of the floor force under two balls, and under the lower ball alone."""

from typing import TYPE_CHECKING, Any

import numpy as np

from stackbounce.plots.style import COLORS, FORCES, WIDTH, panels

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def draw(data: Any, found: Any, axes: Any = None) -> "Figure":  # noqa: ARG001
    """Draw both forces, below them their difference, and the time of the second ball's touch.

    Parameters
    ----------
    data : object
        Not used.
    found : FloorGap
        The result of the analysis.
    axes : matplotlib.axes.Axes or sequence of them, optional
        Where to draw; by default in a new figure.

    Returns
    -------
    matplotlib.figure.Figure
        Not shown and not saved.
    """
    kink, stack, alone = found.kink, found.stack, found.alone
    touch, lasting = (stack.contacts[0].start, alone.contacts[0].time)
    since = stack.times - touch.nominal_value
    own = alone.times - alone.contacts[0].start.nominal_value + kink.shift
    last = stack.contacts[0].end
    end = max(1.3 * lasting.nominal_value, 0.0 if last is None else (last - touch).nominal_value)
    seen = (since > -0.2 * lasting.nominal_value) & (since < 1.15 * end)
    ms, force = 1e3 * since[seen], stack.force[seen]
    like = kink.gain * np.interp(since[seen], own, alone.force, left=np.nan, right=np.nan)
    with panels((WIDTH, 5.8), axes, [3, 2]) as (figure, (above, below)):
        above.plot(ms, force, color=COLORS[0], linewidth=1.3, label="both balls")
        above.plot(ms, like, color=COLORS[1], linewidth=1.3, label="lower ball alone, as high")
        below.plot(ms, force - like, color=COLORS[2], linewidth=1.1)
        below.axhspan(-stack.noise, stack.noise, color="#bdbdbd", alpha=0.45, linewidth=0)
        title = f"gap between the balls: {found.rows()[0].value} m"
        if found.delay is not None:
            middle, wide = 1e3 * found.delay.nominal_value, 1e3 * found.delay.std_dev
            for axes in (above, below):
                axes.axvspan(middle - wide, middle + wide, color=COLORS[3], alpha=0.25, linewidth=0)
                axes.axvline(middle, color=COLORS[3], linewidth=1.2)
            title = (
                f"the balls touch {1e3 * found.delay:.1uS} ms after the floor: "
                f"a gap of {1e3 * found.gap:.1uS} mm"
            )
        above.set_title(title, loc="left", fontsize=10)
        above.set_ylabel(FORCES.get(stack.unit, "signal"))
        below.set_ylabel("difference")
        below.set_xlabel("time since the touch (ms)")
        above.legend(frameon=False, loc="upper right")
    return figure
