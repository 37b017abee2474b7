"""The line: what it draws and says is what was computed."""

import re

import numpy as np
import pytest

import stackbounce as sb

pytestmark = [pytest.mark.slow, pytest.mark.release]

MASSES = "#view=line&line.x.path=mass_ratio&line.x.low=1&line.x.high=10&line.x.log=false"
CURVES = """() => [...document.querySelectorAll('.line-curve')].map((curve) =>
    [...curve.getAttribute('d').matchAll(/[ML](\\S+) ([-\\d.]+)/g)].map(([, x, y]) => [+x, +y]))"""


def opened(visit, fragment="#view=line"):
    page = visit.open(fragment)
    whole(page)
    return page


@pytest.fixture
def page(visit):
    return opened(visit)


def whole(page):
    """Wait until a line is drawn."""
    page.wait_for_function(
        "() => document.querySelector('.line-curve') && document.querySelector('#line-summary')"
        ".textContent && !document.querySelector('.line-message').textContent"
    )


def spot(page, part, up=0.5):
    """Return where a place of the drawing, in parts of its sides, is on the board, in px."""
    curve = np.array(page.evaluate(CURVES)[0])
    across = page.evaluate(
        """() => [...document.querySelectorAll('.line-drawing svg > line')]
             .filter((one) => one.getAttribute('y1') === one.getAttribute('y2'))
             .map((one) => +one.getAttribute('y1'))"""
    )
    left, right = curve[[0, -1], 0]
    return {"x": left + part * (right - left), "y": max(across) - up * np.ptp(across)}


def ratios(visit, mass_ratio):
    drop = visit.drop()
    balls = [sb.Ball(drop.balls[1].mass * mass_ratio), drop.balls[1]]
    return sb.simulate(sb.Drop(balls, drop.contacts, impact_speed=3.53)).rebound_ratios


def test_curves_and_axis_are_the_library_s(visit):
    """Heights of the curves in px are proportional to the rebound ratios."""
    page = opened(visit, MASSES)
    lower, upper = (np.array(curve) for curve in page.evaluate(CURVES))
    marks = page.evaluate(
        """() => [...document.querySelectorAll('.line-drawing svg > text[text-anchor=end]')]
             .map((one) => [+one.getAttribute('y'), +one.textContent])"""
    )
    scale = np.polyfit(*np.transpose(marks), 1)
    for ratio in (1.3, 2.0, 4.4, 9.1):
        x = spot(page, (ratio - 1.0) / 9.0)["x"]
        drawn = [np.polyval(scale, np.interp(x, *curve.T)) for curve in (lower, upper)]
        assert drawn == pytest.approx(ratios(visit, ratio), abs=0.01)


def test_words_at_the_crosshair_are_those_of_the_drop_there(visit):
    page = opened(visit, MASSES)
    board = page.locator(".line-board")
    board.press("ArrowRight")  # the crosshair appears at the present drop
    board.press("Shift+ArrowRight")
    said = page.locator("#line [aria-live]").inner_text()
    words = r"Mass ratio m₁/m₂ ([\d.]+): tennis ([\d.]+) times \(textbook ([\d.]+)\), basketball "
    ratio, upper, textbook = map(float, re.match(words, said).groups())
    assert ratio == pytest.approx(0.150 / 0.057 + 0.9, abs=0.01)
    assert upper == pytest.approx(ratios(visit, ratio)[1], abs=0.006)
    assert textbook == pytest.approx((3 * ratio - 1) / (ratio + 1), abs=0.006)  # eq. 2, e = 1
    assert page.locator(".line-readout").inner_text() == said
    board.press("Home")
    assert "m₁/m₂ 2.63:" in page.locator("#line [aria-live]").inner_text()
    board.press("Shift+ArrowRight")
    board.press("Enter")
    assert visit.state("view") == "play"
    assert visit.state("drop.balls[0].mass") == pytest.approx(0.150 + 0.9 * 0.057, rel=1e-3)


def test_a_click_plays_the_drop_of_that_point(visit):
    page = opened(visit, MASSES)
    page.locator(".line-board").click(position=spot(page, 0.5))
    assert visit.state("view") == "play"
    page.wait_for_function("() => clock.playing")
    assert visit.state("drop.balls[0].mass") == pytest.approx(5.5 * 0.057, rel=0.01)


def test_the_point_can_be_dragged_and_its_drop_follows(visit):
    page = opened(visit, MASSES)
    drawn = page.evaluate(CURVES)
    box = page.locator(".line-board").bounding_box()
    begin, end = spot(page, 0.2), spot(page, 0.7, 0.2)
    page.mouse.move(box["x"] + begin["x"], box["y"] + begin["y"])
    page.mouse.down()
    page.mouse.move(box["x"] + end["x"], box["y"] + end["y"], steps=8)
    page.mouse.up()
    visit.ready()
    assert visit.state("view") == "line"
    masses = [ball["mass"] for ball in visit.state("result.drop.balls")]
    assert masses[0] / masses[1] == pytest.approx(1.0 + 9.0 * 0.7, rel=0.01)
    assert page.evaluate(CURVES) == drawn  # what varies along the line does not change it
    dot = page.locator(".line-board circle").first
    assert float(dot.get_attribute("cx")) == pytest.approx(end["x"], abs=1.5)


