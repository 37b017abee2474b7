"""The usual models of a stack, made from what is known of its contacts."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from statistics import geometric_mean
from typing import Any

from stackbounce.errors import InvalidValue
from stackbounce.fitting.parameters import Drops
from stackbounce.fitting.problem import FitProblem, Model
from stackbounce.model import LAWS, ContactLaw, Drop
from stackbounce.run.calibration import calibrate
from stackbounce.run.collision import contact_time

_LOSSY = 0.8  # the restitution that a search begins with
_FACTOR = 30.0  # by which a stiffness may differ from its start value
_FLIGHTS = 4.0  # contact times at the calibration speed: the widest gap that is looked at
_WEAK, _STRONG = 0.05, 0.999  # bounds of a restitution
_EXPONENTS = 0.0, 1.0  # bounds of the power of the speed: known ones are 1/5 to 1


def standard_models(drop: Drop | Drops, *, times: bool = False) -> dict[str, FitProblem]:
    """Return the usual models of a stack, to be compared.

    A model has one set of contacts for all drops, whatever their speeds. The search begins with
    contacts that last as long as the given ones at one speed, the `calibration_speed`: the
    geometric mean of the drops' impact speeds.

    Parameters
    ----------
    drop : Drop, or mapping of str to Drop
        With contacts of finite duration, about as long as the true ones. Several are drops of the
        same stack, of which the upper balls may be missing; they share all varied numbers.
    times : bool, optional
        Whether times were measured. Without them the data determine only ratios of stiffnesses, so
        the floor's stiffness is not varied.

    Returns
    -------
    dict of str to FitProblem
        The rigid laws with one restitution and with one for each contact, then the `usual_models`
        of all laws: first those without loss, then those with a rate-independent loss, then the
        others. Rigid laws whose restitution depends on the speed also vary its power.
        Models of finite contacts vary stiffnesses, and gaps unless the drops differ in them. Lossy
        ones also vary one loss parameter that all contacts share. A model with nothing to vary is
        left out, such as `Spring` for a ball alone without times.

    Raises
    ------
    InvalidValue
        If a drop has no floor or rigid contacts, of which no contact time is known, or if drops
        have different masses or contacts at the same place.

    Examples
    --------
    >>> import stackbounce as sb
    >>> springs = [sb.Spring(2500.0), sb.Spring(1000.0)]
    >>> drop = sb.Drop([sb.Ball(0.150), sb.Ball(0.057)], springs, impact_speed=3.53)
    >>> list(standard_models(drop)["Spring"].vary)
    ['contacts.1.stiffness', 'gaps.0']
    """
    drops = FitProblem(drop).drops
    stack, speed = _whole_stack(drops), calibration_speed(drops)
    known = [_measured(stack, i, speed) for i in range(len(stack.contacts))]
    widest = _FLIGHTS * speed * max(contact["contact_time"] for contact in known)
    known_gaps = len({drop.gaps for drop in drops.values() if len(drop.gaps) == len(stack.gaps)})
    gaps = {f"gaps.{i}": (0.0, widest) for i in range(len(stack.gaps)) if known_gaps == 1}
    models: dict[str, FitProblem] = {}
    for name, law_class, numbers, shared in _usual(len(known)):
        given = {"restitution": _LOSSY, **numbers} if law_class.loss else numbers
        contacts = [calibrate(law_class, **contact, **given) for contact in known]
        vary, tie = _numbers(contacts, times, shared)
        if times or not law_class.rigid:  # in rigid collisions a gap changes only the times
            vary |= gaps
        if vary:
            changed = {
                key: replace(own, contacts=contacts[: len(own.balls)]) for key, own in drops.items()
            }
            models[name] = Model(changed, vary, tie)
    return models


def usual_model(problem: FitProblem) -> FitProblem:
    """Return a problem with the model of a stack that the paper ends with, `Hysteretic`.

    It varies the ratio of the stiffnesses, the gaps, and one restitution of all contacts.
    """
    return replace(standard_models(problem.drops)["Hysteretic"], data=problem.data)


def calibration_speed(drops: Drops) -> float:
    """Return the geometric mean of the drops' impact speeds in m/s.

    Examples
    --------
    >>> import stackbounce as sb
    >>> slow, fast = (sb.Drop([sb.Ball(1.0)], [sb.Spring(1.0)], impact_speed=v) for v in (1, 4))
    >>> round(calibration_speed({"slow": slow, "fast": fast}), 9)
    2.0
    """
    return geometric_mean(drop.reference_speed for drop in drops.values())


def _whole_stack(drops: Drops) -> Drop:
    """Return the drop with the most balls, after a check that the others are parts of its stack."""
    whole = max(drops.values(), key=lambda drop: len(drop.balls))
    if whole.rigid or whole.contacts[0] is None:
        raise InvalidValue(
            "drop must have finite contacts, the floor's among them, for the usual models: Rigid "
            "ones tell no contact time"
        )
    for key, drop in drops.items():
        for i, (ball, law) in enumerate(zip(drop.balls, drop.contacts, strict=True)):
            if ball.mass != whole.balls[i].mass or law != whole.contacts[i]:
                raise InvalidValue(
                    "drops must be of the same stack for the usual models, which have one set of "
                    f"contacts: {key} has another mass or contact at place {i}; compare those "
                    "drops apart, or give models of your own"
                )
    return whole


def _usual(count: int) -> Iterator[tuple[str, type[ContactLaw], Mapping[str, float], bool]]:
    """Yield name, law, arguments of `calibrate`, and whether the contacts share a restitution."""
    for law in sorted(
        LAWS.values(), key=lambda law: (not law.rigid, bool(law.loss), not law.rate_free)
    ):
        if law.rigid:
            yield f"{law.__name__}, one restitution", law, {}, True
            if count > 1:
                yield f"{law.__name__}, one for each contact", law, {}, False
        for name, numbers in law.usual_models.items():
            yield name, law, numbers, True


def _numbers(
    contacts: Sequence[ContactLaw], times: bool, shared: bool
) -> tuple[dict[str, Any], dict[str, str]]:
    """Return the varied numbers of contacts of one law, and the ties between them."""
    first, places = contacts[0], range(len(contacts))
    vary: dict[str, Any] = {}
    if not first.rigid:
        for i in places if times else places[1:]:
            k = contacts[i].stiffness
            vary[f"contacts.{i}.stiffness"] = (k / _FACTOR, k * _FACTOR)
    bounds: dict[str, tuple[float, float]] = {}
    if first.loss == "restitution":
        bounds["restitution"] = (_WEAK, 1.0 if first.rigid else _STRONG)
    elif first.loss:
        loss = getattr(first, first.loss)
        bounds[first.loss] = (loss / _FACTOR, loss * _FACTOR)
    if not shared:
        vary |= {f"contacts.{i}.restitution": bounds["restitution"] for i in places}
        del bounds["restitution"]
    if "speed_exponent" in first.quantities():
        bounds["speed_exponent"] = _EXPONENTS
    return vary | bounds, {f"contacts.{i}.{name}": name for name in bounds for i in places}


def _measured(stack: Drop, i: int, speed: float) -> dict[str, Any]:
    """Return masses and contact time of a contact alone at a speed, as `calibrate` takes them."""
    law: Any = stack.contacts[i]
    upper = stack.balls[i].mass
    mass = (stack.balls[i - 1].mass, upper) if i else upper
    lasts = float(contact_time(law, mass, speed))
    return {"mass": mass, "impact_speed": speed, "contact_time": lasts}
