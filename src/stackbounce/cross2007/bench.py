"""The bench: access to the paper's data and to the solver, with a record of what was used.

Every row of the audit, every table and every figure is computed on a bench. It records which
numbers are read and which drops are simulated. The inputs and library calls that a row shows are
this record.
"""

from collections.abc import Callable
from dataclasses import MISSING, fields, is_dataclass, replace
from functools import lru_cache
from typing import TYPE_CHECKING, Any

from stackbounce.cross2007.data import Data
from stackbounce.model.drop import Drop
from stackbounce.run.driver import simulate
from stackbounce.run.result import Result

if TYPE_CHECKING:
    from uncertainties import UFloat


class Bench:
    """The paper's numbers by key, and the solver.

    Parameters
    ----------
    data : mapping of str to Input
        The paper's numbers.

    Examples
    --------
    >>> from stackbounce.cross2007.data import PAPER
    >>> bench = Bench(PAPER)
    >>> bench("tennis.mass"), bench.read
    (0.057, ['tennis.mass'])
    """

    def __init__(self, data: Data) -> None:
        self.data = data
        self.read: list[str] = []
        self.drops: list[Drop] = []

    def __call__(self, key: str) -> float:
        """Return a number of the paper in SI units."""
        if key not in self.read:
            self.read.append(key)
        return self.data[key].value

    def measured(self, key: str) -> "UFloat":
        """Return a number of the paper with its error, in SI units."""
        from uncertainties import ufloat

        return ufloat(self(key), self.data[key].spread)

    def simulate(self, drop: Drop) -> Result:
        """Simulate a drop and record it."""
        self.drops.append(drop)
        return _simulated(drop)


@lru_cache(maxsize=8192)
def _simulated(drop: Drop) -> Result:
    return simulate(drop)


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
    derived = getattr(value, "derived", None)
    given = []
    for field in fields(value):
        content = getattr(value, field.name)
        default = None if field.default is MISSING else field.default
        empty = field.name == "gaps" and not any(content)
        if field.init and field.name != derived and content != default and not empty:
            given.append(f"{field.name}={_text(content)}")
    return f"sb.{type(value).__name__}({', '.join(given)})"


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
    >>> from stackbounce.cross2007.data import PAPER
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
