"""The figures of the posterior probabilities and of the expected information."""

from typing import TYPE_CHECKING

from stackbounce.cross2007.style import BLACK, FLOOR, GREY, UPPER, Picture
from studies.table2.figures import make_wide_figure
from studies.table2.hierarchy import CERTAIN, Hierarchy
from studies.table2.information import Information
from studies.table2.ratio_tables import SEPARATE

if TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = ["draw_information", "draw_probabilities"]

_STYLES = {
    SEPARATE: ("#FFFFFF", "xxxx"),
    "A": (FLOOR, ""),
    "P": ("#E69F00", "\\\\\\\\"),
    "S": ("#56B4E9", "...."),
    "V": ("#F0E442", ""),
    "H": ("#009E73", ""),
    "H, linear": ("#A6DCC9", "\\\\\\\\"),
    "B": (UPPER, ""),
}
"""Colour and hatching of each model."""
_NARROW = 0.045  # a share near this or below has no name in its bar


def draw_probabilities(found: Hierarchy) -> Picture:
    """Draw the probabilities of the models as bars: over all choices, by choice and by prior."""
    rows: list[tuple[str, dict[str, float]]] = [("over all choices", found.probabilities)]
    breaks = [len(rows)]
    for choice, values in found.by_choice.items():
        rows += [(f"{choice}: {value}", shares) for value, shares in values.items()]
        breaks.append(len(rows))
    rows += [one for one in found.by_prior.items() if one[0] != "as stated"]
    figure = make_wide_figure(0.27 * (len(rows) + 0.5 * len(breaks)) + 0.95)
    ax = figure.subplots()
    high = figure.get_figheight()
    figure.subplots_adjust(left=0.34, right=0.985, bottom=0.45 / high, top=1.0 - 0.5 / high)
    places, place = [], 0.0
    for k in range(len(rows)):
        place -= 1.5 if k in breaks else 1.0
        places.append(place)
    for at, (_, shares) in zip(places, rows, strict=True):
        _draw_bar(ax, at, shares, labelled=at == places[0])
    ax.axvline(CERTAIN, color=BLACK, lw=0.8, ls=":")
    ax.set(xlim=(0.0, 1.0), ylim=(places[-1] - 0.6, places[0] + 0.6), xlabel="probability")
    ax.set_yticks(places, [name for name, _ in rows], fontsize=9)
    ax.tick_params(axis="y", which="both", left=False, right=False)
    handles, labels = ax.get_legend_handles_labels()
    figure.legend(
        handles, labels, loc="upper center", ncols=9, frameon=False, fontsize=9,
        handlelength=1.2, columnspacing=1.1,
    )  # fmt: skip
    return Picture(
        "study-probabilities",
        "Posterior probabilities of the models",
        "Over all choices; with one choice fixed; and with one prior changed. Every model has the "
        f"same prior share. A bar to the dotted line at {CERTAIN} would decide.",
        (),
        (),
        figure,
    )


def _draw_bar(ax: "Axes", at: float, shares: dict[str, float], *, labelled: bool) -> None:
    left = 0.0
    for name, share in sorted(shares.items(), key=lambda one: -one[1]):
        color, hatch = _STYLES[name]
        ax.barh(at, share, 0.78, left, color=color, hatch=hatch, edgecolor=GREY, lw=0.5)
        short = {"H, linear": "H lin.", SEPARATE: "rigid"}.get(name, name)
        if share > _NARROW * (1.0 + 0.12 * len(short)):
            box = {"boxstyle": "round,pad=0.15", "fc": "white", "ec": "none", "alpha": 0.85}
            ax.text(left + 0.5 * share, at, short, ha="center", va="center", fontsize=8, bbox=box)
        left += share
    if labelled:
        for name, (color, hatch) in _STYLES.items():
            ax.barh(at, 0.0, color=color, hatch=hatch, edgecolor=GREY, lw=0.5, label=name)


def draw_information(found: Information) -> Picture:
    """Draw the expected information of each measurement about the model and about Table I."""
    gains = found.gains[::-1]
    figure = make_wide_figure(0.29 * len(gains) + 0.75)
    ax = figure.subplots()
    high = figure.get_figheight()
    figure.subplots_adjust(left=0.4, right=0.98, bottom=0.47 / high, top=1.0 - 0.08 / high)
    places = range(len(gains))
    ax.errorbar(
        [one.model for one in gains], places, xerr=[one.error for one in gains], fmt="o",
        color=BLACK, capsize=2, label="about the model",
    )  # fmt: skip
    ax.plot(
        [one.reading for one in gains], places, "s", mfc="white", mec=UPPER,
        label="about the reading of Table I",
    )  # fmt: skip
    ax.axvline(found.model, color=BLACK, lw=0.8, ls=":")
    ax.axvline(found.reading, color=UPPER, lw=0.8, ls=":")
    ax.set(xlim=(-0.02, 1.05 * max(found.model, found.reading)), ylim=(-0.6, len(gains) - 0.4))
    ax.set_xlabel("expected information (bits)")
    ax.set_yticks(places, [one.what for one in gains], fontsize=9)
    ax.tick_params(axis="y", which="both", left=False, right=False)
    ax.legend(loc="lower right", framealpha=1.0, edgecolor="white", handletextpad=0.3)
    return Picture(
        "study-information",
        "How much each measurement is expected to say",
        "Dotted: all that is unknown, about the model and about Table I. With gaps and delays, "
        "the mean over 1 to 5 mm or ms.",
        (),
        (),
        figure,
    )
