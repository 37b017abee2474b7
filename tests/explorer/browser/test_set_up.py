"""The set-up: sliders that can be used, words that a pupil knows, and explanations."""

import pytest

pytestmark = pytest.mark.slow
FORMS = ("served",)

WIDE = (
    "#impact_speed=3.5&balls.0.mass=0.15&balls.1.mass=0.06"
    "&contacts.0.law=HuntCrossley&contacts.0.stiffness=2e4&contacts.0.exponent=1.5"
    "&contacts.0.dissipation=0.2&contacts.1.law=StandardLinearSolid&contacts.1.stiffness=1000"
    "&contacts.1.relaxation_strength=0.5&contacts.1.relaxation_time=1e-3"
)
CLIPPED = """(selects) => selects.filter((select) => {
  const probe = document.createElement('canvas').getContext('2d');
  probe.font = getComputedStyle(select).font;
  const text = select.selectedOptions[0].textContent;
  return probe.measureText(text).width > select.clientWidth - 24;  // the arrow has its place
}).map((select) => select.selectedOptions[0].textContent)"""


@pytest.mark.parametrize(("width", "least"), [(1366, 120), (1024, 120), (390, 300)])
def test_sliders_are_wide_and_laws_are_not_clipped(visits, width, least):
    visit = visits(viewport={"width": width, "height": 800})
    page = visit.open(WIDE)
    widths = page.locator(".field-slider:visible").evaluate_all(
        "(all) => all.map((one) => one.getBoundingClientRect().width)"
    )
    assert len(widths) >= 8
    assert min(widths) >= least
    laws = page.locator(".contact-card select")
    assert laws.evaluate_all(CLIPPED) == []
    assert laws.first.locator("option:checked").inner_text() == "Standard Linear Solid"


def test_a_number_is_called_by_a_word_and_its_term_and_explained(page):
    field = page.get_by_label("how stiff (stiffness) of floor – basketball", exact=True)
    assert field.input_value() == "2.5"
    ask = page.get_by_role("button", name="What is stiffness?").first
    says = page.get_by_text("A stiffer contact is pressed less").first
    assert not says.is_visible()
    ask.click()
    assert says.is_visible()
    assert ask.get_attribute("aria-expanded") == "true"
    ask.click()
    assert not says.is_visible()


def test_on_a_phone_the_ball_and_the_number_that_changes_it_are_on_one_screen(visits):
    page = visits(viewport={"width": 390, "height": 844}).open()
    top = "(one) => one.getBoundingClientRect().y + scrollY"

    def wait_for_stage(where):
        page.wait_for_function(
            f"() => document.querySelector('#stage').getBoundingClientRect().y {where}"
        )

    place = page.locator("#transport").evaluate(top)
    slider = page.locator("[data-slider='balls.0.mass']")
    slider.scroll_into_view_if_needed()
    slider.focus()
    wait_for_stage("=== 0")
    assert page.locator("#transport").evaluate(top) == pytest.approx(place, abs=1.0)
    stage, number = page.locator("#stage").bounding_box(), slider.bounding_box()
    assert stage["y"] + stage["height"] <= number["y"] <= 844 - number["height"]
    page.evaluate("() => scrollTo(0, 0)")  # the number is out of view, and the stage where it was
    wait_for_stage("> 100")
    slider.scroll_into_view_if_needed()
    wait_for_stage("=== 0")
    slider.evaluate("(one) => one.blur()")
    wait_for_stage("< 0")


# --- the share box shows a class where it finds the page
@[pytest.mark.slow, pytest.mark.release]
def test_the_share_box_shows_the_address_and_its_code(visit):
    place = {"address": "http://192.168.1.5:8050/", "code": ["101", "010", "101"]}
    visit.page.route("**/api/places", lambda route: route.fulfill(json={"places": [place]}))
    page = visit.open()
    page.get_by_text("Share", exact=True).click()
    page.get_by_text("http://192.168.1.5:8050/").wait_for()
    code = page.get_by_role("img", name="QR code of http://192.168.1.5:8050/")
    assert code.locator("path").get_attribute("d").count("M") == 5


@[pytest.mark.slow, pytest.mark.release]
def test_a_page_for_one_machine_shows_none(page):
    with page.expect_response("**/api/places"):
        page.get_by_text("Share", exact=True).click()
    assert not page.locator(".places").is_visible()


# --- the server is away for a while: what is opened meanwhile comes to life when it is back
@[pytest.mark.slow, pytest.mark.release]
def test_a_view_opened_while_the_server_is_away_comes_to_life(visit, page):
    page.evaluate("() => whole.then(() => null)")
    page.context.set_offline(True)
    page.get_by_role("tab", name="Measure").click()
    page.locator("#measure .field-error").filter(has_text="The server does not answer").wait_for()
    page.context.set_offline(False)
    page.get_by_role("button", name="Choose a file").wait_for()  # by itself
    assert page.locator("#measure .unopened").count() == 0
    visit.complaints.clear()  # Chromium logs the requests that failed


@[pytest.mark.slow, pytest.mark.release]
def test_the_banner_moves_nothing(page):
    before = page.locator("#stage").bounding_box()
    page.evaluate("() => store.set({ error: { detail: 'No answer.', offline: true } })")
    page.locator("#banner").wait_for()
    assert page.locator("#stage").bounding_box() == before
