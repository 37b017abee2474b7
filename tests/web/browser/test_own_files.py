"""Bring your own, in Chromium: a file is read, laid over the drop, and the drop fitted to it."""

import numpy as np
import pytest


def opened(visit):
    page = visit.open("#view=measure")
    page.locator(".fit-vary input").first.wait_for()
    return page


def tried(page, title):
    page.get_by_role("button", name=title).click()
    page.locator(".recognised b").wait_for()


def fitted(page):
    page.get_by_role("button", name="Fit", exact=True).click()
    page.locator(".fit-outcome table").first.wait_for()


def apart(visit):
    """Return how far the record is from the simulated force, in N, on the mean."""
    (overlay,) = visit.state("overlays")
    frames = visit.state("result.frames")
    force = np.interp(overlay["time"], frames["time"], frames["force"][0])
    return np.abs(np.array(overlay["values"]) - force).mean()


def test_a_force_record_is_laid_over_the_drop_and_fitted(visit):
    page = opened(visit)
    tried(page, "Force on the floor")
    found = page.locator(".measure-in table").inner_text()
    assert "30.00 ± 0.06 ms" in found
    page.wait_for_function("() => window.stackbounce.store.get().overlays.length")
    before = apart(visit)
    fitted(page)
    visit.ready()
    page.wait_for_function("() => window.stackbounce.store.get().overlays.length")
    stiffness = [visit.state(f"drop.contacts[{i}].stiffness") for i in (0, 1)]
    assert stiffness[0] == pytest.approx(2700.0, abs=3 * 2.2)  # errors as the fit tells them
    assert stiffness[1] == pytest.approx(1350.0, abs=3 * 7.0)
    assert before > 1.0
    assert apart(visit) < 0.5  # N, what its noise is
    visit.picture("measure-laptop", full_page=True)
    page.get_by_role("button", name="Back to the drop before").click()
    assert visit.state("drop.contacts[0].stiffness") == 2500


def test_the_record_can_be_shifted_by_hand(visit):
    page = opened(visit)
    tried(page, "Force on the floor")
    page.wait_for_function("() => window.stackbounce.store.get().overlays.length")
    first = visit.state("overlays[0].time[0]")
    slider = page.locator("#record-shift")
    for _ in range(5):
        slider.press("ArrowRight")
    assert visit.state("overlays[0].time[0]") > first + 1e-4
    assert page.locator(".record-moved").inner_text().startswith("+")


def test_a_track_shows_how_much_is_lost(visit):
    page = opened(visit)
    tried(page, "Video of two balls")
    fitted(page)
    damping = [visit.state(f"drop.contacts[{i}].damping") for i in (0, 1)]
    assert damping == pytest.approx([8.0, 2.0], abs=0.5)


def test_a_dropped_file_is_read(visit):
    page = opened(visit)
    page.evaluate(
        """(text) => { const data = new DataTransfer();
             data.items.add(new File([text], 'heights.csv'));
             const event = new DragEvent('drop', { dataTransfer: data, bubbles: true });
             document.querySelector('.measure-out').dispatchEvent(event); }""",
        "Height (m)\n1.00\n0.62\n0.39\n0.24\n",
    )
    page.locator(".recognised b").wait_for()
    assert "heights.csv holds a table" in page.locator(".recognised").inner_text()
    assert "The file is of one ball alone" in page.locator(".fit").inner_text()
