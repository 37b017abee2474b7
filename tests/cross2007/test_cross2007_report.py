"""What `stackbounce paper` writes: complete, self-contained, and the same every time."""

import csv
import json
import os
import subprocess
import sys
from html.parser import HTMLParser

import pytest

from refusals import refusal
from stackbounce import __version__, cross2007
from stackbounce.cross2007 import report
from stackbounce.cross2007.pages import typeset
from stackbounce.errors import FileError
from stopped_sweep import content

pytestmark = pytest.mark.slow  # the whole report is written twice

NAMES = "2a 2b 4a 4b 5 6 7 8 8-hollow 9 10a 10b 11a 11b 12 13".split()
VOID = {"meta", "img", "input", "br", "hr", "link"}


class Page(HTMLParser):
    """Collects what a page refers to, and sees that its tags match."""

    def __init__(self):
        super().__init__()
        self.open, self.ids, self.loads, self.links, self.text = [], [], [], [], []
        self.handle_data = self.text.append

    def handle_starttag(self, tag, attrs):
        self.open += [tag] if tag not in VOID else []
        for name, value in attrs:
            if name == "id":
                self.ids.append(value)
            elif name in ("src", "srcset", "data", "poster", "href"):
                (self.links if (tag, name) == ("a", "href") else self.loads).append(value)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag


@pytest.fixture(scope="module")
def told():
    return []


@pytest.fixture(scope="module")
def folder(tmp_path_factory, told):
    out = tmp_path_factory.mktemp("paper") / "new" / "folder"
    cross2007.write(out, told.append)
    return out


@pytest.fixture(scope="module")
def page(folder):
    page = Page()
    page.feed((folder / "index.html").read_text(encoding="utf-8"))
    return page


def test_all_files_and_no_others(folder):
    figures = {f"figures/figure-{name}.{end}" for name in NAMES for end in ("svg", "png")}
    others = {"index.html", "audit.csv", "audit.json", "stackbounce.sha256"}
    assert set(content(folder)) == others | figures


def test_it_says_what_it_is_doing(folder, told):
    assert any("audit" in line for line in told)
    assert [line for line in told if line.startswith("figure")] == [f"figure {n}" for n in NAMES]
    assert told[-1] == f"writing to {folder}"


def test_another_process_writes_the_same_bytes(tmp_path, monkeypatch):
    less = (
        "report.FIGURES = {name: report.FIGURES[name] for name in ('6', '12')};"
        "report.CLAIMS = {name: c for name, c in report.CLAIMS.items() if name[:2] in ('T1', 'T2')}"
    )
    monkeypatch.setattr(report, "FIGURES", report.FIGURES)  # put back at the end
    monkeypatch.setattr(report, "CLAIMS", report.CLAIMS)
    exec(less, {"report": report})
    cross2007.write(tmp_path / "here")
    code = f"import sys, pathlib; from stackbounce.cross2007 import report, write; {less};"
    code += "write(pathlib.Path(sys.argv[1]))"
    other = os.environ | {"PYTHONHASHSEED": "7", "TZ": "Asia/Tokyo"}
    subprocess.run([sys.executable, "-c", code, tmp_path / "there"], check=True, env=other)
    assert content(tmp_path / "there") == content(tmp_path / "here")


def test_the_page_loads_nothing(page):
    assert page.loads
    assert all(one.startswith("data:image/svg+xml;base64,") for one in page.loads)
    assert page.open == []


def test_the_page_links_to_what_exists(page, folder):
    assert len(set(page.ids)) == len(page.ids)
    for link in page.links:
        if link.startswith("#"):
            assert link[1:] in page.ids
        elif not link.startswith("https://doi.org/"):
            assert (folder / link).exists()


def test_the_page_has_every_row_figure_and_guess(page, folder):
    done = json.loads((folder / "audit.json").read_text(encoding="utf-8"))
    assert {row["id"] for row in done["rows"]} <= set(page.ids)
    assert {f"figure-{name}" for name in NAMES} <= set(page.ids)
    text = " ".join("".join(page.text).split())
    assert "Guessed" in text
    assert "Table II. Rebound ratios of the pairs." in text
    assert f"stackbounce {__version__}" in text


def test_json_has_rows_inputs_guesses_and_version_and_csv_the_same_rows(folder):
    done = json.loads((folder / "audit.json").read_text(encoding="utf-8"))
    assert done["stackbounce"] == __version__
    assert sum(done["counts"].values()) == len(done["rows"])
    assert all(row["verdict"] and row["explained"] for row in done["rows"])
    assert {one["key"] for one in done["inputs"]} == set(cross2007.PAPER)
    assert [one["name"] for one in done["figures"]] == NAMES
    assert all(one["guesses"] for one in done["figures"])
    with (folder / "audit.csv").open(encoding="utf-8", newline="") as stream:
        lines = [(line["id"], float(line["computed"])) for line in csv.DictReader(stream)]
    assert lines == [(row["id"], row["computed"]) for row in done["rows"]]


def test_a_file_in_the_way_is_told_before_any_work(tmp_path):
    page, told = tmp_path / "index.html", []
    page.write_text("mine", encoding="utf-8")
    for out in (page, page / "below"):
        assert str(out) in refusal(FileError, cross2007.write, out, told.append)
    said = refusal(FileError, cross2007.write, tmp_path, told.append)
    assert "index.html is there, and is not as this command" in said
    assert told == []
    assert page.read_text(encoding="utf-8") == "mine"


@pytest.mark.parametrize(
    ("text", "html"),
    [
        ("m1/m2 of B1", "m<sub>1</sub>/m<sub>2</sub> of B1"),
        ("1.03e4 N/m, 1e4", "1.03 × 10<sup>4</sup> N/m, 10<sup>4</sup>"),
        ("5 - sqrt(20)", "5 − √20"),
        ("<b> & e1", "&lt;b&gt; &amp; e<sub>1</sub>"),
        ("1.040 x 101 g", "1.040 × 101 g"),
        ("2 mm, 30 ms, D (mm), h1/h0", "2 mm, 30 ms, D (mm), h<sub>1</sub>/h<sub>0</sub>"),
        ("r_k and r_m, k1", "r<sub>k</sub> and r<sub>m</sub>, k<sub>1</sub>"),
        ("the balls' 'about', ('so')", "the balls\u2019 \u2018about\u2019, (\u2018so\u2019)"),
    ],
)
def test_signs_as_they_are_printed(text, html):
    assert str(typeset(text)) == html


def test_a_computed_number_has_two_digits_more_than_the_printed_one(folder, page):
    rows = json.loads((folder / "audit.json").read_text(encoding="utf-8"))["rows"]
    written = {row["id"]: row["computed"] for row in rows}
    assert f"{written['II.ten_springs']:.4f}" in page.text  # printed 1.13
    assert f"{written['II.fig5_slow']:.2f}" in page.text  # printed 19
