"""Links open drops and lines, such as those of the paper."""

from dataclasses import asdict

import pytest

from stackbounce.cross2007.cases import explorer_address, list_cases, list_lines

pytestmark = [pytest.mark.slow, pytest.mark.release]
FORMS = ("served",)


def line_of_figure_6():
    line = next(line for line in list_lines() if line.name == "figure-6-B2")
    view = {"view": "line", "line": {"x": asdict(line.across), "show": "rebound_ratio"}}
    return explorer_address(line.drop, view)


def test_drops_are_played_and_lines_opened(visit):
    drop = next(case.drop for case in list_cases() if case.name == "B1-on-B3-late")
    visit.open(explorer_address(drop, {}))
    assert (visit.state("view"), visit.state("notice")) == ("play", None)
    assert visit.state("drop.gaps[0]") == pytest.approx(0.024, abs=1e-4)
    assert visit.state("result.intervals.length") > 9
    page = visit.page
    page.goto(f"{visit.address}{line_of_figure_6()}")
    page.wait_for_function("() => state.view === 'line'")
    assert visit.state("line.x.path") == "stiffness_ratio"
    assert visit.state("drop.balls[1].name") == "B2"
    assert visit.state("notice") is None


def test_a_link_is_followed_though_the_page_writes_its_own_address_meanwhile(visit):
    line = line_of_figure_6().removeprefix("#")
    page = visit.open()
    page.evaluate(
        """(link) => { const own = location.hash; location.hash = link;
             history.replaceState(history.state, "", own || "#"); }""",
        line,
    )
    page.wait_for_function("() => state.view === 'line'")
    assert page.evaluate("() => location.hash").startswith("#view=line")
