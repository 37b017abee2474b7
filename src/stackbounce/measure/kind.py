"""A kind of measurement: what a file of it has, and which analysis it gets."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from importlib import import_module
from typing import TYPE_CHECKING

from stackbounce.library_types import Dataset

if TYPE_CHECKING:
    from stackbounce.measure.finding import Finding
    from stackbounce.measure.reading.roles import Column
    from stackbounce.measure.setup import Setup


@dataclass(frozen=True)
class Kind:
    """A kind of measurement; `stackbounce.measure.kinds.KINDS` lists all of them.

    Parameters
    ----------
    name : str
        As users write it: ``holds="track"``.
    says : str
        The help text.
    module : str
        Where its analysis is, imported when it is needed: ``analyse(data, setup)`` goes from a
        Dataset to the result, or a tuple of results, and ``of_numbers(setup)`` to the result
        without a file. A kind has one of them or both.
    options : sequence of str
        What its analysis takes of `Setup`. Other options have no effect on it.
    columns : sequence of sequence of str
        The columns that its file needs: one of each sequence, by role or name. A file with these
        columns is recognised, unless `recognised` decides.
    dimension : str
        Of the Dataset: ``"time"``, ``"track"`` for (time, track), or a name for plain rows.
    longest_step : float
        Steps of time in s that are longer than any in a file of this kind: without a unit, times
        with longer ones are in milliseconds or in something smaller.
    recognised : callable, optional
        Whether columns are those of this kind.
    starts_with : sequence of str
        The options of which one is enough for `of_numbers`.
    typed : str
        What the numbers are called: ``"heights of bounces"``.

    Examples
    --------
    >>> from stackbounce.measure.kinds import KINDS
    >>> KINDS["acceleration"].options
    ['gravity']
    """

    name: str
    says: str
    module: str
    options: Sequence[str] = ()
    columns: Sequence[Sequence[str]] = ()
    dimension: str = "time"
    longest_step: float = 0.2
    recognised: "Callable[[Sequence[Column]], bool] | None" = None
    starts_with: Sequence[str] = ()
    typed: str = ""

    def analyse(self, data: Dataset, setup: "Setup") -> "tuple[Finding, ...]":
        """Return the results of a file."""
        found = import_module(self.module).analyse(data, setup)
        return found if isinstance(found, tuple) else (found,)

    def of_numbers(self, setup: "Setup") -> "Finding":
        """Return the result of numbers without a file."""
        found: Finding = import_module(self.module).of_numbers(setup)
        return found
