"""Bring your own: a file on the page, what was found in it, and a fit in place."""

import re
from pathlib import Path

import pytest

from stackbounce.web import LIMITS

EXAMPLES = Path(__file__).parents[3] / "src" / "stackbounce" / "web" / "static" / "examples"


def opened(visit):
    page = visit.open("#view=measure")
    page.get_by_role("button", name="Fit", exact=True).wait_for()
    return page


def found(page):
    return page.locator('#measure section[aria-label="What was found"] table').first


def test_a_force_is_recognised_laid_over_and_fitted(visit):
    page = opened(visit)
    page.locator("#measure input[type=file]").set_input_files(EXAMPLES / "floor-force.csv")
    found(page).locator("tr").nth(5).wait_for()
    page.wait_for_function("() => window.stackbounce.store.get().overlays.length > 0")
    page.get_by_label("Stiffness of floor and basketball").check()
    page.get_by_label("Stiffness of basketball and tennis").check()
    page.get_by_role("button", name="Fit", exact=True).click()
    page.locator(".fit-outcome table").first.wait_for()
    visit.ready()
    fitted = [contact["stiffness"] for contact in visit.state("drop.contacts")]
    assert fitted == pytest.approx([2700.0, 1350.0], rel=0.03)  # with which the example was made
    visit.picture("measure")
    page.get_by_role("tab", name="Play").click()
    labels = page.locator(".plot .legend").nth(1).inner_text()
    assert "force" in labels.lower()
    page.get_by_role("tab", name="Measure").click()
    page.get_by_role("button", name="Back to the drop before").click()
    assert visit.state("drop.contacts[0].stiffness") == 2500.0


def test_a_track_gives_rebound_ratios(visit):
    page = opened(visit)
    page.get_by_role("button", name="Video of two balls").click()
    found(page).wait_for()
    values = page.locator(".fit-value").evaluate_all("(all) => all.map((one) => one.value)")
    assert len(values) == 2
    assert all(re.fullmatch(r"-?[\d.]+ ± [\d.]+", value) for value in values)
    page.wait_for_function("() => window.stackbounce.store.get().overlays.length === 2")
    assert {one["what"] for one in visit.state("overlays")} == {"position"}


def test_a_file_can_be_dropped_on_the_page(visit):
    page = opened(visit)
    text = (EXAMPLES / "floor-force.csv").read_text()
    page.evaluate(
        """(text) => {
             const data = new DataTransfer();
             data.items.add(new File([text], "mine.csv", { type: "text/csv" }));
             const target = document.querySelector("#measure");
             for (const type of ["dragenter", "dragover", "drop"]) {
               target.dispatchEvent(new DragEvent(type, { bubbles: true, cancelable: true,
                                                          dataTransfer: data }));
             } }""",
        text,
    )
    page.locator(".recognised").filter(has_text="mine.csv").wait_for()


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"", "is empty"),
        (b"%PDF-1.7 and so on", "it is a PDF document"),
        (b"x" * (LIMITS.upload_bytes + 1), "larger than 16 MiB"),
    ],
)
def test_a_file_that_is_none_is_told(visit, content, message):
    page = opened(visit)
    file = {"name": "mine.csv", "mimeType": "text/csv", "buffer": content}
    page.locator("#measure input[type=file]").set_input_files(file)
    page.locator("#measure .field-error").filter(has_text=message).wait_for()
    visit.complaints.clear()  # Chromium logs the refusal, which is the point here


def test_typed_numbers_are_fitted_without_a_file(visit):
    page = opened(visit)
    page.locator(".fit-row select").select_option("rebound_ratios.1")
    page.locator(".fit-value").fill("1.64 ± 0.02")
    page.get_by_role("button", name="Fit", exact=True).click()
    page.locator(".fit-outcome table").first.wait_for()
    visit.ready()
    assert visit.state("result.rebound_ratios")[1] == pytest.approx(1.64, abs=0.005)


def test_a_fit_that_cannot_be_is_told(visit):
    page = opened(visit)
    page.locator(".fit-value").fill("about 2")
    page.get_by_role("button", name="Fit", exact=True).click()
    page.locator(".fit .field-error").filter(has_text="rebound_ratios.0").wait_for()
    visit.complaints.clear()  # Chromium logs the answer 422, which is the point here


def test_a_phone_shows_it_all(visits):
    visit = visits(viewport={"width": 360, "height": 780}, has_touch=True, is_mobile=True)
    page = opened(visit)
    force = page.get_by_role("button", name="Force on the floor")
    if not force.is_visible():
        page.get_by_text("Or try an example").click()
    force.click()
    found(page).wait_for()
    assert page.evaluate("() => document.documentElement.scrollWidth") <= 360
    visit.picture("measure-phone", full_page=True)
