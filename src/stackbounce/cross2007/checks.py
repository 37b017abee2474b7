"""The audit's checks: each number that the paper prints, and the function that computes it.

A check has the place of a number in the paper, its printed form and its function. Running a check
on a bench gives a row: the computed value, the verdict, the source of the function, and the library
calls and the inputs that the bench recorded.
"""

import ast
import inspect
import linecache
import math
import textwrap
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from decimal import Decimal
from typing import Any, TypeAlias

from stackbounce.cross2007.bench import Bench, propagate_error, write_call
from stackbounce.cross2007.data import Data

AGREES = "agrees"
WITHIN_ERROR = "agrees within error"
DIFFERS = "differs"

SCALES = {"": 1.0, "%": 1e-2, "ms": 1e-3, "mm": 1e-3, "m": 1.0, "m/s": 1.0, "J": 1.0, "N/m": 1.0}
"""The size of an audit unit in SI units."""

Number: TypeAlias = float | Any
"""A number, of Python or of a numpy array."""

Compute = Callable[[Bench], Number]


@dataclass(frozen=True)
class Check:
    """A printed number and how to compute it.

    Parameters
    ----------
    id : str
        Its name.
    where : str
        Section, figure or table.
    what : str
        What it is.
    printed : str
        As printed, without the unit.
    number : str
        The same in digits; the tolerance follows from its last one.
    unit : str
        A key of `SCALES`.
    compute : callable
        Computes the number, in SI units, on a bench.
    counted : bool
        Whether it is a count, which must be equal.
    stated : float
        The error in `unit` that the paper states for the printed number, or 0.
    reason : str
        The reason for a difference, or a remark on an agreement.
    others : tuple of (str, str, callable)
        Other readings: the assumption, the digits to compare with, and the computation.
    """

    id: str
    where: str
    what: str
    printed: str
    number: str
    unit: str
    compute: Compute
    counted: bool = False
    stated: float = 0.0
    reason: str = ""
    others: tuple[tuple[str, str, Compute], ...] = ()


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
    """A printed number beside the computed one; see `Check` for the first five.

    ``number`` is the printed value and ``tolerance`` half a unit in its last digit. ``error`` is
    the standard error that follows from the inputs and from the printed number itself, in `unit`.
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
        """Whether the number agrees, or has a reason and a reading that agrees."""
        if self.verdict != DIFFERS:
            return True
        return bool(self.attempts) and any(attempt.verdict != DIFFERS for attempt in self.attempts)


@dataclass
class Section:
    """The checks of one section of the paper, in the order of its text.

    Examples
    --------
    >>> section = Section("Sec. I")
    >>> @section.check("nine", "bounce over drop height", "9")
    ... def nine(bench):
    ...     return 9.0
    >>> section.checks[0].id, section.checks[0].where
    ('nine', 'Sec. I')
    """

    where: str
    checks: list[Check] = field(default_factory=list)

    def check(
        self,
        name: str,
        what: str,
        printed: str,
        unit: str = "",
        *,
        number: str = "",
        counted: bool = False,
        stated: float = 0.0,
        where: str = "",
        reason: str = "",
    ) -> Callable[[Compute], Compute]:
        """Return a decorator that adds a check; see `Check` for the arguments."""

        def add(compute: Compute) -> Compute:
            digits = number or printed
            place = where or self.where
            self.checks.append(
                Check(name, place, what, printed, digits, unit, compute, counted, stated, reason)
            )
            return compute

        return add

    def other(self, reading: str, compute: Compute, *, number: str = "") -> None:
        """Add another reading to the latest check: what it assumes and how it is computed."""
        latest = self.checks[-1]
        more = (reading, number or latest.number, compute)
        self.checks[-1] = replace(latest, others=(*latest.others, more))


def run_check(check: Check, data: Data) -> Row:
    """Return the row of a check.

    Parameters
    ----------
    check : Check
        The printed number and its computation.
    data : mapping of str to Input
        The paper's numbers.

    Returns
    -------
    Row
    """
    computed, error, verdict, bench = _compared(check, check.number, check.compute, data)
    attempts = [_attempt(check, *other, data) for other in check.others]
    return Row(
        id=check.id,
        where=check.where,
        what=check.what,
        printed=check.printed,
        digits=check.number,
        number=float(check.number),
        unit=check.unit,
        computed=computed,
        tolerance=_tolerance(check, check.number),
        error=error,
        verdict=verdict,
        reason=check.reason,
        attempts=tuple(attempts),
        source=source_of(check.compute),
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
    return float(_last_digit(number) / 2)


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
    'float(_last_digit(number) / 2)'
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
    body = definition.body
    if ast.get_docstring(definition) is not None:
        body = body[1:]
    last = body[-1]
    if len(body) == 1 and isinstance(last, ast.Return) and last.value is not None:
        return ast.unparse(fill(last.value))
    return "\n".join(ast.unparse(fill(statement)) for statement in body)


def _lambda(function: Any) -> ast.Lambda:
    """Return the syntax tree of a lambda."""
    code = function.__code__
    module = ast.parse("".join(linecache.getlines(code.co_filename)))
    (found,) = (
        node
        for node in ast.walk(module)
        if isinstance(node, ast.Lambda) and node.lineno == code.co_firstlineno
    )
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


def _attempt(check: Check, reading: str, number: str, compute: Compute, data: Data) -> Attempt:
    computed, _, verdict, _ = _compared(check, number, compute, data)
    return Attempt(reading, number, computed, verdict, source_of(compute))


def _compared(
    check: Check, number: str, compute: Compute, data: Data
) -> tuple[float, float, str, Bench]:
    """Return the computed number, its error, the verdict, and the bench that it was made on."""
    bench = Bench(data)
    scale = SCALES[check.unit]
    computed = float(compute(bench)) / scale
    spread = 0.0 if check.counted else propagate_error(compute, data, bench.read) / scale
    error = math.hypot(spread, check.stated)
    verdict = _verdict(computed, float(number), _tolerance(check, number), error)
    return computed, error, verdict, bench


def _tolerance(check: Check, number: str) -> float:
    return 0.0 if check.counted else half_unit(number)


def _verdict(computed: float, number: float, tolerance: float, error: float) -> str:
    distance = abs(computed - number)
    if distance <= tolerance * (1.0 + 1e-9):
        return AGREES
    # with an error as large as the number itself, every value would pass
    telling = error < abs(number)
    return WITHIN_ERROR if telling and distance <= tolerance + error else DIFFERS


def _last_digit(number: str) -> Decimal:
    exponent = Decimal(number).as_tuple().exponent
    assert isinstance(exponent, int)
    return Decimal(1).scaleb(exponent)
