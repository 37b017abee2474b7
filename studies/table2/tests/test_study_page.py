"""The study's page: complete, self-contained, linked, whatever numbers came out."""

import json
import struct
from dataclasses import replace
from html.parser import HTMLParser

import numpy as np
import pytest
from studies.table2 import (
    basketball,
    choice_fits,
    cross_validation,
    readings,
    results,
    sensitivity,
)
from studies.table2.catalogue import NAMES, THEORIES
from studies.table2.choices import BASE, CHOICES
from studies.table2.observed import observe
from studies.table2.page import write

from stackbounce.fitting import Fit
from stackbounce.fitting.least_squares import Minimum

pytestmark = pytest.mark.slow

FIGURES = ["comparison", "misfits", "delays", "energy", "decisive"]


def looked_at(model, data, *_, **__):
    """Stands for a fit: one trial in the middle, gaps of 5 mm."""
    objective = observe(replace(model, data=data))
    x = np.array(
        [5e-3 if one.name.endswith("gaps.0") else sum(one.span) / 2 for one in objective.parameters]
    )
    x = np.clip(x, objective.spans[:, 0], objective.spans[:, 1])
    return Fit(objective, [Minimum(x, float(objective.chi_squared(x[None])[0]), True)])


@pytest.fixture(scope="module")
def told():
    return []


@pytest.fixture(scope="module")
def folder(tmp_path_factory, told):
    out = tmp_path_factory.mktemp("study")
    with pytest.MonkeyPatch.context() as patch:
        for module in (choice_fits, readings, basketball):
            patch.setattr(module, "fit_model", looked_at)
        for module in (choice_fits, sensitivity):
            patch.setattr(module, "fit_near", looked_at)
        for module in (sensitivity, cross_validation):
            patch.setattr(module, "refit", looked_at)
        patch.setattr(results, "refit_section_v", list)
        write(out, told.append)
    return out


class Page(HTMLParser):
    """Collects what a page refers to, and sees that its tags match."""

    def __init__(self):
        super().__init__()
        self.open, self.ids, self.loads, self.links, self.text = [], [], [], [], []

    def handle_starttag(self, tag, attrs):
        attrs = dict(attrs)
        if tag not in {"meta", "img", "br", "link"}:
            self.open.append(tag)
        if "id" in attrs:
            self.ids.append(attrs["id"])
        if "src" in attrs:
            self.loads.append(attrs["src"])
        if "href" in attrs and tag == "a":
            self.links.append(attrs["href"])

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        self.text.append(data)


@pytest.fixture(scope="module")
def page(folder):
    page = Page()
    page.feed((folder / "study.html").read_text(encoding="utf-8"))
    return page


def test_its_files_lie_beside_the_reports(folder):
    for name in FIGURES:
        assert (folder / "figures" / f"study-{name}.svg").stat().st_size > 1000
        png = (folder / "figures" / f"study-{name}.png").read_bytes()
        assert struct.unpack(">II", png[16:24])[0] > 1000


def test_it_loads_nothing_and_its_links_lead_somewhere(page, folder):
    assert page.open == []
    assert len(page.loads) == len(FIGURES)
    assert all(one.startswith("data:image/svg+xml;base64,") for one in page.loads)
    assert len(set(page.ids)) == len(page.ids)
    for link in page.links:
        assert link[1:] in page.ids if link.startswith("#") else (folder / link).exists()


def test_every_model_is_there(page, folder):
    text = " ".join("".join(page.text).split())
    done = json.loads((folder / "study.json").read_text(encoding="utf-8"))
    names = {*THEORIES, *NAMES}
    assert {one["name"] for one in done["models"]} == names
    for one in done["models"]:
        assert one["title"] in text
        assert set(one["pairs"]) == set(done["data"][BASE.name])
    assert "nan" not in text.lower().replace("resonant", "")


def test_every_choice_is_there(page, folder):
    text = " ".join("".join(page.text).split())
    done = json.loads((folder / "study.json").read_text(encoding="utf-8"))
    assert done["headline"] in text
    for one in done["claims"]:
        assert len(one["holds"]) + len(one["fails"]) == len(CHOICES)
    for choice in CHOICES:
        assert choice.name in text
        assert all(choice.name in row for row in done["choices"]["cells"].values())


def test_the_basketball_is_there_with_all_its_theories(page, folder):
    text = " ".join("".join(page.text).split())
    done = json.loads((folder / "study.json").read_text(encoding="utf-8"))
    assert len(done["basketball"]) == 2 * len(basketball.READINGS) * len(basketball.THEORIES)
    assert len(done["buckling"]) == 18
    assert [one["reading"] for one in done["basketball_limits"]] == [
        one.name for one in basketball.READINGS
    ]
    for theory in basketball.THEORIES:
        assert theory.name in text


def test_it_says_what_it_is_doing(told):
    assert any("model 'S'" in line for line in told)
    assert [line for line in told if line.startswith("figure study")] == [
        f"figure study-{name}" for name in FIGURES
    ]
