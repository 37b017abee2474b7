"""The explorer as one file, opened from a disk: it computes, and asks for nothing."""

import pytest

import stackbounce as sb
from explorer.browser.test_measure import DROP_A_FILE

pytestmark = pytest.mark.slow
FORMS = ("one file",)

MOST = 1_500_000  # bytes


def test_it_is_small(one_file):
    assert one_file.stat().st_size < MOST


def test_it_computes_and_asks_for_nothing(visit, page, in_firefox):
    assert "1.803" in page.locator("#numbers").inner_text()
    visit.type("gaps.0", "2 mm")
    page.wait_for_function("() => state.result.drop.gaps[0] === 0.002")
    page.locator("[data-key=law-0]").select_option("Hysteretic")
    page.wait_for_function("() => state.result.drop.contacts[0].law === 'Hysteretic'")
    ratios = sb.simulate(visit.drop(), rtol=1e-10).rebound_ratios
    assert visit.state("result.rebound_ratios") == pytest.approx(ratios, rel=1e-12)
    asked = [url for url in visit.requests if not url.startswith("blob:null/")]
    assert asked == ([] if in_firefox else [visit.address])  # Firefox tells of none to the disk


def test_its_policy_lets_nothing_out(visit, page):
    policy = page.locator("meta[http-equiv]").get_attribute("content")
    assert policy.startswith("default-src 'none'; script-src 'sha256-")
    assert "unsafe-inline" not in policy
    answer = page.evaluate("() => fetch('https://example.org/').catch((error) => error.name)")
    assert answer == "TypeError"
    assert visit.script_is_refused()


def test_two_cells_of_a_notebook_are_two_explorers(visit, tmp_path):
    drop = sb.Drop([sb.Ball(0.6, name='"ä" & +'), sb.Ball(0.05)], [sb.Hertz(1e7)] * 2, height=1.0)
    cells = [drop.explore(height=700)._repr_html_(), sb.explore()._repr_html_()]
    notebook = tmp_path / "notebook.html"
    notebook.write_text(f'<!doctype html><meta charset="utf-8">{"".join(cells)}', "utf-8")
    visit.address = notebook.as_uri()
    visit.page.goto(visit.address)
    for frame, name in zip(visit.page.frames[1:], ('"ä" & +', "big basketball"), strict=True):
        frame.wait_for_function("() => state?.result && !state.busy")
        assert frame.evaluate("() => state.drop.balls[0].name") == name
    first = visit.page.frames[1]
    first.locator("#language select").select_option("de")
    first.locator("#tab-line").get_by_text("Kurve").click()
    first.locator("#line").get_by_text("Rückprall").first.wait_for()
    assert sb.Drop.from_mapping(first.evaluate("() => state.drop")) == drop
    assert first.url == "about:srcdoc"  # Firefox would lose a frame that has written an address


def test_what_it_cannot_do_is_said_and_a_dropped_file_changes_nothing(visit):
    page = visit.open("#view=measure")
    said = page.locator("#preset-says")
    assert (visit.state("view"), page.locator("#tab-measure").is_visible()) == ("play", False)
    assert "stackbounce app" in said.inner_text()
    page.evaluate("() => store.set({ notice: null })")
    assert page.evaluate(DROP_A_FILE, "1.00") == [False, False]
    assert (visit.state("view"), "stackbounce app" in said.inner_text()) == ("play", True)
    visit.type("balls.1.mass", "57 ± 1 g")
    page.locator("#numbers").get_by_text("“stackbounce app” opens a page that does").wait_for()


def test_the_papers_figures_play_in_it(visit, page):
    page.locator("#tab-paper").click()
    assert "stackbounce paper" in page.locator("#paper").inner_text()
    assert page.locator('a[href="paper/"]').is_hidden()
    page.get_by_role("button", name="Figure 6: tennis on basketball").click()
    assert (visit.state("view"), visit.state("line.x.path")) == ("line", "stiffness_ratio")
    page.locator("#tab-paper").click()
    page.get_by_role("button", name="Figure 5: two impacts on the floor").click()
    visit.ready()
    assert (visit.state("view"), visit.state("result.collisions[0]")) == ("play", 2)


def test_without_workers_it_says_what_it_needs(visit):
    page = visit.page
    page.add_init_script("window.Worker = class { constructor() { throw new Error('no'); } };")
    page.goto(visit.address)
    told = page.locator("#controls [role=alert]")
    told.filter(has_text="does not let this page start a worker").wait_for()
    assert visit.state("result") is None
    visit.complaints.clear()


def test_a_browser_without_webassembly_is_told_what_it_needs(visit):
    page = visit.page
    page.add_init_script("delete window.WebAssembly;")
    page.goto(visit.address)
    page.locator("#old").wait_for()
    assert "needs a browser" in page.locator("#old").inner_text()
