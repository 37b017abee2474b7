"""All stacks of given balls, in the order of the top ball's rebound."""

import functools
import itertools
import math
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from stackbounce.errors import (
    InvalidType,
    InvalidValue,
    instance,
    listed,
    non_negative,
    placed,
    shown,
    whole,
)
from stackbounce.files import shipped_table
from stackbounce.library_types import Dataset
from stackbounce.model import STANDARD_GRAVITY, Ball, ContactLaw, Drop, Hysteretic, law_named
from stackbounce.model.catalogue import BALLS, catalogue_ball
from stackbounce.model.laws.series import between
from stackbounce.run.calibration import calibrate
from stackbounce.towers.masses import best_masses, geometric_means, mass_range, solve_drops
from stackbounce.towers.separation import replace_gaps
from stackbounce.units import checked
from stackbounce.version import __version__

_GAPS = (0.0, 0.001, 0.005)
_HEIGHT = 1.0  # m
_MOST = 100_000  # drops
_AT_THE_END = 1e-3  # relative distance of a mass from an end of its range that counts as none
_SWEPT = ("rebound_ratio", "energy_retained", "collisions", "status")
_MEANINGS = shipped_table(__package__, "meanings.toml")  # of variables that a sweep does not have


class _Candidate(NamedTuple):
    """A ball for a stack, with its contact on a hard floor."""

    name: str
    ball: Ball
    contact: ContactLaw


class _Stack(NamedTuple):
    """A stack, the names of its balls, and a note on its masses if they are other ones."""

    names: tuple[str, ...]
    drop: Drop
    note: str = ""


def highest(
    balls: Sequence[str | Drop] | Drop | None = None,
    count: int | None = None,
    *,
    gaps: Sequence[float] | None = None,
    repeat: bool = False,
    law: type[ContactLaw] = Hysteretic,
    impact_speed: float | None = None,
    masses: bool | Sequence[float] = False,
) -> Dataset:
    """Return all stacks of given balls, in the order of the top ball's rebound, highest first.

    Parameters
    ----------
    balls : sequence of str or Drop, or Drop, optional
        The balls: names of the catalogue, or drops of one ball on the floor, as `Drop.from_toml`
        reads and `stackbounce measure --save` writes them, of which the ball and the contact are
        used. By default the balls of the paper. A ball that is given twice can be used twice. A
        single Drop is the only stack, with its own order and contacts.
    count : int, optional
        The number of balls in a stack, 2 or more; by default 3, or 2 if only two are given.
    gaps : sequence of float, optional
        In m, 0 or above. Each stack is dropped once for each value, with that gap between all
        neighbours. The stacks are in the order at the first gap. By default 0, 1 mm and 5 mm, or a
        single Drop's own gaps.
    repeat : bool, optional
        Whether each ball can be used any number of times.
    law : type, optional
        The contact law of the catalogue's balls, calibrated to the contact time of each ball on the
        floor and, unless the law is lossless, to its restitution.
    impact_speed : float, optional
        In m/s, above 0. By default the speed after a fall from 1 m. A single Drop has its own.
    masses : bool or (float, float), optional
        Whether the best stack with other inner masses, at the first gap, is one of the stacks: with
        the best ones, as from `best_masses`, and with the geometric means. Two numbers are the
        smallest and the largest mass in kg that are tried.

    Returns
    -------
    xarray.Dataset
        With the dimensions `stack`, in order, whose values name the stacks, and `gap`, in m (nan
        for a single Drop's own gaps): `balls` and `mass` (stack, ball), names and masses in kg, the
        lowest first; `place` (stack, gap), the rank at each gap, from 1; `rebound_ratio`
        (stack, gap, ball); `height_ratio` (stack, gap), the top ball's rebound height over the drop
        height; `energy_share` (stack, gap), the top ball's kinetic energy over that of all balls
        before the impact; `energy_retained` and `status` (stack, gap); `collisions`
        (stack, gap, contact). The attribute `best` is the first stack, or that with the best
        masses, with the first gap as a scenario file. With `masses`, `within` is the range of
        masses in kg, and `at_the_end` has the indices of the best masses that lie at an end of it:
        better ones lie beyond.

    Raises
    ------
    InvalidValue
        If there are too few balls or too many stacks, a Drop has a `count`, the contacts of two
        balls cannot be combined into one law, or a number is out of its range.
    InvalidType
        If something has the wrong type.

    Notes
    -----
    The contact of two balls is both their floor contacts in series, as in `series.between`.
    The springs that the paper fitted to three of the catalogue's pairs are not used, because the
    other pairs have none. The ranks depend on the gap, which is seldom known.

    Examples
    --------
    >>> import stackbounce as sb
    >>> ds = sb.highest(["B1", "B2", "B3"], 2, gaps=[0.0, 0.005])
    >>> ds["stack"].values[:3].tolist()
    ['B2 + B3', 'B1 + B2', 'B1 + B3']
    >>> ds.place.values[:3].tolist()
    [[1, 2], [2, 3], [3, 1]]
    """
    instance("repeat", repeat, bool)
    if isinstance(balls, Drop):
        if count is not None or repeat:
            raise InvalidValue("a Drop is one stack: count and repeat are for a choice of balls")
        names = tuple(ball.name or f"ball {i}" for i, ball in enumerate(balls.balls))
        stacks = [_Stack(names, balls)]
        widths = None if gaps is None else _checked_gaps(gaps)
    else:
        fallen = math.sqrt(2.0 * STANDARD_GRAVITY * _HEIGHT)
        speed = fallen if impact_speed is None else impact_speed
        chosen = _list_candidates(balls, law, speed)
        widths = _checked_gaps(_GAPS if gaps is None else gaps)
        size = (3 if repeat else min(3, len(chosen))) if count is None else count
        stacks = _stacks(chosen, size, repeat, len(widths), speed)
    ds = _solved(stacks, widths)
    best = stacks[_order(ds)[0, 0]].drop
    best = best if widths is None else replace_gaps(best, None, widths[0])
    attrs: dict[str, Any] = {"stackbounce": __version__, "impact_speed": best.reference_speed}
    if masses is not False:
        names, means = stacks[_order(ds)[0, 0]].names, geometric_means(best)
        within = None if masses is True else masses
        attrs["within"] = low, high = mass_range(best, within)
        best = best_masses(best, within=within)
        attrs["at_the_end"] = [
            i
            for i, ball in enumerate(best.balls[1:-1], start=1)
            if min(ball.mass / low, high / ball.mass) < 1.0 + _AT_THE_END
        ]
        for note, drop in ((" (best masses)", best), (" (geometric means)", means)):
            inner = (f"{1e3 * ball.mass:.4g} g" for ball in drop.balls[1:-1])
            stacks.append(_Stack((names[0], *inner, names[-1]), drop, note))
        ds = _solved(stacks, widths)
    return _ranked(stacks, ds).assign_attrs(attrs, best=best.to_toml())


