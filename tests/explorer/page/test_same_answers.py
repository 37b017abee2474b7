"""The page's own code answers as the library does: the same numbers, and it refuses the same."""

import math
import random
import re
import tomllib

import numpy as np
import pytest

import stackbounce as sb
from explorer.page import library as own
from explorer.page.scenarios import drawn
from stackbounce.cross2007.cases import list_cases
from stackbounce.errors import StackbounceError
from stackbounce.explorer.answers.predictions import add_values, run_drop
from stackbounce.json_values import plain
from stackbounce.model.catalogue import BALLS, CLASS_BALLS
from stackbounce.model.toml import read_law
from stackbounce.prediction.inputs import read_inputs
from stackbounce.prediction.prediction import split_errors
from stackbounce.run.paths import numbers_of

SEED = 5
CLOSE = 1e-12
MEASURED = 1e-9  # of a restitution or a contact time: the page has them from a run
EVENTS = 300  # of random drops
NUMBER = re.compile(r"\d+(?:\.\d+)?(?:e[+-]?\d+)?")


def library(call):
    """Return what the library answers, as the page's answers are written."""
    try:
        return {"answer": plain(call())}
    except StackbounceError as error:
        return {"error": str(error)}


def differences(one, other, path="", tolerance=CLOSE):
    """Yield where two answers differ: numbers by more than a tolerance, all else at all."""
    if isinstance(one, dict) and isinstance(other, dict):
        if sorted(one) != sorted(other):
            yield path, sorted(one), sorted(other)
        for key in set(one) & set(other):
            yield from differences(one[key], other[key], f"{path}.{key}", tolerance)
    elif isinstance(one, list) and isinstance(other, list):
        if len(one) != len(other):
            yield path, len(one), len(other)
        for i, (a, b) in enumerate(zip(one, other, strict=False)):
            yield from differences(a, b, f"{path}.{i}", tolerance)
    elif not same(one, other, tolerance):
        yield path, one, other


def same(one, other, tolerance):
    """Return whether words are the same, and numbers, also those in words, nearly."""
    if isinstance(one, str) and isinstance(other, str):
        words = NUMBER.sub("#", one) == NUMBER.sub("#", other)
        pairs = zip(NUMBER.findall(one), NUMBER.findall(other), strict=False)
        return words and all(same(float(a), float(b), tolerance) for a, b in pairs)
    numbers = all(isinstance(n, int | float) and not isinstance(n, bool) for n in (one, other))
    if numbers:
        return math.isclose(one, other, rel_tol=tolerance, abs_tol=1e-300)
    return one == other


def compare(asked, questions, calls):
    """Compare what page and library answer; return the answers."""
    told = [library(call) for call in calls]
    for question, ours, theirs in zip(questions, asked(questions), told, strict=True):
        assert ("error" in ours) == ("error" in theirs), (question, ours, theirs)
        assert not list(differences(ours.get("answer"), theirs.get("answer"))), question
    return told


def refused(answers):
    return sum("error" in one for one in answers) / len(answers)


def compare_cases(asked, drops, until, frames):
    answers = asked([["simulate", drop, until, frames] for drop in drops])
    for drop, ours in zip(drops, answers, strict=True):
        times = np.array(ours["answer"]["frames"]["time"])
        assert (np.diff(times) > 0.0).all()
        theirs = own.played(drop, until, times)
        if until is not None:  # from rest
            assert theirs["frames"]["velocity"][0][0] == pytest.approx(0.0, abs=1e-12)
        compare_plays(ours["answer"], theirs)


def test_all_cases_of_the_paper_play_with_the_same_numbers(asked):
    compare_cases(asked, [case.drop.to_mapping() for case in list_cases()], None, 200)


def test_balls_off_the_middle_leave_alike(asked):
    drops = [case.drop.to_mapping() for case in list_cases() if len(case.drop.balls) > 1][::5]
    for drop in drops:
        for i, ball in enumerate(drop["balls"]):
            ball["diameter"] = 0.16 / (i + 1)
    told = [run_drop(sb.Drop.from_mapping(drop), None).sideways({1: 1e-3}) for drop in drops]
    for drop in drops:
        drop["balls"][1]["offset"] = 1e-3
    line = {"x": {"path": "balls.1.offset", "low": 0.0, "high": 1e-3, "log": False}}
    played = asked([["simulate", drop, None, 2] for drop in drops])
    lines = asked([["line", {"drop": drop, "show": "angle"} | line] for drop in drops])
    [python] = asked([["exportText", "python", drops[0], None, {}]])
    assert "\nprint(result.sideways({1: 0.001}))\n" in python["answer"]
    for theirs, one, curves in zip(told, played, lines, strict=True):
        for name in ("offset", "angle", "landing"):
            found = np.array(one["answer"]["sideways"][name], float)
            assert found == pytest.approx(theirs[name].values, rel=1e-9, abs=1e-15, nan_ok=True)
        last = [curve["values"][-1] for curve in curves["answer"]["curves"]]
        up = np.degrees(theirs.angle.where(abs(theirs.angle) < 0.5 * math.pi).values)
        assert np.array(last, float) == pytest.approx(up, nan_ok=True)


