"""The play view: what it draws is what was computed, by mouse, touch and keyboard."""

import re

import numpy as np
import pytest

import stackbounce as sb
from stackbounce.model import STANDARD_GRAVITY, catalogue
from stackbounce.prediction import read_scenario

pytestmark = pytest.mark.slow

POSITIONS = "[...document.querySelectorAll('[data-ball]')].map((ball) => +ball.dataset.position)"


def at(visit, time):
    """Put the cursor at a time; return where the page draws the balls, in m."""
    visit.page.evaluate("(time) => { clock.pause(); clock.seek(time); }", time)
    for _ in range(2):
        visit.page.evaluate("() => new Promise(requestAnimationFrame)")
    return visit.page.evaluate(f"() => {POSITIONS}")


def test_balls_are_where_the_computed_array_has_them(visit):
    visit.open()
    frames, speeds = visit.state("result.frames"), np.array(visit.state("result.rebound_speeds"))
    result = sb.simulate(visit.drop())
    last = max(one["end"] for one in visit.state("result.intervals"))
    for time in (-0.004, 0.0, 0.00713, 0.0135, 0.0301, 0.045):
        drawn = at(visit, time)
        computed = [np.interp(min(time, last), frames["time"], path) for path in frames["position"]]
        if time < 0.0:  # a fall from rest, to the impact speed at the touch
            expected = [-3.53 * time - 0.5 * STANDARD_GRAVITY * time**2] * 2
        else:  # gravity acts on the balls from their last separation
            flown = max(0.0, time - last)
            expected = computed + speeds * flown - 0.5 * STANDARD_GRAVITY * flown**2
        assert drawn == pytest.approx(expected, abs=1e-12)
        if 0.0 <= time <= last:
            exact = result.sample([time]).position.values[:, 0]
            assert drawn == pytest.approx(exact, abs=2e-6)


def test_surfaces_meet_where_they_press(visit):
    """Drawn outlines share their end at each closed contact, and one lies on the floor."""
    visit.open()
    at(visit, 0.015)
    ends = visit.page.evaluate(
        """() => [...document.querySelectorAll('.ball-body')].map((body) => {
             const box = body.getBoundingClientRect();
             return [box.top, box.bottom]; })"""
    )
    floor = visit.page.locator(".ground-line").bounding_box()["y"]
    assert ends[0][1] == pytest.approx(floor, abs=1.0)
    assert ends[1][1] == pytest.approx(ends[0][0], abs=1.0)
    assert ends[0][1] - ends[0][0] > 40.0


def test_playing_follows_the_clock_with_no_request(visit, page):
    page.wait_for_load_state("networkidle")
    before = len(visit.requests)
    seen = page.evaluate(
        f"""() => new Promise((done) => {{
             clock.pause(); clock.seek(clock.begin); clock.play();
             const frames = [];
             const look = (now) => {{
               frames.push([now, clock.reel, clock.time, ...{POSITIONS}]);
               if (frames.length < 90) requestAnimationFrame(look); else done(frames);
             }};
             requestAnimationFrame(look); }})"""
    )
    now, reel, time, *positions = np.array(seen[1:]).T
    expected = "(times) => times.map((time) => clock.film.at(time).position)"
    assert np.transpose(positions).tolist() == page.evaluate(expected, time.tolist())
    assert (np.diff([reel, time]) > 0).all()
    passed = np.minimum(np.diff(now), 100.0).sum()  # a long stop is left out
    assert reel[-1] - reel[0] == pytest.approx(1e-3 * passed * visit.state("speed"), rel=0.2)
    assert len(visit.requests) == before


WATCH_THE_LAYOUT = """() => {
  window.shifts = [];
  new PerformanceObserver((list) => {
    const moved = ({ node }) => node?.outerHTML?.slice(0, 80);
    for (const one of list.getEntries()) window.shifts.push([one.value, one.sources.map(moved)]);
  }).observe({ type: "layout-shift" });
}"""


