"""The audit's checks: each claim of the paper, beside what its function computes.

The claims stand in ``claims.toml``, and the functions in the modules ``checks_*``. Running a check
on a bench gives a row: the computed value, the verdict, the source of the function, and the library
calls and the inputs that the bench recorded.
"""

import ast
import inspect
import linecache
import textwrap
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from decimal import Decimal
from typing import Any

from stackbounce.cross2007.bench import Bench, Claim, Data, Reading, propagate_error, write_call

AGREES = "agrees"
WITHIN_ERROR = "agrees within error"
DIFFERS = "differs"

SCALES = {"": 1.0, "%": 1e-2, "ms": 1e-3, "mm": 1e-3, "m": 1.0, "m/s": 1.0, "J": 1.0, "N/m": 1.0}
"""The size of an audit unit in SI units."""

_OF_CLAIM = ("id", "where", "what", "printed", "digits", "unit", "reason")

Compute = Callable[[Bench], Any]
"""Computes a number, of Python or of a numpy array."""


@dataclass(frozen=True)
class Attempt:
    """Another reading of a printed number: its assumption, computed value and verdict."""

    reading: str
    number: str
    computed: float
    verdict: str
    source: str


@dataclass(frozen=True)
class Row:
    """A printed number beside the computed one; see `Claim` for the first five.

    ``number`` is the printed value and ``tolerance`` half a unit in its last digit. ``error`` is
    the standard error that follows from the inputs, in `unit`.
    ``source`` is the text of the function that computed the number, ``calls`` are the library calls
    that it made and ``inputs`` the keys of the data that it read.
    """

    id: str
    where: str
    what: str
    printed: str
    digits: str
    number: float
    unit: str
    computed: float
    tolerance: float
    error: float
    verdict: str
    reason: str
    attempts: tuple[Attempt, ...]
    source: str
    calls: tuple[str, ...]
    inputs: tuple[str, ...]

    @property
    def explained(self) -> bool:
        """Return whether the number agrees, or has a reason and a reading that agrees."""
        others = (attempt.verdict for attempt in self.attempts)
        return any(verdict != DIFFERS for verdict in (self.verdict, *others))


def run_check(claim: Claim, compute: Compute, readings: Sequence[Compute], data: Data) -> Row:
    """Return the row of a claim.

    Parameters
    ----------
    claim : Claim
        The printed number.
    compute : callable
        Computes it, in SI units, on a bench.
    readings : sequence of callable
        Compute its other readings, in the order of `Claim.readings`.
    data : mapping of str to Input
        The paper's numbers.

    Returns
    -------
    Row
    """
    computed, error, verdict, bench = _compared(claim, claim.digits, compute, data)
    return Row(
        **{name: getattr(claim, name) for name in _OF_CLAIM},
        number=float(claim.digits),
        computed=computed,
        tolerance=_tolerance(claim, claim.digits),
        error=error,
        verdict=verdict,
        attempts=tuple(
            _attempt(claim, reading, other, data)
            for reading, other in zip(claim.readings, readings, strict=True)
        ),
        source=source_of(compute),
        calls=tuple(dict.fromkeys(write_call(drop) for drop in bench.drops)),
        inputs=tuple(bench.read),
    )


def half_unit(number: str) -> float:
    """Return half a unit in the last printed digit.

    Parameters
    ----------
    number : str
        Such as ``"2.64"`` or ``"5.4e4"``.

    Returns
    -------
    float

    Examples
    --------
    >>> half_unit("2.64"), half_unit("5.4e4"), half_unit("106")
    (0.005, 500.0, 0.5)
    """
    return float(Decimal(5).scaleb(last_place(number) - 1))


def last_place(number: str) -> int:
    """Return the power of ten of the last printed digit."""
    exponent = Decimal(number).as_tuple().exponent
    assert isinstance(exponent, int)
    return exponent


def source_of(function: Callable[..., object]) -> str:
    """Return what a function computes as Python text, without its name, arguments and docstring.

    Parameters
    ----------
    function : callable
        A function or a lambda, the only one that begins on its line of a file.

    Returns
    -------
    str
        A single ``return`` is reduced to what it returns. Names that are taken from an enclosing
        function are replaced by their values.

    Examples
    --------
    >>> source_of(half_unit)
    'float(Decimal(5).scaleb(last_place(number) - 1))'
    >>> def bounce_of(ball):
    ...     return lambda b: b(f"{ball}.rebound_height")
    >>> source_of(bounce_of("tennis"))
    "b('tennis.rebound_height')"
    """
    fill = _Filled(inspect.getclosurevars(function).nonlocals).visit
    if function.__name__ == "<lambda>":
        return ast.unparse(fill(_lambda(function).body))
    definition = ast.parse(textwrap.dedent(inspect.getsource(function))).body[0]
    assert isinstance(definition, ast.FunctionDef)
    first = 0 if ast.get_docstring(definition) is None else 1
    lines = [ast.unparse(fill(statement)) for statement in definition.body[first:]]
    return "\n".join(lines) if len(lines) > 1 else lines[0].removeprefix("return ")


def _lambda(function: Any) -> ast.Lambda:
    """Return the syntax tree of a lambda."""
    code = function.__code__
    module = ast.parse("".join(linecache.getlines(code.co_filename)))
    lambdas = (node for node in ast.walk(module) if isinstance(node, ast.Lambda))
    (found,) = (node for node in lambdas if node.lineno == code.co_firstlineno)
    return found


class _Filled(ast.NodeTransformer):
    """Replaces a name that stands for a function by its name, any other by its value."""

    def __init__(self, values: Mapping[str, Any]) -> None:
        self.values = values

    def visit_Name(self, node: ast.Name) -> ast.expr:
        if node.id not in self.values:
            return node
        value = self.values[node.id]
        return ast.Name(value.__name__) if callable(value) else ast.Constant(value)

    def visit_JoinedStr(self, node: ast.JoinedStr) -> ast.expr:
        self.generic_visit(node)
        parts = [
            part.value if isinstance(part, ast.FormattedValue) else part for part in node.values
        ]
        texts = [str(part.value) for part in parts if isinstance(part, ast.Constant)]
        return ast.Constant("".join(texts)) if len(texts) == len(parts) else node


def _attempt(claim: Claim, reading: Reading, compute: Compute, data: Data) -> Attempt:
    number = reading.number or claim.digits
    computed, _, verdict, _ = _compared(claim, number, compute, data)
    return Attempt(reading.text, number, computed, verdict, source_of(compute))


def _compared(
    claim: Claim, number: str, compute: Compute, data: Data
) -> tuple[float, float, str, Bench]:
    """Return the computed number, its error, the verdict, and the bench that it was made on."""
    bench = Bench(data)
    scale = SCALES[claim.unit]
    computed = float(compute(bench)) / scale
    error = 0.0 if claim.counted else propagate_error(compute, data, bench.read) / scale
    verdict = _verdict(computed, float(number), _tolerance(claim, number), error)
    return computed, error, verdict, bench


def _tolerance(claim: Claim, number: str) -> float:
    return 0.0 if claim.counted else half_unit(number)


def _verdict(computed: float, number: float, tolerance: float, error: float) -> str:
    distance = abs(computed - number)
    if distance <= tolerance * (1.0 + 1e-9):
        return AGREES
    # with an error as large as the number itself, every value would pass
    return WITHIN_ERROR if error < abs(number) and distance <= tolerance + error else DIFFERS
