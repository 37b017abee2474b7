"""A hundred beads struck at one end: Hertz's law carries a solitary wave, springs do not."""

import matplotlib.pyplot as plt
import numpy as np
from shared import BLACK, FLOOR, UPPER, WIDE, chain

SHOWN = (0, 5, 20, 35, 50, 65, 80)

times = np.linspace(0.0, 1.06e-3, 4241)
figure, panels = plt.subplots(2, 1, sharex=True, sharey=True, figsize=(WIDE, 4.6))
for ax, law, color in zip(panels, ("Hertz", "springs"), (UPPER, FLOOR), strict=True):
    velocities = chain(law).sample(times).velocity.values
    for bead in SHOWN:
        tint = color if bead else BLACK
        ax.plot(1e6 * times, velocities[bead], color=tint)
        peak = int(np.argmax(velocities[bead]))
        ax.annotate(
            f"ball {bead}" if bead in (0, 20) else f"{bead}",
            (1e6 * times[peak], velocities[bead, peak]),
            (0, 3) if bead else (6, -4),
            textcoords="offset points",
            ha="center" if bead else "left",
            color=tint,
        )
    ax.set_ylim(-0.25, 1.12)
    ax.set_xlim(-8.0, 1060.0)
    ax.set_ylabel("velocity (m/s)")
    ax.text(0.985, 0.93, law, transform=ax.transAxes, ha="right", va="top")
panels[1].set_xlabel("time since the first touch (µs)")
figure.subplots_adjust(left=0.08, right=0.985, top=0.985, bottom=0.105, hspace=0.06)
