"""Newton's cradle of five: velocities against time under four laws."""

import matplotlib.pyplot as plt
import numpy as np
from shared import COLORS, CRADLE, LOSSY, SPEED, WIDE, contacts, label_ends, paths

import stackbounce as sb

PANELS = [
    ("rigid", "rigid"),
    ("springs", "springs"),
    ("Hertz", "Hertz"),
    ("lossy", f"Hertz with losses, {LOSSY} at {SPEED:.0f} m/s"),
]

times = np.linspace(-20e-6, 240e-6, 1301)
figure, panels = plt.subplots(2, 2, sharex=True, sharey=True, figsize=(WIDE, 5.0))
for ax, (law, title) in zip(panels.flat, PANELS, strict=True):
    laws = contacts(CRADLE, law, floor=False)
    result = sb.simulate(sb.Drop(CRADLE, laws, velocities=[SPEED, 0.0, 0.0, 0.0, 0.0]))
    tracks = paths(result, times, "velocity")
    for track, color in zip(tracks, COLORS, strict=True):
        ax.plot(1e6 * times, track, color=color)
    ax.set_ylim(-0.2, 1.3)
    ends = [
        (v, f"ball {b}:  {v:.3f}".replace("-", "−").replace("−0.000", "0.000"), color)
        for b, (v, color) in enumerate(zip(result.rebound_speeds, COLORS, strict=True))
    ]
    label_ends(ax, 240.0, ends, apart=0.08)
    ax.text(0.97, 0.96, title, transform=ax.transAxes, ha="right", va="top")
for ax in panels[:, 0]:
    ax.set_ylabel("velocity (m/s)")
for ax in panels[1]:
    ax.set_xlabel("time since the first touch (µs)")
figure.subplots_adjust(left=0.08, right=0.875, top=0.985, bottom=0.095, wspace=0.42, hspace=0.07)
