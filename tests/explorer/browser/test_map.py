"""The map: what it draws and says is what was computed, by mouse and keyboard."""

import re

import numpy as np
import pytest

import stackbounce as sb

pytestmark = [pytest.mark.slow, pytest.mark.release]

LEFT, RIGHT, TOP, BOTTOM = 58, 14, 48, 44  # px around the field of the map


def opened(visit, more=""):
    page = visit.open(f"#view=map{more}")
    page.wait_for_function(
        "() => document.querySelector('.map-title')?.textContent"
        " && !document.querySelector('.map-message').textContent"
    )
    page.wait_for_load_state("networkidle")
    return page


@pytest.fixture
def page(visit):
    return opened(visit)


def spot(page, across, up):
    """Return where a place of the field, in parts of its sides, is on the board, in px."""
    box = page.locator(".map-board").bounding_box()
    width, height = box["width"] - LEFT - RIGHT, box["height"] - TOP - BOTTOM
    return {"x": LEFT + across * width, "y": TOP + (1.0 - up) * height}


def ratio(mass_ratio, stiffness_ratio):
    balls = [sb.Ball(0.057 * mass_ratio), sb.Ball(0.057)]
    contacts = [sb.Spring(1000.0 * stiffness_ratio), sb.Spring(1000.0)]
    return sb.simulate(sb.Drop(balls, contacts, impact_speed=3.53)).rebound_ratios[1]


def test_words_at_the_crosshair_are_those_of_the_drop_there(visit, page):
    board = page.locator(".map-board")
    board.press("ArrowRight")  # the crosshair appears at the present drop
    board.press("Shift+ArrowUp")
    said = page.locator("#map [aria-live]").inner_text()
    masses, stiffnesses, found = map(float, re.findall(r" (\d+\.?\d*)(?=[,:.]| *$)", said))
    assert masses == pytest.approx(0.150 / 0.057, rel=2e-3)
    assert stiffnesses == pytest.approx(2.5 * 1000.0 ** (1 / 6), rel=5e-3)
    assert found == pytest.approx(ratio(masses, stiffnesses), abs=0.02)
    board.press("Enter")
    assert visit.state("view") == "play"
    assert visit.state("drop.contacts[0].stiffness") == pytest.approx(1e3 * stiffnesses, rel=5e-3)
    assert visit.state("drop.balls[0].mass") == pytest.approx(0.150, rel=1e-3)


def test_the_map_follows_a_slider_while_it_moves(visit, page):
    drawn = page.evaluate(
        """async () => {
             const slider = document.querySelector("#map [data-slider='gaps.0']");
             const summary = document.querySelector("#map-summary");
             const drawn = new Set();
             for (let step = 1; step <= 200 && (step < 20 || drawn.size < 3); step += 1) {
               slider.value = step;
               slider.dispatchEvent(new Event("input", { bubbles: true }));
               await new Promise(requestAnimationFrame);
               drawn.add(summary.textContent);
             }
             return drawn.size; }"""
    )
    assert drawn >= 3
    visit.ready()
    page.wait_for_function("() => state.result.drop.gaps[0] === state.drop.gaps[0]")
    expected = sb.simulate(visit.drop()).rebound_ratios[1]
    for _ in range(100):  # until the map of the last drop is there
        page.locator(".map-board").press("Home")  # the crosshair goes to the present drop
        said = page.locator("#map [aria-live]").inner_text()
        if float(re.search(r"(\d+\.?\d*)\.$", said)[1]) == pytest.approx(expected, abs=0.02):
            return
        page.wait_for_timeout(200)
    pytest.fail(f"{said} is not of {expected}")


def test_the_set_up_is_one_form_that_goes_with_the_view(page):
    assert page.locator("#map #controls [data-path='balls.0.mass']").is_visible()
    page.locator("#tab-play").click()
    assert page.locator("#play #controls [data-path='balls.0.mass']").is_visible()
    page.locator("#tab-map").click()
    assert page.locator("#map #controls").count() == page.locator("#controls").count() == 1


def test_a_finger_looks_first_and_plays_by_the_button(visits, in_firefox):
    if in_firefox:
        pytest.skip("Playwright taps nothing by WebDriver BiDi")
    visit = visits(viewport={"width": 360, "height": 780}, has_touch=True)
    page = opened(visit)
    assert page.evaluate("() => document.documentElement.scrollWidth <= innerWidth")
    page.locator(".map-board").tap(position=spot(page, 0.5, 0.5))
    assert visit.state("view") == "map"
    page.locator(".map-play").tap()
    assert visit.state("view") == "play"
    assert visit.state("drop.balls[0].mass") == pytest.approx(0.057 * 10.0**0.5, rel=0.03)


def test_brighter_is_more(page):
    """Colours at points of the canvas are ordered as the ratios of their drops."""
    parts = [(0.82, 0.95), (0.6, 0.7), (0.55, 0.35), (0.9, 0.1)]
    places = [spot(page, *part) for part in parts]
    lights = page.evaluate(
        """(places) => {
             const canvas = document.querySelector('.map-field');
             const { width, height } = canvas;
             const { data } = canvas.getContext('2d').getImageData(0, 0, width, height);
             return places.map(({ x, y }) => {
               const at = 4 * (Math.round(y) * width + Math.round(x));
               return 0.2126 * data[at] + 0.7152 * data[at + 1] + 0.0722 * data[at + 2]; }); }""",
        places,
    )
    ratios = [ratio(10.0 ** (3 * x - 1), 10.0 ** (3 * y - 1)) for x, y in parts]
    assert sorted(ratios, reverse=True) == ratios
    assert sorted(lights, reverse=True) == lights


@pytest.mark.forms("one file")
def test_sides_and_what_is_shown_are_in_the_address(visit, page):
    page.locator("[data-key=map-x]").select_option("gaps.0")
    page.locator("[data-key=map-show]").select_option("rebound_height.1")
    page.wait_for_function("() => /rebound_height/.test(location.hash)")
    link = page.evaluate("() => location.hash")
    page.goto("about:blank")
    page.goto(f"{visit.address}{link}")
    page.wait_for_function("() => /height/.test(document.querySelector('.map-title')?.textContent)")
    assert page.locator("[data-key=map-x]").input_value() == "gaps.0"
    assert page.locator("[data-key=map-x-high]").input_value() == "10"
    assert "mm" in page.locator(".map-form").inner_text()


def test_an_end_that_makes_no_side_is_told_where_it_stands(page):
    low = page.locator("[data-key=map-x-low]")
    low.fill("")
    low.press_sequentially("-1\n")
    assert page.locator("#map-x-error").inner_text() == "A logarithmic axis needs limits above 0."


def test_the_text_beside_tells_the_extremes(visit, page):
    text = page.locator("#map-summary").inner_text()
    base = visit.drop()
    ratios, upper = np.geomspace(0.1, 100, 120), base.balls[1].mass
    stiffnesses = np.geomspace(0.1, 100, 90) * base.contacts[1].stiffness
    varied = {"balls.0.mass": ratios * upper, "contacts.0.stiffness": stiffnesses}
    largest = float(sb.sweep(base, varied).rebound_ratio[..., 1].max())
    assert f"largest {largest:.3g} at" in text
