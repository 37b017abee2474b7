"""A kind of measurement: what a file of it has, and which analysis it gets."""

import inspect
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from stackbounce.measure.finding import Finding
    from stackbounce.measure.reading.roles import Column

__all__ = ["Kind", "keywords_of"]


@dataclass(frozen=True)
class Kind:
    """A kind of measurement; `stackbounce.measure.kinds.KINDS` lists all of them.

    Parameters
    ----------
    name : str
        As users write it: ``holds="track"``.
    says : str
        The help text.
    analyse : callable or None
        From a Dataset to the result, or a tuple of results. Its keywords are the options that it
        takes, each one of `stackbounce.measure.options.OPTIONS`. None for a kind without files.
    columns : tuple of tuple of str
        The columns that its file needs: one of each tuple, given by role or name. A file with these
        columns is recognised, unless `recognised` decides.
    dimension : str
        Of the Dataset: ``"time"``, ``"track"`` for (time, track), or a name for plain rows.
    longest_step : float
        Steps of time in s that are longer than any in a file of this kind: without a unit, times
        with longer ones are in milliseconds or in something smaller.
    recognised : callable, optional
        Whether columns are those of this kind.
    of_numbers : callable, optional
        From options, its keywords, to the result without a file.
    starts_with : tuple of str
        The options of which one is enough for `of_numbers`.
    typed : str
        What the numbers are called: ``"heights of bounces"``.

    Examples
    --------
    >>> from stackbounce.measure.kinds import KINDS
    >>> KINDS["acceleration"].options
    ('gravity',)
    """

    name: str
    says: str
    analyse: "Callable[..., Finding | tuple[Finding, ...]] | None" = None
    columns: tuple[tuple[str, ...], ...] = ()
    dimension: str = "time"
    longest_step: float = 0.2
    recognised: "Callable[[Sequence[Column]], bool] | None" = None
    of_numbers: "Callable[..., Finding] | None" = None
    starts_with: tuple[str, ...] = ()
    typed: str = ""

    @cached_property
    def options(self) -> tuple[str, ...]:
        """The options that its analyses take."""
        functions = (self.analyse, self.of_numbers)
        return tuple(
            dict.fromkeys(name for one in functions if one is not None for name in keywords_of(one))
        )


def keywords_of(function: Callable[..., Any]) -> tuple[str, ...]:
    """Return the names of a function's keyword-only arguments."""
    every = inspect.signature(function).parameters.values()
    return tuple(one.name for one in every if one.kind is one.KEYWORD_ONLY)
