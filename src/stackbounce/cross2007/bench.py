"""The paper's data and claims, and the bench: access to the data and the solver, with a record.

The claims are the numbers that the paper prints, from ``claims.toml``: where, what, and why one
differs.

The data stand in ``numbers.csv``. Values are in SI units. ``printed`` is the number as the paper
gives it. ``spread`` is the error that the paper states, or half a unit in the last printed digit if
that is larger or no error is stated.

A spread of 0 marks a number that the paper chooses for a calculation: Fig. 5's masses and springs,
and the restitutions in eqs 1 to 4. Some of these come from a fit; the audit's row says so if their
rounding matters (71 % with e = 0.92).

Every row of the audit, every table and every figure is computed on a bench. It records which
numbers are read, which drops are simulated, and which curves are computed. The inputs and library
calls that a row shows, and the data of a figure, are this record.
"""

import csv
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, is_dataclass, replace
from functools import lru_cache
from types import MappingProxyType
from typing import Any, NamedTuple

from stackbounce.files import shipped, shipped_table
from stackbounce.library_types import Dataset, UFloat
from stackbounce.model.drop import Drop
from stackbounce.run.driver import simulate
from stackbounce.run.result import Result
from stackbounce.shown import call_of


@dataclass(frozen=True)
class Input:
    """One number that the paper gives.

    Parameters
    ----------
    key : str
        Its name in this package, such as ``"tennis.mass"``.
    printed : str
        As printed, with its unit.
    value : float
        In SI units.
    unit : str
        The SI unit; empty for a plain ratio.
    spread : float
        Its error in `unit`, see the module's text.
    where : str
        Section, table or figure.
    what : str
        What it is.
    """

    key: str
    printed: str
    value: float
    unit: str
    spread: float
    where: str
    what: str


Data = Mapping[str, Input]
"""The paper's numbers by key."""


def changed(data: Data, key: str, factor: float) -> Data:
    """Return the data with one value multiplied.

    Parameters
    ----------
    data : mapping of str to Input
        The data to start from.
    key : str
        The number to change.
    factor : float
        The factor.

    Returns
    -------
    mapping of str to Input

    Raises
    ------
    KeyError
        If the key is unknown.

    Examples
    --------
    >>> heavier = changed(PAPER, "tennis.mass", 1.01)
    >>> round(heavier["tennis.mass"].value, 5)
    0.05757
    """
    old = data[key]
    return MappingProxyType({**data, key: replace(old, value=old.value * factor)})


def _read_numbers() -> Iterator[Input]:
    """Yield the rows of ``numbers.csv``, in the order of the paper."""
    text = shipped(__package__, "numbers.csv")
    for key, printed, value, unit, spread, where, what in [*csv.reader(text.splitlines())][1:]:
        yield Input(key, printed, float(value), unit, float(spread), where, what)


PAPER: Data = MappingProxyType({number.key: number for number in _read_numbers()})
"""The paper's numbers by key, in the order of the paper."""


class Bench:
    """The paper's numbers by key, and the solver.

    Parameters
    ----------
    data : mapping of str to Input
        The paper's numbers.

    Examples
    --------
    >>> from stackbounce.cross2007.bench import PAPER
    >>> bench = Bench(PAPER)
    >>> bench("tennis.mass"), bench.read
    (0.057, ['tennis.mass'])
    """

    def __init__(self, data: Data) -> None:
        self.data = data
        self.read: list[str] = []
        self.drops: list[Drop] = []
        self.curves: list[Dataset] = []

    def __call__(self, key: str) -> float:
        """Return a number of the paper in SI units."""
        if key not in self.read:
            self.read.append(key)
        return self.data[key].value

    def measured(self, key: str) -> UFloat:
        """Return a number of the paper with its error, in SI units."""
        from uncertainties import ufloat

        return ufloat(self(key), self.data[key].spread)

    def simulate(self, drop: Drop) -> Result:
        """Simulate a drop and record it."""
        self.drops.append(drop)
        return _simulated(drop)


