"""Bring your own: a file is read, laid over the drop, and the drop fitted to it."""

from pathlib import Path

import numpy as np
import pytest

import stackbounce as sb
from stackbounce.explorer import LIMITS

pytestmark = pytest.mark.slow
FORMS = ("served",)  # the one file does not measure


def opened(visit):
    page = visit.open("#view=measure")
    page.locator(".fit-vary input").first.wait_for()
    return page


@pytest.fixture
def page(visit):
    return opened(visit)


def tried(page, title):
    page.get_by_role("button", name=title).click()
    page.locator(".recognised button").wait_for()


def fitted(page):
    page.get_by_role("button", name="Fit", exact=True).click()
    page.locator(".fit-outcome table").first.wait_for()


def apart(visit):
    """Return how far the record is from the simulated force, in N, on the mean."""
    (overlay,), frames = visit.state("overlays"), visit.state("result.frames")
    force = np.interp(overlay["time"], frames["time"], frames["force"][0])
    return np.abs(np.array(overlay["values"]) - force).mean()


def test_a_force_record_is_laid_over_the_drop_and_fitted(visit, page):
    tried(page, "Force on the floor")
    found = page.locator(".measure-in table").inner_text()
    assert "30.00 ± 0.06 ms" in found
    page.wait_for_function("() => state.overlays.length")
    before = apart(visit)
    fitted(page)
    visit.ready()
    page.wait_for_function("() => state.overlays.length")
    stiffness = [visit.state(f"drop.contacts[{i}].stiffness") for i in (0, 1)]
    assert stiffness[0] == pytest.approx(2700.0, abs=3 * 2.2)  # errors as the fit tells them
    assert stiffness[1] == pytest.approx(1350.0, abs=3 * 7.0)
    assert before > 1.0
    assert apart(visit) < 0.5  # N, what its noise is
    page.get_by_role("button", name="Back to the drop before").click()
    assert visit.state("drop.contacts[0].stiffness") == 2500


def test_a_track_shows_how_much_is_lost_also_on_a_phone(visits):
    visit = visits(viewport={"width": 360, "height": 780})
    page = opened(visit)
    tried(page, "Video of two balls")
    fitted(page)
    damping = [visit.state(f"drop.contacts[{i}].damping") for i in (0, 1)]
    assert damping == pytest.approx([8.0, 2.0], abs=0.5)
    assert page.evaluate("() => document.documentElement.scrollWidth <= innerWidth")


def test_a_typed_height_is_fitted(visit, page):
    page.locator(".fit-row select").select_option("rebound_heights.1")
    page.locator(".fit-value").fill("1.72 ± 0.03 m")
    fitted(page)
    visit.ready()
    assert visit.state("result.rebound_heights[1]") == pytest.approx(1.72, abs=1e-3)


@pytest.mark.parametrize(
    ("content", "message"),
    [(b"", "mine.csv is empty"), (b"x" * (LIMITS.upload_bytes + 1), "larger than 16 MiB")],
)
def test_a_file_that_is_none_is_told(visit, page, tmp_path, content, message):
    file = tmp_path / "mine.csv"
    file.write_bytes(content)
    page.locator(".file-drop input[type=file]").set_input_files(file)
    page.locator("#measure .field-error:visible").filter(has_text=message).wait_for()
    assert page.locator(".recognised button").count() == 0
    visit.complaints.clear()  # Chromium logs the refusal, which is the point here


def test_a_fit_that_cannot_be_is_told(visit, page):
    page.locator(".fit-value").fill("about 2")
    page.get_by_role("button", name="Fit", exact=True).click()
    refusal = page.locator(".fit .field-error").filter(has_text="rebound_ratios.0")
    refusal.wait_for()
    assert "about 2" in refusal.inner_text()
    visit.complaints.clear()  # Chromium logs the answer 422, which is the point here


def test_a_law_that_is_new_is_offered_with_its_loss(visit):
    """The page has the laws that are made for it, and ticks the number that sets a law's loss."""
    page = visit.page
    new = {"law": "Clay", "loss_fields": ["softness"]}

    def add(route):
        model = route.fetch().json()
        spring = next(law for law in model["laws"] if law["law"] == "Spring")
        field = spring["fields"][0] | {"name": "softness", "unit": "s", "least": 0.0, "most": 1.0}
        model["laws"].append(spring | new | {"loss": "softness", "fields": [field]})
        route.fulfill(json=model)

    page.route("**/model.json", add)
    opened(visit)
    assert "Clay" in page.locator('[data-key="law-0"] option').all_inner_texts()
    page.evaluate(
        """() => { const { drop } = store.get();
             const contacts = [{ law: 'Clay', softness: 0.1 }, drop.contacts[1]];
             store.set({ drop: { ...drop, contacts } }); }"""
    )
    box = page.locator('.fit-vary input[value="contacts.0.softness"]')
    box.wait_for()
    assert box.is_checked()
    assert page.locator('[data-path="contacts.0.softness"]').count() == 1


