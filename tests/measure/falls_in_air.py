"""Falls and bounces in air by an integrator, which knows nothing of the package's formulas."""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp
from uncertainties import ufloat

from stackbounce.measure import Drag
from synthetic.falls import Falls

BALL = 2.7e-3, 0.040  # a table tennis ball: kg, m
AIR, UNSURE = Drag(*BALL, 0.45), Drag(*BALL, ufloat(0.45, 0.05))
GRAVITY, DENSITY = 9.80665, 1.204
AT_REST, SLOPE = 0.92, 0.012  # restitution at no speed, and its fall per m/s


def kept(speed):
    return AT_REST - SLOPE * speed


@dataclass(frozen=True)
class FallsInAir(Falls):
    """Falls in air: `apexes` in m after each bounce, and the solutions between the bounces."""

    apexes: Any
    solutions: Any

    def position(self, times):
        heights = np.where(times < 0.0, self.height, 0.0)
        starts, ends = [0.0, *self.releases], [*self.touches, math.inf]
        for start, end, solution in zip(starts, ends, self.solutions, strict=True):
            flying = (times >= start) & (times < end)
            if flying.any():
                at = np.minimum(times[flying] - start, solution.t_max)
                heights[flying] = np.maximum(solution(at)[0], 0.0)
        return heights


def falls_in_air(height, kept, *, ball=BALL, coefficient=0.45, bounces=8, lasts=lambda _: 0.0):
    """Return a ball's bounces, with its restitution and the duration of a contact at a speed."""
    mass, diameter = ball
    k = DENSITY * coefficient * math.pi * (diameter / 2.0) ** 2 / (2.0 * mass)
    first = _flight(k, [height, 0.0])
    time, speed = first.t[-1], -first.y[1, -1]
    rows, solutions = [], [first.sol]
    for _ in range(bounces):
        e, contact_time = kept(speed), lasts(speed)
        flown = _flight(k, [0.0, e * speed])
        rows.append((time, time + contact_time, speed, e, flown.y_events[1][0][0]))
        solutions.append(flown.sol)
        time, speed = time + contact_time + flown.t[-1], -flown.y[1, -1]
    *columns, apexes = np.array(rows).T
    return FallsInAir(height, GRAVITY, *columns, apexes, solutions)


def _flight(k, state):
    def floor(_, y):
        return y[0]

    def top(_, y):
        return y[1]

    floor.terminal, floor.direction, top.direction = True, -1.0, -1.0

    def falling(_, y):
        return [y[1], -GRAVITY - k * y[1] * abs(y[1])]

    exact = {"method": "DOP853", "rtol": 1e-11, "atol": 1e-13, "dense_output": True}
    return solve_ivp(falling, (0.0, 10.0), state, events=(floor, top), **exact)
