"""The numbers of a drop that have errors, and draws of them.

A number with an error is a ``UFloat`` of `uncertainties`: a value, and how it depends on variables
that are independent of each other. Numbers that share a variable are correlated.
"""

import functools
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from stackbounce.errors import InvalidType, InvalidValue, all_real, finite, shown
from stackbounce.measure.quantities import deviation, known_to, quantity_with_error, spread_of
from stackbounce.model import Drop
from stackbounce.run.options import Options
from stackbounce.run.paths import Number, check, drop_at, number_at, value_in
from stackbounce.run.quantities import Array, Solved, solve_quantities
from stackbounce.sweeps.dataset import check_together
from stackbounce.units import magnitude, quantity

FEWEST = 100
"""The least number of draws."""

_STEP = 0.1  # of a standard deviation, for central differences
_ROUND_OFF = 1e-12  # relative: an error of this size is none
_ATTEMPTS = 50  # rounds of draws, of which some are possible drops


@dataclass(frozen=True, eq=False)
class Inputs:
    """The numbers of a drop that have errors.

    Parameters
    ----------
    base : Drop
        The drop that has them; their values take the place of its own.
    numbers : tuple of Number
        Which numbers.
    errors : tuple of UFloat
        Their values with errors.
    given : mapping of int to ndarray
        Draws (n,) of those numbers that were given by draws, by index: a row holds for all of them.
    offsets : mapping of int to UFloat
        How far balls lie off the middle, in m.
    """

    base: Drop
    numbers: tuple[Number, ...]
    errors: tuple[Any, ...]
    given: Mapping[int, Array]
    offsets: Mapping[int, Any]

    @property
    def middle(self) -> dict[int, float]:
        """Offsets in m without their errors, by ball."""
        return {ball: offset.nominal_value for ball, offset in self.offsets.items()}

    @property
    def paths(self) -> list[str]:
        """The paths of the numbers."""
        return [number.path for number in self.numbers]

    @functools.cached_property
    def values(self) -> Array:
        """(numbers,) values without errors, in SI units."""
        return np.array([error.nominal_value for error in self.errors])

    @functools.cached_property
    def spread(self) -> Array:
        """(numbers, variables) change of each number by one standard deviation of a variable."""
        return spread_of(self.errors)

    @property
    def covariance(self) -> Array:
        """(numbers, numbers) covariances."""
        return np.asarray(self.spread @ self.spread.T)

    @property
    def deviations(self) -> Array:
        """(numbers,) standard deviations."""
        return np.asarray(np.sqrt(np.sum(self.spread**2, axis=1)))

    @property
    def independent(self) -> bool:
        """Return whether no two numbers depend on the same variable."""
        return not self.given and bool(np.all(np.count_nonzero(self.spread, axis=0) <= 1))

    @functools.cached_property
    def drop(self) -> Drop:
        """The drop with the values of the numbers."""
        return self.drop_at(self.values)

    def drop_at(self, x: Array) -> Drop:
        """Return the drop with other numbers (numbers,)."""
        return drop_at(self.base, dict(zip(self.numbers, x.tolist(), strict=True)))

    @property
    def neighbours(self) -> Array:
        """(2 numbers + 1, numbers) the values, then each number larger, then each smaller."""
        steps = np.diag(_STEP * self.deviations)
        return np.concatenate([self.values[None], self.values + steps, self.values - steps])

    def slopes(self, answers: Array) -> Array:
        """Return the derivatives (numbers, ...) of what follows of `neighbours`."""
        larger, smaller = np.split(answers[1:], 2)
        widths = np.where(self.deviations > 0.0, 2.0 * _STEP * self.deviations, np.inf)
        return np.asarray(((larger - smaller).T / widths).T)

    def solve(self, x: Array, options: Options) -> Solved:
        """Return all quantities of drops with numbers (n, numbers)."""
        rows = dict(zip(self.numbers, x.T, strict=True))
        return solve_quantities(self.drop, rows, len(x), options)

    def possible(self, x: Array) -> tuple[NDArray[np.bool_], str]:
        """Return which rows (n, numbers) are possible drops, and the first message of those not."""
        every = np.ones(len(x), dtype=bool)
        try:
            check(self.drop, dict(zip(self.numbers, x.T, strict=True)), lambda _: "")
        except (InvalidValue, InvalidType) as error:
            for i, row in enumerate(x):
                try:
                    self.drop_at(row)
                except (InvalidValue, InvalidType):
                    every[i] = False
            return every, str(error).strip()
        return every, ""

    def linear(self, value: float, slopes: Array) -> Any:
        """Return a value that depends on the numbers with these derivatives (numbers,)."""
        apart = [number - number.nominal_value for number in self.errors]
        return known_to(value, 0.0) + np.dot(slopes, apart)

    def draw(self, count: int, seed: int) -> tuple[Array, str, float]:
        """Return draws from the normal distribution of the numbers that are possible drops.

        Parameters
        ----------
        count : int
            The number of draws; all given ones, if there are any.
        seed : int
            Of the random numbers.

        Returns
        -------
        draws : ndarray
            (count, numbers)
        refused : str
            Why draws that are not possible were left out, by the first of them; empty if none was.
        share : float
            The share of those left out.

        Raises
        ------
        InvalidValue
            If few draws are possible.
        """
        random = np.random.default_rng(seed)
        if self.given:
            count = len(next(iter(self.given.values())))
        found, refused, left_out = np.empty((0, len(self.numbers))), "", 0
        for attempt in range(1, _ATTEMPTS + 1):
            z = random.standard_normal((count, self.spread.shape[1]))
            # a product of matrices need not be the same bit for bit on all machines
            x = self.values + np.sum(z[:, None, :] * self.spread, axis=2)
            for k, draws in self.given.items():
                x[:, k] = draws
            good, wrong = self.possible(x)
            refused = refused or wrong
            left_out += int(np.sum(~good))
            found = np.concatenate([found, x[good]])[:count]
            if len(found) == count or (self.given and len(found)):
                return found, refused, left_out / (attempt * count)
        raise InvalidValue(f"errors leave few drops that are possible: {refused}")


