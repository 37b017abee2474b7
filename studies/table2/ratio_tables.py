"""Tables of the rebound ratios of a pair, over shared numbers of the balls and over delays.

A table holds drops of one pair by one model at all combinations of Chebyshev nodes of the shared
numbers and at equally spaced delays between the two touches. Polynomials through the nodes then
give the ratios for any numbers within the table's ranges.
"""

from collections.abc import Mapping
from dataclasses import replace
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.polynomial import chebyshev
from numpy.typing import NDArray

from stackbounce.cross2007.drops import fallen_speed
from stackbounce.model import STANDARD_GRAVITY, ContactLaw, Drop, Rigid
from stackbounce.run.driver import simulate
from stackbounce.run.result import Status
from stackbounce.sweeps import sweep
from studies.table2 import inputs
from studies.table2.catalogue import THEORIES
from studies.table2.theories import OWN

__all__ = [
    "SEPARATE",
    "RatioTable",
    "Spans",
    "fall_gaps",
    "make_drop",
    "make_drops",
    "make_rows",
    "make_table",
    "over",
    "run_pair",
    "run_rows",
    "set_floor",
    "spread_nodes",
    "weigh",
]

Array: TypeAlias = NDArray[np.float64]
Spans: TypeAlias = Mapping[str, tuple[float, float]]
"""The ranges of the shared numbers: ``e_B1``, ``e_B2``, ``e_B3``, the restitutions at 20 cm;
``e_between``, that of two balls; ``log_stiffer``, the logarithm of the factor on the stiffness
between two balls."""

SEPARATE = "rigid, two"
"""The model with separate collisions, as `catalogue.NAMES` calls it."""

_TOUCHED = 8  # nodes of a floor contact's restitution, for the gaps
_RTOL = 1e-6
_EVENTS = 1000  # of a run; no impact has so many
_FLIGHT = 0.15  # s: a drop that ends later is in its next bounce
_COARSE = 4  # every fourth delay is run with gravity exactly
_SINE = 0.8  # mean speed over the last one, where a spring expands: between 2/pi and 1


class RatioTable(NamedTuple):
    """Ratios of a pair by one model.

    `axes` are the names of the shared numbers, `nodes` their values, `delays` (d,) are in s, and
    `ratios` have the shape (nodes of each axis..., d, 2).
    """

    axes: tuple[str, ...]
    spans: Spans
    nodes: tuple[Array, ...]
    delays: Array
    ratios: Array

    def weights(self, values: Mapping[str, Array]) -> Array:
        """Return (n, nodes of all axes) weights of the drops for shared numbers (n,)."""
        found = np.ones((len(values[self.axes[0]]), 1))
        for axis, nodes in zip(self.axes, self.nodes, strict=True):
            own = weigh(nodes, self.spans[axis], values[axis])
            found = (found[:, :, None] * own[:, None, :]).reshape(len(own), -1)
        return found


def make_table(
    name: str,
    pair: str,
    delays: Array,
    spans: Spans,
    counts: Mapping[str, int],
    *,
    gravity: bool = False,
) -> RatioTable:
    """Return the table of a pair by a model.

    Parameters
    ----------
    name : str
        `SEPARATE`, or a name of `THEORIES`.
    pair : str
        A name of `inputs.PAIRS`.
    delays : ndarray
        (d,) in s.
    spans, counts : mapping
        The range and the number of nodes of each shared number.
    gravity : bool, optional
        Whether the balls fall during the impact, as `run_pair` has it.

    Examples
    --------
    >>> spans = {"e_B1": (0.8, 0.9), "e_between": (0.8, 0.9), "log_stiffer": (-0.1, 0.1)}
    >>> table = make_table("B", "B2_on_B1", np.array([1e-3, 2e-3]), spans, dict.fromkeys(spans, 2))
    >>> table.axes, table.ratios.shape
    (('e_B1', 'e_between', 'log_stiffer'), (2, 2, 2, 2, 2))
    """
    axes = _axes(name, pair)
    nodes = tuple(spread_nodes(spans[one], counts[one]) for one in axes)
    grid = [one.ravel() for one in np.meshgrid(*nodes, indexing="ij")]
    middle = {one: 0.5 * sum(spans[one]) for one in axes}
    values = dict(zip(axes, grid, strict=True))
    found = run_pair(name, pair, values, delays, gravity=middle if gravity else None)
    return RatioTable(axes, spans, nodes, delays, found.reshape(*map(len, nodes), *found.shape[1:]))


