"""Hands on the stage: balls are dragged to change the height, the gap, the order and the size."""

import pytest

from stackbounce.model.catalogue import stacked

pytestmark = [pytest.mark.slow, pytest.mark.release]
FORMS = ("served",)


def body(page, ball):
    """Return the middle of a ball on the stage and its radius, in px."""
    box = page.locator(f"#stage [data-ball='{ball}'] .ball-body").bounding_box()
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2, box["width"] / 2


def drag(page, start, end):
    page.mouse.move(*start)
    page.mouse.down()
    page.mouse.move(start[0] + (end[0] - start[0]) / 4, start[1] + (end[1] - start[1]) / 4)
    page.wait_for_timeout(150)  # the drop is shown from its beginning, and measured there
    page.mouse.move(*end, steps=4)
    page.mouse.up()


def opened(visit):
    page = visit.open(
        "#t=-0.001&height=0.5"
        "&balls.0.mass=0.15&balls.0.diameter=0.16&balls.0.name=basketball"
        "&balls.1.mass=0.057&balls.1.diameter=0.066&balls.1.name=tennis"
        "&contacts.0.law=Spring&contacts.0.stiffness=2500"
        "&contacts.1.law=Spring&contacts.1.stiffness=1000"
    )
    page.locator("#stage [data-ball='1'] .ball-body").wait_for()
    return page


@pytest.fixture
def page(visit):
    return opened(visit)


def test_the_lowest_ball_is_lifted_with_the_stack(visit, page):
    x, y, _ = body(page, 0)
    drag(page, (x, y), (x, y - 60))
    assert visit.state("drop.height") > 0.51
    assert visit.state("drop.gaps") == [0]
    visit.ready()
    page.get_by_role("button", name="Undo", exact=True).click()
    assert visit.state("drop.height") == 0.5  # the whole movement is one step


def test_an_upper_ball_is_lifted_off_and_put_below(visit, page):
    x, y, _ = body(page, 1)
    drag(page, (x, y), (x, y - 30))
    gap = visit.state("drop.gaps[0]")
    assert 0.001 < gap < 0.2
    visit.ready()
    page.get_by_role("button", name="Undo", exact=True).click()
    visit.ready()
    page.evaluate("() => { clock.pause(); }")
    page.wait_for_timeout(200)
    x, y, _ = body(page, 1)
    drag(page, (x, y), (x, y + 260))
    page.wait_for_function("() => state.drop.balls[0].name === 'tennis'")
    assert visit.drop().contacts == stacked(["tennis", "basketball"]).contacts


def test_the_edge_of_a_ball_changes_its_size_alone(visit, page):
    x, y, radius = body(page, 0)
    drag(page, (x + 0.93 * radius, y), (x + 1.3 * radius, y))
    balls = visit.state("drop.balls")
    assert balls[0]["diameter"] > 0.18
    assert balls[0]["mass"] == 0.15
    assert visit.state("drop.height") == 0.5


def touch(page, start, up, rest=0):
    """Put a finger down, leave it for `rest` ms, move it up by so many px, and lift it."""
    fingers, (x, y) = page.context.new_cdp_session(page), start

    def send(kind, *points):
        fingers.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})

    send("touchStart", {"x": x, "y": y})
    page.wait_for_timeout(rest)
    for step in range(1, 11):
        send("touchMove", {"x": x, "y": y - up * step / 10})
        page.wait_for_timeout(16)
    send("touchEnd")
    page.wait_for_timeout(300)


@pytest.fixture
def phone(visits, in_firefox):
    if in_firefox:
        pytest.skip("Playwright sends no touches by WebDriver BiDi")
    return visits(viewport={"width": 390, "height": 844}, has_touch=True, is_mobile=True)


def test_a_finger_that_swipes_over_a_ball_scrolls_and_one_that_rests_on_it_drags(phone):
    page = opened(phone)
    x, y, _ = body(page, 1)
    touch(page, (x, y), 80)
    page.wait_for_function("() => scrollY > 20")
    assert phone.state("drop.gaps") == [0]
    page.evaluate("() => scrollTo(0, 0)")
    x, y, _ = body(page, 1)
    touch(page, (x, y), 30, rest=400)
    assert phone.state("drop.gaps")[0] > 0.0
    assert page.evaluate("() => scrollY") == 0


def test_a_guess_is_dragged_by_a_finger(phone):
    page = opened(phone)
    page.evaluate("() => store.set({ predict: true })")
    mark = page.get_by_role("slider", name="Your guess")
    mark.wait_for()
    before = float(mark.get_attribute("aria-valuenow"))
    grip = page.locator(".guess-grip").bounding_box()
    touch(page, (grip["x"] + 9, grip["y"] + 9), 100)
    assert float(mark.get_attribute("aria-valuenow")) > before + 0.3
    assert page.evaluate("() => scrollY") == 0
