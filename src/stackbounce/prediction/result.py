"""The result of `predict`: what follows of a drop whose numbers have errors, with errors."""

import contextlib
import functools
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from stackbounce.errors import InvalidValue, one_of, shown
from stackbounce.library_types import DataArray, Dataset, UFloat
from stackbounce.model import Drop
from stackbounce.prediction.draws import Slopes, budget, carry, fit_slopes, linear_shares
from stackbounce.prediction.inputs import Inputs, error_of_deviation, of_draws
from stackbounce.run.driver import solve_one
from stackbounce.run.options import Options
from stackbounce.run.paths import identifier
from stackbounce.run.quantities import QUANTITIES, Array, Solved
from stackbounce.run.result import Result, Status
from stackbounce.run.sideways import LIMIT, REMARK, UNITS
from stackbounce.shown import Shown, Table
from stackbounce.units import numbers_in, rounded
from stackbounce.version import __version__

_CURVES = ("position", "velocity", "force", "compression")
_ROUGH = 0.02  # the relative error of a standard deviation above which a note says so
_RUNS = 1000  # single runs of draws, at most
_ONE_SIGMA = (0.159, 0.841)
_FLOATS = [name for name in QUANTITIES if name != "collisions"]


class Apex(NamedTuple):
    """The highest point of a flight.

    Parameters
    ----------
    ball : int
        Which ball.
    flight : int
        Which of its flights that have a highest point, from 0.
    time, height : UFloat
        In s and m.
    share : float
        The share of the drops that have it.
    """

    ball: int
    flight: int
    time: Any
    height: Any
    share: float


def _parts(name: str, text: str) -> property:
    """Return a property: the parts of a quantity, one for each ball or contact."""

    def parts(found: "Prediction") -> list[Any]:
        return [found[f"{name}.{k}"] for k in range(len(found.drop.balls))]

    return property(parts, doc=text)


