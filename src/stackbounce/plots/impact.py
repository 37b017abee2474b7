"""The plot of one run in its time window: positions of balls, forces or impulses of contacts."""

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from stackbounce.library_types import Axes, Figure
from stackbounce.model.drawing import meetings, names_of
from stackbounce.plots.style import WIDTH, check_kind, color_of, into_axes, panels, written
from stackbounce.run.quantities import Array
from stackbounce.run.result import STOPPED, Result

if TYPE_CHECKING:
    from stackbounce.prediction import Prediction

_BEFORE, _AFTER = 0.15, 0.35  # margins, over the duration of the impact
_INSTANT = 0.010  # s: used as the duration of an instantaneous impact
_SAMPLES = 1200


def choose_window(result: Result) -> tuple[float, float]:
    """Return the start and the end of the plot's time window in s; the first touch is at 0.

    Examples
    --------
    >>> import stackbounce as sb
    >>> drop = sb.Drop([sb.Ball(0.057)], [sb.Spring(22500.0)], impact_speed=3.5)
    >>> [round(1e3 * time, 2) for time in choose_window(sb.simulate(drop))]
    [-0.75, 6.75]
    """
    ends = result.intervals["end"]
    last = float(max([0.0, *ends[np.isfinite(ends)], result.end_time]))
    span = last if last > 0.0 else _INSTANT
    return -_BEFORE * span, last if result.status in STOPPED else last + _AFTER * span


def sample_with_approach(result: Result, times: Array) -> dict[str, Array]:
    """Return `Result.sampled` at given times, extended to times before the first touch.

    Examples
    --------
    >>> import numpy as np
    >>> import stackbounce as sb
    >>> drop = sb.Drop([sb.Ball(0.057)], [sb.Spring(22500.0)], impact_speed=3.5)
    >>> sample_with_approach(sb.simulate(drop), np.array([-1e-3]))["position"]
    array([[0.0035]])
    """
    drop = result.drop
    sample = result.sampled(np.maximum(times, 0.0))
    early = np.minimum(times, 0.0)
    fallen = np.array(drop.start_velocities)[:, None] * early - 0.5 * drop.gravity * early**2
    sample["position"] += fallen
    sample["velocity"] -= drop.gravity * early
    sample["compression"] -= np.diff(fallen, axis=0, prepend=0.0)
    sample["force"] *= times >= 0.0
    return sample | {"time": times}


@into_axes
def bounce(result: "Result | Prediction", *, axes: Any = None) -> Figure:
    """Draw the impact: the position of each ball and the force at each contact against time.

    Parameters
    ----------
    result : Result or Prediction
        What to draw. A rigid stack has no finite forces: its impulses are drawn instead. The curves
        of a prediction have bands of one standard deviation.
    axes : pair of matplotlib.axes.Axes, optional
        Where to draw the positions and the forces; by default in a new figure.

    Returns
    -------
    matplotlib.figure.Figure, or `axes` if given
        Not shown and not saved: ``figure.savefig("bounce.svg")`` does.

    Raises
    ------
    InvalidType
        If `result` is neither.
    InvalidValue
        If `axes` are not two.

    Examples
    --------
    >>> import stackbounce as sb
    >>> from stackbounce import plots
    >>> drop = sb.Drop(
    ...     balls=[sb.Ball(0.150, name="basketball"), sb.Ball(0.057, name="tennis ball")],
    ...     contacts=[sb.Spring(2500.0), sb.Spring(1000.0)],
    ...     impact_speed=3.53,
    ... )
    >>> figure = plots.bounce(sb.simulate(drop))
    >>> [axes.get_ylabel() for axes in figure.axes]
    ['position (mm)', 'force (N)']
    """
    prediction: Prediction | None = None
    if not isinstance(result, Result):
        check_kind(result, "result", "Result", "Prediction")
        prediction, result = result, result.result
    with panels((WIDTH, 5.6), axes, [3, 2]) as (figure, (above, below)):
        times = np.linspace(*choose_window(result), _SAMPLES)
        sample = sample_with_approach(result, times)
        _draw_positions(above, result, times, sample["position"])
        _draw_contacts(below, result, times, sample["force"])
        if prediction is not None:
            _draw_bands(above, prediction, times, "position", 1e3)
            if not result.drop.rigid:
                _draw_bands(below, prediction, times, "force", 1.0)
        floor = result.drop.contacts[0] is not None
        below.set_xlabel("time" + floor * " since the lowest ball touched the floor" + " (ms)")
        below.set_xlim(1e3 * times[0], 1e3 * times[-1])
    return figure


def _draw_positions(axes: Axes, result: Result, times: Array, paths: Array) -> None:
    """Draw the position of each ball against time, extended to times before the first touch."""
    for b, (ball, path) in enumerate(zip(names_of(result.drop.balls), paths, strict=True)):
        name = f"{written(ball)}: {result.rebound_ratios[b]:.3g} v₀"
        axes.plot(1e3 * times, 1e3 * path, color=color_of(b), label=name)
    axes.legend(frameon=False, loc="best", reverse=True)
    axes.set_ylabel("position (mm)")
    axes.axhline(0.0, color="#808080", linewidth=0.8)
    words = f"v₀ = {result.drop.reference_speed:.3g} m/s"
    if math.isfinite(result.energy_retained):
        words += f", kinetic energy retained {100.0 * result.energy_retained:.0f} %"
    axes.set_title(words, loc="left", fontsize=10)


def _draw_bands(
    axes: Axes, prediction: "Prediction", times: Array, name: str, factor: float
) -> None:
    """Draw one standard deviation on both sides of each curve, from the first touch on."""
    after = times[times >= 0.0]
    for k, (low, high) in enumerate(zip(*prediction.band(after, name), strict=True)):
        if prediction.drop.contacts[k] is not None or name == "position":
            look: Any = {"color": color_of(k), "alpha": 0.3, "linewidth": 0}
            axes.fill_between(1e3 * after, factor * low, factor * high, **look)


def _draw_contacts(axes: Axes, result: Result, times: Array, forces: Array) -> None:
    """Draw the force at each contact, or each impulse of a rigid stack as a stem."""
    for i, name in enumerate(map(written, meetings(result.drop.balls))):
        law, color = result.drop.contacts[i], color_of(i)
        if law is None:
            continue
        if law.rigid:
            rows = result.intervals[result.intervals["contact"] == i]
            name += f" ({_count(int(result.collisions[i]))})"
            wide = 3.0 if i == 0 else 1.6
            starts = 1e3 * rows["start"]
            axes.vlines(starts, 0.0, rows["impulse"], color=color, linewidth=wide, label=name)
        else:
            axes.plot(1e3 * times, forces[i], color=color, label=name)
            axes.fill_between(1e3 * times, forces[i], color=color, alpha=0.12, linewidth=0)
    axes.set_ylabel("impulse (N s)" if result.drop.rigid else "force (N)")
    axes.set_ylim(bottom=0.0)
    axes.legend(frameon=False, loc="upper right")


def _count(collisions: int) -> str:
    if collisions < 0:
        return "infinitely many"
    return "once" if collisions == 1 else f"{collisions} times"
