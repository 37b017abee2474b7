"""The numbers beside the film: whole, known, and silent while a guess is asked for."""

import pytest

pytestmark = [pytest.mark.slow, pytest.mark.release]
NAMES = "&balls.0.mass=0.6&balls.0.name=big+basketball&balls.1.mass=0.057&balls.1.name=table+tennis"
LONG = (
    f"#height=5{NAMES}&contacts.0.law=Spring&contacts.0.stiffness=9e4"
    "&contacts.1.law=Spring&contacts.1.stiffness=8e4"
)


@pytest.mark.parametrize("width", [360, 1160, 1200, 1280, 1366])
def test_the_table_is_not_cut(visits, width):
    page = visits(viewport={"width": width, "height": 800}).open(LONG)
    room = "(one) => one.parentElement.clientWidth - one.scrollWidth"
    assert page.locator("#numbers table").evaluate(room) >= 0


def test_a_run_that_has_not_ended_shows_no_numbers_of_its_end(page):
    numbers = page.locator("#numbers").inner_text()
    assert "Kinetic energy retained" in numbers
    assert "0.564\xa0N\xa0s" in numbers  # which no line breaks
    page.evaluate(
        """() => { const { result } = store.get();
             store.set({ result: { ...result, status: "EVENT_LIMIT" } }); }"""
    )
    cells = page.locator("#numbers tbody td").all_inner_texts()
    assert cells[:3] == ["–", "–", "–"]
    said = page.locator(".sentence-more").inner_text()
    assert said.startswith("The balls meet more often than this page can follow")
    assert said not in page.locator("#numbers").inner_text()


def test_each_entry_is_a_step_and_reset_leaves_no_tick(visit, page):
    for text in ("60", "61", "62"):
        visit.type("balls.1.mass", text)
    page.get_by_label("Momentum", exact=True).check()
    undo = page.get_by_role("button", name="Undo", exact=True)
    undo.click()
    undo.click()
    assert visit.state("drop.balls[1].mass") == 0.06
    page.get_by_role("button", name="Reset").click()
    assert (visit.state("momentum"), visit.state("drop.balls[1].mass")) == (False, 0.057)


def test_the_line_does_not_tell_what_is_asked(visit):
    page = visit.open("#view=line&predict=1")
    page.wait_for_function("() => document.querySelector('.line-title').textContent")
    assert page.locator(".line-told").inner_text() == "How high will the tennis ball fly?"
    assert page.locator("#line .line-marks circle").count() == 0
    page.evaluate("() => store.set({ guess: 1 })")
    assert "1.80 times" in page.locator(".line-told").inner_text()
    assert page.locator("#line .line-marks circle").count() > 0


def test_paper_has_no_control(page, in_firefox):
    if in_firefox:
        pytest.skip("Playwright shows no page as printed by WebDriver BiDi")
    page.emulate_media(media="print")
    assert page.locator("button:visible, select:visible, input:visible").count() == 0
