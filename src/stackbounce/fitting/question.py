"""What a user asks for -> the problem, checked."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from stackbounce.errors import InvalidType, InvalidValue, nearest, shown
from stackbounce.fitting.measured import Measured, read_measured
from stackbounce.fitting.parameters import Parameter, read_parameters
from stackbounce.fitting.problem import Problem, clock
from stackbounce.fitting.ties import read_ties
from stackbounce.model import Drop

if TYPE_CHECKING:
    from stackbounce.fitting.result import Fit

__all__ = ["Question", "TooFewData", "read_problem"]


class TooFewData(InvalidValue):
    """There is more to vary than was measured."""


@dataclass(frozen=True, eq=False)
class Question:
    """What is asked of a fit, as files have it: all that `stackbounce.fit` takes.

    Parameters
    ----------
    drops : mapping of str to Drop
        By their names; one alone may have an empty one.
    data : mapping of str to mapping
        What was measured of each drop, by its name.
    vary : mapping or sequence of str
        What may change.
    tie : mapping, optional
        What follows from it.

    Examples
    --------
    >>> import stackbounce as sb
    >>> drop = sb.Drop([sb.Ball(0.0567)], [sb.Spring(1e4)], height=0.3)
    >>> data = {"durations.0": "5.0 ± 0.1 ms"}
    >>> question = Question({"": drop}, {"": data}, ["contacts.0.stiffness"])
    >>> print(f"{question.fit()['contacts.0.stiffness']:.2u} N/m")
    (2.238+/-0.090)e+04 N/m
    """

    drops: Mapping[str, Drop]
    data: Mapping[str, Mapping[str, Any]]
    vary: Any
    tie: Any = None

    def fit(self, **options: Any) -> "Fit":
        """Return the fit.

        Parameters
        ----------
        **options
            Those of `stackbounce.fit`: ``starts``, ``seed`` and ``rtol``.

        Returns
        -------
        Fit
        """
        from stackbounce.fitting.search_run import fit

        return fit(self.drops, self.data, self.vary, tie=self.tie, **options)


def read_problem(
    drop: Drop | Mapping[str, Drop],
    data: object,
    vary: object,
    tie: object,
    rtol: float,
) -> Problem:
    """Return a fit to be made, checked; see `fit`."""
    drops: dict[str, Drop]
    if isinstance(drop, Drop):
        drops, given = {"": drop}, {"": data}
    elif isinstance(drop, Mapping) and drop:
        for key in drop:
            alone = key == "" and len(drop) == 1
            if not alone and not (isinstance(key, str) and key.isidentifier() and key.isascii()):
                raise InvalidValue(
                    "a drop's name must be letters, digits and _, such as B2_on_B1, "
                    f"got {shown(key)}"
                )
        drops = dict(drop)
        if not isinstance(data, Mapping):
            raise InvalidType(f"data must map each drop's name to its data, got {shown(data)}")
        given = dict(data)
        for key in given:
            if key not in drops:
                raise InvalidValue(f"data of {shown(key)}: no drop; {nearest(key, drops)}")
    else:
        raise InvalidType(f"drop must be a Drop or map names to Drops, got {shown(drop)}")
    for one in drops.values():
        if not isinstance(one, Drop):
            raise InvalidType(f"drop must be a Drop or map names to Drops, got {shown(one)}")
    measured = {
        key: read_measured(drops[key], one, f"{key}." if key else "") for key, one in given.items()
    }
    parameters = read_parameters(drops, vary)
    clocks = tuple(_clock(key, one) for key, one in measured.items() if one.waveforms)
    own = {one.name for one in parameters}
    for name in (one.name for one in clocks):
        if name in own:
            raise InvalidValue(f"{name} is the clock of a record: take another name")
    ties = read_ties(drops, parameters, tie)
    problem = Problem(drops, measured, parameters + clocks, ties, rtol)
    free = len(problem.parameters) + problem.linear
    if problem.size < free:
        asked, known = _many(free, "number"), _many(problem.size, "measured number")
        raise TooFewData(
            f"vary has {asked} for {known}: fix some, or say what is known of them "
            "(a Range with a prior)"
        )
    return problem


def _clock(key: str, measured: Measured) -> Parameter:
    """Return the time of the first touch in a record, a parameter of its own."""
    lows, highs = zip(*(wave.begins for wave in measured.waveforms), strict=True)
    floor = [k for k, wave in enumerate(measured.waveforms) if wave.index == 0]
    low, high = (lows[floor[0]], highs[floor[0]]) if floor else (min(lows), max(highs))
    return Parameter(clock(key), low, high, None, "s")


def _many(count: int, what: str) -> str:
    return f"{count} {what}{'' if count == 1 else 's'}"
