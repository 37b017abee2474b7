"""What the figures of `towers.md` share: steel balls, their contacts, colours and labels."""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes

import stackbounce as sb
from stackbounce.cross2007.style import BLACK, FLOOR, UPPER

WIDE = 7.2  # inches
COLORS = (BLACK, FLOOR, "#009E73", UPPER, "#AA4499")  # of balls 0 to 4
SPEED = 1.0  # m/s of what comes in
LOSSY = 0.9  # restitution at that speed


def steel(mass: float) -> sb.Ball:
    """Return a steel ball of that mass in kg."""
    size = (6.0 * mass / (math.pi * 7800.0)) ** (1.0 / 3.0)
    return sb.Ball(mass, diameter=size, young_modulus=2.1e11, poisson_ratio=0.3)


CANNON = [steel(mass) for mass in (0.300, 0.100, 0.050, 0.030, 0.020)]
CRADLE = [steel(0.040)] * 5
BEAD = steel(7800.0 * math.pi * 0.008**3 / 6.0)  # 8 mm
BEADS = 100


def contacts(balls: Sequence[sb.Ball], law: str, *, floor: bool) -> list[Any]:
    """Return the contacts of a row of steel balls under a law named below.

    All finite ones have the contact time of Hertz's law when their pair meets at `SPEED`.
    """
    lower: list[sb.Ball | None] = [None, *balls[:-1]]
    found: list[Any] = []
    for below, ball in zip(lower, balls, strict=True):
        hertz = sb.Hertz.between(ball) if below is None else sb.Hertz.between(below, ball)
        mass = ball.mass if below is None else (below.mass, ball.mass)
        time = sb.contact_time(hertz, mass=mass, impact_speed=SPEED)
        measured = {"mass": mass, "contact_time": time}
        if law == "rigid":
            found.append(sb.Rigid(1.0))
        elif law == "springs":
            found.append(sb.calibrate(sb.Spring, **measured))
        elif law == "Hertz":
            found.append(hertz)
        else:
            measured |= {"restitution": LOSSY, "impact_speed": SPEED}
            found.append(sb.calibrate(sb.HuntCrossley, **measured))
    return found if floor else [None, *found[1:]]


def label_ends(
    ax: Axes, x: float, ends: Sequence[tuple[float, str, str]], apart: float = 0.075
) -> None:
    """Write (y, text, colour) to the right of x, each near its y and none on another.

    `apart` is the distance of two lines of text over the height of the axes.
    """
    low, high = ax.get_ylim()
    ends = sorted(ends, key=lambda end: (round(end[0], 9), end[1]))
    step = apart * (high - low)
    places = np.array([y for y, _, _ in ends])
    for _ in range(400):
        for i in range(len(places) - 1):
            missing = step - (places[i + 1] - places[i])
            if missing > 0.0:
                places[i] -= 0.5 * missing
                places[i + 1] += 0.5 * missing
        places = np.clip(places, low + 0.3 * step, high - 0.3 * step)
    for place, (_, text, color) in zip(places, ends, strict=True):
        ax.annotate(
            text,
            xy=(x, place),
            xytext=(4, 0),
            textcoords="offset points",
            va="center",
            color=color,
            fontsize=9.5,
            annotation_clip=False,
        )


def paths(result: sb.Result, times: np.ndarray, name: str) -> np.ndarray:
    """Return positions or velocities at times in s, (ball, time); straight flight before 0."""
    values = result.sample(np.maximum(times, 0.0))[name].values
    start = np.array(result.drop.start_velocities)[:, None]
    early = times < 0.0
    if name == "velocity":
        return np.where(early, start - result.drop.gravity * times, values)
    fallen = start * times - 0.5 * result.drop.gravity * times**2
    return values + np.where(early, fallen, 0.0)


def chain(law: str, speed: float = SPEED) -> sb.Result:
    """Return the run of a chain of beads at rest, the first of which has got a speed in m/s."""
    beads, rest = [BEAD] * BEADS, [0.0] * (BEADS - 1)
    pair = contacts(beads[:2], law, floor=False)[1]
    return sb.simulate(sb.Drop(beads, [None] + [pair] * (BEADS - 1), velocities=[speed, *rest]))