def test_a_curve_follows_while_a_number_changes(visit, page):
    """Many changes in a row: curves are drawn in between, and the last one wins."""
    seen = page.evaluate(
        """async () => {
             const seen = new Set();
             for (let stiffness = 1000; stiffness <= 4000; stiffness += 100) {
               const { drop } = store.get();
               const contacts = [{ law: 'Spring', stiffness }, drop.contacts[1]];
               store.set({ drop: { ...drop, contacts } });
               await new Promise(requestAnimationFrame);
               seen.add(document.querySelectorAll('.line-curve')[1].getAttribute('d')); }
             return seen.size; }"""
    )
    assert seen > 3
    visit.ready()
    assert visit.drop().contacts[0].stiffness == 4000.0
    ratio = sb.simulate(visit.drop()).rebound_ratios[1]
    page.wait_for_function(
        "(said) => document.querySelector('#line-summary').textContent.includes(said)",
        arg=f"Tennis: smallest {ratio:.3g} times at 0 mm",
    )


def test_a_figure_of_the_paper_sets_drop_and_line(visit, page):
    page.locator("[data-key=line-figure]").select_option("figure-6-B2")
    page.locator(".line-measured").first.wait_for()
    assert page.locator(".line-measured").count() == 2
    assert "measured 1.91 ± 0.02" in page.locator(".line-board").inner_text()
    assert visit.state("drop.balls[1].mass") == 0.0248
    assert page.locator("[data-key=line-x-high]").input_value() == "100"
    assert page.locator("[data-key=line-figure] option").count() == 10  # the first is none
    page.evaluate("""() => { store.set({ drop: { ...store.get().drop, gaps: [0.001] } }); }""")
    page.locator(".line-measured").first.wait_for(state="detached")  # no drop of that figure
    assert page.locator("[data-key=line-figure]").input_value() == ""


def test_every_outcome_is_drawn(page):
    for show in ("rebound_height", "energy_retained", "collisions"):
        page.locator("[data-key=line-show]").select_option(show)
        word = show.replace("_", " ").split()[0]
        page.locator(".line-title").filter(has_text=word).wait_for()  # in capitals or not
        whole(page)
        assert page.locator(".line-curve").count()


def test_the_address_keeps_the_line(visits):
    first = visits()
    page = opened(first)
    page.locator("[data-key=line-x]").select_option("impact_speed")
    page.locator("[data-key=line-show]").select_option("rebound_height")
    page.locator("[data-key=line-x-high]").fill("")
    page.locator("[data-key=line-x-high]").press_sequentially("5\n")
    page.wait_for_function("() => /line.x.high=5/.test(location.hash)")
    second = visits()
    other = opened(second, page.evaluate("() => location.hash"))
    assert second.state("line") == first.state("line")
    assert other.locator("[data-key=line-show]").input_value() == "rebound_height"
    assert other.locator(".line-title").inner_text() == "Rebound heights against impact speed"


@pytest.mark.parametrize(
    ("more", "missing"),
    [
        ("line.x.path=__proto__&line.x.low=0&line.x.high=1", "__proto__"),
        ("line.x.path=gaps.0&line.x.low=1e999&line.x.high=%3Cb%3E", "x"),
        ("line.show=%3Cimg%20src%3Dx%3E", "<img src=x>"),
    ],
)
def test_what_a_link_has_and_this_drop_has_not_is_named(visit, more, missing):
    page = opened(visit, f"#view=line&{more}")
    said = page.locator(".line-form .note").inner_text()
    assert said.startswith(f"This drop has no “{missing}”")
    assert page.locator("[data-key=line-x]").input_value() == "gaps.0"
    assert page.locator("img").count() == 0


def test_settings_of_a_newer_page_are_named_and_the_rest_is_kept(visit):
    page = opened(visit, "#view=line&line.show=collisions&line.smooth=3&map.z.low=1&line.x=1")
    assert visit.state("line") == {"show": "collisions"}
    assert "“line.smooth”, “map.z.low”, “line.x”" in page.locator("#preset-says").inner_text()
    assert page.locator("[data-key=line-show]").input_value() == "collisions"


def test_a_drop_that_is_none_is_told_and_the_line_comes_back(page):
    change = "(impact_speed) => store.set({ drop: { ...store.get().drop, impact_speed } })"
    page.evaluate(change, -1)
    page.locator(".line-message").get_by_text("impact_speed must be a positive number").wait_for()
    page.evaluate(change, 3)
    whole(page)
    assert page.locator(".line-message").inner_text() == ""


RELAXING = {"stiffness": 1e4, "relaxation_strength": 1.0, "relaxation_time": 1e-3}
LAWS = [
    {"law": "HuntCrossley", "stiffness": 1e6, "exponent": 1.5, "dissipation": 0.1},
    {"law": "StandardLinearSolid"} | RELAXING,
]


@pytest.mark.parametrize("contact", LAWS)
def test_six_balls_with_a_law_of_their_own_are_drawn_from_coarse_to_fine(visit, page, contact):
    page.evaluate(
        """(contact) => { const { drop } = store.get();
             const balls = Array.from({ length: 6 }, (_, i) => ({ mass: 0.1 / (1 + i) }));
             store.set({ drop: { ...drop, balls, gaps: [0, 0, 0, 0, 0],
                                 contacts: balls.map(() => contact) } }); }""",
        contact,
    )
    page.wait_for_function(
        "() => document.querySelectorAll('.line-curve')[5]?.getAttribute('d').length > 2000"
    )
    assert page.locator(".line-curve").count() == 6
    assert page.locator(".line-message").inner_text() == ""
    assert visit.state("error") is None


def test_a_screen_reader_is_told(visit):
    page = opened(visit)
    board = page.locator(".line-board")
    assert board.get_attribute("role") == "application"
    assert board.get_attribute("aria-label").startswith("Line: Rebound speeds over v₀; across, gap")
    for described in board.get_attribute("aria-describedby").split():
        assert len(page.locator(f"#{described}").text_content()) > 40
    board.focus()
    assert page.evaluate("() => getComputedStyle(document.activeElement).cursor") == "crosshair"
    page.locator("#tab-line").focus()
    page.keyboard.press("ArrowRight")
    assert visit.state("view") == "map"
