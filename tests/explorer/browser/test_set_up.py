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
