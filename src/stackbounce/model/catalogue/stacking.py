"""Balls of the catalogue by name, and their contacts and gaps in a stack."""

import itertools
from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple, cast

from stackbounce.errors import InvalidValue, UnknownName, nearest, shown
from stackbounce.model.ball import Ball
from stackbounce.model.catalogue.balls import ENTRIES, PAIRS, UNITS, CatalogueBall, Pair
from stackbounce.model.drop import Drop
from stackbounce.model.laws import ContactLaw, Spring
from stackbounce.model.laws.series import between
from stackbounce.shown import Shown, Table
from stackbounce.units import handy_text

DEFAULT_HEIGHT = 1.0
"""In m: the height of a fall of which nothing is said."""

_FIGURES = ("mass", "diameter", "restitution", "contact_time", "stiffness")


class Stack(NamedTuple):
    """A stack of balls of the catalogue: the arguments of a `Drop`, and their sources.

    Parameters
    ----------
    balls : tuple of Ball
        N balls, the lowest first.
    contacts : tuple of ContactLaw
        N contacts, each below its ball.
    gaps : tuple of float
        N - 1 distances in m.
    contact_sources : tuple of str
        Where each contact's numbers come from, (N,).
    gap_sources : tuple of str
        Where each gap comes from, (N - 1,).

    Examples
    --------
    >>> from stackbounce.model.catalogue import stacked
    >>> stacked(["B1", "B2"]).gaps
    (0.001,)
    """

    balls: tuple[Ball, ...]
    contacts: tuple[ContactLaw, ...]
    gaps: tuple[float, ...]
    contact_sources: tuple[str, ...]
    gap_sources: tuple[str, ...]


def catalogue_ball(name: str) -> CatalogueBall:
    """Return the catalogue's entry for a ball's name.

    Parameters
    ----------
    name : str
        Such as ``"basketball"`` or ``"B1"``. Case does not matter, and the words of a name may be
        joined by hyphens: ``"tennis-ball"``.

    Returns
    -------
    CatalogueBall

    Raises
    ------
    UnknownName
        If the catalogue has no ball of this name; the message suggests the nearest.

    Examples
    --------
    >>> catalogue_ball("Tennis").ball.mass
    0.057
    >>> catalogue_ball("ping-pong-ball").restitution
    0.88
    """
    asked = _plain(str(name))
    for known, entry in ENTRIES.items():
        if asked == _plain(known):
            return entry
    names = [known.replace(" ", "-") for known in ENTRIES]
    raise UnknownName(
        f"ball must be one of the catalogue, got {shown(name)}; {nearest(name, names)}"
    )


def _plain(name: str) -> str:
    return name.casefold().replace("-", " ")


def stack(
    *balls: str | Sequence[str],
    height: float | str | None = None,
    impact_speed: float | str | None = None,
    velocities: Sequence[float | str] | None = None,
    gravity: float | str = 0.0,
    gap: float | str | None = None,
    gaps: Sequence[float | str] | None = None,
) -> Drop:
    """Return a drop of balls of the catalogue, on the contacts that it has for them.

    Parameters
    ----------
    *balls : str
        Their names, or one list of them, the lowest first, as `catalogue_ball` reads them;
        `stackbounce.balls` has all.
    height, impact_speed, velocities, gravity : optional
        As of `Drop`. By default the stack falls from 1 m, as in ``stackbounce simulate``.
    gap : float, optional
        In m, 0 or above: one gap between all neighbours.
    gaps : sequence of float, optional
        In m, 0 or above: the N - 1 gaps. By default those that the paper fitted to the pair, or 0.

    Returns
    -------
    Drop
        Its contacts follow the rules in the docstring of `stackbounce.model.catalogue`.

    Raises
    ------
    InvalidValue
        If there is no name, the catalogue lacks one, `gap` and `gaps` are both given, or as of
        `Drop`.

    Examples
    --------
    >>> import stackbounce as sb
    >>> drop = sb.stack("basketball", "tennis", height="63 cm", gap="2 mm")
    >>> drop.gaps, drop.height, drop.contacts[0]
    ((0.002,), 0.63, Spring(stiffness=2500.0))
    """
    if gap is not None and gaps is not None:
        raise InvalidValue("gap and gaps: only one of the two can be given, got both")
    one_list = len(balls) == 1 and isinstance(balls[0], list | tuple)
    chosen = stacked(cast("Sequence[str]", balls[0] if one_list else balls))
    if gap is not None:
        gaps = [gap] * (len(chosen.balls) - 1)
    drop = Drop(chosen.balls, chosen.contacts, chosen.gaps, height=DEFAULT_HEIGHT)
    fall = {"height": height, "impact_speed": impact_speed, "velocities": velocities}
    numbers = fall | {"gaps": gaps, "gravity": gravity}
    return drop.replace(**{name: value for name, value in numbers.items() if value is not None})