def _axes(name: str, pair: str) -> tuple[str, ...]:
    """Return the names of the shared numbers on which a pair depends."""
    lower, upper = (f"e_{ball}" for ball in inputs.PAIRS[pair])
    if name == SEPARATE:
        return lower, "e_between"
    second = "e_between" if THEORIES[name].where == OWN else upper
    return (lower, "log_stiffer") if second == lower else (lower, second, "log_stiffer")


def spread_nodes(span: tuple[float, float], count: int) -> Array:
    """Return (count,) Chebyshev nodes of a range."""
    low, high = span
    return np.asarray(low + 0.5 * (chebyshev.chebpts1(count) + 1.0) * (high - low))


def weigh(nodes: Array, span: tuple[float, float], x: Array) -> Array:
    """Return (n, nodes) weights, with which values at the nodes give the polynomial at x (n,).

    Examples
    --------
    >>> nodes = spread_nodes((0.0, 1.0), 4)
    >>> weights = weigh(nodes, (0.0, 1.0), np.array([0.3]))
    >>> bool(abs(weights[0] @ nodes**3 - 0.3**3) < 1e-12)
    True
    """
    low, high = span
    count = len(nodes)
    here = chebyshev.chebvander(2.0 * (x - low) / (high - low) - 1.0, count - 1)
    there = chebyshev.chebvander(2.0 * (nodes - low) / (high - low) - 1.0, count - 1)
    return np.asarray(np.linalg.solve(there.T, here.T).T)


def run_pair(
    name: str,
    pair: str,
    values: Mapping[str, Array],
    delays: Array,
    *,
    gravity: Mapping[str, float] | None = None,
) -> Array:
    """Return the ratios (n, d, 2) of drops with shared numbers (n,) at delays (d,) in s.

    Without gravity a ratio is a final speed over the impact speed. With gravity it is the square
    root of a ball's apex over the drop height; `gravity` then has shared numbers near the middle of
    `values`. Separate collisions take no time and are run without gravity in any case.
    """
    gaps = fall_gaps(name, pair, values, delays)
    if name == SEPARATE:  # their outcome depends on no gap
        found = run_rows(name, pair, values, gaps[:, :1])
        return np.asarray(np.broadcast_to(found, (*gaps.shape, 2)))
    if gravity is None:
        return run_rows(name, pair, values, gaps)
    middle = {key: np.array([value]) for key, value in gravity.items()}
    coarse = delays[::_COARSE]
    there = fall_gaps(name, pair, middle, coarse)
    exact = np.array([_apexes(one) for one in make_drops(name, pair, middle, there[0])])
    missed = fill_missing(exact) - run_rows(name, pair, middle, there, gravity=True)[0]
    shift = np.stack([np.interp(delays, coarse, one) for one in missed.T], axis=-1)
    return np.asarray(run_rows(name, pair, values, gaps, gravity=True) + shift)


def make_drops(name: str, pair: str, values: Mapping[str, Array], gaps: Array) -> list[Drop]:
    """Return drops with gravity for gaps (d,) in m, and the first one of the shared numbers."""
    drop, rows = make_drop(name, pair), make_rows(name, pair, values)
    contacts = [_law(drop, rows, i, 0) for i in range(len(drop.contacts))]
    drop = replace(drop, contacts=contacts, gravity=STANDARD_GRAVITY)
    return [replace(drop, gaps=[gap]) for gap in gaps.tolist()]


