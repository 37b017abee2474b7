"""The pictures of `straight.md`: angles by offset, in a tower, and what contact time does."""

import matplotlib.pyplot as plt
import numpy as np
from shared import BLACK, CANNON, FLOOR, UPPER, WIDE, contacts

import stackbounce as sb
from stackbounce.cross2007.style import GREY

GREEN = "#009E73"
FOUR = sb.Drop(CANNON[:4], contacts(CANNON[:4], "Hertz", floor=True), [0.0] * 3, height=1.0)
STACKS = [  # what is drawn, its color, and the drop
    ("cannon of four steel balls", GREEN, FOUR),
    ("superballs B1 and B2", FLOOR, sb.stack("B1", "B2", height=0.2)),
    ("basketball and tennis ball", UPPER, sb.stack("basketball", "tennis", height=0.63)),
    ("big basketball and tennis ball", GREY, sb.stack("big-basketball", "tennis-ball", height=1.0)),
]
EXACT = ([5.0, 10.0, 20.0], [8.27, 16.47, 32.53])  # mm and degrees, by tests/test_sideways.py
PAIR = sb.stack("basketball", "tennis", height=0.63)
STIFFER = [("as they are", UPPER, 1.0), ("10 times stiffer", FLOOR, 10.0)]
STIFFER += [("100 times", GREEN, 100.0), ("infinitely", BLACK, 1e8)]


def per_mm(drop, ball=-1):
    """Return the angles in degrees at which a ball leaves, for 1 mm of the offset of each."""
    result = sb.simulate(drop, rtol=1e-9)
    return np.degrees(1e-3 * result.sideways().transfer.values[ball] / result.rebound_speeds[ball])


def offset():
    """The angle of the uppermost ball against the offset of its centre."""
    figure, ax = plt.subplots(figsize=(WIDE, 4.2))
    offsets = np.geomspace(0.03, 20.0, 60)
    for name, color, drop in STACKS:
        for stack, line, label in ((drop, "-", name), (sb.separate(drop), "--", None)):
            slope = np.tan(np.radians(per_mm(stack)[-1]))
            angles = np.degrees(np.arctan(slope * offsets))
            ax.loglog(offsets, angles, line, color=color, label=label)
    ax.plot(*EXACT, "o", color=UPPER, markersize=5)
    ax.axhline(15.0, color=BLACK, linewidth=0.6, linestyle=":")
    for at, name in ((0.1, "rod"), (0.5, "tube, 1 mm of play"), (2.0, "hand")):
        ax.axvline(at, color=BLACK, linewidth=0.6, linestyle=":")
        ax.text(1.04 * at, 0.022, name)
    ax.set_xlim(0.03, 20.0)
    ax.set_ylim(0.018, 60.0)
    ax.set_xlabel("offset of the uppermost ball (mm)")
    ax.set_ylabel("angle at which it leaves (°)")
    ax.set_xticks([0.1, 1.0, 10.0], ["0.1", "1", "10"])
    ax.set_yticks([0.1, 1.0, 10.0], ["0.1", "1", "10"])
    white = {"facecolor": "white", "edgecolor": "white", "framealpha": 1.0}
    ax.legend(loc="upper left", fontsize=9.5, **white)
    figure.tight_layout()


def tower():
    """A cannon of five: which ball matters, and how offsets are amplified."""
    figure, (bars, curves) = plt.subplots(1, 2, figsize=(WIDE, 3.2), width_ratios=[1.2, 1.0])
    for place, (gap, color, name) in enumerate(
        ((0.0, UPPER, "touching"), (1e-3, FLOOR, "gaps of 1 mm"), (1e-2, GREEN, "gaps of 10 mm"))
    ):
        angles, most = [], []
        for count in range(2, 6):
            laws = contacts(CANNON[:count], "Hertz", floor=True)
            drop = sb.Drop(CANNON[:count], laws, [gap] * (count - 1), height=1.0)
            angles = np.abs(per_mm(drop))
            most.append(np.linalg.svd(sb.simulate(drop).sideways().transfer.values)[1][0])
        bars.bar(np.arange(1, 5) + 0.26 * (place - 1), angles[1:], 0.24, color=color, label=name)
        curves.semilogy(range(2, 6), most, "o-", color=color, markersize=4)
    bars.set_yscale("log")
    bars.set_ylim(1e-4, 1e3)
    bars.set_xticks(range(1, 5))
    bars.tick_params(axis="x", which="both", length=0.0)
    bars.set_xlabel("ball that is off; ball 4 is the uppermost")
    bars.set_ylabel("angle of ball 4 (° per mm)")
    bars.legend(frameon=False, loc="upper left", fontsize=9.5)
    curves.set_xticks(range(2, 6))
    curves.set_yticks([500, 1000, 2000, 5000], ["500", "1000", "2000", "5000"])
    curves.set_yticks([], minor=True)
    curves.set_xlabel("balls in the cannon")
    curves.set_ylabel("largest singular value (1/s)")
    figure.tight_layout()


def contact_time():
    """The angle with springs over that of rigid balls, by mass ratio and stiffness ratio."""
    figure, panels = plt.subplots(1, 2, figsize=(WIDE, 3.4), sharey=True)
    upper, stiffness = PAIR.balls[1], PAIR.contacts[1].stiffness
    masses, ratios = np.geomspace(0.5, 50.0, 41), np.geomspace(0.1, 100.0, 41)

    def beside_rigid(mass_ratio, ratio, factor):
        lower = sb.Ball(mass_ratio * upper.mass, diameter=PAIR.balls[0].diameter)
        laws = [sb.Spring(factor * k * stiffness) for k in (ratio, 1.0)]
        drop = PAIR.replace(balls=[lower, upper], contacts=laws)
        return per_mm(drop)[-1] / per_mm(sb.separate(drop))[-1]

    for name, color, factor in STIFFER:
        panels[0].loglog(masses, [beside_rigid(m, 2.5, factor) for m in masses], color=color)
        own = PAIR.balls[0].mass / upper.mass
        angles = [beside_rigid(own, ratio, factor) for ratio in ratios]
        panels[1].loglog(ratios, angles, color=color, label=name)
    for ax, label, x in zip(panels, ("mass ratio", "stiffness ratio"), (2.63, 2.5), strict=True):
        ax.axhline(1.0, color=BLACK, linewidth=0.6, linestyle=":")
        ax.axvline(x, color=BLACK, linewidth=0.6, linestyle=":")
        ax.set_xlabel(label)
    panels[0].set_xticks([1.0, 10.0], ["1", "10"])
    panels[1].set_xticks([0.1, 1.0, 10.0, 100.0], ["0.1", "1", "10", "100"])
    panels[0].set_ylim(0.8, 6.0)
    panels[0].set_yticks([1.0, 2.0, 3.0, 4.0, 5.0], ["1", "2", "3", "4", "5"])
    panels[0].set_yticks([], minor=True)
    panels[0].set_ylabel("angle over that of rigid balls")
    panels[1].legend(frameon=False, fontsize=9.5)
    figure.tight_layout()
