"""Measurements that have not been made, as draws of the posterior predict them.

A prediction is an array (designs, n, numbers) with errors of the same shape. A measurement may have
several designs, such as several gaps, of which one is made.
"""

from collections.abc import Callable, Mapping
from typing import NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from stackbounce.model import Drop
from stackbounce.run.driver import simulate
from stackbounce.sweeps import sweep
from studies.table2 import inputs
from studies.table2.ratio_tables import (
    fall_gaps,
    make_drop,
    make_rows,
    over,
    run_rows,
    set_floor,
    spread_nodes,
    weigh,
)

__all__ = ["MEASUREMENTS", "Measurement", "Outcome", "Sample", "measure_loops"]

Array: TypeAlias = NDArray[np.float64]

_RTOL = 1e-6
_HEIGHTS = (0.05, inputs.HEIGHT, 0.80)  # m
_ALONE = 0.01  # error of the restitution of a ball alone, or of two balls
_LOOP = (0.03, 0.02, 0.02)  # errors of the numbers of `measure_loops`, the first one relative
_GAPS = (1e-3, 2e-3, 3e-3, 4e-3, 5e-3)  # m
_DELAYS = (1e-3, 2e-3, 3e-3, 4e-3, 5e-3)  # s
_FILMED, _TIMED = 0.1e-3, 0.1e-3  # errors in m, of a gap, and in s, of a delay
_WANDER = 0.01  # of a restitution from bounce to bounce
_NODES = 8
_OWN_PAIR = {"B1": "B1_on_B1", "B2": "B1_on_B2", "B3": "B1_on_B3"}  # with the ball below


class Sample(NamedTuple):
    """Equally probable draws (n,) of one model's posterior.

    `values` are the shared numbers, `extra` the extra errors of ratios, `reading` numbers the
    readings of Table I, and `normal` has (n, 5) standard normal numbers for what differs from
    bounce to bounce.
    """

    name: str
    values: dict[str, Array]
    extra: Array
    reading: NDArray[np.int64]
    normal: Array


class Outcome(NamedTuple):
    """Predictions and errors, both (designs, n, numbers)."""

    values: Array
    errors: Array


class Measurement(NamedTuple):
    """A measurement: what is measured, how well, what it takes, its designs, and predictions."""

    what: str
    precision: str
    cost: str
    designs: tuple[str, ...]
    predict: Callable[[Sample], Outcome]


def _alone(ball: str, *heights: float) -> Callable[[Sample], Outcome]:
    """Return the prediction of a ball's restitutions after falls from heights in m."""

    def predict(sample: Sample) -> Outcome:
        found = [_bounce(sample.name, ball, sample.values, height) for height in heights]
        return _plain(np.stack(found, axis=-1), _ALONE)

    return predict


def _plain(values: Array, error: float) -> Outcome:
    return Outcome(values[None], np.full((1, *values.shape), error))


def _bounce(name: str, ball: str, values: Mapping[str, Array], height: float) -> Array:
    """Return the restitutions (n,) of a ball alone after a fall from a height in m."""
    pair = _OWN_PAIR[ball]
    drop = make_drop(name, pair)
    rows = {
        path: over(array, "trial")
        for path, array in make_rows(name, pair, values).items()
        if path.startswith("contacts.0.")
    }
    found = sweep(Drop(drop.balls[:1], drop.contacts[:1], height=height), rows, rtol=_RTOL)
    return np.asarray(found["rebound_ratio"].isel(ball=0))


def _meet(sample: Sample) -> Outcome:
    """Predict the restitution of two balls B1 that meet at 2 m/s."""
    drop = make_drop(sample.name, "B1_on_B1")
    rows = {
        path: over(array, "trial")
        for path, array in make_rows(sample.name, "B1_on_B1", sample.values).items()
        if path.startswith("contacts.1.")
    }
    own = Drop(drop.balls, [None, drop.contacts[1]], velocities=[2.0, 0.0])
    ratio = sweep(own, rows, rtol=_RTOL)["rebound_ratio"]
    values = np.asarray(ratio.isel(ball=1) - ratio.isel(ball=0))
    return _plain(values[:, None], _ALONE)


def _press(sample: Sample) -> Outcome:
    """Predict the dynamic force-compression loop of B1 at 20 cm."""
    span = float(sample.values["e_B1"].min()) - 1e-3, float(sample.values["e_B1"].max()) + 1e-3
    nodes = spread_nodes(span, _NODES)
    values = weigh(nodes, span, sample.values["e_B1"]) @ measure_loops(sample.name, nodes)
    errors = np.broadcast_to(_LOOP, values.shape) * np.stack(
        [values[:, 0], np.ones(len(values)), np.ones(len(values))], axis=-1
    )
    return Outcome(values[None], errors[None])


