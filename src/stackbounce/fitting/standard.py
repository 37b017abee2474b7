"""The usual models of a stack, made from what is known of its contacts."""

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from stackbounce.errors import InvalidValue
from stackbounce.fitting.problem import FitProblem, Model
from stackbounce.model import LAWS, ContactLaw, Drop, Rigid
from stackbounce.run.calibration import calibrate
from stackbounce.run.collision import contact_time

_LOSSY = 0.8  # the restitution that a search begins with
_FACTOR = 30.0  # by which a stiffness may differ from its start value
_FLIGHTS = 4.0  # contact times at the impact speed: the widest gap that is looked at
_WEAK, _STRONG = 0.05, 0.999  # bounds of a restitution


def standard_models(
    drop: Drop | Mapping[str, Drop], *, times: bool = False
) -> dict[str, FitProblem]:
    """Return the usual models of a stack, to be compared.

    Parameters
    ----------
    drop : Drop, or mapping of str to Drop
        With contacts of finite duration, about as long as the true ones. Several are drops of the
        same stack; they share all varied numbers.
    times : bool, optional
        Whether times were measured. Without them the data determine only ratios of stiffnesses, so
        the floor's stiffness is not varied.

    Returns
    -------
    dict of str to FitProblem
        `Rigid` with one restitution and with one for each contact, then the `usual_models` of all
        laws: first those without loss, then those with a rate-independent loss, then the others.
        Models of finite contacts vary stiffnesses and gaps. Lossy ones also vary one loss parameter
        that all contacts share.

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

    models = {
        "Rigid, one restitution": _rigid(drops, times, shared=True),
        "Rigid, one for each contact": _rigid(drops, times, shared=False),
    }
    for law in sorted(LAWS.values(), key=lambda law: (bool(law.loss), not law.rate_free)):
        for name, numbers in law.usual_models.items():
            models[name] = _made(drops, times, law, numbers)
    return models


def _made(
    drops: Mapping[str, Drop], times: bool, law: type[ContactLaw], numbers: Mapping[str, float]
) -> FitProblem:
    """Return the model with all contacts of one finite law that last as long as the true ones."""
    given = {"restitution": _LOSSY, **numbers} if law.loss else numbers
    changed = {
        key: replace(
            drop, contacts=[_alike(drop, i, law, given) for i in range(len(drop.contacts))]
        )
        for key, drop in drops.items()
    }
    vary, tie = _finite(next(iter(changed.values())), times, law.loss)
    return Model(changed, vary, tie)


def _rigid(drops: Mapping[str, Drop], times: bool, *, shared: bool) -> FitProblem:
    changed = {
        key: replace(drop, contacts=[Rigid(_LOSSY)] * len(drop.contacts))
        for key, drop in drops.items()
    }
    first = next(iter(drops.values()))
    paths = [f"contacts.{i}.restitution" for i in range(len(first.contacts))]
    names, tie = (["restitution"], dict.fromkeys(paths, "restitution")) if shared else (paths, None)
    vary: dict[str, Any] = dict.fromkeys(names, (_WEAK, 1.0))
    if times:  # in rigid collisions a gap changes only the times
        vary |= _gaps(first)
    return Model(changed, vary, tie)


def _gaps(drop: Drop) -> dict[str, Any]:
    lasting = max(_lasting(drop, i) for i in range(len(drop.contacts)))
    widest = _FLIGHTS * drop.reference_speed * lasting
    return {f"gaps.{i}": (0.0, widest) for i in range(len(drop.gaps))}


def _finite(drop: Drop, times: bool, loss: str) -> tuple[dict[str, Any], Any]:
    """Return the varied numbers and the ties of a stack with one finite law."""
    laws: list[Any] = list(drop.contacts)
    own = {
        f"contacts.{i}.stiffness": laws[i].stiffness for i in range(0 if times else 1, len(laws))
    }
    vary: dict[str, Any] = {path: (k / _FACTOR, k * _FACTOR) for path, k in own.items()}
    vary |= _gaps(drop)
    if not loss:
        return vary, None
    first: float = getattr(laws[0], loss)
    vary[loss] = (_WEAK, _STRONG) if loss == "restitution" else (first / _FACTOR, first * _FACTOR)
    return vary, {f"contacts.{i}.{loss}": loss for i in range(len(laws))}


def _mass(drop: Drop, i: int) -> float | tuple[float, float]:
    """Return the mass of the ball above the floor, or both masses of a pair."""
    upper = drop.balls[i].mass
    return (drop.balls[i - 1].mass, upper) if i else upper


def _lasting(drop: Drop, i: int) -> float:
    """Return how long a contact alone lasts at the impact speed, in s."""
    law: Any = drop.contacts[i]
    return float(contact_time(law, mass=_mass(drop, i), impact_speed=drop.reference_speed))


def _alike(drop: Drop, i: int, law: type[ContactLaw], numbers: Mapping[str, float]) -> ContactLaw:
    """Return a law of another class that lasts as long alone at the impact speed."""
    time, speed = _lasting(drop, i), drop.reference_speed
    return calibrate(law, mass=_mass(drop, i), contact_time=time, impact_speed=speed, **numbers)
