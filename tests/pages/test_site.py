"""`make site` finds what is wrong with a site."""

import shutil
import sys

import pytest
import site_check

pytestmark = pytest.mark.slow
PAGE = '<a href="gone.html">1</a><a href="#gone">2</a><img src="http://127.0.0.1:9/x.png">'


def test_what_is_wrong_is_found(tmp_path, monkeypatch, capsys):
    if not any(map(shutil.which, site_check.BROWSERS)):
        pytest.skip("there is no Chromium on this machine")
    for name in ("index.html", "search.html"):
        (tmp_path / name).write_text(PAGE)
    monkeypatch.setattr(sys, "argv", ["site_check.py", str(tmp_path)])
    monkeypatch.setattr(site_check, "SEARCHED", 100)
    assert site_check.main() == 1
    found = capsys.readouterr().out
    for words in ("leads to gone.html", "such place", "asks for", "image-alt", "finds nothing"):
        assert words in found
