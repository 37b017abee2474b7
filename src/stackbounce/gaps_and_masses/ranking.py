"""All stacks of given balls, in the order of the top ball's rebound."""

import functools
import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from stackbounce.errors import (
    InvalidType,
    InvalidValue,
    StackbounceError,
    non_negative,
    positive,
    shown,
    whole,
)
from stackbounce.gaps_and_masses.batch import solve_drops
from stackbounce.gaps_and_masses.separation_limit import replace_gaps
from stackbounce.model import STANDARD_GRAVITY, Ball, ContactLaw, Drop, Hysteretic
from stackbounce.model.catalogue import BALLS, catalogue_ball
from stackbounce.model.laws.series import between
from stackbounce.run.calibration import calibrate
from stackbounce.version import __version__

if TYPE_CHECKING:
    import xarray as xr

__all__ = ["Candidate", "build_stack", "highest", "join_contacts", "list_candidates"]

_GAPS = (0.0, 0.001, 0.005)
_HEIGHT = 1.0  # m
_MOST = 100_000  # drops


@dataclass(frozen=True)
class Candidate:
    """A ball for a stack, with its contact on a hard floor.

    Examples
    --------
    >>> from stackbounce.model import Spring
    >>> Candidate("B1", Ball(0.101), Spring(54000.0)).contact
    Spring(stiffness=54000.0)
    """

    name: str
    ball: Ball
    contact: ContactLaw


def highest(
    balls: Sequence[str | Drop] | None = None,
    count: int = 3,
    *,
    gaps: Sequence[float] = _GAPS,
    repeat: bool = False,
    law: type[ContactLaw] = Hysteretic,
    impact_speed: float | None = None,
) -> "xr.Dataset":
    """Return all stacks of given balls, in the order of the top ball's rebound, highest first.

    Parameters
    ----------
    balls : sequence of str or Drop, optional
        The balls: names of the catalogue, or drops of one ball on the floor, as `Drop.from_toml`
        reads and `stackbounce measure --save` writes them, of which the ball and the contact are
        used. By default the balls of the paper. A ball that is given twice can be used twice.
    count : int, optional
        The number of balls in a stack, 2 or more.
    gaps : sequence of float, optional
        In m, 0 or above. Each stack is dropped once for each value, with that gap between all
        neighbours. The stacks are in the order at the first gap.
    repeat : bool, optional
        Whether each ball can be used any number of times.
    law : type, optional
        The contact law of the catalogue's balls, calibrated to the contact time of each ball on the
        floor and, unless the law is lossless, to its restitution.
    impact_speed : float, optional
        In m/s, above 0. By default the speed after a fall from 1 m.

    Returns
    -------
    xarray.Dataset
        With the dimensions `stack`, in order, and `gap`, in m: `balls` (stack, ball), the names,
        the lowest first; `place` (stack, gap), the rank at each gap, from 1; `rebound_ratio`
        (stack, gap, ball); `height_ratio` (stack, gap), the top ball's rebound height over the drop
        height; `energy_share` (stack, gap), the top ball's kinetic energy over that of all balls
        before the impact; `energy_retained` and `status` (stack, gap); `collisions`
        (stack, gap, contact). The attribute `best` is the first stack with the first gap as a
        scenario file.

    Raises
    ------
    InvalidValue
        If there are too few balls or too many stacks, the contacts of two balls cannot be combined
        into one law, or a number is out of its range.
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
    >>> ds.balls.values[:3].tolist()
    [['B2', 'B3'], ['B1', 'B2'], ['B1', 'B3']]
    >>> ds.place.values[:3].tolist()
    [[1, 2], [2, 3], [3, 1]]
    """
    if impact_speed is None:
        impact_speed = math.sqrt(2.0 * STANDARD_GRAVITY * _HEIGHT)
    chosen = list_candidates(balls, law, impact_speed)
    widths = _checked_gaps(gaps)
    stacks = _stacks(chosen, count, repeat, len(widths))
    drops = [build_stack(stack, impact_speed) for stack in stacks]
    ds = solve_drops(drops, widths).assign_coords(gap=("gap", widths, {"units": "m"}))
    ds = _ranked(stacks, ds)
    best = replace_gaps(drops[int(ds["stack"][0])], None, widths[0])
    attrs = {"stackbounce": __version__, "impact_speed": impact_speed, "best": best.to_toml()}
    return ds.drop_vars("stack").assign_attrs(attrs)


def list_candidates(
    balls: Sequence[str | Drop] | None, law: type[ContactLaw], impact_speed: float
) -> list[Candidate]:
    """Return the balls for the stacks, each with its floor contact; see `highest`.

    Examples
    --------
    >>> from stackbounce.model import Spring
    >>> [one.name for one in list_candidates(["b1", "b3"], Spring, 1.0)]
    ['B1', 'B3']
    """
    positive("impact_speed", impact_speed, "m/s")
    if law.rigid:
        raise InvalidValue(
            f"law must be one with a stiffness, such as Spring, got {law.__name__}: what two rigid "
            "balls lose in a collision does not follow from their bounces on a floor"
        )
    if balls is None:
        balls = [str(entry.ball.name) for entry in BALLS]
    if isinstance(balls, str | Drop):
        raise InvalidType(f"balls must be a list, got {shown(balls)}")
    return [_candidate(one, i, law, impact_speed) for i, one in enumerate(balls)]


