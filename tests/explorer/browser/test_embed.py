"""The page in a frame of another site's page, and in full screen."""

import pytest

from adversary.server import serving

pytestmark = [pytest.mark.slow, pytest.mark.release]


@pytest.fixture(scope="module")
def school(site):
    """Serve a page of another site, which frames the address after its question mark."""
    (site.folder / "index.html").write_text(
        "<!doctype html><title>School</title><iframe width=640 height=480></iframe><script>"
        "document.querySelector('iframe').src = decodeURIComponent(location.search.slice(1))"
        "</script>"
    )
    return f"http://127.0.0.1:{site.server_port}"


@pytest.fixture(scope="module")
def open_to(school):
    """Serve the explorer where the school's pages may frame it; return its address."""
    with serving("--embed", school, workers=1) as server:
        yield server.address


@pytest.fixture
def page(browser):
    """Open a page whose complaints are not looked at: a browser logs what a policy refuses."""
    page = browser.new_page(viewport={"width": 900, "height": 640})
    page.set_default_timeout(30_000)
    yield page
    page.close()


def frame_of(page, school, address):
    page.goto(f"{school}/?{address.replace('#', '%23')}")
    return page.frame_locator("iframe")


def test_a_site_that_may_frames_the_page_and_its_link_opens_the_whole(page, school, open_to):
    frame = frame_of(page, school, f"{open_to}?embed#view=map&centre=1")
    frame.locator(".sentence-lead").get_by_text("tennis").wait_for()
    frame.locator("#stage .ball").first.wait_for()
    assert frame.get_by_role("slider", name="Time").is_visible()
    for hidden in (".top", ".results", "#controls", "#map"):
        assert not frame.locator(hidden).is_visible(), hidden
    with page.context.expect_page() as opened:
        frame.get_by_role("link", name="Open the explorer").click()
    whole = opened.value
    whole.locator("#controls [data-path='gaps.0']").wait_for()
    assert whole.url.startswith(f"{open_to}#view=play&")
    assert "centre=1" in whole.url
    assert whole.locator(".top").is_visible()
    whole.close()


def test_a_site_that_may_not_is_refused(page, school, address_of_server):
    address = f"{address_of_server}?embed"
    with page.expect_response(address) as answered:
        frame = frame_of(page, school, address)
    assert "frame-ancestors 'none'" in answered.value.headers["content-security-policy"]
    page.wait_for_timeout(500)
    assert frame.locator("#stage").count() == 0


def test_the_one_file_has_the_same_form(page, one_file):
    page.goto(f"{one_file.as_uri()}?embed#view=map&centre=1")
    page.locator("#stage .ball").first.wait_for()
    assert not page.locator(".top").is_visible()
    link = page.get_by_role("link", name="Open the explorer").get_attribute("href")
    assert link.startswith(f"{one_file.as_uri()}#view=play&balls.0.mass=0.625")


def test_full_screen_shows_the_film_larger(visit, address_of_server):
    visit.address = address_of_server
    page = visit.open()
    size = "() => parseFloat(getComputedStyle(document.querySelector('.scene-time')).fontSize)"
    before = page.evaluate(size)
    page.get_by_role("button", name="Full screen").click()
    leave = page.get_by_role("button", name="Leave full screen")
    leave.wait_for()
    assert page.evaluate(size) > 1.5 * before
    page.evaluate("() => clock.pause()")
    page.keyboard.press(" ")  # plays, and does not leave
    assert page.evaluate("() => clock.playing")
    assert page.locator(".sentence-lead").is_visible()
    assert page.locator("#controls:visible, .results:visible").count() == 0
    leave.click()
    page.get_by_role("button", name="Full screen", exact=True).wait_for()
    assert page.locator("#controls").is_visible()
    assert page.evaluate(size) == before
