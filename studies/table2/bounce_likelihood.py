"""The likelihood of each model when all inputs are uncertain and bounces scatter.

Each pair's filmed bounces scatter about a mean delay. The recorded delay is that of one more
bounce, read with its own error. The priors, all independent:

==========================  ====================================================================
mean delay of a pair        the recorded one; error: reading (0.5 ms; 2 ms for two balls B1) and
                            one bounce's scatter, added in squares; within the table's delays
scatter of delays           log-uniform: equal shares of 0.1, 0.3, 0.6, 1.0 and 2.0 ms
restitutions at 20 cm       Table I's column in one of three readings, ± 0.02 of what is printed
their scatter               0.01 from bounce to bounce
restitution of two balls    uniform from 0.7 to 1, in the models that have a number of its own
stiffness of two balls      log-normal, ± 15 % about that of both floor contacts in series
impact speed                ± 2.5 % (drop height ± 1 cm), the same for all ratios
extra error of each ratio   half-normal with scale 0.02, from 0.002 to 0.3; in squares with the
                            printed 0.02
==========================  ====================================================================

Both balls fall during the impact: gravity is a fact. Separate collisions take no time, and need
none. Normal distributions of restitutions and stiffness are cut at three standard deviations.
Table II has means of "three or four" bounces: a mean has the variance of a bounce over 3.5. Choices
between two or three readings of the paper have equal prior shares, and so have the models.
"""

import math
from collections.abc import Callable
from typing import NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from studies.table2 import inputs
from studies.table2.evidence import draw_normal
from studies.table2.ratio_tables import SEPARATE, RatioTable, Spans, make_table
from studies.table2.readings import READINGS
from studies.table2.scatter import Moments, scatter_bounces

__all__ = [
    "CHOICES",
    "EXTRA",
    "MODELS",
    "SCATTER",
    "Draws",
    "Priors",
    "Size",
    "draw_numbers",
    "find_spans",
    "likelihoods",
    "score_pair",
    "tabulate",
    "weigh_draws",
]

Array: TypeAlias = NDArray[np.float64]

MODELS = (SEPARATE, "A", "P", "S", "V", "H", "H, linear", "B")
"""The models, by the names of the catalogue."""

CHOICES: dict[str, tuple[str, ...]] = {
    "Table I's COR": tuple(READINGS),
    "delay of B1 on B3": ("2 ms", "7 ms"),
    "row of two balls B1": ("in", "out"),
}
"""The choices, each with its values. A row that is out says nothing: its ratios have the density
of two uniform numbers between 0.5 and 1."""

SCATTER = np.array([0.1e-3, 0.3e-3, 0.6e-3, 1.0e-3, 2.0e-3])
"""The scatter of delays from bounce to bounce, in s."""

EXTRA = (0.002, 0.3)
"""The range of the extra error; its draws are log-uniform."""

_CUT = 3.0  # standard deviations
_MARGIN = 0.012  # of a table beyond the prior of a restitution
_TOP = 0.998  # the largest restitution of a table
_WANDER = 0.01  # of a restitution from bounce to bounce
_STIFFER = 0.15
_SPEED = 0.025
_BETWEEN = (0.7, 1.0)
_BOUNCES = 3.5
_ROOT = math.sqrt(2.0)
_OUT = math.log(4.0)  # the density of two uniform numbers between 0.5 and 1

_LONGEST = {
    "B2_on_B1": 6.4e-3,
    "B1_on_B2": 8.0e-3,
    "B3_on_B1": 6.4e-3,
    "B1_on_B3": 10.8e-3,
    "B1_on_B1": 10.8e-3,
}  # s: of the tables; after 4.3 ms B1 has left the floor, and a later ball finds the same


class Size(NamedTuple):
    """How fine the numbers are computed.

    `step` of the delays in s; nodes of a lower restitution, of an upper one, of that of two balls
    and of the stiffness; nodes of each restitution for separate collisions; independent sets of
    draws, and draws in each.
    """

    step: float = 0.08e-3
    lower: int = 4
    upper: int = 3
    between: int = 7
    stiffness: int = 4
    separate: int = 16
    sets: int = 8
    each: int = 512


