"""Numbers of a drop that follow from others: formulas of what is varied."""

import math
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from stackbounce.errors import InvalidType, InvalidValue, nearest, shown
from stackbounce.fit.parameters import Parameter, current, paths, places
from stackbounce.model import Drop
from stackbounce.sweep.paths import Number, numbers_of

__all__ = ["Tie", "read_ties", "tied"]

Array: TypeAlias = NDArray[np.float64]
Formula: TypeAlias = Callable[[Mapping[str, Array]], Any]

_FUNCTIONS: dict[str, Any] = {
    "sqrt": np.sqrt,
    "exp": np.exp,
    "log": np.log,
    "minimum": np.minimum,
    "maximum": np.maximum,
    "pi": math.pi,
}
_PLAIN = re.compile(r"[\w\s.+*/(),-]*", re.ASCII)
_WORD = re.compile(r"[A-Za-z_]\w*(?:\.\w+)*")


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
    uses : frozenset of str
        The names in it; empty for a function of Python, which may use any.

    Examples
    --------
    >>> Tie("", Number("gaps.0", "gaps", 0, "", "m"), lambda v: v["gap"], "gap", frozenset()).text
    'gap'
    """

    drop: str
    number: Number
    formula: Formula
    text: str
    uses: frozenset[str]


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
        of what is varied and of numbers of the same drop, or a function of Python that takes a
        mapping of names to arrays. A number without a drop's name is that of every drop.

    Returns
    -------
    tuple of Tie

    Raises
    ------
    InvalidValue
        If a name is unknown, a formula cannot be read, or a number is both varied and tied.
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
    found: list[Tie] = []
    for name, formula in given.items():
        at = places(drops, name) if isinstance(name, str) else []
        if not at:
            right = nearest(name, paths(drops))
            raise InvalidValue(f"tie: {shown(name)} is no number of the drop; {right}")
        for key, number in at:
            if (key, number.path) in varied:
                raise InvalidValue(f"{name} is both varied and tied: only one of the two")
            found.append(_tie(drops[key], key, number, parameters, formula))
    _check_used(drops, parameters, found)
    return tuple(found)


def tied(
    ties: Sequence[Tie], numbers: Mapping[str, float], values: Mapping[str, Array]
) -> dict[str, Array]:
    """Return the numbers of one drop that follow, by path, in the order of the ties.

    Parameters
    ----------
    ties : sequence of Tie
        Those of the drop.
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
        except (ArithmeticError, TypeError, ValueError, LookupError) as error:
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
        return Tie(key, number, formula, name, frozenset())
    if not isinstance(formula, str) or not formula.strip() or not _PLAIN.fullmatch(formula):
        raise InvalidType(
            f"tie: {number.path} must have a formula such as '2 * modulus', got {shown(formula)}"
        )
    numbers = numbers_of(drop)
    known = {one.name for one in parameters} | set(numbers)
    uses = frozenset(_WORD.findall(re.sub(r"\b\d+\.?\d*[eE][+-]?\d+", "0", formula)))
    for word in sorted(uses - known - set(_FUNCTIONS)):
        raise InvalidValue(
            f"tie: {number.path} = {shown(formula)} has {word[:60]}, which is neither varied nor a "
            f"number of the drop; {nearest(word, [*sorted(known), *_FUNCTIONS])}"
        )
    for word in sorted(uses & set(numbers)):
        if math.isnan(current(drop, numbers[word])):
            raise InvalidValue(f"tie: {number.path} needs {word}, which the drop does not tell")
    return Tie(key, number, _compiled(formula, number.path, known), formula, uses)


def _compiled(formula: str, path: str, known: set[str]) -> Formula:
    """Return a formula as a function of values by name; asteval alone reads and runs it."""
    from asteval import Interpreter

    names = {name: f"name_{k}" for k, name in enumerate(sorted(known))}
    plain = _WORD.sub(lambda found: names.get(found[0], found[0]), formula)
    reader = Interpreter(symtable=dict(_FUNCTIONS), minimal=True, use_numpy=False)
    try:
        tree = reader.parse(plain)
    except SyntaxError:
        raise InvalidValue(f"tie: {path} = {shown(formula)} cannot be read") from None

    def run(values: Mapping[str, Array]) -> Any:
        reader.symtable.update({names[name]: values[name] for name in known if name in values})
        reader.error = []
        result = reader.run(tree, with_raise=False)
        if reader.error:
            raise ValueError(str(reader.error[0].get_error()[1]).splitlines()[-1])
        return result

    return run


def _check_used(
    drops: Mapping[str, Drop], parameters: Sequence[Parameter], ties: Sequence[Tie]
) -> None:
    """Refuse a varied number of the user's own that nothing follows from."""
    for one in parameters:
        used = any(one.name in tie.uses or not tie.uses for tie in ties)
        if not places(drops, one.name) and not used:
            raise InvalidValue(
                f"{one.name[:60]} is neither a number of the drop nor used by a tie; "
                f"{nearest(one.name, paths(drops))}"
            )