@pytest.mark.release
@pytest.mark.parametrize("width", [1440, 390])
def test_nothing_moves_while_the_page_opens_and_a_film_plays(visits, width, in_firefox):
    if in_firefox:
        pytest.skip("Firefox does not measure layout shifts")
    size = {"width": width, "height": 844}
    opening, playing = visits(viewport=size), visits(viewport=size)
    opening.page.add_init_script(f"({WATCH_THE_LAYOUT})()")
    assert opening.open(playback=False).locator("#sentence").is_visible()
    assert opening.page.evaluate("() => window.shifts") == []
    page = playing.open("#momentum=1&centre=1&speed=4")
    page.evaluate("() => new Promise((drawn) => setTimeout(drawn, 99))")
    page.evaluate(WATCH_THE_LAYOUT)  # once what the visit opened has been drawn
    page.evaluate("() => { clock.seek(clock.begin); clock.play(); }")
    page.wait_for_function("() => !clock.playing")
    assert page.evaluate("() => window.shifts") == []


def test_buttons_step_from_event_to_event(page):
    said = page.locator("#stage .scene-time")
    page.evaluate("() => { clock.pause(); clock.seek(-0.1); }")
    seen = []
    for _ in range(7):
        page.get_by_role("button", name="Next event").click()
        page.evaluate("() => new Promise(requestAnimationFrame)")
        seen.append(said.text_content().partition(": ")[2])
    assert seen[0] == "floor – basketball touch"
    assert "top of tennis" in seen
    assert seen[-1] == "the end of the film"
    page.get_by_role("button", name="Previous event").click()
    page.wait_for_function("() => clock.time < clock.end")
    page.get_by_role("button", name="Replay").click()
    page.wait_for_function("() => clock.playing")
    assert page.evaluate("() => clock.time") < 0.0


CHANGE_THE_GAP = """(gap) => { store.set({ drop: { ...store.get().drop, gaps: [gap] } }); }"""


def test_a_changed_drop_is_shown_at_the_same_moment(visit, page):

    def changed_at(time, gap):
        page.evaluate("(time) => { clock.pause(); clock.seek(time); }", time)
        page.evaluate(CHANGE_THE_GAP, gap)
        page.wait_for_function("(gap) => state.result.drop.gaps[0] === gap", arg=gap)
        visit.ready()
        return page.evaluate("() => [clock.time, clock.end, clock.begin, clock.playing]")

    now, end, *_ = changed_at(99.0, 0.01)
    assert now == end
    page.wait_for_function("() => clock.playing")  # what had ended is played again
    now, _, begin, _ = changed_at(page.evaluate("() => 0.5 * clock.begin"), 0.02)
    assert now == pytest.approx(0.5 * begin)
    assert changed_at(0.012, 0.015)[0] == pytest.approx(0.012)
    page.evaluate("() => clock.play()")
    page.evaluate(CHANGE_THE_GAP, 0.005)
    visit.ready()
    assert page.evaluate("() => clock.playing")


def test_a_kept_drop_is_shown_beside_the_present_one(visit, page):
    page.get_by_role("button", name="Keep this one to compare").click()
    page.evaluate(CHANGE_THE_GAP, 0.02)
    visit.ready()
    at(visit, 0.3)
    assert page.locator("#stage .kept path").count() == 2
    assert page.locator("#numbers table").count() == 2
    assert "1.803" in page.locator("#numbers table").nth(1).inner_text()
    page.get_by_role("button", name="Let go what was kept").click()
    assert page.locator("#stage .kept path").count() == 0
    assert page.locator("#numbers table").count() == 1


def test_momentum_arrows_and_centre_of_mass_can_be_shown(visit, page):
    page.get_by_label("Momentum", exact=True).check()
    page.get_by_label("Centre of mass").check()
    page.get_by_label("Velocities").uncheck()
    at(visit, 0.0)
    values = page.locator("#momentum text[text-anchor=end]").all_text_contents()
    assert values == ["−0.201", "−0.529", "−0.731"]  # 57 g, 150 g and both at 3.53 m/s: 0.5295
    assert page.locator("#stage .mass-centre").is_visible()
    assert not page.locator("#stage .ball-arrow").first.is_visible()
    page.wait_for_function(
        "() => ['momentum=1', 'centre=1', 'arrows=0'].every((one) => location.hash.includes(one))"
    )


