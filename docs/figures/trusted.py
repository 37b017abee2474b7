"""The picture of `coverage.md`: how often each error bar holds the truth, from the table there."""

import csv

import matplotlib.pyplot as plt
from shared import WIDE
from shown import DOCS

from stackbounce.cross2007.style import BLACK, FLOOR, GREY

TABLE = DOCS / "coverage.csv"
BAND = (60.0, 76.0)  # %
ROW = 0.5  # inches


def shares():
    """A dot for each quantity of each case, a row for each analysis."""
    with TABLE.open(encoding="utf-8") as file:
        rows = [
            (one["analysis"], float(one["within 1 σ"].rstrip("%"))) for one in csv.DictReader(file)
        ]
    kinds = sorted({kind for kind, _ in rows}, reverse=True)
    _, ax = plt.subplots(figsize=(WIDE, 1.0 + ROW * len(kinds)), layout="constrained")
    ax.axvspan(*BAND, color=GREY, alpha=0.25, linewidth=0)
    ax.axvline(68.3, color=BLACK, linewidth=0.8)
    for height, kind in enumerate(kinds):
        own = [share for name, share in rows if name == kind]
        apart = [0.6 * ((7 * k) % len(own) / len(own) - 0.5) for k in range(len(own))]
        colors = [BLACK if BAND[0] <= share <= BAND[1] else FLOOR for share in own]
        ax.scatter(own, [height + shift for shift in apart], s=14, c=colors, linewidths=0)
    ax.set_yticks(range(len(kinds)), kinds)
    ax.set(xlabel="truth within one error (%)", xlim=(-2.0, 100.0), ylim=(-0.6, len(kinds) - 0.4))
