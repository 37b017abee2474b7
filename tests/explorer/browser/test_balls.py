"""Balls that a class owns, in a real browser: their losses, their colours and their patterns."""

import pytest

import stackbounce as sb
from stackbounce.model.catalogue import stacked

pytestmark = [pytest.mark.slow, pytest.mark.release]

COLORS = """() => [0, 1].map((i) =>
  getComputedStyle(document.documentElement).getPropertyValue(`--ball-${i}`).trim())"""
INK = """(name) =>
  getComputedStyle(document.documentElement).getPropertyValue(`--place-${name}`).trim()"""
LOOKS = """() => [...document.querySelectorAll("#stage .ball-pattern")]
  .map((one) => one.dataset.look ?? null)"""
DRAWN = """() => [...document.querySelectorAll("#stage .ball")]
  .map((one) => one.querySelectorAll(".ball-mark").length)"""


def choose(visit, ball, name):
    visit.page.locator(f"#controls [data-key='ball-{ball}']").select_option(name)
    visit.page.wait_for_function(
        "([ball, name]) => state.drop.balls[ball].name === name", arg=[ball, name]
    )
    visit.ready()


def test_a_ball_of_a_class_brings_its_losses(visit, page):
    groups = page.locator("#controls [data-key='ball-0'] optgroup")
    labels = [group.get_attribute("label") for group in groups.all()]
    assert labels == ["Balls a class owns", "Balls of the paper"]
    choose(visit, 0, "big basketball")
    choose(visit, 1, "tennis ball")
    chosen = stacked(["big basketball", "tennis ball"])
    expected = sb.simulate(sb.Drop(chosen.balls, chosen.contacts, [0.0], impact_speed=3.53))
    assert visit.state("result.rebound_ratios") == pytest.approx(expected.rebound_ratios, rel=1e-9)
    notes = page.locator("#controls .contact-card > .note").all_inner_texts()
    assert "big basketball and tennis ball in series" in notes


def test_colours_belong_to_balls_and_not_to_places(visit, page):
    inks = [page.evaluate(INK, name) for name in (1, 4)]  # of basketballs and tennis balls
    assert all(inks)
    assert page.evaluate(COLORS) == inks
    page.locator("#controls [data-key='down-1']").click()
    page.wait_for_function("() => state.drop.balls[0].name === 'tennis'")
    visit.ready()
    assert page.evaluate(COLORS) == inks[::-1]
    assert page.evaluate(LOOKS) == ["tennis", "basketball"]
    assert page.evaluate(DRAWN) == [2, 2]
    page.locator("#controls [data-key='ball-1']").select_option("")  # a ball without a name
    page.wait_for_function("() => !state.drop.balls[1].name")
    visit.ready()
    tennis, other = page.evaluate(COLORS)
    assert (tennis, other) == (inks[1], inks[0])  # that of its place
    assert page.evaluate(LOOKS) == ["tennis", None]
