"""What a user asks for -> the problem, checked."""

from collections.abc import Mapping

from stackbounce.errors import InvalidType, InvalidValue, nearest, shown
from stackbounce.fit.measured import Measured, read_measured
from stackbounce.fit.parameters import Parameter, read_parameters
from stackbounce.fit.problem import Problem, clock
from stackbounce.fit.ties import read_ties
from stackbounce.model import Drop

__all__ = ["read_problem"]


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
            if not (isinstance(key, str) and key.isidentifier() and key.isascii()):
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
        raise InvalidValue(
            f"vary has {_many(free, 'number')} for {_many(problem.size, 'measured number')}: fix "
            "some, or say what is known of them (a Range with a prior)"
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