class Priors(NamedTuple):
    """Priors that can be exchanged after the likelihoods are known.

    `extra` is the scale of the half-normal prior of the extra error, infinity for log-uniform over
    `EXTRA`; `scatter` are the shares of `SCATTER`; `speed` and `stiffness` are relative errors, at
    most the usual ones.
    """

    extra: float = 0.02
    scatter: tuple[float, ...] = (0.2, 0.2, 0.2, 0.2, 0.2)
    speed: float = _SPEED
    stiffness: float = _STIFFER


class Draws(NamedTuple):
    """Draws (n,) of the prior for one reading: shared numbers, speed error, and extra error."""

    values: dict[str, Array]
    speed: Array
    extra: Array


def find_spans(reading: str) -> dict[str, tuple[float, float]]:
    """Return the ranges of the shared numbers in the tables of a reading.

    Examples
    --------
    >>> find_spans("as printed")["e_B1"]
    (0.708, 0.852)
    """
    spans = {}
    for name, (middle, error) in _restitutions(reading).items():
        far = _CUT * error + _MARGIN
        spans[name] = round(middle - far, 6), round(min(middle + far, _TOP), 6)
    return {**spans, "e_between": _BETWEEN, "log_stiffer": (-_CUT * _STIFFER, _CUT * _STIFFER)}


def _restitutions(reading: str) -> dict[str, tuple[float, float]]:
    """Return the prior mean and error of each ball's restitution."""
    found = {}
    for name, value in READINGS[reading].items():
        slope = value / inputs.PRINTED[name[2:]] if reading == "ratios of heights" else 2.0
        found[name] = value, 0.5 * slope * inputs.ERROR
    return found


def draw_numbers(normal: Array, reading: str) -> Draws:
    """Return draws of the prior from standard normal numbers (..., 7), flattened."""
    from scipy.special import ndtr

    z = normal.reshape(-1, normal.shape[-1]).T
    cut = np.clip(z, -_CUT, _CUT)
    values = {
        name: np.minimum(middle + error * cut[k], _TOP)
        for k, (name, (middle, error)) in enumerate(_restitutions(reading).items())
    }
    low, high = _BETWEEN
    values["log_stiffer"] = _STIFFER * cut[3]
    values["e_between"] = low + (high - low) * ndtr(z[4])
    extra = EXTRA[0] * (EXTRA[1] / EXTRA[0]) ** ndtr(z[6])
    return Draws(values, _SPEED * z[5], np.asarray(extra))


def weigh_draws(draws: Draws, priors: Priors) -> Array:
    """Return the logarithm of the ratio of the priors to the density of the draws: (n,)."""
    e, (low, high) = draws.extra, EXTRA
    found = np.zeros_like(e)
    if math.isfinite(priors.extra):
        within = math.erf(high / priors.extra / _ROOT) - math.erf(low / priors.extra / _ROOT)
        half = math.log(2.0 / priors.extra / math.sqrt(2.0 * math.pi) / within)
        found += half - 0.5 * (e / priors.extra) ** 2 + np.log(e * math.log(high / low))
    found += _narrow(draws.speed / _SPEED, priors.speed / _SPEED)
    return found + _narrow(draws.values["log_stiffer"] / _STIFFER, priors.stiffness / _STIFFER)


def _narrow(z: Array, factor: float) -> Array:
    """Return the logarithm of a normal density of another width over the standard one."""
    return np.asarray(0.5 * z**2 * (1.0 - 1.0 / factor**2) - math.log(factor))


def score_pair(
    weights: Array, moments: Moments, measured: tuple[float, float], draws: Draws, prior: Array
) -> Array:
    """Return the logarithms (choices, n) of the likelihood of a pair's two ratios.

    Parameters
    ----------
    weights : ndarray
        (n, nodes) of a table for the draws.
    moments : Moments
        Of single bounces, at m mean delays.
    measured : tuple of float
        e1 and e2, each ± `inputs.ERROR`.
    draws : Draws
        The draws (n,).
    prior : ndarray
        (choices, m) prior shares of the mean delays.
    """
    parts = weights @ moments.parts.reshape(len(moments.parts), -1)
    first, second, one, two, both = np.moveaxis(parts.reshape(len(parts), 5, -1), 1, 0)
    factor = (1.0 + draws.speed)[:, None]
    noise = (inputs.ERROR**2 + draws.extra**2)[:, None]
    scale = factor**2 / _BOUNCES
    one, two = scale * np.maximum(one, 0.0) + noise, scale * np.maximum(two, 0.0) + noise
    most = np.sqrt((one - noise) * (two - noise))
    both = np.clip(scale * both, -most, most)
    off, away = measured[0] - factor * first, measured[1] - factor * second
    area = one * two - both**2
    squares = (two * off**2 - 2.0 * both * off * away + one * away**2) / area
    density = np.exp(-0.5 * squares) / (2.0 * math.pi * np.sqrt(area))
    return np.asarray(np.log(np.maximum(density @ prior.T, 1e-300))).T


