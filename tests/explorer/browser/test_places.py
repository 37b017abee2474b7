"""The share box shows a class where it finds the page."""

import pytest

pytestmark = [pytest.mark.slow, pytest.mark.release]
FORMS = ("served",)


def test_the_share_box_shows_the_address_and_its_code(visit):
    place = {"address": "http://192.168.1.5:8050/", "code": ["101", "010", "101"]}
    visit.page.route("**/api/places", lambda route: route.fulfill(json={"places": [place]}))
    page = visit.open()
    page.get_by_text("Share", exact=True).click()
    page.get_by_text("http://192.168.1.5:8050/").wait_for()
    code = page.get_by_role("img", name="QR code of http://192.168.1.5:8050/")
    assert code.locator("path").get_attribute("d").count("M") == 5


def test_a_page_for_one_machine_shows_none(page):
    with page.expect_response("**/api/places"):
        page.get_by_text("Share", exact=True).click()
    assert not page.locator(".places").is_visible()
