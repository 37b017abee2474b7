"""The usual models of a stack, made from what is known of its contacts."""

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

from stackbounce.calibration import calibrate, contact_time
from stackbounce.errors import InvalidValue
from stackbounce.fitting.problem import FitProblem, Model
from stackbounce.model import (
    ContactLaw,
    Drop,
    Hertz,
    HuntCrossley,
    Hysteretic,
    Rigid,
    Spring,
    Viscoelastic,
)

__all__ = ["standard_models"]

_LOSSY = 0.8  # the restitution that a search begins with
_FACTOR = 30.0  # up to which a stiffness may be more or less than at first
_FLIGHTS = 4.0  # contact times at the impact speed: the widest gap that is looked at
_WEAK, _STRONG = 0.05, 0.999  # between which restitutions


def standard_models(
    drop: Drop | Mapping[str, Drop], *, times: bool = False
) -> dict[str, FitProblem]:
    """Return the usual models of a stack, to be compared.

    Parameters
    ----------
    drop : Drop, or mapping of str to Drop
        With finite contacts that last about as long as the true ones. Several are drops of the same
        stack, and share all that varies.
    times : bool, optional
        Whether times were measured: without them only ratios of stiffnesses show, and the floor's
        is kept.

    Returns
    -------
    dict of str to FitProblem
        `Rigid` with one restitution and with one for each contact; `Spring`; `Hysteretic` from a
        linear spring and from Hertz's law; `Hertz` without loss; `Viscoelastic`; `HuntCrossley`.
        Those with finite contacts vary their stiffnesses and gaps, lossy ones one loss that all
        contacts share.

    Raises
    ------
    InvalidValue
        If a drop has no floor or rigid contacts, of which no contact time is known.

    Examples
    --------
    >>> import stackbounce as sb
    >>> springs = [sb.Spring(2500.0), sb.Spring(1000.0)]
    >>> drop = sb.Drop([sb.Ball(0.150), sb.Ball(0.057)], springs, impact_speed=3.53)
    >>> list(standard_models(drop)["Spring"].vary)
    ['contacts.1.stiffness', 'gaps.0']
    """
    drops = {"": drop} if isinstance(drop, Drop) else dict(drop)
    first = next(iter(drops.values()))
    if first.rigid or first.contacts[0] is None:
        raise InvalidValue(
            "drop must have finite contacts, the floor's among them, for the usual models: Rigid "
            "ones tell no contact time"
        )

    def made(law: Callable[[Drop, int], ContactLaw], *losses: str) -> FitProblem:
        changed = {
            key: replace(one, contacts=[law(one, i) for i in range(len(one.contacts))])
            for key, one in drops.items()
        }
        vary, tie = _finite(next(iter(changed.values())), times, losses)
        return Model(changed, vary, tie)

    def lossy(kind: Any, **shape: Any) -> Callable[[Drop, int], ContactLaw]:
        return lambda one, i: _alike(one, i, kind, restitution=_LOSSY, **shape)

    return {
        "Rigid, one restitution": _rigid(drops, times, shared=True),
        "Rigid, one for each contact": _rigid(drops, times, shared=False),
        "Spring": made(lambda one, i: _alike(one, i, Spring)),
        "Hertz": made(lambda one, i: _alike(one, i, Hertz)),
        "Hysteretic": made(lossy(Hysteretic), "restitution"),
        "Hysteretic, Hertz loading": made(lossy(Hysteretic, exponent=1.5), "restitution"),
        "Viscoelastic": made(lossy(Viscoelastic), "dissipative_time"),
        "HuntCrossley": made(lossy(HuntCrossley, exponent=1.5), "dissipation"),
    }


def _rigid(drops: Mapping[str, Drop], times: bool, *, shared: bool) -> FitProblem:
    changed = {
        key: replace(one, contacts=[Rigid(_LOSSY)] * len(one.contacts))
        for key, one in drops.items()
    }
    first = next(iter(drops.values()))
    paths = [f"contacts.{i}.restitution" for i in range(len(first.contacts))]
    names, tie = (["restitution"], dict.fromkeys(paths, "restitution")) if shared else (paths, None)
    vary: dict[str, Any] = dict.fromkeys(names, (_WEAK, 1.0))
    if times:  # a gap changes nothing but when the balls meet
        vary |= _gaps(first)
    return Model(changed, vary, tie)


def _gaps(drop: Drop) -> dict[str, Any]:
    lasting = max(_lasting(drop, i) for i in range(len(drop.contacts)))
    widest = _FLIGHTS * drop.reference_speed * lasting
    return {f"gaps.{i}": (0.0, widest) for i in range(len(drop.gaps))}


def _finite(drop: Drop, times: bool, losses: tuple[str, ...]) -> tuple[dict[str, Any], Any]:
    """Return what varies in a stack of one finite law, and what follows."""
    vary: dict[str, Any] = {}
    for i, law in enumerate(drop.contacts):
        if i or times:
            own: float = law.stiffness  # type: ignore[union-attr]
            vary[f"contacts.{i}.stiffness"] = (own / _FACTOR, own * _FACTOR)
    vary |= _gaps(drop)
    tie = {}
    for name in losses:
        own = getattr(drop.contacts[0], name)
        vary[name] = (_WEAK, _STRONG) if name == "restitution" else (own / _FACTOR, own * _FACTOR)
        tie.update({f"contacts.{i}.{name}": name for i in range(len(drop.contacts))})
    return vary, tie or None


def _mass(drop: Drop, i: int) -> float | tuple[float, float]:
    """Return the mass of the ball above the floor, or both masses of a pair."""
    upper = drop.balls[i].mass
    return (drop.balls[i - 1].mass, upper) if i else upper


def _lasting(drop: Drop, i: int) -> float:
    """Return how long a contact alone lasts at the impact speed, in s."""
    law: Any = drop.contacts[i]
    return float(contact_time(law, mass=_mass(drop, i), speed=drop.reference_speed))


def _alike(drop: Drop, i: int, kind: Any, **numbers: Any) -> ContactLaw:
    """Return a law of another kind that lasts as long alone at the impact speed."""
    time, speed = _lasting(drop, i), drop.reference_speed
    made: ContactLaw = calibrate(
        kind, mass=_mass(drop, i), contact_time=time, impact_speed=speed, **numbers
    )
    return made
