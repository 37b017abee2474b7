"""A fit problem: drops, what was measured of them, what is varied and what follows from it."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any

import numpy as np

from stackbounce.errors import InvalidType, InvalidValue, between, counted, one_of, shown, whole
from stackbounce.fitting.least_squares import Minimum, expected_trials, find_minima
from stackbounce.fitting.measurements import Measured, read_measured
from stackbounce.fitting.objective import Objective, touch_name
from stackbounce.fitting.parameters import Drops, Parameter, find_numbers, read_parameters
from stackbounce.fitting.result import Fit
from stackbounce.fitting.ties import read_ties
from stackbounce.model import Drop
from stackbounce.prediction.draws import Progress
from stackbounce.run.options import seed_of
from stackbounce.run.paths import value_in

_MOST_STARTS = 1_000_000
_RTOL = 1e-9


class TooFewData(InvalidValue):
    """A fit has more free numbers than data."""


class Interrupted(KeyboardInterrupt):
    """Ctrl+C ended a fit; its message has the best values so far.

    Parameters
    ----------
    fit : Fit
        With these values.
    """

    def __init__(self, fit: Fit) -> None:
        values = ", ".join(
            f"{name} = {value:.6g} {fit.units[name]}".rstrip() for name, value in fit.best.items()
        )
        super().__init__(
            f"the best of {fit.objective.course.trials} trials, with a chi squared of "
            f"{fit.chi_squared:.4g}: {values}"
        )
        self.fit = fit


@dataclass(frozen=True, eq=False)
class FitProblem:
    """All that a fit needs: drops, what was measured, what is varied and what follows.

    It is checked when it is made. Without data, or with nothing to vary, it is a model that can be
    completed by `dataclasses.replace`; `compare` does so with the data.

    Parameters
    ----------
    drops : Drop, or mapping of str to Drop
        What was dropped. A single drop is kept as a mapping with an empty name.
    data : mapping, optional
        What was measured, as `fit` takes it; of several drops by the drop's name.
    vary : mapping or sequence of str, optional
        What is varied, as `fit` takes it.
    tie : mapping, optional
        What follows from other numbers, as `fit` takes it.
    rtol : float, optional
        The relative tolerance of each run if the contact laws are not linear.

    Raises
    ------
    InvalidValue
        If a name is unknown, a number has no error, bounds are not possible, or there is more to
        vary than was measured.
    InvalidType
        If something has the wrong type.

    Examples
    --------
    >>> import stackbounce as sb
    >>> drop = sb.Drop([sb.Ball(0.0567)], [sb.Spring(1e4)], height=0.3)
    >>> problem = FitProblem(drop, {"durations.0": "5.0 ± 0.1 ms"}, ["contacts.0.stiffness"])
    >>> print(f"{problem.fit()['contacts.0.stiffness']:.2u} N/m")
    (2.238+/-0.090)e+04 N/m
    """

    drops: Any
    data: Any = field(default_factory=dict)
    vary: Any = field(default_factory=dict)
    tie: Any = None
    rtol: float = _RTOL

    def __post_init__(self) -> None:
        object.__setattr__(self, "rtol", between("rtol", self.rtol, 1e-14, 1e-3))
        object.__setattr__(self, "drops", _read_drops(self.drops))
        without_data, without_vary = _is_empty(self.data), _is_empty(self.vary)
        named = isinstance(self.data, Mapping) and "" in self.data
        if list(self.drops) == [""] and not without_data and not named:
            object.__setattr__(self, "data", {"": self.data})
        if not without_data and not without_vary:
            _ = self.objective

    @property
    def drop(self) -> Drop | dict[str, Drop]:
        """The single drop, or several by name."""
        drops: dict[str, Drop] = self.drops
        return drops.get("", drops)

    @cached_property
    def objective(self) -> Objective:
        """The residuals and chi squared as functions of the parameters.

        Raises
        ------
        InvalidValue, InvalidType
            As for the problem itself.
        """
        measured = self._read_data()
        parameters = read_parameters(self.drops, self.vary)
        touches = tuple(_touch(key, own) for key, own in measured.items() if own.waveforms)
        own = {parameter.name for parameter in parameters}
        for parameter in touches:
            if parameter.name in own:
                raise InvalidValue(
                    f"{parameter.name} is the time of first touch in a force record: take another "
                    "name"
                )
        ties = read_ties(self.drops, parameters, self.tie)
        objective = Objective(self.drops, measured, parameters + touches, ties, self.rtol)
        if objective.size < objective.free:
            asked = counted(objective.free, "number")
            raise TooFewData(
                f"vary has {asked} for {counted(objective.size, 'measured number')}: fix some, or "
                "say what is known of them (a Range with a prior)"
            )
        return objective

    def _read_data(self) -> dict[str, Measured]:
        data = {"": {}} if _is_empty(self.data) and "" in self.drops else self.data
        if not isinstance(data, Mapping):
            raise InvalidType(f"data must map each drop's name to its data, got {shown(data)}")
        for key in data:
            one_of(key, self.drops, f"data of {shown(key)}: no drop")
        paths = {key: f"{key}." if key else "" for key in data}
        return {key: read_measured(self.drops[key], data[key], paths[key]) for key in data}

    def fit(
        self,
        *,
        starts: int | None = None,
        rng: Any = 0,
        rtol: float | None = None,
        progress: Progress | None = None,
    ) -> Fit:
        """Fit what is varied to the data, by least squares.

        Parameters
        ----------
        starts : int, optional
            The number of trials that are screened before the best of them are followed.
        rng : int, numpy.random.Generator or the like, optional
            Of their places, as `numpy.random.default_rng` takes it.
        rtol : float, optional
            Another relative tolerance than that of the problem.
        progress : callable, optional
            Is called with the number of trials done and about the number of all.

        Returns
        -------
        Fit

        Raises
        ------
        Interrupted
            After Ctrl+C; it has the best values so far.
        """
        accuracy = self.rtol if rtol is None else between("rtol", rtol, 1e-14, 1e-3)
        objective = replace(self.objective, rtol=accuracy)  # with its own count of unsolved runs
        count = None if starts is None else whole("starts", starts, 1, _MOST_STARTS)
        first, seed = _first_trial(objective), seed_of(rng)
        course = objective.course
        try:
            with course.reported(progress, expected_trials(objective, count)):
                minima = find_minima(objective, first[None], count, seed)
        except KeyboardInterrupt as stopped:
            if course.best is None:
                raise
            best = Minimum(course.best, course.chi_squared, converged=False)
            raise Interrupted(Fit(objective, [best], dict(objective.unsolved))) from stopped
        return Fit(objective, minima, dict(objective.unsolved))


def Model(  # noqa: N802  the public name of a problem without data
    drop: Drop | Drops, vary: Any, tie: Any = None
) -> FitProblem:
    """Return a model for `compare`: a `FitProblem` without data.

    Parameters
    ----------
    drop : Drop, or mapping of str to Drop
        With all that is known, and the contact laws of the model.
    vary, tie : optional
        As `fit` takes them.

    Returns
    -------
    FitProblem

    Examples
    --------
    >>> import stackbounce as sb
    >>> drop = sb.Drop([sb.Ball(1.0)], [sb.Rigid(0.8)], height=1.0)
    >>> Model(drop, ["contacts.0.restitution"]).vary
    ['contacts.0.restitution']
    """
    return FitProblem(drop, {}, vary, tie)


def fit(
    drop: Drop | Drops,
    data: Any,
    vary: Any,
    *,
    tie: Any = None,
    starts: int | None = None,
    rng: Any = 0,
    rtol: float = _RTOL,
    progress: Progress | None = None,
) -> Fit:
    """Fit parameters of one or several drops to measured values, by least squares.

    Parameters
    ----------
    drop : Drop, or mapping of str to Drop
        What was dropped, with all that is known. Several drops have names, such as ``B2_on_B1``.
    data : mapping
        What was measured, by name: ``rebound_ratios.1``, ``rebound_speeds`` (m/s),
        ``rebound_heights`` (m), ``first_touch.1`` (s, the delay), ``last_release``, ``durations``
        (s), ``energy_retained``, ``force.0`` (a waveform), each with its error: ``"1.64 ± 0.02"``;
        ``collisions`` are compared, not fitted. Of several drops: by the drop's name.
    vary : mapping or sequence of str
        What may change, by the paths that `sweep` has: ``{"contacts.1.stiffness": (1e3, 1e6)}``,
        ``{"gaps.0": "0 mm : 5 mm"}``, ``{"gaps.0": "1.3 ± 0.9 mm"}`` for what is known beforehand,
        `Range` for both; None, or a list of names alone, for bounds around the drop's own numbers.
        With several drops a path is shared by all that have it; ``B2_on_B1.gaps.0`` belongs to one.
        A name that is no path can be varied if a tie uses it.
    tie : mapping, optional
        Numbers that follow from others: ``{"contacts.1.stiffness": "0.5 * contacts.0.stiffness"}``,
        a formula of what is varied and of numbers of the same drop, or a Python function that takes
        a mapping of names to arrays.
    starts : int, optional
        The number of trials that are screened before descents start at the best of them; default
        128 per parameter, 1024 at most.
    rng : int, numpy.random.Generator or the like, optional
        Of their places, as `numpy.random.default_rng` takes it.
    rtol : float, optional
        The relative tolerance of each run if the contact laws are not linear.
    progress : callable, optional
        Is called with the number of trials done and about the number of all.

    Returns
    -------
    Fit
        Best values with errors and correlations, chi squared, residuals, and what the data cannot
        determine; `Fit.intervals` gives confidence intervals, `Fit.sample` the posterior.

    Raises
    ------
    InvalidValue
        If a name is unknown, a number has no error, bounds are not possible, or there is more to
        vary than was measured.
    InvalidType
        If something has the wrong type.
    Interrupted
        After Ctrl+C; it has the best values so far.

    Notes
    -----
    Least squares with known errors. Chi squared has kinks where the number of contact intervals
    changes. Trials spread over the bounds are screened at once, and descents start at the
    best: by trust region, then by Nelder and Mead's simplex if they stop at a kink. Other minima
    are reported in the notes.

    Examples
    --------
    The tennis ball on a basketball of R. Cross, Am. J. Phys. 75, 1009 (2007): which stiffness
    between the balls throws it up at 1.64 v0, if nothing is lost?

    >>> import stackbounce as sb
    >>> balls, contacts = [sb.Ball(0.150), sb.Ball(0.057)], [sb.Spring(2500.0), sb.Spring(1000.0)]
    >>> drop = sb.Drop(balls, contacts, impact_speed=3.53)
    >>> data = {"rebound_ratios.1": "1.64 ± 0.02"}
    >>> found = sb.fit(drop, data, {"contacts.1.stiffness": "0.7 kN/m : 2.5 kN/m"})
    >>> print(f"{found['contacts.1.stiffness']:.1u} N/m")
    (1.48+/-0.06)e+03 N/m
    """
    return FitProblem(drop, data, vary, tie, rtol).fit(starts=starts, rng=rng, progress=progress)


def _read_drops(drops: object) -> dict[str, Drop]:
    """Return the drops by name, checked."""
    if isinstance(drops, Drop):
        return {"": drops}
    if not isinstance(drops, Mapping) or not drops:
        raise InvalidType(f"drop must be a Drop or map names to Drops, got {shown(drops)}")
    for key, drop in drops.items():
        alone = key == "" and len(drops) == 1
        if not alone and not (isinstance(key, str) and key.isidentifier() and key.isascii()):
            raise InvalidValue(
                f"a drop's name must be letters, digits and _, such as B2_on_B1, got {shown(key)}"
            )
        if not isinstance(drop, Drop):
            raise InvalidType(f"drop must be a Drop or map names to Drops, got {shown(drop)}")
    return dict(drops)


def _touch(key: str, measured: Measured) -> Parameter:
    """Return the parameter for the time of first touch in a drop's force records."""
    lows, highs = zip(*(wave.begins for wave in measured.waveforms), strict=True)
    floor = [k for k, wave in enumerate(measured.waveforms) if wave.index == 0]
    low, high = (lows[floor[0]], highs[floor[0]]) if floor else (min(lows), max(highs))
    return Parameter(touch_name(key), low, high, None, "s")


def _first_trial(objective: Objective) -> Any:
    """Return the trial (parameters,) of the drops' own numbers, or mid-range outside the bounds.

    A parameter that is no number of a drop has the value of one that is tied to it alone.
    """
    found = []
    for parameter in objective.parameters:
        at = find_numbers(objective.drops, parameter.name)
        at += [(tie.drop, tie.number) for tie in objective.ties if tie.text == parameter.name]
        value = value_in(objective.drops[at[0][0]], at[0][1]) if at else np.nan
        inside = parameter.low <= value <= parameter.high
        found.append(parameter.coordinate(value) if inside else 0.5 * sum(parameter.span))
    return np.array(found)


def _is_empty(given: object) -> bool:
    return isinstance(given, Mapping) and not given