def _list_candidates(balls: Any, law: type[ContactLaw], impact_speed: float) -> list[_Candidate]:
    """Return the balls for the stacks, each with its floor contact; see `highest`."""
    law = law_named(law)
    if law.rigid:
        raise InvalidValue(
            f"law must be one with a stiffness, such as Spring, got {law.__name__}: what two rigid "
            "balls lose in a collision does not follow from their bounces on a floor"
        )
    if balls is None:
        balls = [str(entry.ball.name) for entry in BALLS]
    many = enumerate(listed("balls", balls, _MOST))
    return [_candidate(ball, i, law, impact_speed) for i, ball in many]


def _candidate(given: object, i: int, law: type[ContactLaw], impact_speed: float) -> _Candidate:
    if isinstance(given, Drop):
        contact = given.contacts[0]
        if len(given.balls) != 1 or contact is None or contact.rigid:
            raise InvalidValue(
                f"balls.{i} must be a drop of one ball on a floor of finite stiffness, got "
                f"{len(given.balls)} on {shown(contact)}"
            )
        return _Candidate(given.balls[0].name or f"ball {i}", given.balls[0], contact)
    if not isinstance(given, str):
        raise InvalidType(
            f"balls.{i} must be a name of the catalogue or a Drop, got {shown(given)}"
        )
    entry = catalogue_ball(given)
    mass = entry.ball.mass
    measured: dict[str, Any] = {
        "mass": mass,
        "contact_time": entry.contact_time or math.pi * math.sqrt(mass / entry.stiffness),
        "impact_speed": impact_speed,
    }
    if law.loss:
        measured["restitution"] = entry.restitution
    return _Candidate(str(entry.ball.name), entry.ball, calibrate(law, **measured))


