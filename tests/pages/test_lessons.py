"""The lessons, in both languages: their numbers are the package's own, and their links work."""

import dataclasses
import functools
import math
import re
from pathlib import Path

import pytest
from lesson import lesson_markdown
from page_build.lessons.lesson import LANGUAGES, NAMES, explorer_fragment, read_lesson, split_links

import stackbounce as sb
from stackbounce.model.catalogue import catalogue_ball, stacked

PAGES = Path(__file__).parents[2] / "docs" / "lessons"
BASKETBALL, TENNIS = "big basketball", "tennis ball"
CLASSROOM = (BASKETBALL, TENNIS)
GAPS = (0.0, 1e-3, 2e-3, 5e-3, 1e-2, 2e-2, 3e-2)
STIFFNESSES = (1e3, 5e3, 1e4, 2e4, 5e4, 2e5)


@functools.cache
def text(name):
    return " ".join(lesson_markdown(read_lesson(name)).split())


def drop_of(names, gap=0.0):
    chosen = stacked(names)
    return sb.Drop(chosen.balls, chosen.contacts, [gap] * (len(names) - 1), height=1.0)


@functools.cache
def result_of(names, gap=0.0):
    return sb.simulate(drop_of(names, gap))


def ratio(names, gap=0.0):
    return result_of(names, gap).rebound_ratios[-1]


def textbook(names):
    return sb.simulate(sb.separate(drop_of(names))).rebound_ratios


def says(name, *parts):
    missing = [part for part in parts if part not in text(name)]
    assert not missing


def row(head, values):
    return f"| {head} | {' | '.join(f'{value:.2f}' for value in values)} |"


def test_three_times_the_speed():
    drop, result = drop_of(CLASSROOM), result_of(CLASSROOM)
    lossless = dataclasses.replace(drop, contacts=[sb.Rigid(1.0)] * 2)
    speeds, own = drop.reference_speed, result.rebound_speeds
    before = [0.5 * ball.mass * speeds**2 for ball in drop.balls]
    after = [0.5 * ball.mass * v**2 for ball, v in zip(drop.balls, own, strict=True)]
    below, above = result.rebound_ratios
    alone = catalogue_ball(TENNIS).restitution ** 2
    says(
        "three-times",
        f"{1e3 * drop.balls[0].mass:.0f} g below and {1e3 * drop.balls[1].mass:.0f} g above",
        f"collisions give {sb.simulate(lossless).rebound_ratios[1]:.2f} times",
        f"they give {textbook(CLASSROOM)[1]:.2f} times",
        f"{above:.2f} times the speed, {above**2:.2f} times the height",
        f"alone rises to {alone:.2f} m",
        f"it has {before[1]:.2f} J, after it {after[1]:.2f} J: {after[1] / before[1]:.2f} times",
        f"comes in with {before[0]:.2f} J and leaves with {after[0]:.2f} J",
        f"The rest, {sum(before) - sum(after):.2f} J",
        f"of all {sum(before):.2f} J, {100 * result.energy_retained:.0f} % are left",
        f"keeps more: {below:.2f} of its speed, not {textbook(CLASSROOM)[0]:.2f}",
    )


def test_what_stiffness_does():
    golf, superball = ("golf ball", "ping-pong ball"), ("superball", "ping-pong ball")
    pairs = [drop_of(names).contacts for names in (golf, superball)]
    shares = [lower.stiffness / upper.stiffness for lower, upper in pairs]
    drop = drop_of(CLASSROOM)
    tops = []
    for stiffness in STIFFNESSES:
        law = drop.contacts[1].replaced({"stiffness": stiffness})
        changed = dataclasses.replace(drop, contacts=[drop.contacts[0], law])
        tops.append(sb.simulate(changed).rebound_ratios[1])
    says(
        "stiffness",
        f"leaves at {ratio(golf):.2f} times its speed",
        f"it leaves at {ratio(superball):.2f} times",
        f"nearly the same: {textbook(golf)[1]:.2f} and {textbook(superball)[1]:.2f}",
        row("the tennis ball leaves at, times its speed", tops),
        f"is {shares[0]:.0f} times as stiff",
        f"only {shares[1]:.1f} times as stiff",
        f"leaves at {tops[-1]:.2f} times its speed",
        f"basketball alone bounces, at {catalogue_ball(BASKETBALL).restitution:.2f}",
    )
    assert catalogue_ball("superball").restitution > catalogue_ball("golf ball").restitution
    for names, separate in ((golf, True), (superball, False)):
        ends = result_of(names).intervals["end"]
        assert (ends[0] < 0.7 * ends[1]) == separate


