"""Where things stand on the page, at common sizes of the screen and in high contrast."""

import pytest
from page_build.examples import list_examples

from stackbounce.cross2007.cases import explorer_address

pytestmark = pytest.mark.slow
FORMS = ("served",)
PHONE = {"viewport": {"width": 360, "height": 740}, "has_touch": True, "is_mobile": True}
[CANNON] = [explorer_address("", one.drop, {}) for one in list_examples() if one.name == "cannon"]


@pytest.mark.parametrize(("width", "lesson"), [(1024, ""), (1366, "&lesson=gap")])
def test_the_stage_follows_the_sentence(visits, width, lesson):
    page = visits(viewport={"width": width, "height": 768}).open(CANNON + lesson)
    said, stage = (page.locator(one).bounding_box() for one in ("#sentence", "#stage-box"))
    assert stage["y"] - (said["y"] + said["height"]) < 20
    assert said["height"] < 200


def test_high_contrast_shows_what_can_be_pressed_and_what_is_chosen(visits, in_firefox):
    if in_firefox:
        pytest.skip("Playwright sets no media features by WebDriver BiDi")
    page = visits(forced_colors="active").open()
    color = "(one, part) => getComputedStyle(one, part).backgroundColor"
    play, tab, other, chosen, free = (
        page.locator(one).first
        for one in ("#transport .play", "#tab-play", "#tab-map", ".segments :checked + span", "h1")
    )
    assert play.evaluate(color, "::before") != play.evaluate(color)
    assert tab.evaluate(color) != other.evaluate(color)
    assert chosen.evaluate(color) != free.evaluate(color)


def test_on_a_phone_the_stage_stays_in_sight_and_targets_are_large(visits, in_firefox):
    if in_firefox:
        pytest.skip("Playwright sends no touches by WebDriver BiDi")
    page = visits(**PHONE).open()
    page.locator("[data-key=add]").tap()
    page.wait_for_function("() => state.result.drop.balls.length === 3")
    stage = page.locator("#stage").bounding_box()
    assert 0 <= stage["y"] < stage["y"] + stage["height"] < 400
    for name in (".full-screen", ".explain", "#zoom button"):
        box = page.locator(name).first.bounding_box()
        assert min(box["width"], box["height"]) >= 40, name
    head = page.locator("h1")
    assert head.evaluate("(one) => one.scrollWidth <= one.clientWidth")
    assert "dropped together" in head.inner_text()


def test_a_film_that_had_ended_is_played_again_after_a_change(visit, page):
    page.evaluate("() => { clock.pause(); clock.seek(99); }")
    visit.type("gaps.0", "1 mm")
    page.wait_for_function("() => clock.playing")


@pytest.mark.parametrize("speed", [3.53, 1e3, 1e6])
def test_marks_end_trails_and_the_ruler_has_few_ticks(visit, speed):
    page = visit.open(
        "#balls.0.mass=0.1&balls.1.mass=0.05&contacts.0.law=Rigid&contacts.0.restitution=1"
        f"&contacts.1.law=Rigid&contacts.1.restitution=1&impact_speed={speed}"
    )
    page.evaluate("() => { clock.pause(); clock.seek(clock.end); }")
    page.evaluate(
        "() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))"
    )
    assert 1 <= page.locator("#stage .tick").count() <= 20
    ends = page.locator("#stage .trail").last.evaluate("(one) => +one.getAttribute('y2')")
    mark = page.locator("#stage .top-mark").last.evaluate(
        "(one) => one.transform.baseVal.consolidate().matrix.f"
    )
    assert ends == pytest.approx(mark, abs=0.2)


@pytest.mark.parametrize("count", [2, 4, 6])
def test_no_words_on_the_stage_lie_on_each_other(visit, count):
    balls = "&".join(
        f"balls.{i}.mass={2 / 3**i}&contacts.{i}.law=Spring&contacts.{i}.stiffness=50000"
        for i in range(count)
    )
    page = visit.open(f"#{balls}&impact_speed=4")
    for moment in (
        "-0.05",
        "0.01",
        "clock.film.last + 0.05",
        "clock.film.tops.at(-1).time + 1e-3",
        "clock.end",
    ):
        page.evaluate(f"() => {{ clock.pause(); clock.seek({moment}); }}")
        page.wait_for_timeout(200)
        assert page.evaluate(OVERLAPS) == [], moment


OVERLAPS = """() => {
  const isSeen = (one) => one.textContent
    && one.checkVisibility({ visibilityProperty: true, opacityProperty: true })
    && one.closest(".ruler")?.getAttribute("opacity") !== "0.00";
  const all = [...document.querySelectorAll("#stage svg.scene text")].filter(isSeen);
  const said = all.map((one) => one.textContent);
  const boxes = all.map((one) => one.getBoundingClientRect());
  const lie = (a, b) => Math.min(a.right, b.right) - Math.max(a.left, b.left) > 1
    && Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top) > 3;
  return boxes.flatMap((a, i) =>
    boxes.flatMap((b, k) => (k > i && lie(a, b) ? [`${said[i]} | ${said[k]}`] : [])));
}"""


def test_a_drag_and_a_wheel_on_the_stage_wind_the_film(page):
    page.evaluate("() => { clock.pause(); clock.seek(0.01); }")
    box = page.locator("#stage").bounding_box()
    x, y = box["x"] + 40, box["y"] + 0.7 * box["height"]
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + 60, y, steps=3)
    page.mouse.up()
    wound = page.evaluate("() => clock.time")
    assert wound > 0.01
    page.mouse.wheel(0, -300)
    page.wait_for_function("(before) => clock.time < before", arg=wound)