def test_the_form_has_a_field_for_every_option(page, server):
    form = page.locator("form.measure-options")
    for option in server.get("/options.json").json()["options"]:
        name = option["name"]
        assert form.locator(f'[name="{name}"], [data-key="option-{name}"]').count() == 1
        assert option["label"] in form.text_content()


DROP_A_FILE = """(text) => {
  const dataTransfer = new DataTransfer();
  dataTransfer.items.add(new File([text], "heights.csv"));
  const given = { bubbles: true, cancelable: true, dataTransfer };
  const send = (kind) => document.querySelector("#stage").dispatchEvent(new DragEvent(kind, given));
  return [send("dragover"), send("drop")];
}"""


def test_a_file_that_is_dropped_anywhere_on_the_page_is_read(visit):
    page = visit.open()
    text = "Height (m)\n1.00\n0.62\n0.39\n0.24\n"
    assert page.evaluate(DROP_A_FILE, text) == [False, False]  # the browser does not open it
    assert visit.state("view") == "measure"
    page.locator(".recognised button").wait_for()
    assert "heights.csv: table" in page.locator(".recognised").inner_text()
    assert "The file is of one ball alone" in page.locator(".fit").inner_text()


LAB = Path(__file__).parents[3] / "docs/lab"


def given(page, name):
    page.locator(".file-drop input[type=file]").set_input_files(LAB / name)
    page.locator(".recognised").filter(has_text=name).locator("button").wait_for()


def test_a_sound_becomes_the_bounce_of_the_ball_that_is_chosen(visit, page):
    given(page, "tennis.wav")
    use = page.locator(".bounce-use")
    button = use.get_by_role("button", name="Use this as the ball")
    assert button.is_disabled()  # of two balls, none is guessed
    use.get_by_label("Which ball bounced?").select_option("Tennis")
    button.click()
    use.get_by_role("button", name="See it in Play").click()
    visit.ready()
    lower, upper = visit.state("drop.contacts")
    assert lower == {"law": "Spring", "stiffness": 2500}
    assert upper["restitution"] == pytest.approx(0.74993, abs=1e-5)
    drop = visit.drop()
    found, spring = (sb.contact_time(law, 0.057, 3.5) for law in (drop.contacts[1], sb.Spring(1e3)))
    assert found == pytest.approx(spring, rel=1e-3)
    note = page.locator(".contact-card > .note").first.inner_text()
    assert note.startswith("As measured: tennis.wav.")


def test_a_contact_time_becomes_the_stiffness_of_the_ball_that_bounced(visit):
    drop = "balls.0.mass=0.057&contacts.0.law=Spring&contacts.0.stiffness=9e3"
    page = visit.open(f"#view=measure&impact_speed=3.5&{drop}")
    page.locator(".fit-vary input").first.wait_for()
    given(page, "tennis-force.csv")
    page.get_by_role("button", name="Use this as the ball").click()
    page.wait_for_function("() => state.drop.contacts[0].stiffness !== 9000")
    exact = 0.057 * (np.pi / 0.005344390241265924) ** 2
    assert visit.state("drop.contacts[0].stiffness") == pytest.approx(exact, rel=1e-4)


def test_a_press_curve_is_used(visit, page):
    given(page, "basketball-press.csv")
    page.get_by_label("Which ball bounced?").select_option("Basketball")
    page.get_by_role("button", name="Use this as the ball").click()
    page.wait_for_function("() => state.drop.contacts[0].restitution")
    contact = visit.state("drop.contacts[0]")
    assert contact["law"] == "Hysteretic"
    assert contact["stiffness"] == pytest.approx(2500.0, abs=5.0)
    assert contact["restitution"] == pytest.approx(0.770, abs=1e-3)


def test_a_record_of_one_says_over_what_it_lies(page):
    given(page, "tennis-force.csv")
    over = page.get_by_label("The record is of one contact. Which?")
    assert over.locator("option:checked").inner_text() == "floor – basketball"
    over.select_option("basketball – tennis")
    page.wait_for_function("() => state.overlays[0]?.index === 1")
    assert page.locator(".fit-row select").first.input_value() == "force.1"
    over.select_option("floor – basketball")
    page.wait_for_function("() => state.overlays[0]?.index === 0")


def test_a_record_can_be_taken_away(visit, page):
    tried(page, "Video of two balls")
    page.wait_for_function("() => state.overlays.length === 2")
    page.get_by_role("tab", name="Play").click()
    assert "of the whole drop" in page.locator(".options").inner_text()
    page.get_by_role("tab", name="Measure").click()
    page.get_by_role("button", name="Take the record away").click()
    assert visit.state("overlays") == []
    assert not page.locator('section[aria-label="What was found"]').is_visible()
    page.get_by_role("tab", name="Play").click()
    assert "of the whole drop" not in page.locator(".options").inner_text()


def test_a_german_page_takes_decimal_commas_also_in_options(visits):
    page = opened(visits(locale="de-DE"))
    page.locator('input[type="file"]').first.set_input_files(LAB / "tennis.wav")
    change = "(one) => { one.value = '1,20 m'; one.dispatchEvent(new Event('change')); }"
    page.locator('[name="height"]').evaluate(change)
    page.get_by_role("cell", name="1,2 m", exact=True).wait_for()