SAID = """(change) => {
    store.set({ drop: change(store.get().drop) });
    const { result, resultOf, drop } = store.get();
    const isNew = resultOf.drop === drop;
    const said = document.querySelector('#numbers').innerText;
    const frames = result.frames.time.length;
    return { isNew, ratio: result.rebound_ratios[1], frames, said }; }"""


def test_a_change_is_answered_before_the_next_picture(visit, page):
    """The page answers within the same task; the worker adds frames with the same numbers."""
    page.evaluate("() => whole.then(() => null)")
    at_once = page.evaluate(f"() => ({SAID})((drop) => ({{ ...drop, impact_speed: 3 }}))")
    assert at_once["isNew"]
    assert at_once["ratio"] == pytest.approx(sb.simulate(visit.drop()).rebound_ratios[1], abs=1e-12)
    assert f"{at_once['ratio']:.3f}" in at_once["said"]
    visit.ready()
    assert len(visit.state("result.frames.time")) > 2 * at_once["frames"]
    assert visit.state("result.rebound_ratios")[1] == at_once["ratio"]


def test_a_drop_of_many_collisions_is_left_to_the_worker(visit, page):
    page.evaluate("() => whole.then(() => null)")
    many = """(drop) => ({
        balls: [{ mass: 1e6 }, { mass: 0.001 }], gaps: [1e-3], impact_speed: 3, gravity: 0,
        contacts: drop.contacts.map(() => ({ law: "Spring", stiffness: 1e5 })) })"""
    assert not page.evaluate(f"() => ({SAID})({many})")["isNew"]
    visit.ready()
    assert visit.state("result.status") == "FINISHED"
    assert len(visit.state("result.intervals")) > 100  # each with a touch, a peak and a release


def test_a_number_that_cannot_be_is_told_at_its_field_and_the_one_before_stays(visit, page):
    for path, text, kept, other, ends in (
        ("balls.1.mass", "-3 g", "57", "60", "0.001 g to 1000 kg"),
        ("impact_speed", "1e6", "3.53", "4", "0.01 m/s to 100 m/s"),
        ("gaps.0", "many", "0", "1", "0 to 10 m"),
    ):
        field = visit.type(path, text)
        error = page.locator(f"#field-{path.replace('.', '-')}-error")
        said = f"“{text}” cannot be used, the number before stays: it is from {ends}."
        assert (error.inner_text(), field.input_value()) == (said, kept)
        assert field.get_attribute("aria-invalid") == "true"
        visit.type(path, other)
        error.wait_for(state="hidden")
    visit.ready()
    assert visit.state("result.drop.balls[1].mass") == 0.06


def test_a_part_that_cannot_be_drawn_leaves_the_others_alive(visit, page):
    page.evaluate(
        """() => { const { createElementNS } = document;
             window.restore = () => (document.createElementNS = createElementNS);
             document.createElementNS = () => { throw new Error("no pen"); }; }"""
    )
    visit.type("balls.1.mass", "60")
    page.get_by_text("This drop cannot be drawn: no pen").wait_for()
    page.evaluate("() => window.restore()")
    visit.type("balls.1.mass", "70")
    page.get_by_text("This drop cannot be drawn").wait_for(state="hidden")
    assert visit.state("result.drop.balls[1].mass") == 0.07
    visit.complaints.clear()  # the browser logs what failed, which is the point here


def test_the_cursor_by_keyboard(visit, page):
    at(visit, 0.01)
    cursor = page.get_by_role("slider", name="Time")
    cursor.focus()
    page.keyboard.press("ArrowRight")
    assert page.evaluate("() => clock.time") > 0.01
    page.keyboard.press("Home")
    assert page.evaluate("() => clock.time") < 0.0
    page.keyboard.press("End")
    assert page.evaluate("() => clock.time === clock.end && clock.reel === clock.film.length")
    page.keyboard.press(" ")
    page.wait_for_function("() => clock.playing")
    page.keyboard.press(" ")
    page.wait_for_function("() => !clock.playing")


