"""The pictures of `sweeps.md`, drawn by the package itself: what its commands draw."""

import numpy as np
from shown import show as hand_over

import stackbounce as sb
from stackbounce import plots

ONE = sb.Ball(1.0)
SPRINGS = sb.Drop([ONE, ONE], [sb.Spring(1.0), sb.Spring(1.0)], impact_speed=1.0)
SEPARATE = sb.Drop([ONE, ONE], [sb.Rigid(0.8), sb.Rigid(0.8)], impact_speed=1.0)
COLLAPSING = sb.Drop([ONE, ONE], [sb.Rigid(0.9), sb.Rigid(0.5)], impact_speed=1.0)
LAWS = [sb.Hysteretic(56e3, restitution=0.78), sb.Spring(16e3)]
LOSSY = sb.Drop(sb.stack("B1", "B2").balls, LAWS, gaps=[0.001], height=0.2)
BASKETBALL = sb.stack("basketball", "tennis", height=1.0)
MAP = {
    "balls.0.mass": np.geomspace(0.01, 10.0, 200),
    "contacts.0.stiffness": np.geomspace(0.1, 100.0, 200),
}
SWEEPS = {  # the store of the page's command: drop, what varies
    "mass": (SPRINGS, {"balls.0.mass": np.linspace(0.05, 10.0, 400)}),
    "stiffness": (BASKETBALL, {"contacts.0.stiffness": np.geomspace(100.0, 1e5, 241)}),
    "separate": (SEPARATE, {"balls.0.mass": np.linspace(0.02, 10.0, 500)}),
    "gap": (LOSSY, {"gaps.0": np.linspace(0.0, 0.005, 251)}),
    "map": (SPRINGS, MAP),
    "collapse": (
        COLLAPSING,
        {
            "balls.0.mass": np.geomspace(0.001, 1.0, 100),
            "contacts.1.restitution": np.linspace(0.05, 1.0, 96),
        },
    ),
    "energy": (
        LOSSY,
        {
            "gaps.0": np.linspace(0.0, 0.005, 101),
            "balls.0.mass": np.geomspace(0.020, 0.500, 120),
        },
    ),
}


def _draw(name, show="rebound_ratio", **which):
    drop, over = SWEEPS[name]
    draw = plots.lines if len(over) == 1 else plots.heatmap
    hand_over(draw, sb.sweep(drop, over), show, **which)


def mass():
    """Rebound ratios on equal springs against the mass ratio, Figure 4a."""
    _draw("mass")


def stiffness():
    """Rebound ratios of basketball and tennis ball against the floor's stiffness, Figure 6."""
    _draw("stiffness")


def separate():
    """Rebound ratios of separate collisions against the mass ratio, as in Figure 2."""
    _draw("separate")


def gap():
    """Rebound ratios of two superballs against the gap between them."""
    _draw("gap")


def upper():
    """The upper ball's rebound ratio over mass ratio and stiffness ratio."""
    _draw("map")


def touches():
    """How often the lower ball touches the floor."""
    _draw("map", "collisions", index=0)


def collapse():
    """How often two rigid balls collide."""
    _draw("collapse", "collisions")


def energy():
    """Energy retained by two superballs."""
    _draw("energy", "energy_retained")