@pytest.mark.parametrize(("until", "gravity"), [(0.5, 9.80665), (0.05, 1.62)])
def test_a_whole_drop_with_gravity_plays_the_same(asked, until, gravity):
    drops = [case.drop.to_mapping() | {"gravity": gravity} for case in [*list_cases()][::4]]
    compare_cases(asked, drops, until, 300)


def compare_plays(ours, theirs):
    """Compare what page and library say of a drop, and its motion at the page's times."""
    frames, theirs_frames = ours.pop("frames"), theirs.pop("frames")
    place, near = ours["separate"] or {}, theirs["separate"] or {}
    assert close(place.pop("position", []), near.pop("position", []))
    assert list(differences(ours, theirs)) == []
    assert set(ours["impact"]) <= set(frames["time"]) == set(theirs_frames["time"])
    ours_energy, theirs_energy = frames.pop("energy"), theirs_frames.pop("energy")
    most = np.max(theirs_energy["total"])
    for name, values in theirs_energy.items():
        assert np.array(ours_energy[name]) == pytest.approx(np.array(values), abs=1e-8 * most)
    for name, values in theirs_frames.items():
        assert close(frames[name], values), name


def close(ours, theirs):
    if not theirs:
        return ours == theirs
    most = np.max(np.abs(theirs))
    return np.array(ours) == pytest.approx(np.array(theirs), abs=1e-8 * max(most, 1e-300))


@pytest.mark.parametrize(
    ("batches", "count"), [(12, 25), pytest.param(12, 40, marks=pytest.mark.slow)]
)
def test_random_drops_have_the_same_numbers(asked, batches, count):
    """Some drops would take minutes with more events."""
    told = [mapping for batch in range(batches) for mapping in drawn(SEED, batch, count)]
    answers = asked([["simulate", drop, None, 2] for drop in told], events=EVENTS)
    alike = 0
    for mapping, ours in zip(told, answers, strict=True):
        theirs = own.played(mapping, None, np.array(ours["answer"]["frames"]["time"]), EVENTS)
        pair = ours["answer"], theirs
        near = [answer.pop("separate") for answer in pair]
        assert pair[0].pop("frames").keys() == pair[1].pop("frames").keys()
        assert list(differences(*pair)) == [], mapping
        alike += compare_textbook(*near)
    assert alike > 0.3 * len(told)


def compare_textbook(ours, theirs):
    """Compare separate collisions; return whether restitutions have the same bits: many amplify."""
    if theirs is None or "error" in theirs:
        assert ours == theirs
        return True
    near = differences(ours["restitutions"], theirs["restitutions"], tolerance=MEASURED)
    assert list(near) == []
    if ours["restitutions"] != theirs["restitutions"]:
        return False
    for one in (ours, theirs):
        one.pop("position")
    assert list(differences(ours, theirs)) == []
    return True


WORSE = (0.0, -1.0, 1e-320, 1e308, 0.5, 2.0)


@pytest.mark.parametrize("count", [300, pytest.param(1000, marks=pytest.mark.slow)])
def test_a_drop_with_another_number_is_read_or_refused_alike(asked, count):
    chance = random.Random(SEED)
    drops = []
    for batch in range(count):
        [mapping] = drawn(SEED, batch, 1)
        path = chance.choice([*numbers_of(sb.Drop.from_mapping(mapping))])
        *parts, last = (int(key) if key.isdecimal() else key for key in path.split("."))
        place = mapping
        for key in parts:
            place = place[key]
        place[last] = chance.choice(WORSE)
        drops.append(mapping)
    calls = [lambda d=drop: sb.Drop.from_mapping(d).to_mapping() for drop in drops]
    assert 0.2 < refused(compare(asked, [["read", drop] for drop in drops], calls)) < 0.8


def contacts(seed, count):
    """Return random contacts with a mass and a speed."""
    chance = random.Random(seed)
    for batch in range(count):
        [mapping] = drawn(seed, batch, 1)
        index = chance.randrange(len(mapping["contacts"]))
        mass, speed = 10.0 ** chance.uniform(-3, 1), 10.0 ** chance.uniform(-2, 2)
        yield mapping["contacts"][index], mass, speed


