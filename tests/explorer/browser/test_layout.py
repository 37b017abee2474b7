"""Where things stand on the page, at common sizes of the screen and in high contrast."""

import pytest
from page_build.examples import list_examples

from stackbounce.cross2007.cases import explorer_address

pytestmark = [pytest.mark.slow, pytest.mark.release]
FORMS = ("served",)
PHONE = {"viewport": {"width": 360, "height": 740}, "has_touch": True, "is_mobile": True}
[CANNON] = [explorer_address(one.drop, {}) for one in list_examples() if one.name == "cannon"]


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
    assert page.evaluate("() => document.documentElement.scrollWidth") <= 360
    for name in (".play", ".full-screen", ".explain"):
        assert page.locator(name).first.bounding_box()["height"] >= 40, name
    assert page.locator("h1").evaluate("(one) => one.scrollWidth <= one.clientWidth")
    assert "dropped together" in page.locator("h1").inner_text()


RIGID = "contacts.{0}.law=Rigid&contacts.{0}.restitution=1"
SPRING = "contacts.{0}.law=Spring&contacts.{0}.stiffness=50000"
MOMENTS = ("begin * 0.2", "film.last / 3", "film.last + 0.05", "film.tops.at(-1).time", "end")
OVERLAPS = """() => {
  const seen = (one) => one.checkVisibility({ visibilityProperty: true, opacityProperty: true });
  const texts = [...document.querySelectorAll("#stage svg.scene text")].filter(seen);
  const boxes = texts.map((one) => one.getBoundingClientRect()).filter((box) => box.width);
  const lie = (a, b) => Math.min(a.right, b.right) - Math.max(a.left, b.left) > 1
    && Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top) > Math.max(3, a.height - 16);
  return boxes.flatMap((a, i) => boxes.slice(i + 1).filter((b) => lie(a, b)));
}"""  # in Firefox the box of a text is a third higher than its letters


def tower(count, law, speed):
    balls = "&".join(f"balls.{i}.mass={2 / 3**i}&{law.format(i)}" for i in range(count))
    return f"#{balls}&impact_speed={speed}"


def show(page, moment):
    page.evaluate(f"() => {{ clock.pause(); clock.seek(clock.{moment}); }}")
    page.wait_for_timeout(200)


@pytest.mark.parametrize("speed", [3.53, 1e3, 1e6])
def test_marks_end_trails_and_the_ruler_has_few_ticks(visit, speed):
    page = visit.open(tower(2, RIGID, speed))
    show(page, "end")
    assert 1 <= page.locator("#stage .tick").count() <= 20
    end = page.locator("#stage .trail").last.get_attribute("d").split()[-1]
    mark = page.locator("#stage .top-mark").last.get_attribute("transform")
    assert float(end) == pytest.approx(float(mark[12:-1]), abs=0.2)


@pytest.mark.parametrize("count", [2, 4, 6])
def test_no_words_on_the_stage_lie_on_each_other(visit, count):
    page = visit.open(tower(count, SPRING, 4))
    for moment in MOMENTS:
        show(page, moment)
        assert page.evaluate(OVERLAPS) == [], moment


def test_a_drag_and_a_wheel_on_the_stage_wind_the_film(page):
    show(page, "begin")
    page.mouse.move(60, 500)
    page.mouse.down()
    page.mouse.move(160, 500, steps=3)
    page.mouse.up()
    page.wait_for_function("() => clock.time > clock.begin && !clock.playing")
    page.mouse.wheel(0, -3000)
    page.wait_for_function("() => clock.time === clock.begin")
    assert not page.evaluate("() => clock.playing")
