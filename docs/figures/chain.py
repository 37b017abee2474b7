"""A hundred beads struck at one end: Hertz's law carries a solitary wave, springs do not."""

import matplotlib.pyplot as plt
import numpy as np
from shared import BLACK, FLOOR, GREY, SPEED, UPPER, WIDE, contacts, remark, steel

import stackbounce as sb

BEAD = steel(7800.0 * np.pi * 0.008**3 / 6.0)  # 8 mm
COUNT = 100
SHOWN = (0, 5, 20, 35, 50, 65, 80)


def chain(law, speed=SPEED):
    """Return the run of a chain at rest, struck by one more bead."""
    beads = [BEAD] * COUNT
    pair = contacts(beads[:2], law, floor=False)[1]
    drop = sb.Drop(beads, [None] + [pair] * (COUNT - 1), velocities=[speed] + [0.0] * (COUNT - 1))
    return sb.simulate(drop)


if __name__ in ("__main__", "builtins"):
    figure, panels = plt.subplots(2, 1, sharex=True, sharey=True, figsize=(WIDE, 4.6))
    times = np.linspace(0.0, 1.15e-3, 4601)
    for ax, law, color in zip(panels, ("Hertz", "springs"), (UPPER, FLOOR), strict=True):
        velocities = chain(law).sample(times).velocity.values
        for bead in SHOWN:
            ax.plot(1e6 * times, velocities[bead], color=BLACK if bead == 0 else color)
            peak = int(np.argmax(velocities[bead]))
            near = {"xytext": (0, 3), "ha": "center"} if bead else {"xytext": (5, -4), "ha": "left"}
            ax.annotate(
                f"ball {bead}" if bead in (0, 20) else f"{bead}",
                (1e6 * times[peak], velocities[bead, peak]),
                textcoords="offset points",
                color=BLACK if bead == 0 else color,
                **near,
            )
        ax.axhline(0.0, color=GREY, linewidth=0.5)
        ax.set_ylim(-0.25, 1.12)
        ax.set_xlim(-8.0, 1150.0)
        ax.set_ylabel("velocity (m/s)")
        ax.text(0.985, 0.93, law, transform=ax.transAxes, ha="right", va="top")
    panels[1].set_xlabel("time since the first touch (µs)")
    figure.subplots_adjust(left=0.08, right=0.985, top=0.985, bottom=0.105, hspace=0.06)
    assert remark