def _candidate(one: object, i: int, law: type[ContactLaw], impact_speed: float) -> Candidate:
    if isinstance(one, Drop):
        contact = one.contacts[0]
        if len(one.balls) != 1 or contact is None or contact.rigid:
            raise InvalidValue(
                f"balls.{i} must be a drop of one ball on a floor of finite stiffness, got "
                f"{len(one.balls)} on {shown(contact)}"
            )
        return Candidate(one.balls[0].name or f"ball {i}", one.balls[0], contact)
    if not isinstance(one, str):
        raise InvalidType(f"balls.{i} must be a name of the catalogue or a Drop, got {shown(one)}")
    entry = catalogue_ball(one)
    mass = entry.ball.mass
    measured: dict[str, Any] = {
        "mass": mass,
        "contact_time": entry.contact_time or math.pi * math.sqrt(mass / entry.stiffness),
        "impact_speed": impact_speed,
    }
    if law.loss:
        measured["restitution"] = entry.restitution
    return Candidate(str(entry.ball.name), entry.ball, calibrate(law, **measured))


def build_stack(stack: Sequence[Candidate], impact_speed: float) -> Drop:
    """Return the drop of a stack of balls, the lowest first, without gaps.

    Raises
    ------
    InvalidValue
        If the contacts of two neighbours cannot be combined into one law.

    Examples
    --------
    >>> from stackbounce.model import Spring
    >>> build_stack(list_candidates(["B1", "B2"], Spring, 1.0), 1.0).balls[1].name
    'B2'
    """
    contacts = join_contacts([one.name for one in stack], [one.contact for one in stack])
    return Drop([one.ball for one in stack], contacts, impact_speed=impact_speed)


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
        try:
            found.append(_pressed(lower, upper))
        except StackbounceError as error:
            raise InvalidValue(f"{one} and {other}: {error}") from error
    return found


_pressed = functools.lru_cache(between)


def _checked_gaps(gaps: Any) -> list[float]:
    try:
        found = [non_negative(f"gaps.{i}", gap, "metres") for i, gap in enumerate(gaps)]
    except TypeError as error:
        if isinstance(error, InvalidType):
            raise
        raise InvalidType(f"gaps must be a list of numbers, got {shown(gaps)}") from None
    if not found or len(set(found)) < len(found):
        raise InvalidValue(f"gaps must be different ones, at least one, got {shown(gaps)}")
    return found


def _stacks(
    balls: Sequence[Candidate], count: object, repeat: bool, gaps: int
) -> list[tuple[Candidate, ...]]:
    """Return all different stacks of `count` balls."""
    high = whole("count", count, 2, math.inf if repeat else len(balls))
    many = len(balls) ** high if repeat else math.perm(len(balls), high)
    if many * gaps > _MOST:
        raise InvalidValue(
            f"stacks must be at most {_MOST} drops, got {many} of {len(balls)} balls, {high} high, "
            f"at {gaps} gaps: take fewer balls or gaps, or lower stacks"
        )
    chosen: Any = itertools.product(balls, repeat=high)
    if not repeat:
        chosen = itertools.permutations(balls, high)
    return list(dict.fromkeys(chosen))


def _ranked(stacks: Sequence[tuple[Candidate, ...]], ds: "xr.Dataset") -> "xr.Dataset":
    """Return the sweep sorted by the top ball's rebound, with ranks, heights and energy shares."""
    top = ds.rebound_ratio.isel(ball=-1)
    mass = np.array([[one.ball.mass for one in stack] for stack in stacks])
    share = top**2 * (mass[:, -1] / mass.sum(axis=1))[:, None]
    order = np.argsort(-top.values, axis=0, kind="stable")  # nan of unfinished runs comes last
    ds["balls"] = ("stack", "ball"), [[one.name for one in stack] for stack in stacks]
    ds["place"] = top.dims, np.argsort(order, axis=0, kind="stable") + 1
    ds["height_ratio"] = top.clip(min=0.0) ** 2
    ds["energy_share"] = share
    ds = ds[list(_MEANINGS)].isel(stack=order[:, 0])
    for name, meaning in _MEANINGS.items():
        ds[name].attrs = {"units": "1", "long_name": meaning} | ds[name].attrs
    ds.attrs = {}  # those of the sweep describe one stack only
    return ds


_MEANINGS = {
    "balls": "the balls of the stack, the lowest first",
    "place": "place in the order of the top ball's rebound ratio",
    "rebound_ratio": "velocity after the impact over the impact speed v0",
    "height_ratio": "height to which the top ball goes over that of the drop",
    "energy_share": "the top ball's kinetic energy over that of all balls before",
    "energy_retained": "kinetic energy at the end over the one that came in",
    "collisions": "contact intervals",
    "status": "how the run ended",
}
