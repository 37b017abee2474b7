"""The first minute: a question, a drop, and only then the answer; all else is one click away."""

import pytest

pytestmark = pytest.mark.slow
QUESTION = "How high will the tennis ball fly?"
COUNTED = """() => {
  for (const one of document.querySelectorAll(".quiet, .skip, option")) one.remove();
  const all = document.querySelectorAll("button, a, input, select, summary, [role=slider]");
  const seen = [...all].filter((one) => one.checkVisibility({ visibilityProperty: true }));
  const below = document.documentElement.scrollHeight - innerHeight;
  return [document.body.innerText.split(/\\s+/).length, seen.length, below];
}"""


@pytest.mark.parametrize("size", [(1366, 768), (1024, 768), (390, 844), (360, 740), (1920, 1080)])
def test_the_first_screen_is_small_and_still(visits, size):
    page = visits(viewport=dict(zip(("width", "height"), size, strict=True))).open("")
    assert not page.evaluate("() => clock.playing || clock.time > clock.begin")
    words, controls, below = page.evaluate(COUNTED)
    assert (30 < words <= 90, 5 < controls <= 14, below <= 0) == (True, True, True)


@pytest.mark.parametrize(
    "way", ["[data-part=go]", " ", "[data-ball='1'] .ball-light", ".guess-mark"]
)
def test_balls_are_dropped_by_button_space_or_click_and_then_comes_the_answer(visit, way):
    page = visit.open("")
    page.evaluate("() => store.set({ speed: 4 })")
    assert page.locator(".sentence-lead").inner_text() == QUESTION
    if way == ".guess-mark":
        page.locator(way).press("PageUp")
    page.keyboard.press(" ") if way in " .guess-mark" else page.locator(way).click()
    page.wait_for_function("() => clock.time > 0")
    assert page.locator(".sentence-lead").inner_text() == QUESTION  # until it has its top
    page.wait_for_function("() => state.guess !== null")
    said = page.locator("#sentence").inner_text()
    assert "rises 1.85 m; the textbook says 3.73 m." in said
    assert ("You thought" in said) == (way == ".guess-mark")
    assert not page.locator("#numbers").is_visible()
    assert "#" not in page.url


def test_balls_let_go_before_the_last_frames_arrive_fly_on(visit):
    page = visit.open("")
    page.evaluate("() => whole.then(() => null)")
    page.evaluate("""() => { store.set({ drop: { ...state.drop, gaps: [0.02] } });
        document.querySelector("[data-part=go]").click(); }""")
    visit.ready()
    assert page.evaluate("() => clock.playing")
    page.evaluate("() => clock.rewind()")
    page.locator("[data-part=go]").wait_for()  # they can be let go again


def test_look_closer_opens_the_whole_page_and_the_address_remembers_it(visit):
    page = visit.open("")
    page.get_by_role("button", name="Look closer").click()
    page.locator("#numbers table").wait_for()
    page.wait_for_function("() => location.hash.includes('balls.0.mass')")
    page.reload()
    visit.ready()
    assert page.locator("#tab-map").is_visible()
    page.go_back()
    page.locator("#tab-map").wait_for(state="hidden")
    assert page.locator(".sentence-lead").inner_text() == QUESTION


def test_who_plays_by_keyboard_does_not_lose_the_place(visits):
    page = visits(viewport={"width": 390, "height": 844}).open("", playback=False)
    focused = "() => document.activeElement.id || document.activeElement.dataset.part"
    places = []
    for part in ("[data-part=mark]", "[data-part=again]", "#closer"):
        page.locator(f"{part}:visible").press("Enter")
        places.append(page.evaluate(focused))
        page.evaluate("() => { clock.pause(); clock.wind(clock.film.length); }")
    page.locator("[data-key=preset]").press("Escape")
    assert [*places, page.evaluate(focused)] == ["stage-box", "mark", "stage-box", "stage-box"]


def test_no_name_is_cut_and_no_number_stands_at_the_door(visits):
    page = visits(viewport={"width": 390, "height": 844}).open("")
    assert not page.locator("#stage [data-part=room]").text_content()
    page.evaluate("() => { clock.replay(); clock.pause(); clock.wind(clock.film.length / 2); }")
    left = "(one) => one.getBoundingClientRect().left"
    names = page.locator(".ball-name").all()
    assert len(names) == 2
    assert min(name.evaluate(left) for name in names) >= page.locator("#stage").evaluate(left)
