"""The page in the reader's language: of the browser, of the address, or chosen in the head."""

import pytest

pytestmark = [pytest.mark.slow, pytest.mark.release]

FIRST = "Der Tennisball fliegt mit dem 1,80-Fachen der Aufprallgeschwindigkeit nach oben"


def lead(page):
    return page.locator(".sentence-lead").text_content()


def test_a_browser_in_german_gets_german(visits):
    visit = visits(locale="de-DE")
    page = visit.open()
    assert lead(page).startswith(FIRST)
    assert page.locator("html").get_attribute("lang") == "de"
    assert page.title() == "stackbounce: Bälle aufeinander"
    assert page.locator("#tab-map").text_content() == "Karte"
    speed = page.locator("[data-path='impact_speed']")
    assert speed.input_value() == "3,53"
    speed.fill("2,5")
    speed.press("Enter")
    visit.ready()
    assert visit.state("drop.impact_speed") == 2.5
    visit.type("balls.1.mass", "-1")
    page.get_by_text("„-1“ geht hier nicht, die Zahl davor bleibt").wait_for()


@pytest.mark.forms("served")
def test_another_language_keeps_the_drop(visit):
    page = visit.open(
        "#balls.0.mass=0.3&contacts.0.law=Spring&contacts.0.stiffness=2e3&impact_speed=2"
    )
    assert page.locator("html").get_attribute("lang") == "en"
    page.get_by_label("Language").select_option("de")
    page.wait_for_function("() => document.documentElement.lang === 'de'")
    visit.ready()
    assert "lang=de" in page.url
    assert lead(page).startswith("Der Ball fliegt")
    assert page.evaluate("() => document.activeElement.dataset.key") == "language"
    assert visit.state("drop.balls[0].mass") == 0.3
    page.locator("#tab-map").click()
    page.get_by_role("heading", name="Rückprallgeschwindigkeit durch v₀: Ball").wait_for()
    page.get_by_label("Sprache").select_option("en")
    page.wait_for_function("() => document.documentElement.lang === 'en'")
    visit.ready()
    assert visit.state("drop.balls[0].mass") == 0.3


@pytest.mark.forms("served")
def test_english_loads_no_other_language(visit):
    visit.open()
    assert [one for one in visit.requests if one.endswith(".json") and "/languages/" in one] == []
