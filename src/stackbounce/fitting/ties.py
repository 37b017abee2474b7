"""Numbers of a drop that follow from others: formulas of what is varied."""

import math
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from stackbounce.errors import InvalidType, InvalidValue, nearest, shown
from stackbounce.fitting.formula import Formula, read_formula
from stackbounce.fitting.parameters import Parameter, current, paths, places
from stackbounce.model import Drop
from stackbounce.run.paths import Number, numbers_of

__all__ = ["Tie", "read_ties", "tied"]

Array: TypeAlias = NDArray[np.float64]


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
        How it was written.
    uses : frozenset of str, or None
        The names in it; None for a function of Python, which may use any.

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


def read_ties(
    drops: Mapping[str, Drop], parameters: Sequence[Parameter], given: object
) -> tuple[Tie, ...]:
    """Return the ties, checked.

    Parameters
    ----------
    drops : mapping of str to Drop
        By their names.
    parameters : sequence of Parameter
        What is varied.
    given : mapping or None
        By the number that follows: a formula such as ``"4/3 * modulus * sqrt(balls.0.diameter/2)"``
        of what is varied and of numbers of the same drop, tied ones too, or a function of Python
        that takes a mapping of names to arrays. A number without a drop's name is that of every
        drop.

    Returns
    -------
    tuple of Tie

    Raises
    ------
    InvalidValue
        If a name is unknown, a formula cannot be read or needs itself, or a number is tied twice,
        or both varied and tied.
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
    varied = {(key, number.path) for one in parameters for key, number in places(drops, one.name)}
    places_of = {name: places(drops, name) for name in given if isinstance(name, str)}
    follow = [(key, number.path) for at in places_of.values() for key, number in at]
    found: list[Tie] = []
    for name, formula in given.items():
        at = places_of.get(name, [])
        if not at:
            right = nearest(name, paths(drops))
            raise InvalidValue(f"tie: {shown(name)} is no number of the drop; {right}")
        for key, number in at:
            if (key, number.path) in varied:
                raise InvalidValue(f"{name} is both varied and tied: only one of the two")
            if follow.count((key, number.path)) > 1:
                raise InvalidValue(f"{name} is tied twice: only once for each drop")
            found.append(_tie(drops[key], key, number, parameters, formula))
    told = varied.union(follow)
    for tie in found:
        _check_told(drops[tie.drop], tie, {path for key, path in told if key == tie.drop})
    _check_used(drops, parameters, found)
    return tuple(
        tie for key in drops for tie in _in_order([one for one in found if one.drop == key])
    )


def tied(
    ties: Sequence[Tie], numbers: Mapping[str, float], values: Mapping[str, Array]
) -> dict[str, Array]:
    """Return the numbers of one drop that follow, by path.

    Parameters
    ----------
    ties : sequence of Tie
        Those of the drop, each after those that it needs.
    numbers : mapping of str to float
        All numbers of the drop by path.
    values : mapping of str to ndarray
        What is varied, by name, and the drop's varied numbers by path: (n,) each.

    Raises
    ------
    InvalidValue
        If a formula fails or gives something else than finite numbers.
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
        name = getattr(formula, "__name__", "a function")
        return Tie(key, number, formula, name, None)
    known = {one.name for one in parameters} | set(numbers_of(drop))
    run, uses = read_formula(formula, known, number.path)
    return Tie(key, number, run, str(formula), uses)


def _check_told(drop: Drop, tie: Tie, told: Collection[str]) -> None:
    """Refuse a formula of a number that neither the drop nor the fit has."""
    numbers = numbers_of(drop)
    for word in sorted((tie.uses or frozenset()) & set(numbers) - set(told)):
        if math.isnan(current(drop, numbers[word])):
            raise InvalidValue(f"tie: {tie.number.path} needs {word}, which the drop does not tell")


def _in_order(ties: Sequence[Tie]) -> list[Tie]:
    """Return the ties of one drop, each after those that it needs."""
    left, found = list(ties), []
    while left:
        waiting = {tie.number.path for tie in left}
        ready = next((tie for tie in left if not (tie.uses or set()) & waiting), None)
        if ready is None:
            circle = ", ".join(f"{tie.number.path} = {tie.text}" for tie in left)
            raise InvalidValue(f"tie: none of these can come first, they go round: {circle}")
        left.remove(ready)
        found.append(ready)
    return found


def _check_used(
    drops: Mapping[str, Drop], parameters: Sequence[Parameter], ties: Sequence[Tie]
) -> None:
    """Refuse a varied number of the user's own that nothing follows from."""
    for one in parameters:
        used = any(tie.uses is None or one.name in tie.uses for tie in ties)
        if not places(drops, one.name) and not used:
            raise InvalidValue(
                f"{one.name[:60]} is neither a number of the drop nor used by a tie; "
                f"{nearest(one.name, paths(drops))}"
            )