def _law(drop: Drop, rows: Mapping[str, Array], i: int, k: int) -> ContactLaw:
    """Return a contact with the k-th numbers of the rows."""
    start, law = f"contacts.{i}.", drop.contacts[i]
    assert law is not None  # every drop of the study has a floor
    return law.replaced(
        {
            path.removeprefix(start): float(array[k])
            for path, array in rows.items()
            if path.startswith(start)
        }
    )


def _apexes(drop: Drop) -> Array:
    """Return the square roots (2,) of a drop's apexes over the drop height, exactly."""
    result = simulate(drop, rtol=_RTOL, event_limit=_EVENTS)
    if result.status != Status.FINISHED or max(result.last_release) > _FLIGHT:
        return np.full(2, np.nan)
    last = result.sample(np.array([result.end_time]))
    place, speed = (np.asarray(last[what])[:, 0] for what in ("position", "velocity"))
    apex = place + np.maximum(speed, 0.0) ** 2 / (2.0 * STANDARD_GRAVITY)
    return np.asarray(np.sqrt(np.maximum(apex, 0.0) / inputs.HEIGHT))


def run_rows(
    name: str, pair: str, values: Mapping[str, Array], gaps: Array, *, gravity: bool = False
) -> Array:
    """Return the ratios (n, d, 2) of drops with shared numbers (n,) and gaps (n, d) in m.

    With gravity they are those of the apexes, within about 0.05; see `run_pair`.
    """
    rows = {key: over(array, "trial") for key, array in make_rows(name, pair, values).items()}
    rows["gaps.0"] = over(gaps, "trial", "gap")
    drop = make_drop(name, pair)
    if gravity:
        drop = replace(drop, gravity=STANDARD_GRAVITY)
    found = sweep(drop, rows, rtol=_RTOL, event_limit=_EVENTS).transpose("trial", "gap", ...)
    ratios, released = (np.asarray(found[what]) for what in ("rebound_ratio", "last_release"))
    done = np.asarray(found["status"]) == Status.FINISHED
    if gravity:
        done &= np.max(released, axis=-1) < _FLIGHT
    ratios, released = (np.where(done[..., None], one, np.nan) for one in (ratios, released))
    return fill_missing(_from_speeds(drop, ratios, released) if gravity else ratios)


def fill_missing(ratios: Array) -> Array:
    """Replace ratios (..., d, 2) that are nan by those between the neighbouring delays.

    With gravity a few drops do not end after the impact: at every release a ball approaches the
    floor or the other ball, and the run goes on to the next bounce or until both are at rest.
    """
    found = np.array(ratios)
    for one in found.reshape(-1, *found.shape[-2:]):
        known = np.isfinite(one[:, 0])
        for ball in (0, 1):
            one[~known, ball] = np.interp(
                np.flatnonzero(~known), np.flatnonzero(known), one[known, ball]
            )
    return found


def over(array: Any, *dims: str) -> Any:
    """Return an array with named dimensions, as `sweep` takes it."""
    from xarray import DataArray

    return DataArray(array, dims=dims)


def _from_speeds(drop: Drop, ratios: Array, released: Array) -> Array:
    """Estimate the square roots (..., 2) of apexes over the drop height.

    The sweep has final speeds and the last releases. At the last release from the floor the lower
    ball is at its place of the first touch, and at the last release from each other both balls are
    equally far from it. Of the later release the place follows from the flight or from the mean
    velocity, less a compression that is estimated from the speed of its expansion.
    """
    g, heavy, light = STANDARD_GRAVITY, *(ball.mass for ball in drop.balls)
    lower, upper = np.moveaxis(ratios * fallen_speed(inputs.HEIGHT), -1, 0)
    late = released[..., 0] - released[..., 1]  # of the floor's release after that of the balls
    share = light / (heavy + light)
    squeezed = _SINE * np.abs(late) * np.where(late > 0.0, lower, share * (upper - lower))
    mean = (1.0 - share) * lower + share * upper + 0.5 * g * np.abs(late)
    place = np.where(late > 0.0, 0.0, mean * np.abs(late)) - squeezed  # at the balls' release
    then = upper + g * np.maximum(late, 0.0)
    first = np.where(late > 0.0, 0.0, place) + np.maximum(lower, 0.0) ** 2 / (2.0 * g)
    second = place + np.maximum(then, 0.0) ** 2 / (2.0 * g)
    both = np.stack([first, second], axis=-1)
    return np.asarray(np.sqrt(np.maximum(both, 0.0) / inputs.HEIGHT))