_simulated = lru_cache(maxsize=8192)(simulate)


def write_call(drop: Drop) -> str:
    """Return the Python text of the library call that simulates a drop.

    Parameters
    ----------
    drop : Drop
        The simulated drop.

    Returns
    -------
    str
        An expression that gives the same result if ``sb`` is the package.

    Examples
    --------
    >>> from stackbounce.model.ball import Ball
    >>> from stackbounce.model.laws import Rigid
    >>> write_call(Drop([Ball(0.057)], [Rigid(0.9)], impact_speed=2))
    'sb.simulate(sb.Drop(balls=[sb.Ball(mass=0.057)], contacts=[sb.Rigid(restitution=0.9)], \
impact_speed=2.0))'
    """
    return f"sb.simulate({_text(drop)})"


def _text(value: Any) -> str:
    if isinstance(value, tuple):
        return f"[{', '.join(_text(member) for member in value)}]"
    if not is_dataclass(value):
        return repr(value)
    empty = () if any(getattr(value, "gaps", ())) else ("gaps",)
    return f"sb.{call_of(value, getattr(value, 'derived', ''), *empty, write=_text)}"


def propagate_error(compute: Callable[[Bench], float], data: Data, keys: list[str]) -> float:
    """Return the standard error of a computed number, propagated from the errors of its inputs.

    Parameters
    ----------
    compute : callable
        Computes the number on a bench.
    data : mapping of str to Input
        The paper's numbers.
    keys : list of str
        The inputs that the number depends on.

    Returns
    -------
    float
        One standard deviation, from `uncertainties` with numerical derivatives.

    Examples
    --------
    >>> from stackbounce.cross2007.bench import PAPER
    >>> error = propagate_error(lambda b: 2.0 * b("tennis.mass"), PAPER, ["tennis.mass"])
    >>> round(error, 6)
    0.001
    """
    from uncertainties import ufloat, wrap

    uncertain = [key for key in keys if data[key].spread > 0.0]
    if not uncertain:
        return 0.0

    def at(*values: float) -> float:
        moved = dict(data)
        for key, value in zip(uncertain, values, strict=True):
            moved[key] = replace(data[key], value=value)
        return compute(Bench(moved))

    result = wrap(at)(*(ufloat(data[key].value, data[key].spread) for key in uncertain))
    return float(result.std_dev)


class Reading(NamedTuple):
    """Another reading of a claim: what it assumes, and the number to compare with, in digits.

    That number is by default the one of the claim.
    """

    text: str
    number: str = ""


@dataclass(frozen=True)
class Claim:
    """A number that the paper prints.

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
        The same in digits, by default `printed`; the tolerance follows from its last one.
    unit : str
        A key of `SCALES`.
    counted : bool
        Whether it is a count, which must be equal.
    reason : str
        The reason for a difference, or a remark on an agreement.
    readings : tuple of Reading
        Other readings of it.
    """

    id: str
    where: str
    what: str
    printed: str
    number: str = ""
    unit: str = ""
    counted: bool = False
    reason: str = ""
    readings: tuple[Reading, ...] = ()

    @property
    def digits(self) -> str:
        """The printed number in digits."""
        return self.number or self.printed


def _read_claims() -> dict[str, Claim]:
    read = shipped_table(__package__, "claims.toml")
    claims = {}
    for name, entry in read["claims"].items():
        reason = entry.pop("reason", "").format(**read["reasons"])
        readings = tuple(Reading(*found) for found in entry.pop("readings", ()))
        claims[name] = Claim(name, reason=reason, readings=readings, **entry)
    return claims


CLAIMS: Mapping[str, Claim] = MappingProxyType(_read_claims())
"""The claims by name, in the order of the paper.

Examples
--------
>>> CLAIMS["II.ten_springs"].printed
'1.13'
"""
