"""A light ball on a heavy one, both with losses, under gravity: a low bounce, then a high one."""

import math

import matplotlib.pyplot as plt
import numpy as np
from shared import BLACK, FLOOR, UPPER, WIDE, paths

import stackbounce as sb
from stackbounce.cross2007.style import GREY

HEIGHT, GRAVITY = 0.5, 9.81  # m, m/s**2
HEAVY, LIGHT, ZETA = 0.5, 0.01, 0.1  # kg, kg, damping ratio of each contact

speed = math.sqrt(2.0 * GRAVITY * HEIGHT)
stiffness = HEAVY * (GRAVITY / (0.005 * speed)) ** 2
laws = [
    sb.Dashpot(stiffness, 2.0 * ZETA * math.sqrt(stiffness * mass))
    for mass in (HEAVY, HEAVY * LIGHT / (HEAVY + LIGHT))
]
balls = [sb.Ball(HEAVY), sb.Ball(LIGHT)]
result = sb.simulate(sb.Drop(balls, laws, height=HEIGHT, gravity=GRAVITY), until=60.0)
assert result.status is sb.Status.SETTLED

times = np.unique(np.concatenate([np.linspace(-speed / GRAVITY, 4.3, 6000), result.events["time"]]))
low, high = paths(result, times, "position") / HEIGHT
figure, ax = plt.subplots(figsize=(WIDE, 3.5))
ax.plot(times, high, color=UPPER)
ax.plot(times, low, color=FLOOR)
for ball, color in ((1, UPPER), (0, FLOOR)):
    tops = result.apexes[
        (result.apexes["ball"] == ball) & (result.apexes["height"] > 0.02 * HEIGHT)
    ]
    ax.plot(tops["time"], tops["height"] / HEIGHT, "o", color=color, markersize=4)
    for row in tops[: 4 if ball else 0]:
        ax.annotate(
            f"{row['height'] / HEIGHT:.3f}",
            (row["time"], row["height"] / HEIGHT),
            (0, 5),
            textcoords="offset points",
            ha="center",
            color=color,
        )
ax.axvline(result.end_time, color=GREY, linewidth=0.8, linestyle=":")
ax.annotate(
    f"at rest\nafter {result.end_time:.2f} s",
    (result.end_time, 1.2),
    (-5, 0),
    textcoords="offset points",
    ha="right",
    color=GREY,
)
ax.text(2.05, 1.75, f"light ball, {1e3 * LIGHT:.0f} g", color=UPPER)
ax.text(0.95, 0.33, f"heavy ball, {1e3 * HEAVY:.0f} g", color=FLOOR, ha="center")
ax.text(-0.2, 1.02, "released", color=BLACK)
ax.set_xlim(-0.36, 4.3)
ax.set_ylim(-0.06, 2.45)
ax.set_xlabel("time since the heavy ball touched the floor (s)")
ax.set_ylabel("position / height of the fall")
figure.subplots_adjust(left=0.07, right=0.985, top=0.98, bottom=0.135)
