"""The first minute: a question, a drop, and only then the answer; all else is one click away."""

import pytest

pytestmark = pytest.mark.slow

SIZES = [(1366, 768), (1024, 768), (390, 844), (360, 740), (1920, 1080)]
COUNTED = """() => {
  const seen = (one) => one.checkVisibility({ visibilityProperty: true });
  const all = document.querySelectorAll("button, a[href], input, select, summary, [role=slider]");
  const controls = [...all].filter((one) => seen(one) && !one.closest(".quiet, .skip")).length;
  const texts = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  let words = 0;
  for (let text; (text = texts.nextNode()); ) {
    const { parentElement: one } = text;
    if (!one.closest("script, style, option, .quiet, .skip") && seen(one)) {
      words += text.textContent.split(/\\s+/).filter(Boolean).length;
    }
  }
  return [words, controls, document.documentElement.scrollHeight - innerHeight];
}"""


@pytest.mark.parametrize(("width", "height"), SIZES)
def test_the_first_screen_is_small(visits, width, height):
    page = visits(viewport={"width": width, "height": height}).open("")
    words, controls, below = page.evaluate(COUNTED)
    assert words <= 90
    assert controls <= 14
    assert below <= 0
    assert not page.evaluate("() => clock.playing || clock.time > clock.begin")


def answered(visit, rises=1.85):
    page = visit.page
    page.wait_for_function("() => state.guess !== null")
    assert (
        f"rises {rises} m; the textbook says 3.73 m." in page.locator(".sentence-lead").inner_text()
    )


@pytest.mark.parametrize("way", ["button", "space", "ball"])
def test_balls_are_dropped_by_button_space_or_click_and_then_comes_the_answer(visit, way):
    page = visit.open("")
    page.evaluate("() => store.set({ speed: 4 })")
    assert page.locator(".sentence-lead").inner_text() == "How high will the tennis ball fly?"
    if way == "space":
        page.keyboard.press(" ")
    else:
        page.locator(
            {"button": ".guess-go", "ball": "#stage [data-ball='1'] .ball-light"}[way]
        ).first.click()
    page.wait_for_function("() => clock.playing")
    answered(visit)
    assert "You thought" not in page.locator(".sentence-more").inner_text()  # nobody guessed
    assert not page.locator("#numbers").is_visible()
    assert "#" not in page.url


def test_look_closer_opens_the_whole_page_and_the_address_remembers_it(visit):
    page = visit.open("")
    page.get_by_role("button", name="Look closer").click()
    page.locator("#numbers table").wait_for()
    assert page.locator("#controls").is_visible()
    page.wait_for_function("() => location.hash.includes('balls.0.mass')")
    page.reload()
    visit.ready()
    assert page.locator("#tab-map").is_visible()
    page.go_back()
    page.locator("#tab-map").wait_for(state="hidden")
    assert page.locator(".sentence-lead").inner_text() == "How high will the tennis ball fly?"


def test_a_lesson_asks_first_and_so_do_its_steps(visit):
    page = visit.open("")
    page.get_by_role("button", name="Lessons").click()
    assert not page.locator("#numbers table").is_visible()
    page.locator("[data-key=lesson-gap]").click()
    for _ in range(2):
        assert page.locator("#tab-map").is_visible()
        assert not page.locator("#numbers table").is_visible()
        assert visit.state("predict")
        page.get_by_role("link", name="2 cm apart", exact=True).click()
        page.wait_for_function("() => state.result?.drop.gaps[0] === 0.02")
    page.evaluate("() => clock.wind(clock.film.length)")
    page.locator("#numbers table").wait_for()
    page.keyboard.press("Escape")
    assert not visit.state("predict")