def stacked(names: Sequence[str]) -> Stack:
    """Return the balls, contacts and gaps of a stack of the catalogue, with their sources.

    Parameters
    ----------
    names : sequence of str
        The balls, the lowest first.

    Returns
    -------
    Stack
        Its contacts and gaps follow the rules in the docstring of `stackbounce.model.catalogue`.

    Raises
    ------
    InvalidValue
        If there is no name, or the catalogue lacks one of them.

    Examples
    --------
    >>> stacked(["basketball", "tennis"]).contacts
    (Spring(stiffness=2500.0), Spring(stiffness=1000.0))
    >>> [round(law.restitution, 3) for law in stacked(["big basketball", "tennis ball"]).contacts]
    [0.81, 0.767]
    """
    if not names:
        raise InvalidValue("balls must hold at least one name, got none")
    entries = [catalogue_ball(name) for name in names]
    lowest = _pair(*entries[:2]) if len(entries) > 1 else None
    floor = entries[0].contact, dict(entries[0].sources)["stiffness"]
    if lowest is not None:
        floor = Spring(lowest.floor_stiffness), lowest.source
    contacts = [floor, *(_between(a, b) for a, b in itertools.pairwise(entries))]
    laws, sources = zip(*contacts, strict=True)
    many = len(entries) - 1
    gaps, told = [0.0] * many, ["no gap given"] * many
    if lowest is not None and lowest.gap > 0.0:
        gaps[0], told[0] = lowest.gap, lowest.source
    return Stack(tuple(entry.ball for entry in entries), laws, tuple(gaps), sources, tuple(told))


def _pair(lower: CatalogueBall, upper: CatalogueBall) -> Pair | None:
    names = (lower.ball.name, upper.ball.name)
    return next((pair for pair in PAIRS if (pair.lower, pair.upper) == names), None)


def _between(lower: CatalogueBall, upper: CatalogueBall) -> tuple[ContactLaw, str]:
    pair = _pair(lower, upper) or _pair(upper, lower)
    if pair is not None:
        return Spring(pair.stiffness), pair.source
    source = f"{lower.ball.name} and {upper.ball.name} in series"
    return between(lower.contact, upper.contact), source


class Balls(Shown, Mapping[str, Ball]):
    """The balls of the catalogue by name; `stackbounce.balls` is the one there is.

    Names are read as by `stack`. What is not there raises a `KeyError` that is an `InvalidValue`.

    Examples
    --------
    >>> import stackbounce as sb
    >>> sb.balls["tennis"].mass, "golf ball" in sb.balls
    (0.057, True)
    """

    def __getitem__(self, name: str) -> Ball:
        return catalogue_ball(name).ball

    def __iter__(self) -> Iterator[str]:
        return iter(ENTRIES)

    def __len__(self) -> int:
        return len(ENTRIES)

    def _tables(self) -> Sequence[Table]:
        rows = []
        for name, entry in ENTRIES.items():
            numbers = entry.to_mapping()
            cells = ((numbers[figure], UNITS[figure]) for figure in _FIGURES)
            rows.append((name, *("" if x is None else handy_text(x, unit, 4) for x, unit in cells)))
        columns = ("", *(figure.replace("_", " ") for figure in _FIGURES))
        return (Table("Balls of the catalogue", columns, rows),)


balls = Balls()
"""The balls of the catalogue by name."""
