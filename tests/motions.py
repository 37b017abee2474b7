"""Motions that are no bounces, as a video or a phone records them: (times, heights) in s and m."""

import numpy as np

from stackbounce.measure.quantities import Array

G = 9.80665


def _seen(times: Array, heights: Array, noise: float = 1e-3) -> tuple[Array, Array]:
    return times, heights + np.random.default_rng(7).normal(0.0, noise, len(times))


def rectified_sine(rows=1000, rate=50.0, period=1.0):
    """Return arcs of half a sine, which meet as flights do."""
    times = np.arange(rows) / rate
    return _seen(times, 0.3 * np.abs(np.sin(2.0 * np.pi * times / period)))


def pendulum() -> tuple[Array, Array]:
    """Return a pendulum's height: two maxima in each period."""
    times = np.arange(300) / 30.0
    angle = 0.4 * np.cos(np.pi * times) * np.exp(-times / 30.0)
    return _seen(times, 1.0 - np.cos(angle))


def valley() -> tuple[Array, Array]:
    """Return a ball that rolls to and fro between two inclines: true parabolas of 0.14 m/s²."""
    place, speed, heights = 0.5, 0.0, []
    for _ in range(600):
        speed -= 0.01 * (np.sign(place) + 0.1 * np.sign(speed))
        place += 0.01 * speed
        heights.append(abs(place) * np.sin(0.15))
    return _seen(np.arange(600) / 100.0, np.array(heights))


def bowl() -> tuple[Array, Array]:
    times = np.arange(600) / 100.0
    return _seen(times, 0.2 * (np.cos(np.pi * times) * np.exp(-times / 10.0)) ** 2)


def spring() -> tuple[Array, Array]:
    times = np.arange(600) / 100.0
    return _seen(times, 0.1 * np.cos(2.0 * np.pi * times / 0.4) * np.exp(-times / 5.0), 2e-3)


def drift(rows: int = 1000) -> tuple[Array, Array]:
    """Return a random walk."""
    return np.arange(rows) / 30.0, np.cumsum(np.random.default_rng(3).normal(0.0, 3e-3, rows))


def throw() -> tuple[Array, Array]:
    """Return one flight."""
    times = np.arange(40) / 30.0
    return _seen(times, 1.0 + 4.0 * times - 0.5 * G * times**2)


def jumper() -> tuple[Array, Array]:
    """Return a person who jumps: flights of 0.7 s, and 0.2 s on the floor between them."""
    times = np.arange(200) / 30.0
    since = times % 0.9
    flown = 0.5 * G * (since - 0.2) * (0.9 - since)
    return _seen(times, np.where(since > 0.2, flown, -0.1 * np.sin(np.pi * since / 0.2)), 3e-3)


def thrown_up() -> tuple[Array, Array]:
    """Return a ball that is hit in the moment of its bounce: it leaves with 1.3 times its speed."""
    since = np.arange(60) / 60.0 - 0.4
    return _seen(since + 0.4, np.where(since < 0.0, -4.0, 5.2) * since - 0.5 * G * since**2)


TRACKS = {
    "rectified sine": (rectified_sine, "from the middle to the ends"),
    "slow rectified sine": (lambda: rectified_sine(period=2.0), "no free flight"),
    "pendulum": (pendulum, "no free flight"),
    "valley": (valley, "accelerations along y are 0.1.* m/s.2 where a fall has 9.81"),
    "bowl": (bowl, "accelerations along y are .* a ball that rolls, swings or is held"),
    "spring": (spring, "no free flights that meet at a floor"),
    "drift": (drift, "no free flight: accelerations along y are"),
    "throw": (throw, "one flight of 1.3 s with an acceleration of 9.8.* m/s.2 and no bounce"),
    "jumper": (jumper, "on the floor for 0.17 s; legs or a trampoline"),
    "hit": (thrown_up, r"a restitution of 1\..* it is hit or thrown there"),
}
"""Each with the words of its refusal."""


def swings(rate: float = 100.0) -> tuple[Array, Array]:
    """Return the size of the acceleration without g of a phone that is swung: 3 to 21 m/s²."""
    times = np.arange(0.0, 20.0, 1.0 / rate)
    calm = np.where((times > 2.0) & (times < 18.0), 12.0 - 9.0 * np.cos(9.0 * times), 0.2)
    return _seen(times, calm, 0.3)


def jumps(rate: float = 100.0) -> tuple[Array, Array]:
    """Return the size of the acceleration with g of a person who jumps: 0.3 s in the air."""
    times = np.arange(0.0, 10.0, 1.0 / rate)
    since = times % 0.6
    landing = G + 25.0 * np.sin(np.pi * since / 0.3)
    return _seen(times, np.abs(np.where(since < 0.3, landing, 0.8)), 0.3)