def test_dragging_on_a_plot_moves_everything(visit, page):
    at(visit, 0.0)
    box = page.locator(".plot .u-over").nth(1).bounding_box()
    page.mouse.move(box["x"] + 0.3 * box["width"], box["y"] + 20)
    page.mouse.down()
    page.mouse.move(box["x"] + 0.5 * box["width"], box["y"] + 20, steps=5)
    page.mouse.up()
    time, times = page.evaluate("() => clock.time"), visit.state("result.frames.time")
    assert time == pytest.approx(0.5 * (times[0] + times[-1]), rel=0.02)
    lines = page.locator(".cursor-line")
    assert len(set(lines.evaluate_all("(all) => all.map((l) => l.style.transform)"))) == 1
    page.evaluate("() => new Promise(requestAnimationFrame)")
    expected = np.interp(time, times, visit.state("result.frames.position")[1])
    assert page.evaluate(f"() => {POSITIONS}")[1] == pytest.approx(expected, abs=1e-9)


def test_the_address_restores_the_state(visits):
    first = visits()
    page = first.open()
    first.type("gaps.0", "2 mm")
    page.wait_for_function("() => state.result.drop.gaps[0] === 0.002")
    page.get_by_label(re.compile("Textbook")).uncheck()
    page.evaluate("() => { clock.pause(); clock.seek(0.012); }")
    page.keyboard.press("Shift")
    page.wait_for_function("() => location.hash.includes('t=0.012')")
    link = page.evaluate("() => location.hash")
    second = visits()
    second.open(link)
    second.page.wait_for_function("() => Math.abs(clock.time - 0.012) < 1e-6")
    for part in ("drop", "ghosts", "until", "speed", "magnify", "view", "result.rebound_ratios"):
        assert second.state(part) == first.state(part)


BROKEN = [
    "#view=nothing&t=x&speed=-1",
    "#balls.0.mass=1",
    "#__proto__.x=1&constructor.prototype.y=2",
    "#%E0%A4%A&=&&&view",
    "#" + "&".join(f"balls.{i}.mass=1" for i in range(40)),
]


@pytest.mark.release
@pytest.mark.parametrize("fragment", BROKEN)
def test_a_broken_link_shows_a_page_all_the_same(visit, fragment):
    page = visit.open(fragment)
    assert page.locator("[data-ball]").count() == 2
    assert page.evaluate("() => ({}).x === undefined && ({}).y === undefined")


@pytest.mark.parametrize(
    ("part", "said"),
    [
        ("wind=3", "This page does not understand “wind” in the link, and left it out."),
        ("slow=300", ""),  # of an older page
    ],
)
def test_what_a_newer_link_has_is_named_and_the_rest_is_kept(visit, part, said):
    drop = "balls.0.mass=0.1&contacts.0.law=Spring&contacts.0.stiffness=9&height=1"
    page = visit.open(f"#{part}&speed=2&{drop}")
    assert (visit.state("drop.contacts[0].stiffness"), visit.state("speed")) == (9, 2)
    assert page.locator("#preset-says").inner_text() == said


ONE = "balls.0.mass=0.1&contacts.0.law=Spring"


@pytest.mark.parametrize(
    ("drop", "said"),
    [
        (f"{ONE}&contacts.0.stiffness=9e3&impact_speed=1e6", "holds no whole drop"),
        (f"{ONE}&contacts.0.stiffness=9e3&impact_speed=1&height=1", "holds no whole drop"),
        (f"{ONE}&contacts.0.stiffness=-9&height=1", "stiffness must be a positive number"),
        (f"{ONE}s&contacts.0.stiffness=9e3&height=1", "law must be a contact law"),
    ],
)
def test_a_link_to_no_drop_says_so_and_shows_the_first_one(visit, drop, said):
    page = visit.open(f"#{drop}")
    assert page.locator("[data-ball]").count() == 2
    assert said in page.locator("#preset-says").inner_text()
    assert not page.get_by_text("Computing the first drop").is_visible()


