"""The colours of balls: each known ball has its own, and each curve is seen on its card."""

import re
from importlib.resources import files

import pytest

from stackbounce.model.catalogue import CLASS_BALLS

STATIC = files("stackbounce.explorer") / "static"
SCRIPT = (STATIC / "js/stage/looks.js").read_text("utf-8")
STYLES = [(STATIC / name).read_text("utf-8") for name in ("style.css", "css/looks.css")]
LOOKS = re.findall(r'^  "?([\w-]+)"?: \{ balls: \[(.*?)\]', SCRIPT, re.MULTILINE)
KINDS = [kind for kind, _ in LOOKS]


def colors(dark):
    """Return the colours by name, in light or as dark changes them."""
    found = {}
    for text in STYLES:
        light, _, changed = text.partition("@media")
        for part in (light, changed) if dark else (light,):
            found |= dict(re.findall(r"--([\w-]+): (#[0-9a-f]{6});", part))
    return found


def luminance(color):
    parts = [int(color[i : i + 2], 16) / 255 for i in (1, 3, 5)]
    linear = [one / 12.92 if one <= 0.03928 else ((one + 0.055) / 1.055) ** 2.4 for one in parts]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


def contrast(one, other):
    low, high = sorted((luminance(one), luminance(other)))
    return (high + 0.05) / (low + 0.05)


@pytest.mark.parametrize("dark", [False, True], ids=["light", "dark"])
def test_curves_are_seen_on_their_card(dark):
    found = colors(dark)
    inks = [f"ink-{kind}" for kind in KINDS] + [f"place-{i}" for i in range(6)]
    assert min(contrast(found[ink], found["card"]) for ink in inks) >= 3.0
    assert len({found[ink] for ink in inks}) == len(inks)


def test_each_ball_of_a_class_has_a_look():
    kinds = {ball: kind for kind, balls in LOOKS for ball in re.findall(r'"(.+?)"', balls)}
    assert {kinds[str(entry.ball.name)] for entry in CLASS_BALLS} == set(KINDS)
    for name in ("fill", "mark", "ink"):
        assert all(f"{name}-{kind}" in colors(dark=False) for kind in KINDS)
