"""The pictures of `gaps-and-masses.md`: its commands, and the top ball against one mass."""

import matplotlib.pyplot as plt
import numpy as np
from shown import show as hand_over

import stackbounce as sb
from stackbounce import plots
from stackbounce.cross2007.style import BLACK, FLOOR, UPPER

BASKETBALL = sb.stack("basketball", "tennis", height=1.0)
LAWS = [sb.Hysteretic(56e3, restitution=0.78), sb.Spring(16e3)]
LIGHT_BELOW = sb.Drop(sb.stack("B2", "B1").balls, LAWS, height=0.2)
THREE = [sb.Ball(1.0), sb.Ball(0.1), sb.Ball(0.01)]
MASSES = [  # what is drawn, its color, and the drop
    ("rigid", BLACK, sb.Drop(THREE, [sb.Rigid(1.0)] * 3, impact_speed=1.0)),
    ("Hertz, touching", UPPER, sb.Drop(THREE, [sb.Hertz(1e6)] * 3, impact_speed=1.0)),
    ("springs, touching", FLOOR, sb.Drop(THREE, [sb.Spring(1e4)] * 3, impact_speed=1.0)),
    (
        "springs, 3 mm",
        "#009E73",
        sb.Drop(THREE, [sb.Spring(1e4)] * 3, [3e-3] * 2, impact_speed=1.0),
    ),
]


def gap():
    """The basketball and the tennis ball from touching to separate."""
    hand_over(plots.lines, sb.sweep(BASKETBALL, {"gaps.0": np.linspace(0.0, 0.12, 121)}))


def lossy():
    """Two superballs, the light one below, with losses on the floor."""
    hand_over(plots.lines, sb.sweep(LIGHT_BELOW, {"gaps.0": np.linspace(0.0, 0.02, 201)}))


def stacks():
    """The best stacks of three balls of the catalogue."""
    hand_over(plots.highest, sb.highest())


def masses():
    """The top ball's rebound ratio against the mass of the one in the middle."""
    figure, axes = plt.subplots(figsize=(6.4, 3.8))
    between = np.geomspace(0.01, 1.0, 401)
    for name, color, drop in MASSES:
        top = sb.sweep(drop, {"balls.1.mass": between}).rebound_ratio.sel(ball=2)
        axes.semilogx(1e3 * between, top, color=color, label=name)
        best = sb.best_masses(drop)
        ratio = sb.simulate(best).rebound_ratios[-1]
        axes.plot(1e3 * best.balls[1].mass, ratio, "o", color=color, markersize=6)
    axes.set_xticks([10, 30, 100, 300, 1000], ["10", "30", "100", "300", "1000"])
    axes.set_xlabel("mass of the ball in the middle (g)")
    axes.set_ylabel("rebound ratio of the top ball")
    axes.legend(frameon=False)
    figure.tight_layout()