def measure_loops(name: str, restitutions: Array) -> Array:
    """Return three numbers (n, 3) of B1's loop at 20 cm for restitutions (n,).

    The peak force over the mean force of the impact; the time of the peak over the contact time;
    and the share of the energy that is lost.

    Examples
    --------
    A linear spring without loss has π/2, half of the contact time, and nothing:

    >>> measure_loops("H, linear", np.array([0.9999]))[0].round(2)
    array([1.57, 0.5 , 0.  ])
    """
    ball = make_drop(name, "B1_on_B1").balls[:1]
    found = []
    for floor, e in zip(set_floor(name, "B1_on_B1", restitutions), restitutions, strict=True):
        result = simulate(Drop(ball, [floor], height=inputs.HEIGHT), rtol=1e-8)
        row = result.intervals[0]
        duration = float(row["end"] - row["start"])
        times = np.linspace(0.0, duration, 4001)
        force = np.asarray(result.sample(times)["force"].isel(contact=0))
        mean = float(row["impulse"]) / duration
        peak = float(times[np.argmax(force)]) / duration
        found.append((float(row["peak_force"]) / mean, peak, 1.0 - float(e) ** 2))
    return np.array(found)


def _film(*pairs: str) -> Callable[[Sample], Outcome]:
    """Return the prediction of the ratios of pairs whose gap is filmed in the same drop."""

    def predict(sample: Sample) -> Outcome:
        gaps = np.maximum(np.array(_GAPS) + _FILMED * sample.normal[:, :1], 0.0)
        return _ratios(sample, pairs, gaps)

    return predict


def _time(*pairs: str) -> Callable[[Sample], Outcome]:
    """Return the prediction of the ratios of pairs whose delay is recorded in the same drop."""

    def predict(sample: Sample) -> Outcome:
        delays = np.array(_DELAYS) + _TIMED * sample.normal[:, :1]
        return _ratios(sample, pairs, delays, timed=True)

    return predict


def _ratios(sample: Sample, pairs: tuple[str, ...], at: Array, *, timed: bool = False) -> Outcome:
    """Return the ratios of pairs, each ± 0.02 and the extra error, at gaps or delays (n, d)."""
    values = dict(sample.values)
    for k, ball in enumerate(inputs.PRINTED):
        moved = values[f"e_{ball}"] + _WANDER * sample.normal[:, 1 + k]
        values[f"e_{ball}"] = np.minimum(moved, 0.998)
    columns = []
    for pair in pairs:
        gaps = fall_gaps(sample.name, pair, values, at) if timed else at
        found = run_rows(sample.name, pair, values, gaps, gravity=True)
        columns.append(np.moveaxis(found, 1, 0))
    whole = np.concatenate(columns, axis=-1)
    error = np.hypot(inputs.ERROR, sample.extra)
    return Outcome(whole, np.broadcast_to(error[:, None], whole.shape))


_MM = tuple(f"{1e3 * gap:.0f} mm" for gap in _GAPS)
_MS = tuple(f"{1e3 * delay:.0f} ms" for delay in _DELAYS)
_EXACT = "restitution ± 0.01"
_LOOPED = "peak force ± 3 %, its time ± 2 % of the contact, loss ± 0.02"
_FILM = "gap ± 0.1 mm, ratios ± 0.02"
_RECORD = "delay ± 0.1 ms, ratios ± 0.02"
_RULER = "minutes; a ruler and a phone"
_CAMERA = "an hour; a camera of 1000 frames/s, or a phone's slow motion close by"
_PLATE = "an afternoon; a force plate or two copper strips, and a camera"

MEASUREMENTS: tuple[Measurement, ...] = (
    Measurement("B1 alone from 5 cm", _EXACT, _RULER, ("",), _alone("B1", 0.05)),
    Measurement("B1 alone from 20 cm", _EXACT, _RULER, ("",), _alone("B1", inputs.HEIGHT)),
    Measurement("B1 alone from 80 cm", _EXACT, _RULER, ("",), _alone("B1", 0.80)),
    Measurement("B1 alone from 5, 20 and 80 cm", _EXACT, _RULER, ("",), _alone("B1", *_HEIGHTS)),
    Measurement("B2 alone from 5, 20 and 80 cm", _EXACT, _RULER, ("",), _alone("B2", *_HEIGHTS)),
    Measurement("B3 alone from 5, 20 and 80 cm", _EXACT, _RULER, ("",), _alone("B3", *_HEIGHTS)),
    Measurement(
        "dynamic force-compression loop of B1, 20 cm",
        _LOOPED,
        "a day; a force plate of 20 kHz and a displacement sensor",
        ("",),
        _press,
    ),
    Measurement(
        "two balls B1 as pendulums, closing at 2 m/s",
        _EXACT,
        "an hour; threads and a phone",
        ("",),
        _meet,
    ),
    Measurement("B2 on B1, gap filmed", _FILM, _CAMERA, _MM, _film("B2_on_B1")),
    Measurement("B1 on B2, gap filmed", _FILM, _CAMERA, _MM, _film("B1_on_B2")),
    Measurement("B1 on B3, gap filmed", _FILM, _CAMERA, _MM, _film("B1_on_B3")),
    Measurement(
        "B1 on B2 and B1 on B3, gaps filmed", _FILM, _CAMERA, _MM, _film("B1_on_B2", "B1_on_B3")
    ),
    Measurement("B1 on B2, delay of the same drop", _RECORD, _PLATE, _MS, _time("B1_on_B2")),
    Measurement("B1 on B3, delay of the same drop", _RECORD, _PLATE, _MS, _time("B1_on_B3")),
)
"""The candidates; predictions of gaps and delays have one design for each of 1 to 5 mm or ms."""