@pytest.mark.parametrize(
    ("seed", "count"), [(SEED, 200), pytest.param(SEED + 1, 400, marks=pytest.mark.slow)]
)
def test_laws_are_calibrated_and_converted_alike(asked, seed, count):
    chance = random.Random(seed)
    questions, calls = [], []
    for contact, mass, speed in contacts(seed, count):
        to = chance.choice(list(sb.model.LAWS))
        asked_of = {"mass": mass, "impact_speed": speed}
        asked_of["restitution"] = chance.choice((None, 0.8, 1.0, chance.uniform(0.01, 1)))
        asked_of["contact_time"] = chance.choice((None, 5e-3))
        like = {"to": to, **asked_of}
        if creeps_apart(contact, mass, speed):
            continue
        questions.append(["like", {"contact": contact} | like])
        calls.append(lambda c=contact, to=like: own.converted(read_law(c, "contact"), **to))
        asked_of["exponent"] = chance.choice((None, None, 1.0, 1.5, 2.0, 0.5))
        questions.append(["law", {"law": to} | asked_of])
        calls.append(lambda n=to, g=asked_of: own.calibrated(n, **g))
    told = [library(call) for call in calls]
    for (_, given), ours, theirs in zip(questions, asked(questions), told, strict=True):
        if "error" in ours or "error" in theirs:
            assert ("error" in ours) == ("error" in theirs), given
            continue
        one, other = (read_law(found["answer"]["contact"], "contact") for found in (ours, theirs))
        compare_measures(one, other, given["mass"], given["impact_speed"])
    assert 0.05 < refused(told) < 0.6


def compare_measures(one, other, mass, speed):
    """Compare laws, one found by runs, which tell a loss to 1e-11, and what is measured of them."""
    assert type(one) is type(other)
    kept, lasts = sb.restitution(other, mass, speed), sb.contact_time(other, mass, speed)
    assert sb.restitution(one, mass, speed) == pytest.approx(kept, rel=MEASURED, abs=1e-11)
    assert sb.contact_time(one, mass, speed) == pytest.approx(lasts, rel=MEASURED)
    near = max(MEASURED, 1e-10 / max(1.0 - kept, 1e-10))
    ours, theirs = ([getattr(law, name) for name in law.quantities()] for law in (one, other))
    assert ours == pytest.approx(theirs, rel=near, abs=1e-15)


def creeps_apart(contact, mass, speed):
    """Return whether a contact hardly throws back, so that a run does not show its end exactly."""
    try:
        return sb.restitution(read_law(contact, "contact"), mass, speed) < 1e-4
    except sb.StackbounceError:
        return False


def test_stacks_of_the_catalogue_are_the_same(asked):
    names = [one.ball.name for one in (*BALLS, *CLASS_BALLS)]
    chance = random.Random(SEED)
    stacks = [[chance.choice(names) for _ in range(chance.randint(1, 6))] for _ in range(400)]
    calls = [lambda b=balls: own.stacked(b, 0.5) for balls in stacks]
    compare(asked, [["stack", balls, 0.5] for balls in stacks], calls)


def test_texts_of_a_drop_hold_it(asked):
    drops = [case.drop.to_mapping() for case in list_cases()]
    drops += drawn(SEED, 3, 10)
    drops[0]["balls"][0]["name"] = 'a "b" \\ \x7f é\n'
    compare_texts(asked, [(drop, {}) for drop in drops])


def compare_texts(asked, pairs):
    """Compare the scenarios and the lines of Python of drops with errors; return the answers."""
    answers = {}
    for kind in ("toml", "python"):
        questions = [["exportText", kind, drop, None, errors] for drop, errors in pairs]
        answers[kind] = asked(questions)
    for (mapping, errors), *texts in zip(pairs, *answers.values(), strict=True):
        drop = sb.Drop.from_mapping(mapping)
        theirs = library(lambda d=drop, e=errors: checked(d, e))
        if "error" in theirs:
            continue  # two numbers of which one determines the other: no field gives both
        toml, python = (text["answer"] for text in texts)
        known = checked(drop, errors)
        without, written = split_errors(tomllib.loads(toml))
        values = read_inputs(drop, written).errors if written else ()
        varied = read_inputs(drop, known).drop if known else drop
        assert sb.Drop.from_mapping(without) == varied
        read = {path: (value.n, value.s) for path, value in zip(written, values, strict=True)}
        assert read == {path: (value, error) for path, (value, error) in known.items() if error}
        assert known or toml == drop.to_toml()
        lines, _, run = python.partition("result = ")
        exec(lines, found := {})
        assert (found["drop"], found.get("errors", {})) == (drop, known)
        assert run.startswith("sb.predict(drop, errors)\n" if known else "sb.simulate(drop)\n")
    return answers["toml"]


