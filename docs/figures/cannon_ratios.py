"""The cannon's rebound ratios by law, and how a gap between the balls changes the top one's."""

import matplotlib.pyplot as plt
import numpy as np
from shared import BLACK, CANNON, FLOOR, LOSSY, SPEED, UPPER, WIDE, contacts

import stackbounce as sb
from stackbounce.cross2007.style import GREY

LAWS = [
    ("rigid", BLACK, "rigid", "", "-"),
    ("springs", FLOOR, "springs", "////", "--"),
    ("Hertz", UPPER, "Hertz", "", "-"),
    ("lossy", GREY, f"Hertz with losses, {LOSSY} at {SPEED:.0f} m/s", "....", "-."),
]


def ratios(law, gap):
    """Return the rebound ratios of the five balls."""
    laws = contacts(CANNON, law, floor=True)
    drop = sb.Drop(CANNON, laws, [gap] * 4, impact_speed=SPEED)
    return sb.simulate(drop, rtol=1e-9).rebound_ratios


figure, (bars, curves) = plt.subplots(1, 2, figsize=(WIDE, 3.1), width_ratios=[1.15, 1.0])
for j, (law, color, name, hatch, _) in enumerate(LAWS):
    places = np.arange(5) + 0.2 * (j - 1.5)
    style = {"color": color} if not hatch else {"facecolor": "white", "edgecolor": color}
    bars.bar(places, ratios(law, 0.0), 0.17, hatch=hatch, label=name, **style)
bars.set_xlabel("ball")
bars.set_xlim(-0.5, 4.5)
bars.set_ylim(0.0, 5.4)
bars.set_ylabel("rebound ratio, no gaps")
bars.tick_params(axis="x", which="both", length=0.0)
bars.legend(frameon=False, loc="upper left", fontsize=9.5)

gaps = np.geomspace(1e-6, 4e-4, 31)
places = {
    "springs": (9.0, 3.75, "left"),
    "Hertz": (6.0, 4.55, "right"),
    "lossy": (1.2, 2.55, "left"),
}
for law, color, name, _, line in LAWS[1:]:
    top = [ratios(law, gap)[-1] for gap in gaps]
    curves.semilogx(1e6 * gaps, top, color=color, linestyle=line)
    x, y, side = places[law]
    curves.text(x, y, name.split(",")[0], color=color, ha=side)
curves.axhline(5.0, color=BLACK, linewidth=0.8)
curves.annotate("rigid", (1.2, 5.0), (0, 3), textcoords="offset points", va="bottom")
curves.set_ylim(1.6, 5.4)
curves.set_xlabel("gap between neighbours (µm)")
curves.set_ylabel("rebound ratio of ball 4")
figure.subplots_adjust(left=0.065, right=0.985, top=0.97, bottom=0.15, wspace=0.2)
