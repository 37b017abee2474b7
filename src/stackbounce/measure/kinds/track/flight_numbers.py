"""The acceleration, level and speed of each flight, with errors that go together."""

from collections.abc import Sequence
from typing import Any, TypeAlias

import numpy as np

from stackbounce.measure.kinds.track.parabolas import Flights, fit_flights
from stackbounce.measure.kinds.track.shape import OWN, Shape, own_noise
from stackbounce.measure.quantities import Array
from stackbounce.measure.statistics.regression import widening

__all__ = ["Numbers", "flight_numbers"]

Numbers: TypeAlias = tuple[Any, Any, Any]
"""Acceleration, level and speed of a flight at its middle: numbers with errors."""


def flight_numbers(times: Array, heights: Array, fit: Flights, shape: Shape) -> Sequence[Numbers]:
    """Return the numbers of each flight.

    All flights have one acceleration, unless their own differ by more than chance makes them, as
    where a lens, or the distance to the camera, changes the scale from one place to another. Speeds
    at the floor are then right only with the curvature that each flight has: its acceleration is
    its own, drawn to the mean by as much as the accelerations are seen to scatter.
    """
    from uncertainties import correlated_values

    wider = widening(max(fit.freedom, 1)) ** 2
    if shape.widening <= 1.0:
        numbers = correlated_values(fit.values, wider * fit.covariance)
        return [(numbers[0], *numbers[1 + 2 * k : 3 + 2 * k]) for k in range(len(fit.flights))]
    noise = own_noise(times, heights, fit.flights)
    mean, scatter = float(fit.values[0]), shape.scatter * float(fit.values[0])
    found: list[Numbers] = []
    for k, flight in enumerate(fit.flights):
        if flight.last - flight.first < OWN:
            some = [0, 1 + 2 * k, 2 + 2 * k]
            values = fit.values[some]
            covariance = shape.widening**2 * fit.covariance[np.ix_(some, some)]
        else:
            alone = fit_flights(times, heights, [flight])
            values = alone.values
            covariance = (noise / max(alone.sigma, 1e-300)) ** 2 * alone.covariance
            share = covariance[0] / (covariance[0, 0] + scatter**2)
            values = values + share * (mean - values[0])
            covariance = covariance - np.outer(share, covariance[0])
        found.append(tuple(correlated_values(values, wider * covariance)))
    return found