def checked(drop, errors):
    """Return the numbers of a drop that have errors, with them."""
    pairs = add_values(drop, errors)
    if pairs:
        read_inputs(drop, pairs)
    return pairs


def test_the_lines_of_python_run(asked, tmp_path, monkeypatch, capsys):
    drop = next(list_cases()).drop
    monkeypatch.chdir(tmp_path)
    for errors in ({}, {"balls.0.mass": 0.001}):
        (lines,) = asked([["exportText", "python", drop.to_mapping(), 0.5, errors]])
        exec(lines["answer"], found := {})
        assert found["result"].drop == drop
        assert (tmp_path / "bounce.svg").stat().st_size > 10_000
        assert "rebound ratios" in capsys.readouterr().out


ERRORS = (1e-3, 1e-7)


def uncertain(seed, count):
    """Return random drops, and errors of some of their numbers, many of which make none."""
    chance = random.Random(seed)
    for batch in range(count):
        [mapping] = drawn(seed, batch, 1)
        paths = [*numbers_of(sb.Drop.from_mapping(mapping))]
        chosen = chance.sample(paths, chance.choice((0, 1, 1, 2, 3)))
        yield mapping, {path: chance.choice(ERRORS) for path in chosen}


def test_texts_of_a_drop_have_the_errors_of_its_numbers(asked):
    compare_texts(asked, list(uncertain(SEED, 300)))


def test_the_table_of_a_drop_has_the_same_numbers(asked):
    drops = [case.drop for case in list_cases()][::3]
    answers = asked([["exportText", "csv", drop.to_mapping(), None] for drop in drops])
    for drop, ours in zip(drops, answers, strict=True):
        head, *rows = (line.split(",") for line in ours["answer"].splitlines())
        wanted = own.table(drop)
        assert head == list(wanted)
        found = np.array(rows, dtype=float).T
        assert found == pytest.approx(np.array([*wanted.values()]), rel=CLOSE, abs=1e-12)


SHOWS = ("rebound_ratio.1", "rebound_height.0", "collisions.1", "energy_retained", "collisions.7")


def requests(seed, count, log):
    """Return random requests for a map, some of which make none; with logarithmic sides or not."""
    chance = random.Random(seed)
    for batch in range(count):
        [mapping] = drawn(seed, batch, 1)
        if len(mapping["balls"]) < 2:
            continue
        drop = sb.Drop.from_mapping(mapping)
        sides = []
        for path, value in chance.sample(list(own.varying(drop).items()), 2):
            low = chance.choice((*[0.75 * value] * 8, 0.0, -1.0))
            if log:
                low = abs(low) or chance.choice((0.0, 1e-3))
            high = chance.choice((*[1.5 * value or 1.0] * 8, 1.0, low))
            side = {"path": path, "low": low, "high": high, "log": log}
            sides.append(side | {"count": chance.randint(2, 5)})
        yield mapping, *sides, chance.choice(SHOWS)


@pytest.mark.parametrize(
    ("seed", "count"),
    [(SEED, 30), pytest.param(SEED + 1, 1000, marks=[pytest.mark.slow, pytest.mark.release])],
)
@pytest.mark.parametrize("log", [False, True])
def test_maps_are_the_same(asked, seed, count, log):
    """The powers of ten of a logarithmic side differ in their last bit."""
    drawn_maps = list(requests(seed, count, log))
    names = ("drop", "x", "y", "show")
    questions = [["map", dict(zip(names, one, strict=True))] for one in drawn_maps]
    answers = asked(questions, events=EVENTS)
    for given, ours in zip(drawn_maps, answers, strict=True):
        theirs = library(lambda g=given: own.mapped(*g, EVENTS))
        assert ("error" in ours) == ("error" in theirs), (given, ours, theirs)
        if "answer" in ours:
            values = ours["answer"]["values"]
            assert not list(differences(values, theirs["answer"], "", 1e-9 if log else CLOSE))
    assert 0.05 < refused(answers) < 0.8


def test_what_a_map_can_vary_is_what_the_library_varies(asked):
    drops = [drop for batch in range(20) for drop in drawn(SEED, batch, 2)]
    for drop, ours in zip(drops, asked([["mapPaths", drop] for drop in drops]), strict=True):
        found = {number["path"]: number["value"] for number in ours["answer"]["paths"]}
        assert found == pytest.approx(own.varying(sb.Drop.from_mapping(drop)), rel=CLOSE)
        balls = range(len(drop["balls"]))
        shows = [f"{name}.{i}" for name in ("rebound_ratio", "rebound_height") for i in balls]
        assert {"energy_retained", *shows} <= {show["show"] for show in ours["answer"]["shows"]}