def test_the_gap():
    tops = [ratio(CLASSROOM, gap) for gap in GAPS]
    three = (*CLASSROOM, "ping-pong ball")
    cannon = (BASKETBALL, "volleyball", TENNIS, "ping-pong ball")
    contact_time = catalogue_ball(BASKETBALL).contact_time
    speed = drop_of(CLASSROOM).reference_speed
    touching, intervals, apart = (result_of(CLASSROOM, gap).intervals for gap in (0.0, 0.03, 0.043))
    says(
        "gap",
        row("the tennis ball leaves at, times its speed", tops),
        row("it rises to, times the drop height", [top**2 for top in tops]),
        f"{tops[5] ** 2:.2f} against {tops[0] ** 2:.2f} times the drop height",
        f"{textbook(CLASSROOM)[1]:.2f} times is what separate collisions give",
        f"{1e3 * contact_time:.1f} ms. At {speed:.2f} m/s the tennis ball falls "
        f"{1e2 * speed * contact_time:.1f} cm",
        f"leaves at {ratio(three, 0.02):.2f} times its speed, and touching at "
        f"{ratio(three):.2f} times",
        f"{ratio(cannon, 0.02):.2f} times its speed, for "
        f"{ratio(cannon, 0.02) ** 2:.0f} times the height",
        f"With the balls touching it is {1e3 * touching['end'][0]:.1f} ms",
        f"meet {1e3 * intervals['start'][1]:.1f} ms after the touch",
        f"it ends at {1e3 * intervals['end'][0]:.1f} ms",
    )
    assert apart["start"][1] > apart["end"][0] == pytest.approx(contact_time, rel=1e-6)
    assert tops[5] ** 2 / tops[0] ** 2 == pytest.approx(2.0, abs=0.05)
    assert tops[-1] == pytest.approx(textbook(CLASSROOM)[1], rel=1e-2)


def test_measure_your_own_ball():
    mass, restitution, speed = 0.625, 0.81, math.sqrt(2.0 * 9.81)
    pressed = 0.122 - math.sqrt(0.122**2 - 0.112**2 / 4.0)
    law = sb.calibrate(
        sb.Hysteretic, mass=mass, contact_time=math.pi * pressed / speed, restitution=restitution
    )
    force = sb.simulate(sb.Drop([sb.Ball(mass)], [law], impact_speed=speed)).intervals["peak_force"]
    says(
        "own-ball",
        " m, ".join(f"{restitution ** (2 * i):.2f}" for i in (1, 2))
        + f" m and {restitution**6:.2f} m",
        f"{100 / 66:.1f} %, half of it {50 / 66:.1f} %",
        f"0.810 ± {restitution * 0.5 / 66:.3f}",
        f"{1e-3 * force[0]:.2f} kN, {force[0] / mass / 9.81:.0f} times the weight of "
        f"{mass * 9.81:.1f} N",
    )


def texts_of(value):
    """Return all texts of a lesson in their order."""
    if isinstance(value, str):
        return [value]
    parts = value.values() if isinstance(value, dict) else value if isinstance(value, list) else ()
    return [text for part in parts for text in texts_of(part)]


def links_of(lesson):
    parts = [part for text in texts_of(lesson) for part in split_links(text)]
    return [part for part in parts if not isinstance(part, str)]


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("language", LANGUAGES)
def test_links_to_the_explorer_are_drops(name, language):
    links = links_of(read_lesson(name, language))
    assert {link.to for link in links} >= {"explorer"}
    assert {link.what for link in links if link.to == "lesson"} <= set(NAMES)
    for fragment in (explorer_fragment(link.what) for link in links if link.to != "lesson"):
        pairs = dict(pair.split("=", 1) for pair in fragment.split("&"))
        assert pairs["view"] in ("play", "line")
        assert "balls.1.mass" in pairs


@pytest.mark.parametrize("name", NAMES)
def test_each_lesson_is_a_page_with_the_minutes_of_its_steps(name):
    lesson = read_lesson(name)
    assert sum(step["minutes"] for step in lesson["steps"]) == lesson["minutes"]
    assert 20 <= lesson["minutes"] <= 45
    assert len(lesson["answers"]) == len(lesson["questions"])
    page = (PAGES / f"{name}.md").read_text("utf-8")
    assert page.startswith(f"# {lesson['title']}\n\n```{{lesson}} {name}\n```\n")
    assert f"\n{name}\n" in (PAGES / "index.md").read_text("utf-8")


def shape_of(value):
    if isinstance(value, dict | list):
        pairs = value.items() if isinstance(value, dict) else enumerate(value)
        return {key: shape_of(part) for key, part in pairs}
    return bool(value) if isinstance(value, str) else value


def numbers_of(text):
    words = [part if isinstance(part, str) else part.words for part in split_links(text)]
    return sorted(re.findall(r"\d+(?:\.\d+)?", re.sub(r"(?<=\d),(?=\d)", ".", "".join(words))))


@pytest.mark.parametrize("name", NAMES)
def test_german_has_the_same_parts_numbers_and_links(name):
    english, german = (read_lesson(name, language) for language in ("en", "de"))
    assert shape_of(german) == shape_of(english)
    assert [link[1:] for link in links_of(german)] == [link[1:] for link in links_of(english)]
    pairs = zip(texts_of(english), texts_of(german), strict=True)
    differing = [(one, other) for one, other in pairs if numbers_of(one) != numbers_of(other)]
    assert not differing
