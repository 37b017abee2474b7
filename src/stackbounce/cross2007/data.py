"""The paper's data: all input numbers of the audit, the tables and the figures.

The numbers stand in ``numbers.csv``. Values are in SI units. ``printed`` is the number as the paper
gives it. ``spread`` is the error that the paper states, or half a unit in the last printed digit if
that is larger or no error is stated.
A spread of 0 marks a number that the paper chooses for a calculation: Fig. 5's masses and springs,
and the restitutions in eqs 1 to 4. Some of these come from a fit; the audit's row says so if their
rounding matters (71 % with e = 0.92).
"""

import csv
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from importlib.resources import files
from types import MappingProxyType


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
    text = (files(__package__) / "numbers.csv").read_text("utf-8")
    for key, printed, value, unit, spread, where, what in [*csv.reader(text.splitlines())][1:]:
        yield Input(key, printed, float(value), unit, float(spread), where, what)


PAPER: Data = MappingProxyType({number.key: number for number in _read_numbers()})
"""The paper's numbers by key, in the order of the paper."""
