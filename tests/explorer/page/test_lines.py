"""Lines of the page: their numbers are the library's, their points lie where the curves bend."""

import dataclasses
import random

import numpy as np
import pytest

import stackbounce as sb
from explorer.page.library import at, outcome, varying
from explorer.page.scenarios import drawn
from stackbounce.cross2007.cases import list_lines
from stackbounce.errors import StackbounceError

SEED = 7
EVENTS = 300  # of random drops
SAMPLES = 8  # points of a line that are compared
PARTS = 24 * 2**9  # of a side: its points are this close at the closest
SHOWS = ("rebound_ratio", "rebound_height", "energy_retained", "collisions")


def random_lines(seed, count):
    """Yield random drops, each with a number that varies and what is shown."""
    chance = random.Random(seed)
    batch = 0
    while count:
        batch += 1
        [mapping] = drawn(seed, batch, 1)
        path, value = chance.choice(list(varying(sb.Drop.from_mapping(mapping)).items()))
        low, high = sorted((0.5 * value, 1.5 * value or 1.0))
        log = low > 0.0 and chance.random() < 0.4
        x = {"path": path, "low": low, "high": high, "log": log}
        try:
            [at(mapping, x["path"], end) for end in (low, high)]
        except StackbounceError:
            continue
        count -= 1
        yield {"drop": mapping, "x": x, "show": chance.choice(SHOWS)}


def textbook(drop, show, index):
    try:
        return outcome(sb.separate(drop), show, index, EVENTS, drop.gravity)
    except StackbounceError:
        return None


@pytest.mark.parametrize(
    ("seed", "count"), [(SEED, 15), pytest.param(SEED + 1, 10, marks=pytest.mark.slow)]
)
def test_random_lines_have_the_library_s_numbers(asked, seed, count):
    """Compare some points of each line, of the drop and of its separate collisions."""
    lines = list(random_lines(seed, count))
    answers = asked([["line", line] for line in lines], events=EVENTS)
    chance = random.Random(seed)
    compared = {"own": 0, "textbook": 0}
    for line, found in zip(lines, answers, strict=True):
        answer = found["answer"]
        values = answer["x"]["values"]
        assert values == sorted(set(values))
        assert (values[0], values[-1]) == (line["x"]["low"], line["x"]["high"])
        for i in chance.sample(range(len(values)), SAMPLES):
            drop = at(line["drop"], line["x"]["path"], values[i])
            for curve in answer["curves"]:
                given = (line["show"], curve["index"])
                assert alike(curve["values"][i], outcome(drop, *given, EVENTS)), (line, values[i])
                compared["own"] += 1
                if curve["textbook"]:
                    theirs = curve["textbook"]["values"][i]
                    # of restitutions that the page has from runs
                    assert alike(theirs, textbook(drop, *given), 1e-8), (line, values[i])
                    compared["textbook"] += 1
    assert min(compared.values()) > 5 * count


def alike(one, other, near=1e-12):
    return one == other or one == pytest.approx(other, rel=near, abs=1e-300)


def paper_lines(asked, show):
    asks = [
        {"drop": line.drop.to_mapping(), "x": dataclasses.asdict(line.across), "show": show}
        for line in list_lines()
    ]
    answers = asked([["line", ask] for ask in asks])
    return {
        line.name: (line, found["answer"])
        for line, found in zip(list_lines(), answers, strict=True)
    }


def test_the_paper_s_lines_have_the_paper_s_values(asked):
    found = paper_lines(asked, "rebound_ratio")
    for name, end in (("figure-2a", 2.64), ("figure-4a", 1.13)):  # in the text, at m1/m2 = 10
        assert round(found[name][1]["curves"][1]["values"][-1], 2) == end
    _, stops = found["figure-2b"]
    lower = np.array(stops["curves"][0]["values"])
    ratios = np.array(stops["x"]["values"])
    assert ratios[ratios > 0.3][lower[ratios > 0.3].argmin()] == pytest.approx(0.528, abs=1e-3)
    _, tennis = found["figure-6-tennis"]
    at_fit = [np.interp(2.5, tennis["x"]["values"], c["values"]) for c in tennis["curves"]]
    assert at_fit == pytest.approx([0.38, 1.80], abs=0.005)  # Fig. 9's


def test_between_its_points_a_curve_is_straight(asked):
    """The paper's curves are drawn true: they are compared at places where nothing was computed."""
    chance = random.Random(SEED)
    for line, answer in paper_lines(asked, "rebound_ratio").values():
        values = answer["x"]["values"]
        spread = np.log if answer["x"]["log"] else np.asarray
        for value in (chance.uniform(0.3, values[-1]) for _ in range(20)):
            drop = at(line.drop.to_mapping(), answer["x"]["path"], value)
            true = sb.simulate(drop).rebound_ratios
            for curve, wanted in zip(answer["curves"], true, strict=True):
                drawn = np.interp(spread(value), spread(values), curve["values"])
                assert drawn == pytest.approx(wanted, abs=np.ptp(curve["values"]) / 250)


def test_a_jump_lies_where_the_count_changes(asked):
    """Without loss the lower ball meets the floor once above m1/m2 = 3, and more often below."""
    line, answer = paper_lines(asked, "collisions")["figure-2a"]
    floor = answer["curves"][0]
    values = answer["x"]["values"]
    ends = [(values[i], values[i + 1]) for i in floor["jumps"]]
    closest = (line.across.high - line.across.low) / PARTS
    for low, high in ends:
        assert high - low == pytest.approx(closest)
        drops = (at(line.drop.to_mapping(), "mass_ratio", value) for value in (low, high))
        fewer, more = (outcome(drop, "collisions", 0, EVENTS) for drop in drops)
        assert fewer != more
    assert any(low <= 3.0 <= high for low, high in ends)
    between = [i for i in range(len(values) - 1) if floor["values"][i] != floor["values"][i + 1]]
    assert floor["jumps"] == between


def test_what_makes_no_line_is_refused(asked):
    drop = next(list_lines()).drop.to_mapping()
    side = {"path": "mass_ratio", "low": 0.1, "high": 1.0, "log": True}
    asks = [
        ({"x": side | {"path": "wind"}, "show": "collisions"}, "wind is not a parameter"),
        ({"x": side, "show": "rebound"}, "rebound is no outcome"),
        ({"x": side | {"high": 0.1}, "show": "collisions"}, "high must differ from low"),
        ({"x": side | {"low": -1.0}, "show": "collisions"}, "low must be above 0"),
        (
            {"x": side | {"low": -1.0, "log": False}, "show": "collisions"},
            "balls.0.mass must be a positive number",
        ),
    ]
    answers = asked([["line", {"drop": drop} | ask] for ask, _ in asks])
    for (ask, words), found in zip(asks, answers, strict=True):
        assert found["kind"] == "InvalidValue", ask
        assert words in found["error"], ask
