"""The formulas of ties, parsed into functions of arrays; they can do arithmetic only."""

import ast
import math
import re
import sys
from collections.abc import Callable, Collection, Mapping
from typing import Any, TypeAlias

import numpy as np

from stackbounce.errors import InvalidType, InvalidValue, nearest, shown
from stackbounce.run.quantities import Array

Values: TypeAlias = Mapping[str, Array]
Formula: TypeAlias = Callable[[Values], Any]

_LONGEST = 500  # characters
_TOKEN = re.compile(r"(?a)(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?|(?P<word>[A-Za-z_]\w*(?:\.\w+)*)")
_CONSTANTS = {"pi": math.pi}
_FUNCTIONS = {name: getattr(np, name) for name in ("sqrt", "exp", "log", "minimum", "maximum")}
_SIGNS: dict[type[ast.AST], Any] = {ast.UAdd: np.positive, ast.USub: np.negative}
_OPERATIONS: dict[type[ast.AST], Any] = {
    ast.Add: np.add, ast.Sub: np.subtract, ast.Mult: np.multiply, ast.Div: np.divide,
    ast.Pow: np.power,
}  # fmt: skip
OWN_WORDS = frozenset((*_CONSTANTS, *_FUNCTIONS))
"""The reserved names of formulas: no parameter can have one of them."""


def read_formula(text: object, known: Collection[str], path: str) -> tuple[Formula, frozenset[str]]:
    """Return a formula as a function of values by name, and the names that it uses.

    Parameters
    ----------
    text : str
        Made of numbers, names, ``+ - * / **``, brackets, ``sqrt``, ``exp``, ``log``, ``minimum``,
        ``maximum`` and ``pi``. A name may have dots: ``balls.0.mass``.
    known : collection of str
        The names that it may use.
    path : str
        The number that follows from it, for messages.

    Raises
    ------
    InvalidValue
        If it has an unknown name, or cannot be read.
    InvalidType
        If it is not a text.

    Examples
    --------
    >>> run, uses = read_formula("2 * balls.0.mass ** 2", ["balls.0.mass"], "balls.1.mass")
    >>> run({"balls.0.mass": np.array([1.0, 3.0])}), sorted(uses)
    (array([ 2., 18.]), ['balls.0.mass'])
    """
    if not isinstance(text, str) or not text.strip():
        raise InvalidType(
            f"tie: {path} must have a formula such as '2 * modulus', got {shown(text)}"
        )
    if len(text) > _LONGEST:
        raise InvalidValue(
            f"tie: {path} must have a formula of at most {_LONGEST} characters, got {len(text)}"
        )
    words = {token["word"] for token in _TOKEN.finditer(text) if token["word"]}
    for word in sorted(words - set(known) - OWN_WORDS):
        raise InvalidValue(
            f"tie: {path} = {shown(text)} has {word[:60]}, which is neither varied nor a "
            f"number of the drop; {nearest(word, [*sorted(known), *sorted(OWN_WORDS)])}"
        )
    names = {f"name_{k}": word for k, word in enumerate(sorted(words - OWN_WORDS))}
    inside = {word: name for name, word in names.items()}
    plain = _TOKEN.sub(lambda one: inside.get(one["word"], one[0]), " ".join(text.split()))
    try:
        with np.errstate(all="ignore"):
            node = ast.parse(plain, mode="eval").body
            _evaluate(node, dict.fromkeys(names, 1.0) | _CONSTANTS)
    except (SyntaxError, TypeError, ValueError, RecursionError, MemoryError):
        raise InvalidValue(
            f"tie: {path} = {shown(text)} cannot be read: it may have numbers up to 1e308, names, "
            f"+ - * / **, brackets, {', '.join(sorted(OWN_WORDS))}"
        ) from None

    def run(values: Values) -> Any:
        return _evaluate(node, {name: values[word] for name, word in names.items()} | _CONSTANTS)

    return run, frozenset(names.values())


def _evaluate(node: ast.AST, values: Mapping[str, Any]) -> Any:
    """Return what a part of a formula gives; numbers become floats, which limits their size."""
    match node:
        case ast.Constant(int() | float() as value) if value <= sys.float_info.max:
            return float(value)
        case ast.Name(name) if name in values:
            return values[name]
        case ast.UnaryOp(sign, part) if type(sign) in _SIGNS:
            return _SIGNS[type(sign)](_evaluate(part, values))
        case ast.BinOp(left, operation, right) if type(operation) in _OPERATIONS:
            ends = _evaluate(left, values), _evaluate(right, values)
            return _OPERATIONS[type(operation)](*ends)
        case ast.Call(ast.Name(name), parts, []) if name in _FUNCTIONS:
            return _FUNCTIONS[name](*[_evaluate(part, values) for part in parts])
    raise ValueError(f"no part of a formula: {type(node).__name__}")