@pytest.mark.release
def test_a_tower_grows_to_six_and_no_further(visit, page):
    add = page.get_by_role("button", name=re.compile("Add a ball"))
    for count in range(3, 7):
        add.click()
        page.wait_for_function("(n) => state.result.drop.balls.length === n", arg=count)
    visit.ready()
    assert add.is_disabled() or add.count() == 0
    assert page.locator("[data-ball]").count() == 6


def test_exports_are_saved_with_the_errors_of_the_numbers(visit, page, tmp_path):
    visit.type("balls.1.mass", "57 ± 0.5 g")
    page.wait_for_function("() => state.errors['balls.1.mass']")
    page.get_by_text("Share", exact=True).click()

    def saved(name):
        return visit.saved(page.get_by_role("button", name=name).click)

    assert saved("Table (CSV)").startswith(b"time (s),position 0 (m)")
    assert saved("Picture (PNG)").startswith(b"\x89PNG")
    assert saved("Picture (SVG)").startswith(b"<svg xmlns=")
    scenario = tmp_path / "drop.toml"
    scenario.write_bytes(saved("Scenario (TOML)"))
    errors = {"balls.1.mass": "0.057 ± 0.0005 kg"}
    assert read_scenario(scenario) == (visit.drop(), errors)
    lines = saved("Python lines").decode()
    assert lines.startswith("# Made by stackbounce")
    assert '    "balls.1.mass": (0.057, 0.0005),\n' in lines
    assert "sb.predict(drop, errors)" in lines


@pytest.mark.release
def test_numbers_are_printed_without_the_set_up(visit, in_firefox):
    if in_firefox:
        pytest.skip("Playwright sets no media features by WebDriver BiDi")
    page = visit.open()
    page.emulate_media(media="print")
    assert page.locator("#numbers").is_visible()
    assert not page.locator("#controls").is_visible()


def test_reduced_motion_does_not_begin_by_itself(visits, in_firefox):
    if in_firefox:
        pytest.skip("Playwright sets no media features by WebDriver BiDi")
    visit = visits(reduced_motion="reduce")
    page = visit.open()
    assert page.evaluate("() => clock.playing") is False
    page.get_by_role("button", name="Play", exact=True).click()
    page.wait_for_function("() => clock.time >= 0")
    stops = [0.0, *(one["end"] for one in visit.state("result.intervals"))]
    stops += page.evaluate("() => [clock.end, ...clock.film.tops.map(({ time }) => time)]")
    assert page.evaluate("() => clock.time") in stops


def test_a_screen_reader_is_told(visit, page):
    at(visit, 0.0135)
    label = page.locator("#stage svg.scene").get_attribute("aria-label")
    assert re.search(r"basketball at −?\d", label)
    for plot in page.locator(".plot-canvas").all():
        assert len(plot.get_attribute("aria-label")) > 40
    visit.type("gaps.0", "1 mm")
    page.wait_for_function("() => document.querySelector('#live').textContent.includes('tennis')")


@pytest.mark.forms("served")
def test_a_server_that_is_gone_is_not_missed(visit, page):
    page.evaluate("() => whole.then(() => null)")
    page.wait_for_load_state("networkidle")
    page.route("http://**/*", lambda route: route.abort())
    before = len(visit.requests)
    visit.type("gaps.0", "3 mm")
    page.wait_for_function("() => state.result.drop.gaps[0] === 0.003")
    page.locator("[data-key=law-0]").select_option("Hysteretic")
    page.wait_for_function("() => state.result.drop.contacts[0].law === 'Hysteretic'")
    page.locator("#tab-map").click()
    page.wait_for_function(
        "() => /largest/.test(document.querySelector('#map-summary')?.textContent)"
    )
    assert len(visit.requests) == before
    assert visit.state("error") is None


