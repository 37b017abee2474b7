"""The server is away for a while: what is opened meanwhile says so."""

import pytest

pytestmark = [pytest.mark.slow, pytest.mark.release]
FORMS = ("served",)


def test_a_view_opened_while_the_server_is_away_can_be_tried_again(visit, page):
    page.evaluate("() => whole.then(() => null)")
    page.context.set_offline(True)
    page.get_by_role("tab", name="Measure").click()
    page.locator("#measure .field-error").filter(has_text="The server does not answer").wait_for()
    page.context.set_offline(False)
    page.locator("#measure").get_by_role("button", name="Try again").click()
    page.get_by_role("button", name="Choose a file").wait_for()
    assert page.locator("#measure .field-error:visible").count() == 0
    visit.complaints.clear()  # Chromium logs the requests that failed


def test_the_banner_moves_nothing(page):
    before = page.locator("#stage").bounding_box()
    page.evaluate("() => store.set({ error: { detail: 'No answer.', offline: true } })")
    page.locator("#banner").wait_for()
    assert page.locator("#stage").bounding_box() == before
