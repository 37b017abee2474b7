"""The paper's page as the explorer serves it, and the addresses of drops there."""

import re
from urllib.parse import parse_qsl

import pytest

from stackbounce import cross2007
from stackbounce.cross2007 import report
from stackbounce.cross2007.bench import PAPER, Bench
from stackbounce.cross2007.cases import explorer_address
from stackbounce.cross2007.stacks import better_fit
from stackbounce.model import Drop

FEW = ("7", "9")


@pytest.fixture
def short(monkeypatch):
    """Leave the report one section and two figures."""
    monkeypatch.setattr(
        report, "CLAIMS", {name: report.CLAIMS[name] for name in ("I.speed", "I.gain")}
    )
    monkeypatch.setattr(report, "FIGURES", {name: report.FIGURES[name] for name in FEW})


def written(folder, **options):
    cross2007.write(folder, **options)
    page = (folder / "index.html").read_text(encoding="utf-8")
    return [address.replace("&amp;", "&") for address in re.findall(r'href="([^"]+)"', page)]


@pytest.mark.slow
@pytest.mark.usefixtures("short")
def test_the_page_leads_back_to_the_explorer_that_serves_it_and_by_itself_to_none(tmp_path):
    assert not [address for address in written(tmp_path) if "../" in address]
    assert written(tmp_path, explorer="../")[0] == "../"


def test_an_address_has_the_drop():
    fitted = better_fit(Bench(PAPER))
    drop = {"balls": [{}, {}], "contacts": [{}, {}], "gaps": [0.0]}
    for path, text in parse_qsl(explorer_address(fitted, {}).removeprefix("#")):
        name, _, rest = path.partition(".")
        value = float(text) if re.fullmatch(r"[\d.e+-]+", text) else text
        if name in ("balls", "contacts"):
            drop[name][int(rest[0])][rest[2:]] = value
        elif name != "view":
            drop |= {name: [value] if name == "gaps" else value}
    found = Drop.from_mapping(drop)
    assert (found.contacts, found.impact_speed) == (fitted.contacts, fitted.impact_speed)
    assert found.gaps == (0.0,)
    assert [ball.mass for ball in found.balls] == [ball.mass for ball in fitted.balls]
