"""The examples with a class's balls: what they say is what they do."""

import math
import re
from importlib.resources import files
from itertools import combinations

import numpy as np
import pytest
from page_build.examples import list_examples

import stackbounce as sb
from example_records import floor_force, two_tracks
from stackbounce.cross2007.cases import list_cases
from stackbounce.explorer import LIMITS
from stackbounce.model.catalogue import CLASS_BALLS

EXAMPLES = list(list_examples())


@pytest.mark.parametrize("case", EXAMPLES, ids=[case.name for case in EXAMPLES])
def test_an_example_says_what_happens(case):
    result = sb.simulate(case.drop)
    assert result.status == sb.Status.FINISHED
    top = result.rebound_ratios[-1]
    assert f"{top:.2f} times" in case.says
    heights = re.findall(r"(\d+) times the height", case.says)
    assert all(int(height) == round(top**2) for height in heights)
    counts = re.findall(r"collide (\d+) times", case.says)  # the digits of pi
    assert counts in ([], [str(result.collisions.sum())])


def test_the_page_begins_with_the_touching_pair_for_which_the_textbook_errs():
    said = (STATIC / "js/state/store.js").read_text("utf-8").partition("FIRST_DROP = ")[2]
    numbers = sorted(map(float, re.findall(r": \[?([\d.]+)", said.partition("};")[0])))
    [drop] = [case.drop.to_mapping() for case in EXAMPLES if case.name == "class-touching"]
    parts = [*drop["balls"], *drop["contacts"], {"gap": 0.0, "height": 1.0, "gravity": 0.0}]
    assert numbers == sorted(n for one in parts for n in one.values() if not isinstance(n, str))


def test_examples_fit_the_page():
    names = [case.name for case in (*EXAMPLES, *list_cases())]
    assert len(set(names)) == len(names)
    assert all(len(case.drop.balls) <= LIMITS.balls for case in EXAMPLES)


def test_the_last_ball_of_the_cradle_takes_most_of_the_speed():
    case = next(case for case in EXAMPLES if case.name == "cradle")
    *others, next_to_last, last = sb.simulate(case.drop).rebound_ratios
    assert f"the next at {next_to_last:.2f}." in case.says
    assert max(map(abs, others)) < 0.1 * last


# --- the records that the explorer offers for a try are those that `example_records` makes
STATIC = files("stackbounce.explorer") / "static"
RECORDS = STATIC / "examples"
FORCE, TRACKS = (floor_force, 0.1, "waveform"), (two_tracks, 1e-4, "track")
MADE = {"floor-force.csv": FORCE, "two-tracks.csv": TRACKS}


def _numbers(text):
    return np.array([float(number) for number in re.findall(r"-?\d+\.\d+(?:E[+-]?\d+)?", text)])


@pytest.mark.parametrize("name", MADE)
def test_a_record_is_as_it_is_made_to_its_last_digit_and_read_as_what_it_is(name):
    make, digit, holds = MADE[name]
    kept, made = (RECORDS / name).read_text(encoding="utf-8"), make()
    assert kept.count("\n") == made.count("\n") > 100
    assert kept.splitlines()[0] == made.splitlines()[0]
    np.testing.assert_allclose(_numbers(kept), _numbers(made), rtol=0.0, atol=1.001 * digit)
    assert sb.read(RECORDS / name).attrs["holds"] == holds


def test_the_page_offers_each_record_and_no_other():
    said = (STATIC / "index.html").read_text(encoding="utf-8")
    offered = set(re.findall(r'data-example="(.+?)"', said))
    assert offered == set(MADE) == {path.name for path in RECORDS.iterdir()}


# --- the colours of balls: each known ball has its own, and each curve is seen on its card
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
    return float(np.dot([0.2126, 0.7152, 0.0722], linear(color)))


def linear(color):
    parts = [int(color[i : i + 2], 16) / 255 for i in (1, 3, 5)]
    return [one / 12.92 if one <= 0.03928 else ((one + 0.055) / 1.055) ** 2.4 for one in parts]


def contrast(one, other):
    low, high = sorted((luminance(one), luminance(other)))
    return (high + 0.05) / (low + 0.05)


@pytest.mark.parametrize("dark", [False, True], ids=["light", "dark"])
def test_curves_are_seen_on_their_card_and_told_apart_by_everybody(dark):
    found = colors(dark)
    inks = [found[f"place-{i}"] for i in range(6)]
    assert min(contrast(ink, found["card"]) for ink in inks) >= 3.0
    for seen in ([[1, 0, 0], [0, 1, 0], [0, 0, 1]], *DICHROMATS):
        apart = [math.dist(*(lab(ink, seen) for ink in two)) for two in combinations(inks, 2)]
        assert min(apart) >= 20.0


DICHROMATS = (  # Machado, Oliveira and Fernandes 2009, full severity: protan, deutan, tritan
    [[0.1523, 1.0526, -0.2049], [0.1145, 0.7863, 0.0992], [-0.0039, -0.0481, 1.0520]],
    [[0.3673, 0.8606, -0.2280], [0.2801, 0.6725, 0.0474], [-0.0118, 0.0429, 0.9689]],
    [[1.2555, -0.0767, -0.1788], [-0.0784, 0.9308, 0.1476], [0.0047, 0.6914, 0.3039]],
)
XYZ = [[0.4339, 0.3762, 0.1898], [0.2127, 0.7152, 0.0722], [0.0178, 0.1095, 0.8727]]  # by white


def lab(color, seen):
    """Return a colour in CIELAB, as somebody sees it."""
    x, y, z = np.cbrt(XYZ @ np.clip(seen @ np.array(linear(color)), 0.0, 1.0))
    return 116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)


def test_each_ball_of_a_class_has_a_look():
    kinds = {ball: kind for kind, balls in LOOKS for ball in re.findall(r'"(.+?)"', balls)}
    assert {kinds[str(entry.ball.name)] for entry in CLASS_BALLS} == set(KINDS)
    for name in ("fill", "mark"):
        assert all(f"{name}-{kind}" in colors(dark=False) for kind in KINDS)