def make_drop(name: str, pair: str) -> Drop:
    """Return a drop with usual numbers, whose contacts those of `make_rows` replace."""
    if name == SEPARATE:
        balls = inputs.make_balls(pair)
        return Drop(balls, [Rigid(0.9), Rigid(0.9)], gaps=[0.0], height=inputs.HEIGHT)
    usual = {"e_B1": 0.88, "e_B2": 0.95, "e_between": 0.9}
    return replace(THEORIES[name], known=usual, vary=()).drop(pair)


def make_rows(name: str, pair: str, values: Mapping[str, Array]) -> dict[str, Array]:
    """Return the numbers (n,) of the contacts by their paths, from the shared numbers (n,)."""
    lower = values[f"e_{inputs.PAIRS[pair][0]}"]
    if name == SEPARATE:
        return {
            "contacts.0.restitution": lower,
            "contacts.1.restitution": values["e_between"],
        }
    theory = THEORIES[name]
    others = {f"e_{ball}": np.full_like(lower, 0.95) for ball in inputs.PRINTED}
    stiffer = {"stiffer": np.exp(values["log_stiffer"])}
    found = theory.contacts(theory.usual | others | stiffer | dict(values))[pair]
    return {
        f"contacts.{i}.{path}": np.broadcast_to(array, lower.shape)
        for i, contact in enumerate(found)
        for path, array in (("stiffness", contact.stiffness), (theory.law.loss, contact.loss))
    }


def fall_gaps(name: str, pair: str, values: Mapping[str, Array], delays: Array) -> Array:
    """Return the gaps (n, d) in m with which the balls meet after the delays (d,) or (n, d) in s.

    Until then the lower ball bounces alone. The gap is what the upper ball has fallen since the
    first touch, less what the lower ball has.
    """
    own = values[f"e_{inputs.PAIRS[pair][0]}"]
    speed = fallen_speed(inputs.HEIGHT)
    if name == SEPARATE:
        return np.asarray(speed * (1.0 + own[:, None]) * delays)
    span = float(own.min()) - 1e-3, float(own.max()) + 1e-3
    nodes = spread_nodes(span, _TOUCHED)
    every, where = np.unique(delays, return_inverse=True)
    ball = make_drop(name, pair).balls[:1]
    fallen = []
    for floor in set_floor(name, pair, nodes):
        alone = simulate(Drop(ball, [floor], height=inputs.HEIGHT), rtol=1e-8)
        fallen.append(-np.asarray(alone.sample(every)["position"].isel(ball=0)))
    table = np.maximum(speed * every - np.array(fallen), 0.0)[:, where.reshape(delays.shape)]
    letters = "nk,kd->nd" if delays.ndim == 1 else "nk,knd->nd"
    return np.asarray(np.maximum(np.einsum(letters, weigh(nodes, span, own), table), 0.0))


def set_floor(name: str, pair: str, restitutions: Array) -> list[ContactLaw]:
    """Return the floor contacts of a pair's lower ball with restitutions (n,) at 20 cm."""
    none = np.zeros_like(restitutions)
    values = {f"e_{inputs.PAIRS[pair][0]}": restitutions}
    rows = make_rows(name, pair, {**values, "log_stiffer": none, "e_between": none + 0.9})
    drop = make_drop(name, pair)
    return [_law(drop, rows, 0, k) for k in range(len(restitutions))]