def of_draws(column: Array, scale: float = 0.0) -> Any:
    """Return the mean and the standard deviation of those draws that have a number.

    Next to numbers of the size `scale`, deviations of round-off are none.

    Examples
    --------
    >>> of_draws(np.array([1.0, 3.0, np.nan]))
    2.0+/-1.0
    """
    known = column[np.isfinite(column)]
    if not len(known):
        return known_to(np.nan, 0.0)
    mean, deviation = float(np.mean(known)), float(np.std(known))
    return known_to(mean, deviation if deviation > _ROUND_OFF * max(abs(mean), scale) else 0.0)


def error_of_deviation(column: Array) -> float:
    """Return the relative standard error of the standard deviation of draws; 0 without spread.

    Examples
    --------
    >>> round(error_of_deviation(np.array([-1.0, 0.0, 0.0, 1.0] * 25)), 3)
    0.05
    """
    known = column[np.isfinite(column)]
    if not len(known) or of_draws(known).std_dev == 0.0:
        return 0.0
    z = (known - np.mean(known)) / np.std(known)
    return float(np.sqrt(max(np.mean(z**4) - 1.0, 0.0) / (4.0 * len(known))))


def read_inputs(drop: Drop, errors: object) -> Inputs:
    """Check the numbers with errors and return them; see `predict`."""
    if not isinstance(errors, Mapping) or not errors:
        raise InvalidType(
            "errors must map paths to numbers with errors, such as {'height': '63 ± 1 cm'}, "
            f"got {shown(errors)}"
        )
    places = {f"offsets.{i}": i for i in range(len(drop.balls))}
    numbers = tuple(number_at(drop, path) for path in errors if path not in places)
    check_together(numbers)
    aside = [Number(p, "offsets", i, "", "m") for p, i in places.items() if p in errors]
    errors = {
        one.path: magnitude(errors[one.path], one.unit, one.path) for one in (*numbers, *aside)
    }
    given = {
        k: _draws(number.path, errors[number.path])
        for k, number in enumerate(numbers)
        if getattr(errors[number.path], "ndim", 0) > 0
    }
    lengths = {len(draws) for draws in given.values()}
    if len(lengths) > 1:
        listed = " and ".join(map(str, sorted(lengths)))
        raise InvalidValue(f"errors must have as many draws of each number, got {listed}")
    known = dict(zip(given, _as_normal(list(given.values())), strict=True))
    values = tuple(
        known[k] if k in known else _with_error(number, errors[number.path])
        for k, number in enumerate(numbers)
    )
    offsets = {number.index: _with_error(number, errors[number.path]) for number in aside}
    inputs = Inputs(drop, numbers, values, given, offsets)
    if not inputs.spread.any() and not any(offset.std_dev for offset in offsets.values()):
        raise InvalidValue("errors must have a number with an error above 0, got none")
    return inputs


def add_value(drop: Drop, path: str, error: float | str, name: str) -> tuple[float, float]:
    """Return a number of a drop with an error of it, in SI units; messages call the error `name`.

    Raises
    ------
    InvalidValue
        If the drop has no such number or does not give it, or the error is out of range.

    Examples
    --------
    >>> import stackbounce as sb
    >>> drop = sb.Drop([sb.Ball(0.057)], [sb.Spring(2e4)], height=0.63)
    >>> add_value(drop, "height", "1 cm", "error of height")
    (0.63, 0.01)
    """
    number = number_at(drop, path)
    value = value_in(drop, number)
    if math.isnan(value):
        raise InvalidValue(f"{name} needs {path}, which the drop does not give")
    return value, quantity(error, number.unit, name)


def _with_error(number: Number, value: Any) -> Any:
    """Return a value with its error as a UFloat in SI units."""
    path, unit = number.path, number.unit
    right = "a number with an error, such as ufloat(0.63, 0.01), (0.63, 0.01) or '0.63 ± 0.01'"
    found = value
    if isinstance(value, str):
        found = quantity_with_error(value, unit, path)
    elif isinstance(value, Sequence) and len(value) == 2:
        mean, error = (quantity(item, unit, path) for item in value)
        found = known_to(mean, deviation(path, error))
    if not hasattr(found, "nominal_value"):
        raise InvalidType(f"{path} must be {right}, got {shown(value)}")
    finite(path, found.nominal_value)
    deviation(path, found.std_dev)
    return found


def _draws(path: str, value: Any) -> Array:
    """Return the draws of a number."""
    draws = np.asarray(all_real(path, value))
    if draws.ndim != 1 or len(draws) < FEWEST or draws.dtype.kind not in "iuf":
        raise InvalidValue(
            f"{path} must be a number with an error or an array of {FEWEST} draws or more, "
            f"got an array of {draws.dtype} {draws.shape}"
        )
    if not np.all(np.isfinite(draws)):
        raise InvalidValue(f"{path} must have finite draws")
    deviation(path, np.ptp(draws))
    return draws.astype(float)


def _as_normal(draws: Sequence[Array]) -> list[Any]:
    """Return UFloats with the means and the covariances of draws."""
    from uncertainties import correlated_values

    if not draws:
        return []
    means = [float(np.mean(own)) for own in draws]
    return list(correlated_values(means, np.atleast_2d(np.cov(np.array(draws)))))
