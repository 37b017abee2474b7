"""The lessons beside the page: opened, followed, answered, printed, closed."""

import pytest
from page_build.lessons.lesson import NAMES, read_lesson

pytestmark = pytest.mark.slow

PHONE = {"width": 390, "height": 844}
SEEN = "() => [...document.querySelectorAll('body *')].filter((one) => one.checkVisibility()"
OUTSIDE = f"{SEEN} && !one.closest('.worksheet') && !one.querySelector('.worksheet')).length"


def opened(page, name):
    page.get_by_role("button", name="Lessons", exact=True).click()
    page.get_by_role("button", name=read_lesson(name)["title"]).click()


def looked(page):
    assert not page.get_by_role("link", name="2 cm apart", exact=True).is_visible()  # not yet
    page.get_by_text("Look (10").click()


@pytest.mark.parametrize("size", [{"width": 1440, "height": 900}, PHONE], ids=["wide", "phone"])
def test_a_step_sets_the_page_beside_the_lesson(visits, size):
    visit = visits(viewport=size)
    page = visit.open()
    opened(page, "gap")
    assert page.get_by_role("heading", name="The gap").evaluate(
        "(one) => one === document.activeElement"
    )
    looked(page)
    numbers = page.locator("#numbers table")
    assert not numbers.is_visible()  # a lesson asks first, and so do its steps
    page.get_by_role("link", name="2 cm apart", exact=True).click()
    page.wait_for_function("() => state.result?.drop.gaps[0] === 0.02")
    assert not numbers.is_visible()
    page.evaluate("() => clock.wind(clock.film.length)")
    numbers.wait_for()
    assert visit.state("drop.balls.map((ball) => ball.name)") == ["big basketball", "tennis ball"]
    assert "lesson=gap" in page.url
    assert page.evaluate("() => scrollY") == 0  # the head stays
    stage, lesson = (page.locator(one).bounding_box() for one in ("#stage", "#lesson"))
    beside = stage["x"] + stage["width"] <= lesson["x"]
    above = 0 <= stage["y"] <= stage["y"] + stage["height"] <= lesson["y"]
    assert beside or above
    page.get_by_role("link", name="As a line").click()
    page.locator("#line-title, .line-title").first.wait_for()
    assert visit.state("line.x.path") == "gaps.0"
    assert page.locator("#lesson").is_visible()


def test_back_goes_through_the_lessons_and_closes_them(visit, page):
    first = visit.state("drop.gaps")
    opened(page, "gap")
    looked(page)
    page.get_by_role("link", name="2 cm apart", exact=True).click()
    page.wait_for_function("() => state.drop.gaps[0] === 0.02")
    states = []
    for _ in range(3):
        page.go_back()
        states.append((visit.state("lesson"), visit.state("drop.gaps")))
    assert states == [("gap", first), ("all", first), (None, first)]
    assert not page.locator("#lesson").is_visible()
    page.go_forward()
    assert page.locator(".lesson-choice").count() == len(NAMES)
    page.keyboard.press("Escape")
    assert not page.locator("#lesson").is_visible()


def test_answers_are_hidden_until_they_are_opened(visit):
    page = visit.open("#lesson=three-times")
    answer = page.get_by_text("From the basketball, which comes in with 6.13 J")
    assert not answer.is_visible()
    page.get_by_text("Answers for the teacher").click()
    assert answer.is_visible()
    page.get_by_role("button", name="The gap", exact=True).click()
    assert visit.state("lesson") == "gap"


def test_the_worksheet_is_printed_alone(visit, in_firefox):
    page = visit.open("#lesson=gap")
    page.evaluate("() => { window.print = () => { window.printed = document.body.className; }; }")
    page.get_by_role("button", name="Print the worksheet").click()
    assert "only-worksheet" in page.evaluate("() => window.printed")
    if in_firefox:
        pytest.skip("Playwright shows no page as printed by WebDriver BiDi")
    page.emulate_media(media="print")
    sheet = page.locator(".worksheet")
    assert "Draw the height against the gap" in sheet.inner_text()
    assert sheet.locator("svg").is_visible()
    assert page.evaluate(OUTSIDE) == 0
    page.evaluate("() => dispatchEvent(new Event('afterprint'))")
    assert not page.locator("#lesson").is_visible()
    assert page.locator("#stage").is_visible()


def test_lessons_are_in_german_and_elsewhere_marked_as_english(visits):
    page = visits(locale="de-DE").open("#lesson=stiffness")
    page.get_by_role("heading", name="Was die Steifigkeit bewirkt").wait_for()
    assert page.locator("#lesson").get_attribute("lang") is None
    page = visits(locale="fr-FR").open("#lesson=stiffness")
    heading = page.get_by_role("heading", name="What stiffness does")
    assert heading.evaluate("(one) => one.closest('[lang]').lang") == "en"
    assert page.get_by_role("heading", name="Étapes").get_attribute("lang") == "fr"


def test_a_lesson_that_is_not_there_is_the_list(visit):
    page = visit.open("#lesson=nothing-here")
    assert page.locator(".lesson-choice").count() == len(NAMES)
    page = visit.open("#lesson=%3Cimg%3E&view=line")
    assert "does not understand" in page.locator("#preset-says").inner_text()