@dataclass(frozen=True, eq=False, repr=False)
class Prediction(Shown):
    """What follows of a drop whose numbers have errors, with errors; made by `predict`.

    ``prediction["rebound_speeds.1"]`` is a value with its error; the names are those that `fit`
    has: `rebound_speeds` (m/s), `rebound_ratios`, `rebound_heights` (m), `first_touch`,
    `last_release` and `durations` of the contacts (s), `energy_retained`.

    Parameters
    ----------
    inputs : Inputs
        The numbers with errors.
    options : Options
        Of each run.
    reason : str
        Why the errors come from draws; empty if they come from derivatives.
    difference : float
        How far draws are from the straight lines of the derivatives, in standard deviations.
    slopes : mapping
        Value and derivatives of each quantity; empty if draws were needed from the first.
    drawn : ndarray
        (draws, numbers) the numbers of the draws.
    solved : Solved
        The quantities of the draws.
    refused : str
        Why some draws were left out; empty if none was.
    asked : int
        The number of draws that were to be run.

    Examples
    --------
    >>> import stackbounce as sb
    >>> laws = [sb.Spring(2e4), sb.Spring(1e4)]
    >>> drop = sb.Drop([sb.Ball(0.6), sb.Ball(0.06)], laws, gaps=[0.002], height=0.63)
    >>> found = sb.predict(drop, {"height": "63 ± 1 cm", "balls.1.mass": (0.06, 0.001)})
    >>> found.method, str(found["rebound_speeds.1"])
    ('derivatives', '4.93+/-0.05')
    """

    inputs: Inputs
    options: Options
    reason: str
    difference: float
    slopes: Slopes
    drawn: Array
    solved: Solved
    refused: str
    asked: int

    def _tables(self) -> Sequence[Table]:
        rows = []
        units = {name: one.unit for name, one in QUANTITIES.items()} | UNITS
        for name, number in (self._all | self.sideways).items():
            value, error = rounded((number.nominal_value, number.std_dev), number.std_dev)
            rows.append((name, value, f"± {error}", units[name.partition(".")[0]]))
        return (Table(f"Prediction of a drop {self.drop.incidence}", ("", "", "", ""), rows),)

    def _drawing(self) -> str:
        return self.result._drawing()

    @property
    def remarks(self) -> tuple[str, ...]:
        """How the errors were found, and what limits them."""
        return (self.how, *self.notes)

    @property
    def drop(self) -> Drop:
        """The drop with the values of the numbers."""
        return self.inputs.drop

    @property
    def method(self) -> str:
        """``derivatives`` or ``draws``."""
        return "draws" if self.reason else "derivatives"

    @property
    def errors(self) -> dict[str, UFloat]:
        """The numbers with errors, by their paths, in SI units."""
        found = dict(zip(self.inputs.paths, self.inputs.errors, strict=True))
        return found | {f"offsets.{ball}": off for ball, off in self.inputs.offsets.items()}

    @functools.cached_property
    def result(self) -> Result:
        """The run with the values of the numbers."""
        return solve_one(self.drop, self.options)

    @functools.cached_property
    def _results(self) -> list[Result]:
        """Single runs, for what a batch does not give: of some draws, or of `Inputs.neighbours`."""
        # Three times as many cost no more than all draws may.
        most = budget(self.options, self.asked) * len(self.drawn)
        few = self.drawn[: min(_RUNS, most // max(1, 3 * int(np.sum(self.solved.work))))]
        rows = few if self.reason else self.inputs.neighbours
        return [solve_one(self.inputs.drop_at(x), self.options) for x in rows]

    def __getitem__(self, name: str) -> UFloat:
        """Return a value with its error, such as ``rebound_speeds.1``, in SI units."""
        return self._all[one_of(name, self._all, f"{shown(name)} is not predicted")]

    rebound_speeds = _parts(
        "rebound_speeds", "(N,) velocity of each ball after the impact, m/s, up-positive."
    )
    rebound_ratios = _parts(
        "rebound_ratios", "(N,) rebound speed of each ball over the impact speed v0."
    )
    rebound_heights = _parts(
        "rebound_heights",
        "(N,) how far each ball rises at its rebound speed, m; negative if it moves down.",
    )
    first_touch = _parts("first_touch", "(N,) time of each contact's first touch, s.")
    last_release = _parts("last_release", "(N,) time at which each contact opened last, s.")
    durations = _parts(
        "durations", "(N,) time from each contact's first touch to its last release, s."
    )

    @property
    def energy_retained(self) -> Any:
        """Kinetic energy of all balls at the end over that at the start."""
        return self["energy_retained"]

    @property
    def collisions(self) -> list[dict[int, float]]:
        """The share of the drops within the errors by the count of each contact's intervals."""
        counts = self.solved.tables["collisions"]
        found = [np.unique(column, return_counts=True) for column in counts.T]
        return [dict(zip(k.tolist(), (n / len(counts)).tolist(), strict=True)) for k, n in found]

    @functools.cached_property
    def draws(self) -> Dataset:
        """All quantities of drops that are drawn within the errors.

        With the dimensions `draw`, and `ball` or `contact`; the numbers drawn are coordinates.
        """
        import xarray as xr

        data: dict[str, Any] = {"status": ("draw", self.solved.status)}
        for name, table in self.solved.tables.items():
            part, unit = QUANTITIES[name].part, QUANTITIES[name].unit
            attrs = {"units": unit or "1"}
            data[name] = (("draw", part), table, attrs) if part else ("draw", table[:, 0], attrs)
        numbers = {
            identifier(number.path): ("draw", self.drawn[:, k], number.attributes)
            for k, number in enumerate(self.inputs.numbers)
        }
        return xr.Dataset(data, numbers, {"stackbounce": __version__, "drop": self.drop.to_toml()})

    def quantiles(self, name: str, at: Any = (0.159, 0.5, 0.841)) -> Array:
        """Return quantiles of a number over the draws, by default the median and one sigma.

        Parameters
        ----------
        name : str
            Such as ``rebound_speeds.1``.
        at : array_like, optional
            (n,) from 0 to 1.

        Returns
        -------
        ndarray
            (n,) in SI units; nan if no draw has the number.
        """
        _, levels = self[name], numbers_in(at, "", "at").reshape(np.shape(at))
        if not np.all((levels >= 0.0) & (levels <= 1.0)):
            raise InvalidValue(f"at must be from 0 to 1, 0.5 for the median, got {shown(at)}")
        return np.asarray(np.nanquantile(self._columns[name], levels))

    @functools.cached_property
    def sensitivity(self) -> DataArray:
        """The share (quantity, number) of each number's error in the variance of each quantity.

        It is found by derivatives, or by a straight line through the draws. For correlated numbers
        it has half of what each pair makes together, and may be negative.
        """
        import xarray as xr

        if self.reason:
            slopes = fit_slopes(self.drawn, np.column_stack(list(self._columns.values())))
        else:
            slopes = np.vstack([slope for _, slope in self.slopes.values()])
        shares = linear_shares(slopes, self.inputs.covariance)
        sides = {"quantity": list(self._columns), "number": self.inputs.paths}
        return xr.DataArray(shares, sides, name="share")

    def advice(self, name: str = "") -> str:
        """Return which number to measure better, in a sentence; empty if there is only one.

        Parameters
        ----------
        name : str, optional
            For which quantity; by default the speed of the uppermost ball.

        Returns
        -------
        str

        Examples
        --------
        >>> import stackbounce as sb
        >>> drop = sb.Drop([sb.Ball(0.06)], [sb.Rigid(0.8)], height=0.63)
        >>> errors = {"height": "63 ± 1 cm", "contacts.0.restitution": (0.8, 0.01)}
        >>> sb.predict(drop, errors).advice()
        'measure contacts.0.restitution better: it makes 71 % of the variance of rebound_speeds.0'
        """
        name = name or f"rebound_speeds.{len(self.drop.balls) - 1}"
        _ = self[name]
        if len(self.inputs.numbers) < 2:
            return ""
        shares = self.sensitivity.sel(quantity=name).values
        if not np.isfinite(shares).all():
            return ""
        best = int(np.argmax(shares))
        together = "" if self.inputs.independent else " (the errors are correlated)"
        return (
            f"measure {self.inputs.paths[best]} better: it makes {100.0 * shares[best]:.0f} % of "
            f"the variance of {name}{together}"
        )

    @property
    def how(self) -> str:
        """How the errors were found, in a sentence.

        Examples
        --------
        >>> import stackbounce as sb
        >>> drop = sb.Drop([sb.Ball(0.06)], [sb.Rigid(0.8)], height=0.63)
        >>> sb.predict(drop, {"height": "63 ± 1 cm"}).how
        'errors by derivatives: 10000 drops within the errors follow them to 1 % of the error'
        """
        if not self.inputs.numbers:
            return "errors of offsets, carried to first order"
        if self.reason:
            return f"errors by {len(self.drawn)} draws: {self.reason}"
        return (
            f"errors by derivatives: {len(self.drawn)} drops within the errors "
            f"follow them to {max(1, math.ceil(100.0 * self.difference))} % of the error"
        )

    @property
    def notes(self) -> tuple[str, ...]:
        """What limits the prediction, a sentence each."""
        found = []
        if self.refused and self.refused not in self.reason:
            found.append(f"draws that no drop can have were left out, the first as {self.refused}")
        if len(self.drawn) < self.asked:
            found.append(
                f"{len(self.drawn)} of {self.asked} draws were run, for they take long; a larger "
                "event_limit allows more"
            )
        status = self.solved.status
        bad = int(np.isin(status, (Status.EVENT_LIMIT, Status.INVALID)).sum())
        if bad:
            found.append(f"{bad} of {len(status)} drops did not finish and were left out")
        if self.reason:
            errors = {name: error_of_deviation(column) for name, column in self._columns.items()}
            rough = [name for name, error in errors.items() if error > _ROUGH]
            if rough:
                names = ", ".join(rough[:3]) + " and others" * (len(rough) > 3)
                found.append(
                    f"the error of {names} is known "
                    f"to {max(errors.values()):.0%} only, for it comes from few draws far out or "
                    "from few draws; quantiles say more"
                )
        angles = [angle for name, angle in self.sideways.items() if name.startswith("angle")]
        if any(abs(angle.nominal_value) + angle.std_dev > LIMIT for angle in angles):
            found.append(REMARK)
        return tuple(found)

    @functools.cached_property
    def apexes(self) -> list[Apex]:
        """The highest points of the flights; with gravity only. From 1000 draws, if by draws."""

        def points(result: Result) -> dict[tuple[int, int, str], float]:
            counts: dict[int, int] = {}
            found = {}
            for ball, time, height in result.apexes.tolist():
                k = counts.setdefault(ball, 0)
                counts[ball] += 1
                found[ball, k, "time"], found[ball, k, "height"] = time, height
            return found

        found = carry(self.inputs, self._results, points, drawn=bool(self.reason))
        return [
            Apex(ball, k, time, found[ball, k, "height"][0], share)
            for (ball, k, what), (time, share) in sorted(found.items())
            if what == "time"
        ]

    @functools.cached_property
    def sideways(self) -> dict[str, UFloat]:
        """How balls leave sideways that lie off the middle by ``offsets.N``, to first order.

        By what and which ball, such as ``angle.1``, as `Result.sideways` has them; empty without
        offsets. The errors are those of the offsets and of the drop. Speeds and heights lose
        nothing to first order.

        Examples
        --------
        >>> import stackbounce as sb
        >>> drop = sb.stack("basketball", "tennis", height="63 cm")
        >>> found = sb.predict(drop, {"offsets.1": "0 ± 1 mm"}).sideways
        >>> print(f"{found['sideways_speed.1']:.2u} m/s, {found['angle.1']:.2u} rad")
        0.00+/-0.18 m/s, 0.000+/-0.029 rad
        """
        if not self.inputs.offsets:
            return {}
        middle = self.inputs.middle

        def leaving(result: Result, at: Mapping[int, float] = middle) -> dict[str, float]:
            columns = result.sideways(at).items()
            return {f"{name}.{i}": x for name, xs in columns for i, x in enumerate(xs.values)}

        def known(result: Result) -> dict[str, float]:
            with contextlib.suppress(InvalidValue):
                return leaving(result)
            return {}

        found = self.carry(known)
        for ball, offset in self.inputs.offsets.items():
            if offset.std_dev > 0.0:
                apart = offset - middle[ball]
                ends = (middle[ball] - offset.std_dev, middle[ball] + offset.std_dev)
                low, high = (leaving(self.result, middle | {ball: end}) for end in ends)
                for name in found:
                    slope = (high[name] - low[name]) / (2.0 * offset.std_dev)
                    found[name] = found[name] + slope * apart
        return found

    def carry(self, function: Callable[[Result], Mapping[Any, float]]) -> dict[Any, UFloat]:
        """Return any numbers of a `Result` with their errors.

        Parameters
        ----------
        function : callable
            Takes a Result, returns numbers by name. A number may be missing in some results.

        Returns
        -------
        dict of str to UFloat
            By derivatives, or from 1000 draws, as all others.

        Examples
        --------
        >>> import stackbounce as sb
        >>> drop = sb.Drop([sb.Ball(0.06)], [sb.Spring(2e4)], height=0.63)
        >>> found = sb.predict(drop, {"height": "63 ± 1 cm"})
        >>> forces = found.carry(lambda result: {"peak": result.intervals["peak_force"].max()})
        >>> str(forces["peak"])
        '121.8+/-1.0'
        """
        found = carry(self.inputs, self._results, function, drawn=bool(self.reason))
        return {name: value for name, (value, _) in found.items()}

    def band(self, times: Any, name: str = "position") -> tuple[Array, Array]:
        """Return the lower and the upper end of one standard deviation of a curve.

        Parameters
        ----------
        times : array_like
            (T,) in s, as `Result.sample` takes them.
        name : str, optional
            A variable of `Result.sample` that has a ball or a contact: ``position``, ``velocity``,
            ``force`` or ``compression``.

        Returns
        -------
        low, high : ndarray
            (balls, T) in SI units; with draws, quantiles at 15.9 and 84.1 % of 1000 of them.

        Raises
        ------
        InvalidValue
            If there is no such variable, or a time is not one of the run.
        """
        one_of(name, _CURVES, f"{shown(name)} is not a curve")
        within = np.minimum(numbers_in(times, "s", "times"), self.options.until)
        curves = np.array([result.sampled(within)[name] for result in self._results])
        if self.reason:
            low, high = np.nanquantile(curves, _ONE_SIGMA, axis=0)
            return low, high
        each = np.tensordot(self.inputs.spread.T, self.inputs.slopes(curves), axes=1)
        deviation = np.sqrt(np.sum(each**2, axis=0))
        return curves[0] - deviation, curves[0] + deviation

    def as_dict(self) -> dict[str, Any]:
        """Return the prediction as plain values, for JSON."""
        return {
            "method": self.method,
            "how": self.how,
            "advice": self.advice(),
            "notes": list(self.notes),
            "numbers": {name: _plain(number) for name, number in self.errors.items()},
            "values": {name: _plain(x) for name, x in (self._all | self.sideways).items()},
            "shares": {
                number: self.sensitivity.sel(number=number).to_series().to_dict()
                for number in self.inputs.paths
            },
        }

    @functools.cached_property
    def _all(self) -> dict[str, Any]:
        """All quantities with their errors, by their whole names."""
        found: dict[str, Any] = {}
        for name in _FLOATS:
            if self.reason:
                table = self.solved.tables[name]
                scale = float(np.max(np.abs(table), initial=0.0, where=np.isfinite(table)))
                values = [of_draws(column, scale) for column in table.T]
            else:
                pairs = zip(*self.slopes[name], strict=True)
                values = [self.inputs.linear(value, slopes) for value, slopes in pairs]
            found |= {_label(name, part): value for part, value in enumerate(values)}
        return found

    @functools.cached_property
    def _columns(self) -> dict[str, Array]:
        """The draws (draws,) of each quantity by its whole name."""
        return {
            _label(name, part): column
            for name in _FLOATS
            for part, column in enumerate(self.solved.tables[name].T)
        }


def _label(name: str, part: int) -> str:
    return f"{name}.{part}" if QUANTITIES[name].part else name


def _plain(one: Any) -> dict[str, float]:
    return {"value": one.nominal_value, "error": one.std_dev}