@pytest.mark.forms("served")
def test_an_engine_that_cannot_be_loaded_is_told_and_tried_again(visit):
    page = visit.page
    page.route("**/engine.wasm", lambda route: route.abort())
    page.goto(visit.address)
    page.locator("#banner").wait_for(state="visible")
    page.unroute("**/engine.wasm")
    page.get_by_role("button", name="Try again").click()
    visit.ready()
    page.locator("#banner").wait_for(state="hidden")
    assert visit.state("result.status") == "FINISHED"
    visit.complaints.clear()  # Chromium logs the request that failed, which is the point here


def test_a_drop_that_takes_too_long_is_stopped_and_told(visit):
    """The question never reaches the worker, and the clock of the page runs fast."""
    page = visit.page
    page.add_init_script(
        """const { postMessage } = Worker.prototype;
           Worker.prototype.postMessage = function (message, ...rest) {
             if (window.endless && message.name !== "open") window.asked = true;
             else postMessage.call(this, message, ...rest); };"""
    )
    page.clock.install()
    visit.open()
    page.evaluate(
        """() => { window.endless = true;
             store.set({ drop: { ...store.get().drop, impact_speed: 3 } }); }"""
    )
    page.wait_for_function("() => window.asked")
    told = page.locator("#controls [role=alert]").filter(has_text="longer than 10 s")
    assert visit.state("busy")
    assert not told.is_visible()
    page.clock.fast_forward(11_000)
    told.wait_for(state="visible")
    assert not visit.state("busy")
    page.evaluate("() => { window.endless = false; }")
    page.locator("#controls select").first.select_option("cannon")
    page.wait_for_function("() => state.result.drop.balls.length > 2")
    told.wait_for(state="hidden")


def test_a_script_in_a_link_is_only_text(visit):
    evil = "%3Cimg%20src%3Dx%20onerror%3Dalert(1)%3E"
    page = visit.open(
        f"#balls.0.mass=0.15&balls.0.name={evil}&contacts.0.law=Spring&contacts.0.stiffness=2500"
        "&impact_speed=3"
    )
    assert page.locator("img").count() == 0
    assert "<img" in page.locator("#numbers").inner_text()


@pytest.mark.parametrize(
    ("button", "names"),
    [("down-1", "tennis,basketball"), ("up-0", "tennis,basketball"), ("remove-0", "tennis")],
)
def test_contacts_belong_to_the_balls_that_make_them(visit, page, button, names):
    page.locator(f"#controls [data-key='{button}']").click()
    page.wait_for_function(
        "(names) => String(state.drop.balls.map((one) => one.name)) === names", arg=names
    )
    visit.ready()
    stack = catalogue.stacked(names.split(","))
    drop = sb.Drop(stack.balls, stack.contacts, stack.gaps, impact_speed=3.53)
    expected = sb.simulate(drop).rebound_ratios.tolist()
    assert visit.state("result.rebound_ratios") == pytest.approx(expected, rel=1e-12)


def test_a_number_set_by_hand_stays_where_balls_change_places_and_says_so(visit, page):
    visit.type("contacts.0.stiffness", "3.1")
    visit.ready()
    page.locator("#controls [data-key='down-1']").click()
    page.wait_for_function("() => state.drop.balls[0].name === 'tennis'")
    visit.ready()
    found = [one["stiffness"] for one in visit.state("drop.contacts")]
    assert found == [3100.0, 1000.0]  # the second is of the same two balls
    notes = page.locator("#controls .contact-card > .note").all_inner_texts()
    assert notes == ["Kept: this was set by hand."]


def test_a_ball_of_another_mass_is_not_called_the_one_of_the_catalogue(visit, page):
    choice = page.locator("#controls [data-key='ball-0']")
    note = page.locator("#controls .ball-card > .note").last
    assert (choice.input_value(), note.is_hidden()) == ("basketball", True)
    visit.type("balls.0.mass", "600")
    visit.ready()
    assert choice.locator("option:checked").inner_text() == "basketball, changed"
    said = "The basketball of the catalogue has 150 g. Stiffnesses do not follow the mass."
    assert note.inner_text() == said
    visit.type("balls.0.mass", "150")
    assert (choice.input_value(), note.is_hidden()) == ("basketball", True)
