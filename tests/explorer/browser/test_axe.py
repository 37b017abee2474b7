"""The views of the page by axe-core, which knows the rules of WCAG and of ARIA: no violations."""

from importlib.resources import files

import pytest

pytestmark = [pytest.mark.slow, pytest.mark.release]
FORMS = ("served",)
AXE = (files("axe_playwright_python") / "axe.min.js").read_text("utf-8")
OPEN = "() => document.querySelectorAll('main details').forEach((one) => (one.open = true))"
VIOLATIONS = """async () => {
  const { violations, passes } = await axe.run();
  const found = violations.map(({ id, nodes }) => `${id}: ${nodes[0].html.slice(0, 120)}`);
  return [found, passes.length];
}"""


@pytest.mark.parametrize("width", [1366, 390])
@pytest.mark.parametrize("colors", ["light", "dark"])
def test_axe_finds_nothing_to_change(visits, width, colors):
    size = {"width": width, "height": 800}
    page = visits(viewport=size, color_scheme=colors, bypass_csp=True).open("")
    page.evaluate(AXE)
    for moment in ("clock.time", "clock.film.length"):  # the question and the answer
        page.evaluate(f"() => clock.wind({moment})")
        page.wait_for_timeout(200)
        assert page.evaluate(VIOLATIONS)[0] == [], moment
    page.locator("#closer").click()
    for view in ("line", "map", "measure", "paper", "play"):
        page.locator(f"#tab-{view}").click()
        page.locator(f"#{view} :is(h2, svg, canvas, label)").first.wait_for(state="attached")
        page.evaluate("() => clock.pause()")
        page.evaluate(OPEN)
        found, passed = page.evaluate(VIOLATIONS)
        assert passed > 30, "axe has not seen the page"
        assert not found, view
    page.evaluate("() => store.set({ predict: true, guess: null })")
    assert page.evaluate(VIOLATIONS)[0] == []
    for opens in ("#lessons-open", "[data-key=lesson-gap]"):
        page.locator(opens).click()
        page.evaluate(OPEN)
        found, _ = page.evaluate(VIOLATIONS)
        assert page.locator("#lesson").is_visible()
        assert not found, opens