def likelihoods(
    name: str, size: Size, seed: int, progress: Callable[[str], None] = lambda _: None
) -> Array:
    """Return the logarithm of a model's likelihood for all choices and draws.

    Parameters
    ----------
    name : str
        One of `MODELS`.
    size : Size
        How fine.
    seed : int
        Of the draws.
    progress : callable, optional
        Receives a line of text for each table.

    Returns
    -------
    ndarray
        (readings, delays, rows, scatter, sets, draws)
    """
    normal = draw_normal(7, size.sets, size.each, seed)
    found = np.zeros((*map(len, CHOICES.values()), len(SCATTER), size.sets * size.each))
    for i, reading in enumerate(READINGS):
        progress(f"study: model '{name}', Table I's COR {reading}")
        draws = draw_numbers(normal, reading)
        for pair in inputs.PAIRS:
            found[i] += _score(name, pair, find_spans(reading), size, draws)
    return found.reshape(*found.shape[:-1], size.sets, size.each)


def _score(name: str, pair: str, spans: Spans, size: Size, draws: Draws) -> Array:
    """Return a pair's part of the likelihood: (delays, rows, scatter, n)."""
    table = tabulate(name, pair, spans, size, gravity=True)
    weights = table.weights(draws.values)
    found = np.empty((2, 2, len(SCATTER), len(draws.extra)))
    for k, scatter in enumerate(SCATTER):
        middles, prior = _mean_delays(pair, table.delays, float(scatter))
        moments = scatter_bounces(table, middles, float(scatter), _WANDER)
        own = score_pair(weights, moments, inputs.read_ratios(pair), draws, prior)
        found[:, :, k] = own[:, None]
    if pair == "B1_on_B1":
        found[:, 1] = _OUT
    return found


def tabulate(
    name: str, pair: str, spans: Spans, size: Size, *, gravity: bool = False
) -> RatioTable:
    """Return the table of a pair by a model; that of separate collisions has one delay only."""
    last = size.step if name == SEPARATE else _LONGEST[pair]
    delays = np.asarray(size.step * np.arange(1, round(last / size.step) + 1), dtype=float)
    return make_table(name, pair, delays, spans, _count(name, pair, size), gravity=gravity)


def _count(name: str, pair: str, size: Size) -> dict[str, int]:
    """Return the number of nodes of each axis."""
    if name == SEPARATE:
        return dict.fromkeys(find_spans("as printed"), size.separate)
    heavy_below = pair.endswith("B1")  # such pairs change little with all numbers
    lower, upper = inputs.PAIRS[pair]
    few = min(size.upper, size.lower)
    counts = {f"e_{upper}": few, f"e_{lower}": few if heavy_below else size.lower}
    stiffness = few if heavy_below and lower != upper else size.stiffness
    return {**counts, "e_between": size.between, "log_stiffer": stiffness}


def _mean_delays(pair: str, delays: Array, scatter: float) -> tuple[Array, Array]:
    """Return mean delays (m,) and their prior shares (choices, m), for B1 on B3 at 2 or 7 ms."""
    choices = (inputs.MEASURED, inputs.delay_late())
    recorded = [one[pair][inputs.DELAY] for one in choices]
    spread = [math.hypot(error, scatter) for _, error in recorded]
    every = max(1, int(0.25 * scatter / delays[0]))  # the means are smooth over the scatter
    middles = delays[::every]
    prior = np.array(
        [
            np.exp(-0.5 * ((middles - at) / wide) ** 2)
            for (at, _), wide in zip(recorded, spread, strict=True)
        ]
    )
    prior /= prior.sum(axis=1, keepdims=True)
    used = np.any(prior > 1e-6, axis=0)
    return middles[used], prior[:, used]
