"""Ties: numbers of a drop that follow from others by a formula."""

import math
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from stackbounce.errors import InvalidType, InvalidValue, nearest, shown
from stackbounce.fitting.formula import Formula, read_formula
from stackbounce.fitting.parameters import Drops, Parameter, find_numbers, list_paths
from stackbounce.model import Drop
from stackbounce.run.paths import Number, numbers_of, value_in
from stackbounce.run.quantities import Array


@dataclass(frozen=True)
class Tie:
    """A number of one drop that follows from others.

    Parameters
    ----------
    drop : str
        Of which drop.
    number : Number
        Which number.
    formula : callable
        Takes the values by name, as arrays; returns an array.
    text : str
        The formula as it was written.
    uses : frozenset of str, or None
        The names in the formula; None for a Python function, which may use any.

    Examples
    --------
    >>> Tie("", Number("gaps.0", "gaps", 0, "", "m"), lambda v: v["gap"], "gap", None).text
    'gap'
    """

    drop: str
    number: Number
    formula: Formula
    text: str
    uses: frozenset[str] | None


def read_ties(drops: Drops, parameters: Sequence[Parameter], given: object) -> tuple[Tie, ...]:
    """Check what follows from other numbers and return it as ties.

    Parameters
    ----------
    drops : mapping of str to Drop
        By their names.
    parameters : sequence of Parameter
        What is varied.
    given : mapping or None
        By the path of the number that follows: a formula such as
        ``"4/3 * modulus * sqrt(balls.0.diameter/2)"`` of varied numbers and of numbers of the same
        drop (tied ones too), or a Python function that takes a mapping of names to arrays. A path
        without a drop's name stands for every drop.

    Returns
    -------
    tuple of Tie

    Raises
    ------
    InvalidValue
        If a name is unknown, a formula cannot be read, formulas depend on each other in a circle,
        or a number is tied twice, or both varied and tied.
    InvalidType
        If something has the wrong type.

    Examples
    --------
    >>> import stackbounce as sb
    >>> drop = sb.Drop([sb.Ball(1.0)], [sb.Spring(1.0)], height=1.0)
    >>> k = Parameter("k", 1.0, 9.0, None, "")
    >>> [tie.text for tie in read_ties({"": drop}, [k], {"contacts.0.stiffness": "2 * k"})]
    ['2 * k']
    """
    if given is None:
        given = {}
    if not isinstance(given, Mapping):
        raise InvalidType(f"tie must map numbers to formulas, got {shown(given)}")
    varied = {place for parameter in parameters for place in find_numbers(drops, parameter.name)}
    places_of = {name: find_numbers(drops, name) for name in given if isinstance(name, str)}
    follow = [place for places in places_of.values() for place in places]
    found: list[Tie] = []
    for name, formula in given.items():
        places = places_of.get(name, [])
        if not places:
            right = nearest(name, list_paths(drops))
            raise InvalidValue(f"tie: {shown(name)} is not a parameter of the drop; {right}")
        for place in places:
            if place in varied:
                raise InvalidValue(f"{name} is both varied and tied: only one of the two")
            if follow.count(place) > 1:
                raise InvalidValue(f"{name} is tied twice: only once for each drop")
            found.append(_tie(drops[place[0]], *place, parameters, formula))
    for tie in found:
        given_here = {number.path for key, number in varied.union(follow) if key == tie.drop}
        _check_given(drops[tie.drop], tie, given_here)
    _check_used(drops, parameters, found)
    return tuple(
        tie for key in drops for tie in _in_order([own for own in found if own.drop == key])
    )


def evaluate_ties(
    ties: Sequence[Tie], numbers: Mapping[str, float], values: Mapping[str, Array]
) -> dict[str, Array]:
    """Return the tied numbers of one drop by path, (n,) each.

    Parameters
    ----------
    ties : sequence of Tie
        The ties of the drop, each after those that it uses.
    numbers : mapping of str to float
        All numbers of the drop by path.
    values : mapping of str to ndarray
        The varied numbers by parameter name and by path, (n,) each.

    Raises
    ------
    InvalidValue
        If a formula fails, or its result is not a finite number.
    """
    known: dict[str, Any] = {**numbers, **values}
    found: dict[str, Array] = {}
    size = next(iter(values.values())).shape
    for tie in ties:
        try:
            with np.errstate(all="ignore"):
                array = np.broadcast_to(np.asarray(tie.formula(known), dtype=float), size)
        except (ArithmeticError, TypeError, ValueError, LookupError, RecursionError) as error:
            raise InvalidValue(f"tie: {tie.number.path} = {tie.text} fails: {error}") from error
        if not np.all(np.isfinite(array)):
            raise InvalidValue(f"tie: {tie.number.path} = {tie.text} is not always a finite number")
        known[tie.number.path] = found[tie.number.path] = array
    return found


def _tie(
    drop: Drop, key: str, number: Number, parameters: Sequence[Parameter], formula: object
) -> Tie:
    if callable(formula):
        return Tie(key, number, formula, getattr(formula, "__name__", "a function"), None)
    known = {parameter.name for parameter in parameters} | set(numbers_of(drop))
    run, uses = read_formula(formula, known, number.path)
    return Tie(key, number, run, str(formula), uses)


def _check_given(drop: Drop, tie: Tie, given: Collection[str]) -> None:
    """Refuse a formula that uses a number which neither the drop nor the fit gives."""
    numbers = numbers_of(drop)
    for word in sorted((tie.uses or frozenset()) & set(numbers) - set(given)):
        if math.isnan(value_in(drop, numbers[word])):
            raise InvalidValue(f"tie: {tie.number.path} needs {word}, which the drop does not give")


def _in_order(ties: Sequence[Tie]) -> list[Tie]:
    """Return the ties of one drop, each after those that it uses."""
    left, found = list(ties), []
    while left:
        waiting = {tie.number.path for tie in left}
        ready = next((tie for tie in left if not (tie.uses or set()) & waiting), None)
        if ready is None:
            circle = ", ".join(f"{tie.number.path} = {tie.text}" for tie in left)
            raise InvalidValue(f"tie: these depend on each other in a circle: {circle}")
        left.remove(ready)
        found.append(ready)
    return found


def _check_used(drops: Drops, parameters: Sequence[Parameter], ties: Sequence[Tie]) -> None:
    """Refuse a parameter with a user's name that no tie uses."""
    for parameter in parameters:
        used = any(tie.uses is None or parameter.name in tie.uses for tie in ties)
        if not find_numbers(drops, parameter.name) and not used:
            raise InvalidValue(
                f"{parameter.name[:60]} is neither a number of the drop nor used by a tie; "
                f"{nearest(parameter.name, list_paths(drops))}"
            )
