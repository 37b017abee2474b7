"""Five steel balls on each other, each lower one meant to stop: where they go under three laws."""

import matplotlib.pyplot as plt
import numpy as np
from shared import CANNON, COLORS, SPEED, WIDE, contacts, label_ends, paths

import stackbounce as sb

GAP = 50e-6
PANELS = [
    ("rigid", 0.0, "rigid"),
    ("springs", 0.0, "springs, touching"),
    ("Hertz", 0.0, "Hertz, touching"),
    ("Hertz", GAP, f"Hertz, gaps of {1e6 * GAP:.0f} µm"),
]

times = np.linspace(-60e-6, 480e-6, 1081)
figure, panels = plt.subplots(2, 2, sharex=True, sharey=True, figsize=(WIDE, 5.6))
for ax, (law, gap, title) in zip(panels.flat, PANELS, strict=True):
    drop = sb.Drop(CANNON, contacts(CANNON, law, floor=True), [gap] * 4, impact_speed=SPEED)
    result = sb.simulate(drop)
    tracks = 1e3 * paths(result, times, "position")
    for track, color in zip(tracks, COLORS, strict=True):
        ax.plot(1e6 * times, track, color=color)
    ax.set_ylim(-0.17, 1.3)
    ratios = [f"{ratio:.2f}".replace("-0.00", "0.00") for ratio in result.rebound_ratios]
    ends = [
        (track[-1], f"ball {b}:  {ratio}", color)
        for b, (track, ratio, color) in enumerate(zip(tracks, ratios, COLORS, strict=True))
    ]
    label_ends(ax, 480.0, ends)
    ax.text(0.03, 0.96, title, transform=ax.transAxes, va="top")
for ax in panels[:, 0]:
    ax.set_ylabel("position (mm)")
for ax in panels[1]:
    ax.set_xlabel("time since ball 0 touched the floor (µs)")
figure.subplots_adjust(left=0.08, right=0.89, top=0.985, bottom=0.085, wspace=0.37, hspace=0.07)
