"""The map in Chromium: drawn, pointed at, clicked, moved over by keyboard."""

import numpy as np
import pytest

import stackbounce as sb


def shown(visit, fragment="#view=map"):
    page = visit.open(fragment)
    page.locator("#map-summary").filter(has_text="largest").wait_for(timeout=120_000)
    page.wait_for_load_state("networkidle")
    return page


def drop(visit):
    return sb.Drop.from_mapping(visit.state("drop"))


def test_a_click_plays_the_drop_there(visit):
    page = shown(visit)
    visit.picture("map")
    box = page.locator(".map-board").bounding_box()
    page.mouse.move(box["x"] + 0.6 * box["width"], box["y"] + 0.3 * box["height"])
    said = page.locator(".map-readout").inner_text()
    page.mouse.click(box["x"] + 0.6 * box["width"], box["y"] + 0.3 * box["height"])
    page.wait_for_function("() => window.stackbounce.store.get().view === 'play'")
    visit.ready()
    found = drop(visit)
    mass = found.balls[0].mass / found.balls[1].mass
    stiffness = found.contacts[0].stiffness / found.contacts[1].stiffness
    assert 1.0 < mass < 100.0
    assert 1.0 < stiffness < 100.0
    assert f"{mass:.2g}" in said
    ratio = float(sb.simulate(found).rebound_ratios[1])
    assert visit.state("result.rebound_ratios")[1] == pytest.approx(ratio, rel=1e-9)
    told = float(said.rstrip(".").split(":")[1].split()[0])
    assert told == pytest.approx(ratio, rel=0.05)  # that of the nearest point of the map


def test_the_keyboard_moves_a_crosshair_and_plays(visit):
    page = shown(visit)
    before = drop(visit)
    page.locator(".map-board").focus()
    page.keyboard.press("Home")
    for _ in range(3):
        page.keyboard.press("ArrowRight")
    page.keyboard.press("Shift+ArrowUp")
    assert "mass ratio" in page.locator("#map [aria-live]").inner_text().lower()
    page.keyboard.press("Enter")
    page.wait_for_function("() => window.stackbounce.store.get().view === 'play'")
    after = drop(visit)
    assert after.balls[0].mass > before.balls[0].mass
    assert after.contacts[0].stiffness > before.contacts[0].stiffness
    assert after.balls[1] == before.balls[1]


def test_other_sides_and_other_numbers_are_kept_in_the_address(visits):
    first = visits()
    page = shown(first)
    page.locator('[data-key="map-x"]').select_option("gaps.0")
    page.locator('[data-key="map-show"]').select_option("collisions.0")
    page.wait_for_function("() => location.hash.includes('map.show=collisions.0')")
    second = visits()
    shown(second, page.evaluate("() => location.hash"))
    assert second.state("map") == first.state("map")
    assert second.page.locator(".map-title").inner_text().startswith("Collisions of floor")


def test_the_text_beside_tells_the_extremes(visit):
    page = shown(visit)
    text = page.locator("#map-summary").inner_text()
    base = drop(visit)
    ratios, upper = np.geomspace(0.1, 100, 120), base.balls[1].mass
    stiffnesses = np.geomspace(0.1, 100, 90) * base.contacts[1].stiffness
    varied = {"balls.0.mass": ratios * upper, "contacts.0.stiffness": stiffnesses}
    largest = float(sb.sweep(base, varied).rebound_ratio[..., 1].max())
    assert f"largest {largest:.3g} at" in text


def test_a_wrong_end_is_told_and_the_map_stays(visit):
    page = shown(visit)
    low = page.locator('[data-key="map-x-low"]')
    low.fill("0")
    low.press("Tab")
    error = page.locator("#map-x-error")
    error.wait_for(state="visible")
    assert "above 0" in error.inner_text()
    assert page.locator(".map-board").is_visible()


def test_a_phone_shows_the_map(visits):
    visit = visits(viewport={"width": 360, "height": 780}, has_touch=True, is_mobile=True)
    page = shown(visit)
    assert page.evaluate("() => document.documentElement.scrollWidth") <= 360
    page.locator(".map-board").tap()
    page.get_by_role("button", name="Play this drop").click()
    page.wait_for_function("() => window.stackbounce.store.get().view === 'play'")
    visit.picture("map-phone")