def join_contacts(names: Sequence[str], laws: Sequence[ContactLaw]) -> list[ContactLaw]:
    """Return the contacts of a stack from the floor contact of each ball, the lowest first.

    The contact of two balls is both floor contacts in series, as in `series.between`.

    Parameters
    ----------
    names : sequence of str
        The balls, for messages.
    laws : sequence of ContactLaw
        The floor contact of each ball.

    Returns
    -------
    list of ContactLaw

    Raises
    ------
    InvalidValue
        If the contacts of two neighbours cannot be combined into one law.

    Examples
    --------
    >>> from stackbounce.model import Spring
    >>> join_contacts(["B1", "B2"], [Spring(2.0), Spring(2.0)])
    [Spring(stiffness=2.0), Spring(stiffness=1.0)]
    """
    found = [laws[0]]
    for (one, lower), (other, upper) in itertools.pairwise(zip(names, laws, strict=True)):
        with placed(f"{one} and {other}: ", InvalidValue):
            found.append(_pressed(lower, upper))
    return found


_pressed = functools.lru_cache(between)


def _checked_gaps(gaps: Any) -> list[float]:
    many = enumerate(listed("gaps", gaps, _MOST))
    found = [checked(non_negative, f"gaps.{i}", gap, "metres") for i, gap in many]
    if not found or len(set(found)) < len(found):
        raise InvalidValue(f"gaps must be different ones, at least one, got {shown(gaps)}")
    return found


def _stacks(
    balls: Sequence[_Candidate], count: object, repeat: bool, gaps: int, impact_speed: float
) -> list[_Stack]:
    """Return all different stacks of `count` balls, without gaps."""
    if len(balls) < 2 and not repeat:
        raise InvalidValue(f"balls must be two or more, unless they repeat, got {len(balls)} ball")
    high = whole("count of balls", count, 2, math.inf if repeat else len(balls))
    many = len(balls) ** high if repeat else math.perm(len(balls), high)
    if many * gaps > _MOST:
        raise InvalidValue(
            f"stacks must be at most {_MOST} drops, got {many} of {len(balls)} balls, {high} high, "
            f"at {gaps} gaps: take fewer balls or gaps, or lower stacks"
        )
    chosen: Any = itertools.product(balls, repeat=high)
    if not repeat:
        chosen = itertools.permutations(balls, high)
    found = []
    for stack in dict.fromkeys(chosen):
        names, own, floors = zip(*stack, strict=True)
        drop = Drop(own, join_contacts(names, floors), impact_speed=impact_speed)
        found.append(_Stack(names, drop))
    return found


def _solved(stacks: Sequence[_Stack], widths: Sequence[float] | None) -> Dataset:
    """Return the outcome of each stack (stack, gap, ...)."""
    ds = solve_drops([stack.drop for stack in stacks], widths)
    if widths is None:
        ds = ds.expand_dims("gap", 1)
    return ds.assign_coords(gap=("gap", widths or [math.nan], {"units": "m"}))


def _order(ds: Dataset) -> Any:
    """Return the indices of the stacks at each gap, the highest rebound of the top ball first."""
    top = ds.rebound_ratio.values[..., -1]
    return np.argsort(-top, axis=0, kind="stable")  # nan of unfinished runs comes last


def _ranked(stacks: Sequence[_Stack], ds: Dataset) -> Dataset:
    """Return the sweep in the order at the first gap, with ranks, heights and energy shares."""
    top, order = ds.rebound_ratio.isel(ball=-1), _order(ds)
    mass = np.array([[ball.mass for ball in stack.drop.balls] for stack in stacks])
    ds["balls"] = ("stack", "ball"), [stack.names for stack in stacks]
    ds["mass"] = ("stack", "ball"), mass
    ds["place"] = top.dims, np.argsort(order, axis=0, kind="stable") + 1
    ds["height_ratio"] = top.clip(min=0.0) ** 2
    ds["energy_share"] = top**2 * (mass[:, -1] / mass.sum(axis=1))[:, None]
    labels = [" + ".join(stack.names) + stack.note for stack in stacks]
    ds = ds[[*_MEANINGS, *_SWEPT]].assign_coords(stack=labels)
    ds = ds.isel(stack=order[:, 0])
    for name, meaning in _MEANINGS.items():
        ds[name].attrs = {"units": "kg" if name == "mass" else "1", "long_name": meaning}
    ds.attrs = {}  # those of the sweep describe one stack only
    return ds
