"""The solitary wave of a Hertz chain: its shape, and its speed by the striker's speed."""

import matplotlib.pyplot as plt
import numpy as np
from shared import BEAD, BLACK, FLOOR, SPEED, UPPER, WIDE, chain

FIRST, LAST = 30, 70  # beads between which the wave is timed


def waves(speed):
    """Return times in s, and the velocities of `FIRST` and `LAST` in units of the striker's."""
    result = chain("Hertz", speed)
    times = np.linspace(0.0, result.end_time, 8001)
    return times, result.sample(times).velocity.values[[FIRST, LAST]] / speed


def top(times, values):
    """Return time and height of a curve's peak, by a parabola through its highest samples."""
    peak = int(np.argmax(values))
    a, b, c = values[peak - 1 : peak + 2]
    shift = 0.5 * (a - c) / (a - 2.0 * b + c)
    return times[peak] + shift * (times[1] - times[0]), b - 0.25 * (a - c) * shift


def beads_per_second(times, pair):
    """Return the speed of the wave."""
    return (LAST - FIRST) / (top(times, pair[1])[0] - top(times, pair[0])[0])


figure, (shape, law) = plt.subplots(1, 2, figsize=(WIDE, 3.1), width_ratios=[1.1, 1.0])
times, pair = waves(SPEED)
when, height = top(times, pair[1])
places = beads_per_second(times, pair) * (when - times)  # ahead of the wave
shape.plot(places, pair[1] / height, color=UPPER)
inside = np.linspace(-2.5, 2.5, 201)
compacton = np.cos(np.clip(np.sqrt(10.0) / 5.0 * inside, -np.pi / 2, np.pi / 2)) ** 4
shape.plot(inside, compacton, color=FLOOR, linestyle="--")
at = np.arange(-4, 5)
shape.plot(at, np.interp(at, places[::-1], pair[1][::-1] / height), "o", color=UPPER, markersize=4)
shape.set_xlim(-4.2, 4.2)
shape.set_ylim(-0.03, 1.1)
shape.set_xlabel("distance from the peak (beads)")
shape.set_ylabel("velocity / largest velocity")
shape.text(1.05, 0.66, "Nesterenko,\n$\\cos^4(\\sqrt{10}\\,x/5)$", color=FLOOR)
shape.text(-1.2, 0.42, "beads", color=UPPER, ha="right")

strikers = np.geomspace(0.01, 10.0, 7)
speeds = np.array([beads_per_second(*waves(speed)) * BEAD.diameter for speed in strikers])
slope, start = np.polyfit(np.log(strikers), np.log(speeds), 1)
line = np.geomspace(0.006, 16.0, 2)
law.loglog(line, np.exp(start) * line**slope, color=BLACK, linewidth=0.8)
law.loglog(strikers, speeds, "o", color=UPPER, markersize=5)
law.text(0.06, 0.9, f"slope {slope:.4f}", transform=law.transAxes)
law.set_ylim(150.0, 1500.0)
law.set_yticks([200, 300, 400, 600, 800, 1000], ["200", "300", "400", "600", "800", "1000"])
law.set_yticks([], minor=True)
law.set_xlabel("striker's speed (m/s)")
law.set_ylabel("speed of the wave (m/s)")
figure.subplots_adjust(left=0.075, right=0.985, top=0.97, bottom=0.15, wspace=0.25)
