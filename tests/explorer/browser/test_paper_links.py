"""The links of the paper's page open the drops and lines of its figures."""

import pytest

from stackbounce.cross2007.cases import link_figures

pytestmark = [pytest.mark.slow, pytest.mark.release]
FORMS = ("served",)


def test_figures_are_played_and_lines_opened(visit):
    links = link_figures("")
    visit.open(links["11b"][0].address)
    assert (visit.state("view"), visit.state("notice")) == ("play", None)
    assert visit.state("drop.gaps[0]") == pytest.approx(0.024, abs=1e-4)
    assert visit.state("result.intervals.length") > 9
    page = visit.page
    page.goto(f"{visit.address}{links['6'][1].address}")
    page.wait_for_function("() => state.view === 'line'")
    assert visit.state("line.x.path") == "stiffness_ratio"
    assert visit.state("drop.balls[1].name") == "B2"
    assert visit.state("notice") is None


def test_a_link_is_followed_though_the_page_writes_its_own_address_meanwhile(visit):
    line = link_figures("")["6"][1].address.partition("#")[2]
    page = visit.open()
    page.evaluate(
        """(link) => { const own = location.hash; location.hash = link;
             history.replaceState(history.state, "", own || "#"); }""",
        line,
    )
    page.wait_for_function("() => state.view === 'line'")
    assert page.evaluate("() => location.hash").startswith("#view=line")
