"""The views of the page by axe-core, which knows the rules of WCAG and of ARIA: no violations."""

from importlib.resources import files

import pytest

AXE = (files("axe_playwright_python") / "axe.min.js").read_text("utf-8")
OPEN = "() => document.querySelectorAll('main details').forEach((one) => (one.open = true))"
VIOLATIONS = """async () => {
  const { violations, passes } = await axe.run();
  const found = violations.map(({ id, nodes }) => `${id}: ${nodes[0].html.slice(0, 120)}`);
  return [found, passes.length];
}"""


@pytest.mark.slow
@pytest.mark.release
@pytest.mark.parametrize(
    ("width", "colors"), [(1366, "light"), (1366, "dark"), (390, "light"), (390, "dark")]
)
def test_axe_finds_nothing_to_change(browser, address_of_server, width, colors):
    size = {"width": width, "height": 800}
    context = browser.new_context(viewport=size, color_scheme=colors, bypass_csp=True)
    try:
        page = context.new_page()
        page.goto(address_of_server)
        page.wait_for_function("() => window.stackbounce?.store.get().result")
        page.evaluate(AXE)
        for view in ("play", "line", "map", "measure", "paper"):
            page.locator(f"#tab-{view}").click()
            page.locator(f"#{view} :is(h2, svg, canvas, label)").first.wait_for(state="attached")
            page.evaluate("() => window.stackbounce.clock.pause()")
            page.evaluate(OPEN)
            found, passed = page.evaluate(VIOLATIONS)
            assert passed > 30, "axe has not seen the page"
            assert not found, view
        page.locator("#tab-play").click()
        for opens in ("#lessons-open", "[data-key=lesson-gap]"):
            page.locator(opens).click()
            page.evaluate(OPEN)
            found, passed = page.evaluate(VIOLATIONS)
            assert page.locator("#lesson").is_visible()
            assert not found, opens
    finally:
        context.close()
